#pragma once
/// The reduced model of the regime is made of the finite elements [M.70]: V holds free modes and
/// the unstable modes, Ψ the static responses to gaps and to tangential forces at the contact,
/// made M-orthogonal to V and scaled to unit jumps.
#include "algebra/linalg/block.hpp"
#include "model/contact/coupled.hpp"
#include "model/elasticity/elasticity.hpp"
#include "regime/march/model.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::regime {

using march::Node;
using march::ReducedModel;

/// What is reduced; all of it is borrowed.
struct FullModel {
  const elasticity::Bodies& bodies;
  const contact::Contact& contact;
  /// K0 with all nodes closed and held; it solves for the static responses.
  const contact::CoupledSystem& closed;
  const steady::Solution& solution;
  double damping = 1;  ///< factor on the damping of the bodies
};

/// Collective. Returns the contact nodes of this rank with their steady state.
std::vector<Node> ownNodes(const contact::Contact& contact, const steady::Solution& solution);

/// A reduced model, the same on all ranks, and what leads back to the mesh.
struct Reduction {
  ReducedModel model;
  linalg::Block modes;      ///< V, nodal displacements, this rank's rows
  linalg::Block responses;  ///< Ψ, as V
  /// [node of the model] its place among the contact nodes of this rank; −1 on other ranks
  std::vector<PetscInt> contactNode;
};

/// Collective. Returns the reduced model. `free` are the free modes, `unstable` are the real and
/// imaginary parts of the unstable modes, nodal displacements, this rank's rows. Throws Error where
/// the modes carry all of the motion of the contact, so that there is nothing massless, and
/// Interrupted once the run has been asked to stop.
Reduction reduce(const FullModel& full, linalg::Block free, const linalg::Block& unstable);

}  // namespace squeal::regime
