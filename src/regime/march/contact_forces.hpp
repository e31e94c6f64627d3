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
  /// W is symmetric and positive semidefinite, rows × rows. Each node has `dimension` rows; rows
  /// that do not move have no force.
  StepSolver(DenseMatrix w, int dimension, std::vector<unsigned char> moves);
  const DenseMatrix& w() const { return w_; }

  /// Improves forces R to a `tolerance`, N, and updates d = b + W R, which must be given for the
  /// initial forces. active[node] is false for a node that is known to be open; its forces are
  /// zero. Returns the number of sweeps of the projected Gauss–Seidel method. Throws Error after
  /// the largest number of sweeps. Throws Interrupted, only on this rank, once stopRequested() is
  /// true.
  int solve(const std::vector<double>& friction, const std::vector<unsigned char>& active,
            double tolerance, std::vector<double>& r, std::vector<double>& d,
            const StopRequested& stopRequested = {}) const;

 private:
  double sweep(const std::vector<double>& friction, const std::vector<unsigned char>& active,
               double negligible, std::vector<double>& r, std::vector<double>& d) const;
  DenseMatrix w_;
  int dimension_;
  std::vector<unsigned char> moves_;
  std::vector<double> normalStep_, slipStep_;  // [node] steps of the projections, N/m
};

/// Returns the largest violation of the conditions of StepSolver by forces R and jumps d: −d_N, and
/// |d_N| if R_N > 0, in m; −R_N, |R_T| − f R_N and the part of R_T that is not opposite to d_T, in
/// N. `stiffness`, N/m, converts gaps to forces.
double defect(int dimension, const std::vector<unsigned char>& moves,
              const std::vector<double>& friction, const std::vector<double>& r,
              const std::vector<double>& d, const std::vector<double>& stiffness);

}  // namespace squeal::march
