// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Reduction of the finite elements to the model of the regime [M.70]. V contains free modes and
/// the unstable modes. Ψ contains the static responses to gaps and to tangential forces at the
/// contact, M-orthogonal to V and scaled to unit jumps.
#include "algebra/linalg/block.hpp"
#include "regime/march/model.hpp"
#include "regime/regime/full_model.hpp"

namespace squeal::regime {

using march::Node;
using march::ReducedModel;

/// A reduced model, the same on all ranks, and its displacements of the mesh.
struct Reduction {
  ReducedModel model;
  linalg::Block modes;      ///< V, nodal displacements, this rank's rows
  linalg::Block responses;  ///< Ψ, as V
  /// [node of the model] its index among the contact nodes of this rank; −1 on other ranks
  std::vector<PetscInt> contactNode;
};

/// Collective. Returns the reduced model. `free` are the free modes, `unstable` are the real and
/// imaginary parts of the unstable modes, nodal displacements, this rank's rows. Throws Error if
/// the modes contain the whole motion of the contact, which leaves no massless part. Throws
/// Interrupted once a stop of the run has been requested.
Reduction reduce(const FullModel& full, linalg::Block free, const linalg::Block& unstable);

}  // namespace squeal::regime
