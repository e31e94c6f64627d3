// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Load vectors with N entries, one per component of each node, in newtons (moments on reference
/// nodes in N·m).
#include <optional>
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/attachments/forms.hpp"
#include "model/elasticity/motion.hpp"
#include "model/elasticity/settings.hpp"
#include "model/material/material.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

/// The data on which the loads depend; borrowed.
struct LoadInput {
  const mesh::Mesh& mesh;
  const std::vector<material::Material>& materials;  ///< [material group]
  const Settings& settings;
};

/// Collective. Returns the centrifugal forces of these motions, [body].
OwnedVec centrifugalForces(const LoadInput& input, const std::vector<Motion>& motions);

/// Collective. Returns the forces due to gravity, accelerations and spins on all bodies, or only on
/// the cells of one material group. Throws Error for options of a group that is not a body.
OwnedVec bodyForces(const LoadInput& input, std::optional<int> material);

/// The load vectors of pressures, of forces on nodes, and of the weight of point masses.
struct SurfaceLoads {
  OwnedVec hydraulic;  ///< scaled by the pressure of the sweep
  OwnedVec constant;
};

/// Collective. Returns the load vectors. `masses` are the point masses.
SurfaceLoads surfaceLoads(const LoadInput& input, const std::vector<attachments::Form>& masses);

}  // namespace squeal::elasticity
