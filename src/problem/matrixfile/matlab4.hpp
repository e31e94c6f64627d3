// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The variables of MATLAB files of version 4.
#include <vector>

#include "problem/matrixfile/bytes.hpp"
#include "problem/matrixfile/formats.hpp"
#include "problem/matrixfile/matlab_variable.hpp"

namespace squeal::matrixfile {

/// Returns all variables in the order of the file. Throws Error if their sizes do not add up to
/// that of the file, and for damaged headers.
std::vector<Variable> variablesOfVersion4(BinaryFile& file);

/// Reads a variable that is `real` and has two dimensions. Throws Error for damaged content.
Entries readVersion4(BinaryFile& file, const Variable& variable);

}  // namespace squeal::matrixfile
