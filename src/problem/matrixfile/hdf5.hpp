// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A matrix from an HDF5 file; MATLAB files of version 7.3 are HDF5 files.
#include <filesystem>
#include <string>

#include "problem/matrixfile/formats.hpp"

namespace squeal::matrixfile {

/// Reads the object `name` of an HDF5 file. An empty name means the only matrix among the objects
/// of the root group, or the root group itself; a 1 × 1 dataset is considered only if there is no
/// other matrix. The object is a dataset of two dimensions, or a group with the datasets data,
/// indices and indptr of a compressed matrix, as SciPy users and anndata write it. The attribute
/// "format", "h5sparse_format" or "encoding-type" of the group, or its dataset "format", must begin
/// with csr or csc. Without this text the matrix must be symmetric: lists by rows and by columns
/// are then the same. In MATLAB files of version 7.3, the object is a group with data, ir and jc,
/// or a dataset of class double or single. Throws Error if the file has none or several such
/// matrices, and for complex or damaged content.
Entries readHdf5(const std::filesystem::path& path, const std::string& name);

}  // namespace squeal::matrixfile
