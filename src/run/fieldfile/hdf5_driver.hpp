// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The driver with which HDF5 writes to the disk.
#include <hdf5.h>

#include <string>

namespace squeal::fieldfile {

/// Not collective. Returns properties for H5Fcreate that select this driver; negative on failure.
/// Close them with H5Pclose.
///
/// After a write that fails HDF5 1.10 cannot close its file, and crashes when the program ends.
/// This driver (one rank, one file at a time) therefore reports success to the library, discards
/// all writes after the failure, and stores the reason for recordedError().
hid_t errorRecordingProperties();
/// Not collective. Returns errno of the first failed call on the file since its creation (write,
/// truncate or close); 0 if there is none.
int recordedError();
/// Not collective. Returns why the file could not be opened; empty if it was.
const std::string& refusalReason();

}  // namespace squeal::fieldfile
