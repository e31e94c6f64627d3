// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Springs and dashpots between node groups and the ground.
#include <string>

#include "base/petsc/owned.hpp"
#include "model/elasticity/settings.hpp"
#include "model/mesh/mesh.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::elasticity {

/// The matrices of all groups together, N×N. They couple only components of the same node. A matrix
/// is null if all its values are zero.
struct Ground {
  OwnedMat springs;             ///< N/m, symmetric
  OwnedMat dashpots;            ///< N·s/m, symmetric
  bool turnedDashpots = false;  ///< some dashpots act along axes of a frame
};

/// Collective. Returns the springs and dashpots. The nodes of each group share its total stiffness
/// and damping equally. Throws Error for fewer components than dimensions, for a frame that does
/// not exist, and for a node on the axis of a cylindrical frame.
Ground groundOf(const mesh::Mesh& mesh, const Settings& settings);

/// Collective. Return the stiffness of the springs of a group, N/m, and the damping of its
/// dashpots, N·s/m, at each of its nodes, in the order of Mesh::nodeGroups; empty if the group has
/// none. Throw Error as groundOf() does.
std::vector<mesh::Matrix3> groundSprings(const mesh::Mesh& mesh, const Settings& settings,
                                         const std::string& group);
std::vector<mesh::Matrix3> groundDashpots(const mesh::Mesh& mesh, const Settings& settings,
                                          const std::string& group);

}  // namespace squeal::elasticity
