#pragma once
/// This function solves the complementarity problem of steady sliding by PETSc's SNES VI.
#include "petsc/owned.hpp"
#include "steady/steady.hpp"

namespace squeal::steady {

/// Collective. Solves by SNES VI (-steady_snes_*) from the start x, which becomes the solution, and
/// fills residual, convergence, reason and iterations of `solution` at its point of the sweep. All
/// gaps are unknowns. Returns the 2-norm of the natural residual, N.
double complementarity(const Problem& problem, OwnedVec& x, Solution& solution);

}  // namespace squeal::steady
