#pragma once
/// These functions read the constraints: clamped, guided and displaced surfaces, and periodic
/// images.
#include <string>
#include <vector>

#include "model/coupling/coupling.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

/// Not collective. Returns the groups with a clamp, for the mesh reader. Throws Error for a
/// displacement without a clamp.
std::vector<mesh::GroupRequest> constrainedGroups();
/// Not collective. Returns the pairs of groups of which one is the periodic image of the other.
std::vector<mesh::PeriodicRequest> periodicPairs();

/// A component of a master that follows from others, as a support holds a tied node between them:
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
  /// [owned node · dimension + component] 1 if supports act on it, its own or those of tied nodes
  /// that rest on it
  std::vector<unsigned char> supported;
};

/// Collective. Returns the constraints that the options ask for. Throws Error for a component that
/// the dimension does not have or that is given twice, and for two groups that disagree. Warns of a
/// displacement that is not held.
Constraints readConstraints(const mesh::Mesh& mesh);

}  // namespace squeal::interfaces
