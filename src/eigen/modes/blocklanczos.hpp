// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// This file adds rational block Lanczos to SLEPc, as a type of EPS. It finds the eigenvalues of a
/// symmetric definite pencil (K, M) nearest to a target below all of them.
#include <optional>

#include "base/petsc/owned.hpp"

namespace squeal::modes {

/// Name of the type, for EPSSetType and -eps_type.
constexpr const char* blockLanczosType = "blocklanczos";

/// Registers the type with SLEPc, once. It takes the options of EPS (nev, ncv: most vectors of the
/// basis, tol, max_it: most restarts), EPS monitors and convergence tests,
/// and
///   -eps_blocklanczos_blocksize <8>, right-hand sides that are solved for together,
///   -eps_blocklanczos_pole <true>, whether further poles are placed amid the wanted eigenvalues,
///     where the inertia counts those below.
/// The spectral transformation has to be shift-and-invert.
void registerBlockLanczos();

/// Sets the defaults of the options of the type.
void setBlockLanczos(EPS eps, PetscInt blockSize, bool secondPole);

/// Returns the number of vectors that `count` eigenvalues need room for. A run nearly always
/// converges before the first restart, with 2 to 3 vectors an eigenvalue.
constexpr int lanczosVectors(int count, int blockSize) { return 3 * count + 8 * blockSize; }

/// The facts of a solve are what it has found besides the eigenvalues.
struct BlockLanczosFacts {
  int solves = 0;  ///< right-hand sides solved for
  int restarts = 0;
  /// A place σ and the number of eigenvalues below it, by the inertia of K − σ M; 0 if there is
  /// none of the wanted ones.
  double countedTo = 0;
  int below = 0;
};

/// Collective. Calls EPSSolve on a solver of this type and returns the facts. Throws Error if the
/// second pole cannot be factorised or the basis cannot be extended.
BlockLanczosFacts solveBlockLanczos(EPS eps);

}  // namespace squeal::modes
