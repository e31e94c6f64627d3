#pragma once
/// Iterative refinement: nearly linear equations solved to rounding by a solver that need not be
/// exact.
#include <functional>

#include "petsc/owned.hpp"

namespace squeal::steady {

/// A residual and the size of what rounding alone leaves of it: machine epsilon times the
/// magnitudes of what cancels in it.
struct Residual {
  OwnedVec vector;
  double rounding = 0;  ///< in the 2-norm
};

/// How far a refinement came, by residuals computed anew, never by the word of the inner solver.
struct Refinement {
  PetscReal first = 0;     ///< 2-norm of the residual of the start
  PetscReal least = 0;     ///< 2-norm of the residual of the iterate that is returned
  PetscReal rounding = 0;  ///< what rounding leaves of it
  int steps = 0;           ///< inner solves
  /// The residual is down to rounding, or small beside that of the start.
  bool solved() const;
  /// The residual over that of the start; 0 where the start was the solution.
  PetscReal relative() const { return first > 0 ? least / first : 0; }
};

/// Collective. Improves y until the residual is down to rounding or a step no longer halves it: y ←
/// y − A⁻¹ F(y), with `inner` solving A step = F(y) to a few digits. A step that does not make the
/// residual smaller is taken back. `residual`: F(y), in the layout of y.
Refinement refine(KSP inner, const std::function<Residual(Vec)>& residual, Vec y);

/// Collective. GMRES for A = `matrix`, to the few digits that a step of refinement needs.
/// `factorised` is its preconditioner, the direct solver of a matrix near A; both are borrowed.
OwnedKSP innerSolver(Mat matrix, KSP factorised);

}  // namespace squeal::steady
