// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// HDF5 writes to the disc with this driver.
#include <hdf5.h>

#include <string>

namespace squeal::fieldfile {

/// Not collective. Returns properties for H5Fcreate that choose this driver, to be closed with
/// H5Pclose; negative if it cannot be chosen.
///
/// After a write that fails HDF5 1.10 cannot close its file, and crashes when the program ends.
/// This driver (one rank, one file at a time) therefore reports success to the library, drops all
/// writes after the failure, and stores the reason for keptError().
hid_t keepingErrorsProperties();
/// Not collective. Returns errno of the first call on the file that failed since it was made, be it
/// to write, truncate or close it; 0 if none has.
int keptError();
/// Not collective. Returns why the file could not be opened; empty if it was.
const std::string& keptRefusal();

}  // namespace squeal::fieldfile
