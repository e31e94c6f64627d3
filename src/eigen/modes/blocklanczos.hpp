// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Rational block Lanczos as an EPS type of SLEPc. It finds the eigenvalues of a symmetric definite
/// pencil (K, M) nearest to a target that lies below all eigenvalues.
#include <optional>

#include "base/petsc/owned.hpp"

namespace squeal::modes {

/// Name of the type, for EPSSetType and -eps_type.
constexpr const char* blockLanczosType = "blocklanczos";

/// Registers the type with SLEPc; further calls have no effect. It supports the monitors and
/// convergence tests of EPS, and its options nev, ncv (largest number of basis vectors), tol and
/// max_it (largest number of restarts). The type has two options of its own:
///   -eps_blocklanczos_blocksize <8>: number of right-hand sides per block solve,
///   -eps_blocklanczos_pole <true>: place further poles among the wanted eigenvalues; the
///     inertia at such a pole counts the eigenvalues below it.
/// The spectral transformation must be shift-and-invert.
void registerBlockLanczos();

/// Sets the defaults of these two options.
void setBlockLanczos(EPS eps, PetscInt blockSize, bool secondPole);

/// Returns the maximum number of basis vectors for `count` eigenvalues. A run nearly always
/// converges before the first restart, with 2 to 3 vectors per eigenvalue.
constexpr int lanczosVectors(int count, int blockSize) { return 3 * count + 8 * blockSize; }

/// Results of a solve in addition to the eigenvalues.
struct BlockLanczosResult {
  int solves = 0;  ///< number of right-hand sides
  int restarts = 0;
  /// A shift σ and the number of eigenvalues below it, by the inertia of K − σ M; both are 0 if no
  /// further pole was placed among the wanted eigenvalues.
  double countedTo = 0;
  int below = 0;
};

/// Collective. Calls EPSSolve on a solver of this type and returns the results. Throws Error if
/// K − σ M cannot be factorised at a further pole σ, or if the basis cannot be extended.
BlockLanczosResult solveBlockLanczos(EPS eps);

}  // namespace squeal::modes
