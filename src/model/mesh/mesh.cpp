// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/mesh.hpp"

#include <algorithm>

#include "base/system/text.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::mesh {

const Reference* Mesh::referenceWith(PetscInt global) const {
  const auto found = std::ranges::lower_bound(references, global, {}, &Reference::rotation);
  return found == references.end() || found->displacement > global ? nullptr : &*found;
}

const Reference* Mesh::reference(const std::string& name) const {
  const auto found = std::ranges::find(references, name, &Reference::name);
  return found == references.end() ? nullptr : &*found;
}

double Mesh::coincidence(const Point& x) const {
  return std::max(1e-9 * diagonal, 1e-12 * length(x));
}

bool Mesh::hasSections() const {
  return std::ranges::any_of(materialGroups, &MaterialGroup::isSection);
}

std::string Mesh::materialText(int group) const {
  const auto& [name, body, isSection] = materialGroups[group];
  return isSection ? "section '" + name + "' of body '" + bodies[body] + "'"
                   : "body '" + name + "'";
}

std::string text(const Point& p) { return formatted("(%.6g, %.6g, %.6g)", p[0], p[1], p[2]); }

}  // namespace squeal::mesh
