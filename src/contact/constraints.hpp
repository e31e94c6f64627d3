#pragma once
/// Clamped, guided and displaced surfaces, periodic images: what removes rows of u before contact
/// does.
#include <vector>

#include "mesh/mesh.hpp"

namespace squeal::contact {

/// Groups that constraint options name, for the mesh reader.
std::vector<mesh::GroupRequest> constrainedGroups();
std::vector<mesh::PeriodicRequest> periodicPairs();

/// Cartesian components held at each owned node.
struct Constraints {
  std::vector<unsigned char> held;  ///< [owned node · dimension + component] 1 if held
  std::vector<int> heldBy;          ///< [owned node · dimension + component] index into groups
  std::vector<std::string> groups;  ///< groups with a clamp
  /// [owned node · dimension + component] its value where held, m
  std::vector<double> displacement;
};

/// Collective. Errors: component that the dimension does not have, displacement without clamp, two
/// groups that disagree.
Constraints readConstraints(const mesh::Mesh& mesh);

}  // namespace squeal::contact
