// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Runs the method as a user would: options in, the whole analysis out.
#include <petscsys.h>

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <string>

#include "base/options/settings.hpp"
#include "base/petsc/check.hpp"
#include "run/analysis/analysis.hpp"

namespace squeal::test {

/// Collective. Runs with only these options.
inline analysis::Analysis runOptions(const std::string& options) {
  clearOptions();
  insert(settingsOfText("-quiet " + options));
  return analysis::analyse(PETSC_COMM_WORLD, analysis::Settings::given());
}

/// Collective. Runs a case file with a few options changed.
inline analysis::Analysis runCase(const std::string& name, const std::string& changes = {}) {
  clearOptions();
  insertFile(PETSC_COMM_WORLD, "options/" + name + ".yaml");
  insert(settingsOfText("-quiet " + changes));
  return analysis::analyse(PETSC_COMM_WORLD, analysis::Settings::given());
}

/// Measured figures, once for all ranks.
[[gnu::format(printf, 1, 2)]] inline void print(const char* format, ...) {
  int rank = 0;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank != 0) return;
  va_list arguments;
  va_start(arguments, format);
  std::vprintf(format, arguments);
  va_end(arguments);
}

/// Collective. The largest value of all ranks; a NaN of any rank is the result.
inline double largest(double value) {
  double both[] = {std::isnan(value) ? 1.0 : 0.0, std::isnan(value) ? 0.0 : value};
  check(MPI_Allreduce(MPI_IN_PLACE, both, 2, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  return both[0] > 0 ? NAN : both[1];
}

/// Collective. The sum over all ranks.
inline double total(double value) {
  check(MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
  return value;
}

}  // namespace squeal::test
