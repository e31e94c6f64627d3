// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Runs the method as a user would: options in, the whole analysis out.
#include <petscsys.h>

#include <string>

#include "base/options/settings.hpp"
#include "run/analysis/analysis.hpp"
#include "support/harness/ranks.hpp"

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

}  // namespace squeal::test
