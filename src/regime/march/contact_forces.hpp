// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The contact forces of a time step: unilateral contact and Coulomb's cone at every node, for a
/// jump that is affine in the forces [M.72].
#include <vector>

#include "base/system/termination.hpp"
#include "regime/march/model.hpp"

namespace squeal::march {

/// Solves for the forces R of a step and the jump increments
///   d = b + W R
/// in rows of gaps and slips:
///   0 ≤ d_N ⟂ R_N ≥ 0,   |R_T| ≤ f R_N,   R_T = −f R_N d_T / |d_T| where d_T ≠ 0.
/// d_N is the gap at the end of the step, or its rate; d_T is the slip in the step.
class StepSolver {
 public:
  /// W is symmetric and positive semidefinite, rows × rows. `dimension` rows belong to a node; rows
  /// that do not move carry no force.
  StepSolver(DenseMatrix w, int dimension, std::vector<unsigned char> moves);
  const DenseMatrix& w() const { return w_; }

  /// Improves forces R to a `tolerance`, N, and d = b + W R, given for these forces, with them.
  /// active[node] is false for a node that is known to be open, whose forces are zero. Returns the
  /// number of sweeps of the projected Gauss–Seidel method. Throws Error after `mostSweeps`. Throws
  /// Interrupted, only on this rank, once asked() is true.
  int solve(const std::vector<double>& friction, const std::vector<unsigned char>& active,
            double tolerance, std::vector<double>& r, std::vector<double>& d,
            const StopAsked& asked = {}) const;

 private:
  double sweep(const std::vector<double>& friction, const std::vector<unsigned char>& active,
               double negligible, std::vector<double>& r, std::vector<double>& d) const;
  DenseMatrix w_;
  int dimension_;
  std::vector<unsigned char> moves_;
  std::vector<double> normalStep_, slipStep_;  // [node] steps of the projections, N/m
};

/// Returns the largest violation of the conditions of StepSolver by forces R and jumps d: of −d_N
/// and of |d_N| where R_N > 0, in m; of −R_N, |R_T| − f R_N and of the part of R_T that is not
/// opposite to d_T, in N. Gaps are weighted by `stiffness`, N/m, so that the result is in N.
double defect(int dimension, const std::vector<unsigned char>& moves,
              const std::vector<double>& friction, const std::vector<double>& r,
              const std::vector<double>& d, const std::vector<double>& stiffness);

}  // namespace squeal::march
