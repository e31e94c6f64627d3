// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Reduction of the finite element model for the motion after flutter [M.70]. V contains free modes
/// and the unstable modes. Ψ contains the static responses to gaps and to tangential forces at the
/// contact, M-orthogonal to V and scaled to unit jumps.
#include "algebra/linalg/block.hpp"
#include "regime/march/model.hpp"
#include "regime/regime/full_model.hpp"

namespace squeal::regime {

using march::Node;
using march::ReducedModel;

/// A reduced model, the same on all ranks, and its vectors as displacements of the mesh.
struct Reduction {
  ReducedModel model;
  linalg::Block modes;      ///< V, columns of nodal displacements, this rank's rows
  linalg::Block responses;  ///< Ψ, likewise
  /// [node of the model] its index among the contact nodes of this rank; −1 if another rank has it
  std::vector<PetscInt> contactNode;
};

/// Collective. Returns the reduced model. The columns of `free` are the free modes, those of
/// `unstable` the real and imaginary parts of the unstable modes; both contain nodal displacements,
/// this rank's rows. Throws Error if the modes represent the whole motion of the contact, so that
/// no massless part remains. Throws Interrupted once a stop of the run has been requested.
Reduction reduce(const FullModel& full, linalg::Block free, const linalg::Block& unstable);

}  // namespace squeal::regime
