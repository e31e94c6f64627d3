// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Iterative refinement: nearly linear equations are solved up to round-off by an inexact solver.
#include <functional>

#include "base/petsc/owned.hpp"

namespace squeal::steady {

/// A residual with an estimate of its round-off: the machine precision times the magnitudes of the
/// terms that cancel in it.
struct Residual {
  OwnedVec vector;
  double rounding = 0;  ///< round-off in the 2-norm
};

/// The result of a refinement. It is based on recomputed residuals, not on the convergence that the
/// inner solver reports.
struct Refinement {
  PetscReal first = 0;     ///< 2-norm of the initial residual
  PetscReal least = 0;     ///< 2-norm of the residual of the returned iterate
  PetscReal rounding = 0;  ///< round-off of that residual
  int steps = 0;           ///< number of inner solves
  /// Returns true if the residual is at most ten times its round-off, or 1e-9 of the initial one.
  bool solved() const;
  /// Returns the residual divided by the initial one; 0 if the start was the solution.
  PetscReal relative() const { return first > 0 ? least / first : 0; }
};

/// Collective. Improves y by the steps
///   y ← y − A⁻¹ F(y)
/// until the residual F(y) is at round-off, a step does not halve it, or 20 steps have been made.
/// `inner` solves with A inexactly. A step that does not reduce the residual is undone. `residual`
/// returns F(y), in the layout of y.
Refinement refine(KSP inner, const std::function<Residual(Vec)>& residual, Vec y);

/// Collective. Returns GMRES for A = `matrix`, with the tolerance for a step of refinement. It
/// borrows `factorised`, the direct solver of a matrix near A, as preconditioner.
OwnedKSP innerSolver(Mat matrix, KSP factorised);

}  // namespace squeal::steady
