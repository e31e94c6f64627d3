// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Dense quadratic eigenproblems solved in parallel, one problem per rank, with results on all
/// ranks.
#include <mpi.h>

#include <functional>
#include <vector>

#include "algebra/linalg/quadratic.hpp"

namespace squeal::linalg {

/// Collective. Calls action(i) for each i below `count`, on the owner of i, which is rank i modulo
/// the number of ranks. Throws Error on all ranks if one of the calls throws Error.
void onOwners(MPI_Comm comm, std::size_t count, const std::function<void(std::size_t)>& action);

/// Collective. Calls solve(i) for each i below `count` on its owner, as onOwners() does, and
/// returns the pairs on all ranks. Round-off then cannot make the ranks disagree on the order or
/// number of eigenvalues. Throws Error on all ranks if one of the calls throws Error.
std::vector<std::vector<DensePair>> spread(
    MPI_Comm comm, std::size_t count, Vectors vectors,
    const std::function<std::vector<DensePair>(std::size_t)>& solve);

/// Collective. Solves several problems by spread(). Only the rank that solves a problem needs its
/// matrices.
std::vector<std::vector<DensePair>> solveSpread(MPI_Comm comm,
                                                const std::vector<DenseProblem>& problems,
                                                Vectors vectors,
                                                const EigenvalueFilter& wanted = {});

/// Collective. Solves one problem on rank 0 and returns the results on all ranks. Throws Error on
/// all ranks if it fails.
std::vector<DensePair> solveTogether(MPI_Comm comm, const DenseProblem& problem,
                                     Vectors vectors = Vectors::right);

/// Collective. Sends the pairs of rank `root` to all ranks in one message. Vectors of a smaller
/// basis are extended by zeros to the length of the longest one. `vectors` selects whether left
/// vectors are included.
void shareFrom(int root, MPI_Comm comm, std::vector<DensePair>& pairs, Vectors vectors);

}  // namespace squeal::linalg
