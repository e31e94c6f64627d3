// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Numbering of the branches for the output.
#include "eigen/tracking/track.hpp"

namespace squeal::tracking {

/// Not collective. Numbers the branches that are in the band at some station, beginning with 1.
/// Their order is that of the stations where they begin; at one station, ascending frequency, then
/// descending growth rate. Eigenvalues that are equal there within round-off are ordered by the
/// next station where they differ. Branches that are never in the band get the number 0, and their
/// events are removed. Missing partners, and partners that are never in the band, become 0.
void renumber(Branches& branches);

}  // namespace squeal::tracking
