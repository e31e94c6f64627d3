// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The numbers of the branches in the output.
#include "eigen/tracking/track.hpp"

namespace squeal::tracking {

/// Not collective. Numbers the branches that are in the band at some station from 1, by the station
/// where they begin, there by ascending frequency, then by descending growth rate. Eigenvalues that
/// are equal there up to rounding are ordered by the next station where they differ. Branches that
/// are never in the band get the number 0, and their events are dropped. A partner that is none or
/// never in the band becomes 0.
void renumber(Branches& branches);

}  // namespace squeal::tracking
