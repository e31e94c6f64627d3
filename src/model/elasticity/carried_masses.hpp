// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Point masses that moving bodies carry, directly or by couplings.
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/attachments/forms.hpp"
#include "model/constraints/settings.hpp"
#include "model/elasticity/motion.hpp"
#include "model/elasticity/settings.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

/// A point mass that moves with a body.
struct CarriedMass {
  attachments::PointMass mass;
  int body;  ///< index into Mesh::bodies
};

/// Collective. Returns the masses at nodes of moving bodies, and at reference nodes that couplings
/// connect only with bodies of the same motion. Omits masses that are connected with bodies of
/// different motions, and warns about them. With convective terms, throws Error for a mass that is
/// not steady in the axes of the vehicle: a rotating mass must have its centre on the axis of
/// rotation and an inertia that is symmetric about this axis, both within a thousandth.
std::vector<CarriedMass> carriedMasses(const mesh::Mesh& mesh, const Settings& settings,
                                       const std::vector<constraints::CouplingSettings>& couplings,
                                       const std::vector<Motion>& motions);

/// Collective. Adds the centrifugal forces [M.91] of rotating masses to `forces`, which has N
/// entries, in newtons.
void addCentrifugal(const mesh::Mesh& mesh, const std::vector<CarriedMass>& masses,
                    const std::vector<Motion>& motions, Vec forces);

/// Collective. Returns the gyroscopic matrix [M.86] of rotating masses, N×N, exactly skew, N·s/m;
/// null if no mass has an inertia about its axis.
OwnedMat gyroscopicOf(const mesh::Mesh& mesh, const std::vector<CarriedMass>& masses,
                      const std::vector<Motion>& motions);

}  // namespace squeal::elasticity
