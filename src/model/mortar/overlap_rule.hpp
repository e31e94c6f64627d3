// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The number of integration points of a part of a slave face.
#include <vector>

#include "model/mortar/clip.hpp"
#include "model/mortar/face.hpp"
#include "model/mortar/facet.hpp"

namespace squeal::mortar {

/// Returns a rule for the products of shape functions of both faces over a tile of their overlap,
/// which lies in the plane of the frame. `whole` says that neither face is split there.
///
/// On affine faces the rule is exact. On other flat faces with straight edges each function is
/// integrated to rounding. These then hand over a uniform pressure like affine ones. Not
/// collective.
std::vector<WeightedPoint> overlapRule(const Region& tile, const Frame& frame, const Face& slave,
                                       const Face& master, bool whole);

}  // namespace squeal::mortar
