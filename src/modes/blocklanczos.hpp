#pragma once
/// Block Lanczos: the lowest modes of a symmetric pencil (K, M) from blocked solves with a
/// factorised K.
#include <functional>
#include <vector>

#include "petsc/owned.hpp"

namespace squeal::modes {

/// Most vectors kept: 3 a mode are met before the first restart nearly always.
constexpr int lanczosVectors(int count, int blockSize) { return 3 * count + 8 * blockSize; }

struct LanczosResult {
  std::vector<double> lambda;  ///< ascending, ω²
  OwnedBV vectors;             ///< n × converged, M-orthonormal
  int converged = 0;
  int solves = 0;  ///< right-hand sides solved for
  int restarts = 0;
};

/// Collective. The `count` smallest eigenvalues of K d = λ M d, K symmetric positive definite and
/// factorised in `solver` (MUMPS), M symmetric positive definite, of at least 2·lanczosVectors()
/// rows. A pair has converged when ‖K⁻¹M d − d/λ‖_M ≤ tolerance/λ. The basis grows, up to half of
/// all rows, where restarts do not converge. `progress(restarts, converged)` is called on all
/// ranks.
LanczosResult blockLanczos(Mat k, Mat m, KSP solver, int count, int blockSize, double tolerance,
                           int maxRestarts, const std::function<void(int, int)>& progress);

}  // namespace squeal::modes
