// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Quadrature rules for parts of a slave face.
#include <vector>

#include "model/mortar/clip.hpp"
#include "model/mortar/face.hpp"
#include "model/mortar/facet.hpp"

namespace squeal::mortar {

/// Returns a rule for the products of shape functions of both faces over a tile of their overlap,
/// in the plane of the frame. `whole` is true if neither face is split into triangles there.
///
/// On affine faces the rule is exact. On other flat faces with straight edges it integrates each
/// shape function within round-off, so such faces transmit a uniform pressure as affine faces do.
/// Not collective.
std::vector<WeightedPoint> overlapRule(const Region& tile, const Frame& frame, const Face& slave,
                                       const Face& master, bool whole);

}  // namespace squeal::mortar
