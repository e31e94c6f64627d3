// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Constraints: clamped, guided and displaced groups of nodes.
#include <map>
#include <string>
#include <vector>

#include "model/coupling/coupling.hpp"
#include "model/interfaces/settings.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

/// A component of a master that depends on others, because a support holds a tied node between
/// them:
///   u_c = constant + Σ w u_c of the others.
struct CombinedComponent {
  PetscInt node;  ///< local node
  int component;
  std::vector<coupling::Weight> others;
  double constant;  ///< m
};

/// The Cartesian components of the displacement that are held at the nodes owned by this rank.
struct Constraints {
  std::vector<unsigned char> held;  ///< [owned node · dimension + component] 1 if held
  std::vector<int> heldBy;  ///< [owned node · dimension + component] index into groups, or −1
  std::vector<std::string> groups;  ///< groups with a clamp
  /// [owned node · dimension + component] prescribed value where held, m
  std::vector<double> displacement;
  std::vector<CombinedComponent> combined;  ///< owned by this rank
  bool anyCombined = false;                 ///< on any rank
  /// [owned node · dimension + component] 1 if supports act on it directly or on tied nodes that
  /// follow it
  std::vector<unsigned char> supported;
};

/// Collective. Returns the constraints of these clamps, [group]. Throws Error for a component that
/// is given twice or does not exist in the dimension, and for two groups that disagree. Warns of
/// displacements of components that are not held.
Constraints constraintsOf(const mesh::Mesh& mesh,
                          const std::map<std::string, ClampSettings>& clamps);

}  // namespace squeal::interfaces
