// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The semismooth Newton method for the contact forces of a time step. The conditions of contact
/// and friction are written as the equations of P. Alart and A. Curnier (Computer Methods in
/// Applied Mechanics and Engineering 92, 1991, 353–375):
///   F_N = R_N − max(0, R_N − κ_N d_N) = 0,   F_T = R_T − P(R_T − κ_T d_T) = 0,
/// with d = b + W R. P is the projection onto the disc of radius f max(0, R_N − κ_N d_N).
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "base/system/termination.hpp"

namespace squeal::march {

/// The problem of a time step, with the arguments of StepSolver. It borrows its arrays.
struct StepProblem {
  const linalg::DenseMatrix& w;                       ///< rows × rows
  int dimension;                                      ///< rows per node
  const std::vector<unsigned char>& moves;            ///< [row]
  const std::vector<double>&normalScale, &slipScale;  ///< [node] κ_N and κ_T, N/m
  const std::vector<double>& friction;                ///< [node] coefficients f
  const std::vector<unsigned char>& active;           ///< [node]
};

/// Not collective. Improves the forces R, and d = b + W R with them, until no entry of F exceeds
/// `accuracy`, N, in magnitude. Each step reduces the norm of F. At the end, the forces of open
/// nodes are exactly zero. Returns false, with R and d unchanged, if a step cannot reduce the norm,
/// if the derivative is singular or if there are too many steps. Throws Interrupted, only on this
/// rank, once stopRequested() is true.
bool newton(const StepProblem& problem, double accuracy, std::vector<double>& r,
            std::vector<double>& d, const StopRequested& stopRequested = {});

}  // namespace squeal::march
