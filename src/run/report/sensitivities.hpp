// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Tables of the sensitivities of the stored complex modes, and of the work of friction on them.
#include <string>

#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// Returns the first cells of a table row on a stored complex mode: the parameters of the point,
/// and the number, growth rate and frequency of the mode.
std::string modeHead(const pencil::ComplexModes& point, const pencil::Shape& shape);

/// Returns sensitivities.csv: the derivatives of the eigenvalues of the stored complex modes, one
/// row per mode and parameter. A mode without derivatives has one row with the parameter "none".
std::string sensitivityTable(const analysis::Analysis& analysis);

/// Collective. Returns friction_work.csv: the contribution of friction on each interface to the
/// growth rates of the stored complex modes, 1/s (terms::frictionGrowth).
std::string frictionWorkTable(const analysis::Analysis& analysis);

}  // namespace squeal::report
