// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The model that is audited.
#include <vector>

#include "model/constraints/settings.hpp"
#include "model/contact/contact.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/material/settings.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::audit {

/// The parts of a model, borrowed.
struct Subject {
  const mesh::Mesh& mesh;
  const elasticity::Bodies& bodies;
  const contact::Contact& contact;
  const material::Settings& materials;
  const std::vector<constraints::CouplingSettings>& couplings;
};

}  // namespace squeal::audit
