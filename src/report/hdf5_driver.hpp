#pragma once
/// The driver with which HDF5 writes to the disc.
#include <hdf5.h>

namespace squeal::report {

/// After a write that fails HDF5 1.10 cannot close its file, and crashes when the program ends.
/// This driver (one rank, one file at a time) therefore tells the library that all goes well, drops
/// what comes after the failure, and keeps the reason for us.
///
/// Properties for H5Fcreate, to be closed with H5Pclose.
hid_t keepingErrorsProperties();
/// Returns errno of the first write that failed since the file was made; 0 if none has.
int keptError();

}  // namespace squeal::report
