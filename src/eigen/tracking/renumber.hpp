// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Numbering of the branches for the output.
#include "eigen/tracking/track.hpp"

namespace squeal::tracking {

/// Not collective. Numbers the branches that are in the band at some station, beginning with 1.
/// They are ordered by the stations where they begin and, at the same station, by ascending
/// frequency, then by descending growth rate. Eigenvalues that are equal there within round-off are
/// ordered by the next station where they differ. Branches that are never in the band get the
/// number 0, and their events are removed. Partners that are missing or never in the band get the
/// number 0.
void renumber(Branches& branches);

}  // namespace squeal::tracking
