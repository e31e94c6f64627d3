// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The variables of MATLAB files of version 4.
#include <vector>

#include "problem/matrixfile/bytes.hpp"
#include "problem/matrixfile/formats.hpp"
#include "problem/matrixfile/matlab_variable.hpp"

namespace squeal::matrixfile {

/// Returns all variables in the order of the file. Throws Error for damaged headers, and if the
/// sizes of the variables do not add up to that of the file.
std::vector<Variable> variablesOfVersion4(BinaryFile& file);

/// Reads a variable, which must be `real` and have two dimensions. Throws Error for damaged
/// content.
Entries readVersion4(BinaryFile& file, const Variable& variable);

}  // namespace squeal::matrixfile
