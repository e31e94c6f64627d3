// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The complementarity problem of steady sliding, solved by PETSc's SNES VI.
#include <petscsnes.h>

#include "base/petsc/owned.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::steady {

using OwnedSNES = Owned<SNES, SNESDestroy>;

/// The attainable accuracy of a steady state.
struct Accuracy {
  double forceUnit = 1;  ///< 2-norm of the residual at zero displacements, N
  double target = 0;     ///< η0 [M.16], a fraction of forceUnit
};
/// Collective. Returns the attainable accuracy near the unknowns x.
Accuracy accuracyNear(const Problem& problem, const sweep::Parameters& at, Vec x);
/// Collective. Returns the 2-norm of the natural residual, N. This residual is F(x), except in the
/// rows of gaps g ≤ 0: there it is min(R_N, 0), or 0 at nodes that do not separate.
double naturalResidual(const Problem& problem, const sweep::Parameters& at, Vec x);

/// Collective. Returns SNES VI (prefix -steady_) with the tolerance `target`, for forces and gaps
/// scaled to about 1. The caller must set function, Jacobian, bounds and KSP before solveSnes().
OwnedSNES newSnes(MPI_Comm comm, double target);
/// Collective. Applies the options and solves from x, which becomes the solution. Sets the reason
/// and the tolerance of `solution` and adds to its iterations. Returns true if SNES reports
/// convergence.
bool solveSnes(SNES snes, Vec x, Solution& solution);
/// Sets `residual` and `converged` of `solution` from `left`, the 2-norm of its natural residual,
/// N. Only this residual determines success, since SNES also stops if steps have no effect. If SNES
/// has not diverged but the residual is too large, the reason contains the residual and the largest
/// accepted value.
void accept(Solution& solution, double left, const Accuracy& accuracy);

/// Collective. Solves by SNES VI (-steady_snes_*) from the start x, which becomes the solution, and
/// sets residual, convergence, tolerance, reason and iterations of `solution` at its point of the
/// sweep. All gaps are unknowns. Returns the 2-norm of the natural residual, N.
double complementarity(const Problem& problem, OwnedVec& x, Solution& solution);

}  // namespace squeal::steady
