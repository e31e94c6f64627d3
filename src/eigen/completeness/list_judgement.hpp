// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Judges the list of eigenvalues of a point of the sweep by discs in the complex plane that
/// contain one eigenvalue each.
#include <vector>

#include "eigen/pencil/band.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/proof/contour.hpp"
#include "eigen/proof/count.hpp"
#include "eigen/proof/enclosure.hpp"
#include "eigen/proof/reason.hpp"

namespace squeal::completeness {

/// The top of the region of a proof lies between the top of the band and (1 + above) times the top
/// of the band, in a gap between eigenvalues: placedTop(…, wantedTop(top of the band), within).
inline constexpr double above = 0.08;
/// Half the width of this range, relative to wantedTop(), which is its middle.
inline constexpr double within = above / (2 + above);
inline double wantedTop(double bandTop) { return (1 + above / 2) * bandTop; }

/// Returns the options to change so that a proof in a sweep succeeds. `modes` is the option for the
/// number of free modes; it is empty if more modes do not help.
proof::Remedies remedies(const char* modes);

/// Not collective. Records the count, its region and the sizes of its proof. The reason, which
/// depends on the remedies, is not set.
void recordCount(const proof::Region& region, const proof::CountProof& count,
                 pencil::Completeness& found);

/// Not collective. Replaces what a second proof of a point has found by what the first one had, if
/// the second one has failed or no longer proves the count; returns true if so. Discs of both
/// remain valid.
bool keepBetter(pencil::Completeness first, pencil::Completeness& found);

/// Not collective. Sets Eigenvalue::radius of the listed eigenvalues, and records in
/// ComplexModes::completeness which eigenvalues are missing, spurious or undecided.
/// Completeness::proved must be set. `discs` are the enclosures of all eigenvalues of the reduced
/// problem in the region. `band` gives the largest damping ratio of listed eigenvalues; its top is
/// not used.
void judgeList(const std::vector<proof::Enclosure>& discs, const proof::Region& region,
               pencil::WatchedBand band, pencil::ComplexModes& point);

}  // namespace squeal::completeness
