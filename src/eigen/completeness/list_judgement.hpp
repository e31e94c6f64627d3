// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The judgement of the list of a point by discs that contain one eigenvalue each.
#include <vector>

#include "eigen/pencil/band.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/proof/contour.hpp"
#include "eigen/proof/enclosure.hpp"
#include "eigen/proof/reason.hpp"

namespace squeal::completeness {

/// The top of the region of a proof lies in a gap of the eigenvalues between the top of the band
/// and (1 + above) times this top: placedTop(…, wantedTop(top of the band), within).
inline constexpr double above = 0.08;
inline constexpr double within = above / (2 + above);
inline double wantedTop(double bandTop) { return (1 + above / 2) * bandTop; }

/// Returns the options that help a proof in a sweep. `modes` is the one for the number of free
/// modes, empty if more modes do not help.
proof::Remedies remedies(const char* modes);

/// Not collective. Sets the radii of the listed eigenvalues, and in ComplexModes::completeness
/// what is missing, spurious or undecided. Completeness::proved must be set. `discs` are the
/// enclosures of all eigenvalues of the reduced problem in the region. `band` has the largest
/// damping ratio of listed eigenvalues; its top is not used.
void judgeList(const std::vector<proof::Enclosure>& discs, const proof::Region& region,
               pencil::WatchedBand band, pencil::ComplexModes& point);

}  // namespace squeal::completeness
