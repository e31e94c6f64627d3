// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The finite element model at a steady state.
#include "model/contact/coupled.hpp"
#include "model/elasticity/elasticity.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::regime {

/// The finite element model to reduce; all members are borrowed.
struct FullModel {
  const elasticity::Bodies& bodies;
  const contact::Contact& contact;
  /// The system with all contact nodes closed and held. Its K0 is used to solve for the static
  /// responses.
  const contact::CoupledSystem& closed;
  const steady::Solution& solution;
  double damping = 1;  ///< factor on the damping of the bodies
};

}  // namespace squeal::regime
