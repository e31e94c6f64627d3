// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The onset of nonlinearity of the unstable modes of a meshed brake [M.75].
#include <vector>

#include "eigen/pencil/complex_modes.hpp"
#include "model/contact/contact.hpp"
#include "model/elasticity/elasticity.hpp"
#include "regime/march/onset.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::regime {

using march::Onset;
using mesh::Point;

/// The first event (separation, stick or slip of a contact node) as an unstable mode grows.
struct ModeOnset {
  sweep::Parameters at;
  std::size_t mode = 0;  ///< index into ComplexModes::eigenvalues
  Complex s;             ///< 1/s
  Onset onset = {};      ///< `factor` multiplies pencil::Shape; `node` is 0
  Point position{};      ///< of the contact node with the event, m
  int interface = -1;    ///< interface of this node
  double kinetic = 0;    ///< largest kinetic energy over a cycle at the event, J
};

/// Collective. Returns the first events of those unstable modes whose shapes are stored [M.75].
/// `prestress` is K_σ of the steady state; it may be null.
std::vector<ModeOnset> onsets(const elasticity::Bodies& bodies, const contact::Contact& contact,
                              const steady::Solution& solution, const pencil::ComplexModes& point,
                              Mat prestress);

}  // namespace squeal::regime
