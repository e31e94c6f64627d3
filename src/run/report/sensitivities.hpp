// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// These functions return tables of what the complex modes kept depend on, and of what feeds them.
#include <string>

#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// Returns sensitivities.csv: the derivatives of the eigenvalues of the complex modes kept, with a
/// row per mode and parameter. A mode without derivatives has one row, "none".
std::string sensitivityTable(const analysis::Analysis& analysis);

/// Collective. Returns friction_work.csv: the contribution of friction on each interface to the
/// growth rates of the complex modes kept, 1/s (terms::frictionWork).
std::string frictionWorkTable(const analysis::Analysis& analysis);

}  // namespace squeal::report
