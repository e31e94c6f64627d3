// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The contents of HDF5 files, with checks that the HDF5 library itself does not make.
#include <string>
#include <vector>

#include "base/petsc/hdf5.hpp"

namespace squeal::matrixfile {

using hdf5::AttributeId;
using hdf5::DatasetId;
using hdf5::FileId;
using hdf5::ObjectId;
using hdf5::PropertiesId;
using hdf5::Silence;
using hdf5::SpaceId;
using hdf5::TypeId;

/// Returns the cause of HDF5's last failure, such as " (truncated file: ...)"; empty if it is not
/// known.
std::string cause();

bool has(hid_t group, const std::string& name);
bool hasAttribute(hid_t object, const std::string& name);

/// Returns the extents of a dataset; empty for a scalar and for a dataset without extent.
std::vector<hsize_t> shapeOf(hid_t dataset);

/// Return the values of a dataset. Throw Error if the dataset has another type or number of
/// dimensions, or if its values are not in the file (never written, or in other files).
std::vector<long long> integers(hid_t group, const std::string& name);
std::vector<double> reals(hid_t group, const std::string& name, int dimensions = 1);

/// Return the text of an attribute or dataset that consists of a single text. A text of fixed
/// length may have up to 64 characters; one of variable length is truncated to 64. In all other
/// cases the result is empty.
std::string textOfAttribute(hid_t object, const std::string& name);
std::string textOfDataset(hid_t group, const std::string& name);

/// Returns the integers of an attribute; empty if the attribute does not exist, has another type,
/// or has more than 64 integers.
std::vector<long long> integersOfAttribute(hid_t object, const std::string& name);

}  // namespace squeal::matrixfile
