// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The contact forces of a time step: unilateral contact and Coulomb's friction cone at every node.
/// The jumps are an affine function of the forces [M.72].
#include <vector>

#include "base/system/termination.hpp"
#include "regime/march/model.hpp"

namespace squeal::march {

/// Solves for the forces R of a time step and the jumps d,
///   d = b + W R
/// in the rows of gaps (N) and slips (T), under the conditions
///   0 ≤ d_N ⟂ R_N ≥ 0,   |R_T| ≤ f R_N,   R_T = −f R_N d_T / |d_T| where d_T ≠ 0.
/// d_N is the gap at the end of the step or, at nodes with mass, the step times its rate; d_T is
/// the slip during the step.
class StepSolver {
 public:
  /// W is symmetric and positive semidefinite, rows × rows. Each node has `dimension` rows. Rows
  /// with moves[row] = 0 do not move and have no force.
  StepSolver(DenseMatrix w, int dimension, std::vector<unsigned char> moves);
  const DenseMatrix& w() const { return w_; }

  /// Improves the forces R by the projected Gauss–Seidel method until a sweep changes them by at
  /// most `tolerance` (in newtons) or, if this is larger, 1e-10 of the largest force. With strong
  /// friction the sweeps may never converge; after many of them Newton's method is tried, and again
  /// each time their number has doubled. The forces of open nodes are exactly zero at the end. On
  /// entry, d must be b + W R for the initial forces; it is updated with R. `friction` are the
  /// coefficients f, [node]. active[node] is 0 for a node that is known to be open; its forces must
  /// be zero. Returns the number of sweeps. Throws Error if the largest number of sweeps is not
  /// sufficient. Throws Interrupted, only on this rank, once stopRequested() is true.
  int solve(const std::vector<double>& friction, const std::vector<unsigned char>& active,
            double tolerance, std::vector<double>& r, std::vector<double>& d,
            const StopRequested& stopRequested = {}) const;

 private:
  double sweep(const std::vector<double>& friction, const std::vector<unsigned char>& active,
               double negligible, std::vector<double>& r, std::vector<double>& d) const;
  DenseMatrix w_;
  int dimension_;
  std::vector<unsigned char> moves_;
  std::vector<double> normalStep_, slipStep_;  // [node] factors on d in the projections, N/m
};

/// Returns the largest violation, N, of the conditions of StepSolver by forces R and jumps d: the
/// maximum over the nodes of |min(R_N, κ d_N)| and |R_T − P(R_T − κ d_T)|. P is the projection onto
/// the disc |R_T| ≤ f R_N. `stiffness` contains κ, [node], N/m.
double defect(int dimension, const std::vector<unsigned char>& moves,
              const std::vector<double>& friction, const std::vector<double>& r,
              const std::vector<double>& d, const std::vector<double>& stiffness);

}  // namespace squeal::march
