#pragma once
/// Block Lanczos finds the lowest modes of a symmetric pencil (K, M) by blocked solves with a
/// factorised K.
#include <functional>
#include <vector>

#include "petsc/owned.hpp"

namespace squeal::modes {

/// Returns the number of basis vectors that are kept until the basis grows. A run nearly always
/// converges before the first restart, with 3 vectors a mode.
constexpr int lanczosVectors(int count, int blockSize) { return 3 * count + 8 * blockSize; }

/// The pairs that have converged, and what they took.
struct LanczosResult {
  std::vector<double> lambda;  ///< eigenvalues ω², ascending, rad²/s²
  OwnedBV vectors;             ///< n × converged, M-orthonormal; null if none has converged
  int converged = 0;           ///< number of pairs, `count` at most
  int solves = 0;              ///< right-hand sides solved for
  int restarts = 0;
};

/// Collective. Returns the `count` smallest eigenvalues of
///   K d = λ M d,
/// or fewer if they do not converge within `maxRestarts`. K is symmetric positive definite and
/// factorised in `solver` (MUMPS), and M is symmetric positive definite. Both have at least
/// 2·lanczosVectors() rows; all are borrowed. A pair has converged when
///   ‖K⁻¹M d − d/λ‖_M ≤ tolerance/λ.
/// The basis grows, up to half of all rows, where restarts do not converge. `progress(restarts,
/// converged)` is called on all ranks. Throws Error if the basis cannot be extended.
LanczosResult blockLanczos(Mat k, Mat m, KSP solver, int count, int blockSize, double tolerance,
                           int maxRestarts, const std::function<void(int, int)>& progress);

}  // namespace squeal::modes
