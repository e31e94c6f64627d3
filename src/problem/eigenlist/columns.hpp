// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Eigenvalues in columns.
#include <optional>
#include <vector>

#include "problem/eigenlist/lines.hpp"
#include "problem/eigenlist/list.hpp"

namespace squeal::eigenlist {

/// Returns the eigenvalues of rows "real imaginary", conjugates included, or of a table like
/// eigenvalues.csv, whose header names growth_rate_1_per_s and angular_frequency_rad_per_s among
/// other columns. Lines that begin with # or % are headers or comments. The header gives the unit
/// by the words rad, 1/s or Hz, the same unit for both columns. Without such a header, `unit` gives
/// it. Sets `layout` to a text like that of layoutOf(). Throws Error if the unit is not known, or
/// if header and `unit` state different units.
std::vector<Complex> columns(const std::vector<Line>& lines, std::optional<Unit> unit,
                             std::string& layout);

}  // namespace squeal::eigenlist
