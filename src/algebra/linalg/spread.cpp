// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/linalg/spread.hpp"

#include <algorithm>

#include "algebra/linalg/complexdense.hpp"
#include "base/system/error.hpp"
#include "base/system/mpi.hpp"

namespace squeal::linalg {

void shareFrom(int root, MPI_Comm comm, std::vector<DensePair>& pairs, Vectors vectors) {
  PetscInt count = pairs.size(), m = 0;
  for (const auto& pair : pairs)
    m = std::max<PetscInt>(m, std::max(pair.q.size(), pair.left.size()));
  mpi::broadcast(comm, count, root);
  mpi::broadcast(comm, m, root);
  const PetscInt length = 1 + m * (vectors == Vectors::both ? 2 : 1);
  ComplexMatrix packed(length, count);  // s, the right vector, the left vector
  const bool isRoot = mpi::rank(comm) == root;
  for (PetscInt j = 0; j < count && isRoot; ++j) {
    const auto column = packed.column(j);
    column[0] = pairs[j].s;
    std::ranges::copy(pairs[j].q, column.begin() + 1);
    if (vectors == Vectors::both) std::ranges::copy(pairs[j].left, column.begin() + 1 + m);
  }
  mpi::broadcastBytes(comm, packed.data(), packed.size() * sizeof(Complex), root);
  pairs.clear();
  for (PetscInt j = 0; j < count; ++j) {
    const auto column = packed.column(j), q = column.subspan(1, m), left = column.subspan(1 + m);
    pairs.push_back({column[0], {q.begin(), q.end()}, {left.begin(), left.end()}});
  }
}

void onOwners(MPI_Comm comm, std::size_t count, const std::function<void(std::size_t)>& action) {
  const int rank = mpi::rank(comm), ranks = mpi::size(comm);
  std::string failure;
  for (std::size_t i = rank; i < count && failure.empty(); i += ranks) try {
      action(i);
    } catch (const Error& error) {
      failure = error.what();
    }
  failTogether(comm, failure);
}

std::vector<std::vector<DensePair>> spread(
    MPI_Comm comm, std::size_t count, Vectors vectors,
    const std::function<std::vector<DensePair>(std::size_t)>& solve) {
  std::vector<std::vector<DensePair>> solved(count);
  onOwners(comm, count, [&](std::size_t i) { solved[i] = solve(i); });
  const int ranks = mpi::size(comm);
  for (std::size_t i = 0; i < count; ++i) shareFrom(i % ranks, comm, solved[i], vectors);
  return solved;
}

std::vector<std::vector<DensePair>> solveSpread(MPI_Comm comm,
                                                const std::vector<DenseProblem>& problems,
                                                Vectors vectors, const EigenvalueFilter& wanted) {
  return spread(comm, problems.size(), vectors,
                [&](std::size_t i) { return solveQuadratic(problems[i], vectors, wanted); });
}

std::vector<DensePair> solveTogether(MPI_Comm comm, const DenseProblem& problem, Vectors vectors) {
  return solveSpread(comm, {problem}, vectors)[0];
}

}  // namespace squeal::linalg
