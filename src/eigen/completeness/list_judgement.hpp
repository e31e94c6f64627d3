// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The judgement of the list of a point by discs that contain one eigenvalue each.
#include <vector>

#include "eigen/pencil/band.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/proof/contour.hpp"
#include "eigen/proof/enclosure.hpp"

namespace squeal::completeness {

/// Not collective. Sets the radii of the listed eigenvalues, and in ComplexModes::completeness
/// what is missing, spurious or undecided. Completeness::proved must be set. `discs` are the
/// enclosures of all eigenvalues of the reduced problem in the region. `band` has the largest
/// damping ratio of listed eigenvalues; its top is not used.
void judgeList(const std::vector<proof::Enclosure>& discs, const proof::Region& region,
               pencil::WatchedBand band, pencil::ComplexModes& point);

}  // namespace squeal::completeness
