// SPDX-License-Identifier: BSD-2-Clause
#include "problem/matrixfile/matlab_variable.hpp"

namespace squeal::matrixfile {

Entries full(const Variable& variable, const std::vector<double>& values) {
  Entries entries(variable.shape.at(0), variable.shape.at(1));
  for (long long j = 0, k = 0; j < variable.shape[1]; ++j)
    for (long long i = 0; i < variable.shape[0]; ++i, ++k) entries.add(i, j, values[k]);
  return entries;
}

}  // namespace squeal::matrixfile
