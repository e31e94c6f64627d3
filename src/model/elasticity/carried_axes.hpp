// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Checks of the axes of anisotropic materials. The axes must be defined in all cells, and the
/// motion of a body must not change them: matter that arrives at a place must have the elastic law
/// of this place.
#include <vector>

#include "model/elasticity/motion.hpp"
#include "model/material/material.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

/// Collective. Checks that the motion of each body leaves the laws of its materials unchanged: the
/// law at a point, moved with the matter, is the law at the place that the point reaches. This is
/// true for isotropic laws, for cylindrical axes about the axis of rotation, for an axis of
/// transverse isotropy along the axis of rotation, and for uniform laws under translation.
/// Otherwise throws Error with `convective` terms, and warns without them: under approximation A
/// (docs/method.md) the axes stay at rest while the matter moves.
void checkCarriedAxes(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
                      const std::vector<Motion>& motions, bool convective);

/// Collective. Throws Error if the centre of a cell lies on the axis of the cylindrical axes of its
/// material, up to round-off, unless the law is symmetric about this axis: the radial direction is
/// not defined there.
void requireMaterialAxes(const mesh::Mesh& mesh, const std::vector<material::Material>& materials);

}  // namespace squeal::elasticity
