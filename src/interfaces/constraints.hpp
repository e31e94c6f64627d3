#pragma once
/// These functions read the constraints: clamped, guided and displaced surfaces, and periodic
/// images.
#include <vector>

#include "mesh/mesh.hpp"

namespace squeal::interfaces {

/// Not collective. Returns the groups with a clamp, for the mesh reader. Throws Error for a
/// displacement without a clamp.
std::vector<mesh::GroupRequest> constrainedGroups();
/// Not collective. Returns the pairs of groups of which one is the periodic image of the other.
std::vector<mesh::PeriodicRequest> periodicPairs();

/// The Cartesian components of the displacement that are held at the nodes owned by this rank.
struct Constraints {
  std::vector<unsigned char> held;  ///< [owned node · dimension + component] 1 if held
  std::vector<int> heldBy;  ///< [owned node · dimension + component] index into groups, or −1
  std::vector<std::string> groups;  ///< groups with a clamp
  /// [owned node · dimension + component] prescribed value where held, m
  std::vector<double> displacement;
};

/// Collective. Returns the constraints that the options ask for. Throws Error for a component that
/// the dimension does not have or that is given twice, and for two groups that disagree. Warns of a
/// displacement that is not held.
Constraints readConstraints(const mesh::Mesh& mesh);

}  // namespace squeal::interfaces
