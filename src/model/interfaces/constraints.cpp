#include "model/interfaces/constraints.hpp"

#include <algorithm>

#include "base/options/options.hpp"
#include "base/petsc/check.hpp"
#include "base/session/stages.hpp"

namespace squeal::interfaces {
namespace {

const TextOption clampedOption(
    "constraint", "constraint_<group>_clamped", "",
    "components (some of xyz) of displacement held on the group's nodes");
const RealListOption displacementOption("constraint", "constraint_<group>_displacement", "0,0,0",
                                        "m", anyReal, "values of the clamped components");
const TextOption imageOption("constraint", "constraint_<group>_image_of", "",
                             "the group is the periodic image of this one, its translate");

}  // namespace

std::vector<mesh::GroupRequest> constrainedGroups() {
  for (const auto& group : displacementOption.subjects())
    if (!clampedOption.given(group))
      throw Error("option -" + displacementOption.fullName(group) + " needs -" +
                  clampedOption.fullName(group));
  std::vector<mesh::GroupRequest> requests;
  for (const auto& group : clampedOption.subjects())
    requests.push_back({group, "-" + clampedOption.fullName(group)});
  return requests;
}

std::vector<mesh::PeriodicRequest> periodicPairs() {
  std::vector<mesh::PeriodicRequest> pairs;
  for (const auto& image : imageOption.subjects()) {
    const std::string primary = imageOption.get(image);
    pairs.push_back({image, primary, "-" + imageOption.fullName(image) + " " + primary});
  }
  return pairs;
}

Constraints readConstraints(const mesh::Mesh& mesh) {
  const int dimension = mesh.dimension;
  Constraints constraints;
  constraints.held.assign(dimension * mesh.ownedNodes, 0);
  constraints.heldBy.assign(constraints.held.size(), -1);
  constraints.displacement.assign(constraints.held.size(), 0.0);
  std::string failure;
  for (const auto& group : clampedOption.subjects()) {
    constraints.groups.push_back(group);
    const std::string components = clampedOption.get(group),
                      allowed = std::string("xyz").substr(0, dimension);
    const auto values = displacementOption.components(group, dimension);
    if (components.empty() || components.find_first_not_of(allowed) != std::string::npos)
      throw Error("option -" + clampedOption.fullName(group) + " '" + components +
                  "': must be some of the letters " + allowed);
    for (const char letter : components)
      if (std::count(components.begin(), components.end(), letter) > 1)
        throw Error("option -" + clampedOption.fullName(group) + " '" + components + "': " +
                    letter + " twice; must be some of the letters " + allowed + ", each once");
    for (const char letter : std::string("xyz"))
      if (values[letter - 'x'] != 0 && components.find(letter) == std::string::npos)
        complain(mesh.comm, "option -" + displacementOption.fullName(group) +
                                ": the displacement of " + letter + " was not used, as -" +
                                clampedOption.fullName(group) + " " + components +
                                " does not hold it");
    for (PetscInt node : mesh.nodeGroups.at(group))
      for (char letter : components) {
        const PetscInt component = letter - 'x', at = dimension * node + component;
        if (constraints.held[at] && constraints.displacement[at] != values[component])
          failure = "option -" + displacementOption.fullName(group) +
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
