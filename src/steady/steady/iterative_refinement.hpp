// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Iterative refinement solves nearly linear equations to rounding with an inexact solver.
#include <functional>

#include "base/petsc/owned.hpp"

namespace squeal::steady {

/// A residual comes with the size of its rounding error: the machine precision times the magnitudes
/// of the terms that cancel in it.
struct Residual {
  OwnedVec vector;
  double rounding = 0;  ///< rounding error in the 2-norm
};

/// The result of a refinement. It rests on recomputed residuals, not on the convergence
/// reported by the inner solver.
struct Refinement {
  PetscReal first = 0;     ///< 2-norm of the residual of the start
  PetscReal least = 0;     ///< 2-norm of the residual of the iterate that is returned
  PetscReal rounding = 0;  ///< rounding error of that residual
  int steps = 0;           ///< number of inner solves
  /// Returns true if the residual is down to ten times its rounding, or to 1e-9 of the first one.
  bool solved() const;
  /// Returns the residual divided by that of the start; 0 where the start was the solution.
  PetscReal relative() const { return first > 0 ? least / first : 0; }
};

/// Collective. Improves y by the steps
///   y ← y − A⁻¹ F(y)
/// until the residual F(y) is down to rounding, a step no longer halves it, or 20 steps have been
/// made. `inner` solves with A to a few digits. A step that does not make the residual smaller is
/// undone. `residual` returns F(y), in the layout of y.
Refinement refine(KSP inner, const std::function<Residual(Vec)>& residual, Vec y);

/// Collective. Returns GMRES for A = `matrix`, with the tolerance that a step of refinement needs.
/// `factorised`, the direct solver of a matrix near A, is its preconditioner and is borrowed.
OwnedKSP innerSolver(Mat matrix, KSP factorised);

}  // namespace squeal::steady
