// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A matrix from an HDF5 file; MATLAB files of version 7.3 are HDF5 files.
#include <filesystem>
#include <string>

#include "problem/matrixfile/formats.hpp"

namespace squeal::matrixfile {

/// Reads the object `name` of an HDF5 file. An empty name means the only matrix among the objects
/// of the root, or the root itself; a 1 × 1 dataset counts only if there is no other. The object is
/// a dataset of two dimensions, or a group with the datasets data, indices and indptr of a
/// compressed matrix, as SciPy users and anndata write it. The attribute "format",
/// "h5sparse_format" or "encoding-type" of the group, or its dataset "format", begins with csr or
/// csc; without it, the matrix must be symmetric, so the order does not matter. MATLAB files of
/// version 7.3 are read too: groups with data, ir and jc, and datasets of class double or single.
/// Throws Error as readMatlab() does.
Entries readHdf5(const std::filesystem::path& path, const std::string& name);

}  // namespace squeal::matrixfile
