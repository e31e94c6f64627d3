// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/mesh.hpp"

#include <algorithm>

namespace squeal::mesh {

const Reference* Mesh::referenceWith(PetscInt global) const {
  const auto found = std::ranges::find_if(references, [&](const Reference& reference) {
    return reference.displacement == global || reference.rotation == global;
  });
  return found == references.end() ? nullptr : &*found;
}

const Reference* Mesh::reference(const std::string& name) const {
  const auto found = std::ranges::find(references, name, &Reference::name);
  return found == references.end() ? nullptr : &*found;
}

}  // namespace squeal::mesh
