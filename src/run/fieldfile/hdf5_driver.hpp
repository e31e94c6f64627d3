// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The driver with which HDF5 writes to the disk.
#include <hdf5.h>

#include <string>

namespace squeal::fieldfile {

/// Not collective. Returns properties for H5Fcreate() that select this driver; negative on failure.
/// The caller closes them with H5Pclose().
///
/// After a failed write, HDF5 1.10 cannot close the file, and crashes when the program ends. This
/// driver (for one rank, and one file at a time) therefore reports success to the library, discards
/// all writes after the failure, and stores the error for recordedError().
hid_t errorRecordingProperties();
/// Not collective. Returns errno of the first call on the file (write, truncate or close) that has
/// failed since its creation; 0 if none has failed.
int recordedError();
/// Not collective. Returns why the file could not be opened; empty if it was opened.
const std::string& refusalReason();

}  // namespace squeal::fieldfile
