#pragma once
/// These functions read what HDF5 files hold, with the checks that the HDF5 library leaves to its
/// users.
#include <string>
#include <vector>

#include "petsc/hdf5.hpp"

namespace squeal::matrixfile {

using hdf5::AttributeId;
using hdf5::DatasetId;
using hdf5::FileId;
using hdf5::ObjectId;
using hdf5::PropertiesId;
using hdf5::Silence;
using hdf5::SpaceId;
using hdf5::TypeId;

/// The cause of HDF5's last failure, " (truncated file: ...)", or nothing.
std::string cause();

bool has(hid_t group, const std::string& name);
bool hasAttribute(hid_t object, const std::string& name);

/// Empty for a scalar and for what has no extent.
std::vector<hsize_t> shapeOf(hid_t dataset);

/// Integers, or reals. Error: of another type or number of dimensions; values that the file does
/// not hold, since they were never written or lie in other files.
std::vector<long long> integers(hid_t group, const std::string& name);
std::vector<double> reals(hid_t group, const std::string& name, int dimensions = 1);

/// Text of an attribute, or of a dataset, a single one of up to 64 characters, of fixed or variable
/// length; otherwise empty.
std::string textOfAttribute(hid_t object, const std::string& name);
std::string textOfDataset(hid_t group, const std::string& name);

/// Integers of an attribute; empty if there is none, or of another kind.
std::vector<long long> integersOfAttribute(hid_t object, const std::string& name);

}  // namespace squeal::matrixfile
