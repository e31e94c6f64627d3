// SPDX-License-Identifier: BSD-2-Clause
#include "model/interfaces/constraints.hpp"

#include <algorithm>

#include "base/petsc/check.hpp"
#include "base/session/stages.hpp"

namespace squeal::interfaces {
namespace {

/// Throws Error unless the held components exist in the dimension and are listed once.
void requireComponents(const std::string& group, const std::string& components, int dimension) {
  const std::string allowed = std::string("xyz").substr(0, dimension),
                    head = "option " + clampedName(group) + " '" + components + "': ";
  if (components.empty() || components.find_first_not_of(allowed) != std::string::npos)
    throw Error(head + "must be some of the letters " + allowed);
  for (const char letter : components)
    if (std::count(components.begin(), components.end(), letter) > 1)
      throw Error(head + letter + " twice; must be some of the letters " + allowed + ", each once");
}

/// Collective. Warns of displacements of components that are not held.
void warnOfFreeComponents(MPI_Comm comm, const std::string& group, const std::string& components,
                          const mesh::Point& displacement) {
  for (const char letter : std::string("xyz"))
    if (displacement[letter - 'x'] != 0 && components.find(letter) == std::string::npos)
      printWarning(comm, "option " + displacementName(group) + ": the displacement of " + letter +
                             " was not used, since " + clampedName(group) + " " + components +
                             " does not hold it");
}

}  // namespace

Constraints constraintsOf(const mesh::Mesh& mesh,
                          const std::map<std::string, ClampSettings>& clamps) {
  const int dimension = mesh.dimension;
  Constraints constraints;
  constraints.held.assign(dimension * mesh.ownedNodes, 0);
  constraints.heldBy.assign(constraints.held.size(), -1);
  constraints.displacement.assign(constraints.held.size(), 0.0);
  std::string failure;
  for (const auto& [group, clamp] : clamps) {
    constraints.groups.push_back(group);
    const std::string& components = clamp.components;
    const auto values = clamp.displacement.in(dimension);
    requireComponents(group, components, dimension);
    warnOfFreeComponents(mesh.comm, group, components, values);
    for (PetscInt node : mesh.nodeGroups.at(group))
      for (char letter : components) {
        const PetscInt component = letter - 'x', at = dimension * node + component;
        if (constraints.held[at] && constraints.displacement[at] != values[component])
          failure = "option " + displacementName(group) +
                    ": a node of this group is displaced differently by another group";
        constraints.held[at] = 1;
        constraints.heldBy[at] = constraints.groups.size() - 1;
        constraints.displacement[at] = values[component];
      }
  }
  failTogether(mesh.comm, failure);
  constraints.supported = constraints.held;
  return constraints;
}

}  // namespace squeal::interfaces
