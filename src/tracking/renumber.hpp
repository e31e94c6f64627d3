#pragma once
/// The numbers by which the branches of a followed sweep are known to the user.
#include "tracking/track.hpp"

namespace squeal::tracking {

/// Not collective. Drops the events of what is watched beside the band alone, whose number becomes
/// 0, and numbers the rest from 1 by the station where they begin, there by frequency, then the
/// fastest growing first. Eigenvalues that are equal there but for rounding are ordered by the next
/// station where they differ. A partner that is none or outside of the band is 0.
void renumber(Branches& branches);

}  // namespace squeal::tracking
