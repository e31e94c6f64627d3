// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/eigenpair_correction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "algebra/linalg/spread.hpp"
#include "base/petsc/check.hpp"
#include "base/petsc/log_events.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "eigen/reduction/companion.hpp"

namespace squeal::reduction {

using linalg::DensePair;

namespace {

/// Returns true if two pairs coincide: equal eigenvalues and parallel vectors.
bool haveMet(const std::vector<DensePair>& pairs) {
  constexpr double equal = 1e-9, parallel = 1 - 1e-8;
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t j) { return pairs[j].s.imag(); });
  for (std::size_t a = 0; a < order.size(); ++a)
    for (std::size_t b = a + 1; b < order.size(); ++b) {
      const DensePair &x = pairs[order[a]], &y = pairs[order[b]];
      if (y.s.imag() - x.s.imag() > equal * std::abs(x.s)) break;
      if (std::abs(y.s - x.s) <= equal * std::abs(x.s) &&
          std::abs(innerProduct(x.q, y.q)) > parallel * length(x.q) * length(y.q))
        return true;
    }
  return false;
}

struct OwnedGroup {
  std::size_t task;
  PairGroup group;
};

/// Collective. Sends the members of these groups from the ranks that have improved them to all
/// ranks. Group g belongs to rank g modulo the number of ranks.
void share(MPI_Comm comm, const std::vector<CorrectionTask>& tasks,
           const std::vector<OwnedGroup>& groups, const std::vector<bool>& improved) {
  const int rank = mpi::rank(comm), ranks = mpi::size(comm);
  const auto membersOf = [&](int owner, const auto& action) {
    for (std::size_t g = owner; g < groups.size(); g += ranks)
      if (improved[g])
        for (const auto j : groups[g].group.members()) action((*tasks[groups[g].task].pairs)[j]);
  };
  const auto forAll = [](DensePair& pair, const auto& action) {
    action(std::span(&pair.s, 1));
    action(std::span(pair.q));
    action(std::span(pair.left));
  };
  std::vector<Complex> own;
  membersOf(rank, [&](DensePair& pair) {
    forAll(pair, [&](std::span<Complex> part) { own.insert(own.end(), part.begin(), part.end()); });
  });
  if (mpi::sum(comm, own.size()) > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw Error("the eigenvectors of a batch exceed the size of one message: solve fewer points");
  const auto all = concatenated(comm, own);
  auto from = all.cbegin();
  for (int owner = 0; owner < ranks; ++owner)
    membersOf(owner, [&](DensePair& pair) {
      forAll(pair, [&](std::span<Complex> part) {
        std::copy_n(from, part.size(), part.begin());
        from += part.size();
      });
    });
}

/// Collective. Iterates the groups of the unfinished tasks, each on one rank, and returns their
/// outcomes on all ranks, [group].
std::vector<int> iterated(MPI_Comm comm, std::vector<OwnedGroup>& groups,
                          const std::vector<bool>& ended, bool forced) {
  std::vector<int> outcomes(groups.size(), 0);
  linalg::onOwners(comm, groups.size(), [&](std::size_t g) {
    if (ended[groups[g].task]) return;
    const LoggedWork logged(Work::denseEigenvalues);
    outcomes[g] = static_cast<int>(groups[g].group.iterate(forced));
  });
  mpi::reduce(comm, std::span(outcomes), MPI_MAX);
  return outcomes;
}

/// Returns true if a group of the task has this outcome.
bool anyOf(const std::vector<OwnedGroup>& groups, const std::vector<int>& outcomes,
           std::size_t task, PairGroup::Outcome outcome) {
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (groups[g].task == task && outcomes[g] == static_cast<int>(outcome)) return true;
  return false;
}

}  // namespace

std::vector<bool> correctPairs(MPI_Comm comm, const std::vector<CorrectionTask>& tasks) {
  using Outcome = PairGroup::Outcome;
  constexpr int mostSweeps = 4;
  std::vector<Companion> companions;
  companions.reserve(tasks.size());  // groups borrow them
  std::vector<OwnedGroup> groups;
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    const auto& [problem, pairs, open] = tasks[t];
    for (auto& pair : *pairs)
      for (auto* vector : {&pair.q, &pair.left}) vector->resize(problem->order());
    companions.emplace_back(*problem, largestSize(*pairs));
    for (const auto& group : groupsOf(*pairs, open))
      groups.push_back({t, PairGroup(companions.back(), *pairs, group)});
  }
  std::vector<bool> good(tasks.size(), false), ended(tasks.size(), false);
  for (int sweep = 0; sweep < mostSweeps; ++sweep) {
    // From the second sweep on, all groups iterate, since their neighbours may need better vectors.
    const auto outcomes = iterated(comm, groups, ended, sweep > 0);
    std::vector<bool> failed(tasks.size()), improved(groups.size()), next = ended;
    for (std::size_t t = 0; t < tasks.size(); ++t) {
      failed[t] = anyOf(groups, outcomes, t, Outcome::failed);
      const bool unfinished = anyOf(groups, outcomes, t, Outcome::unfinished);
      next[t] = ended[t] || failed[t] || !unfinished;
      if (!ended[t]) good[t] = !failed[t] && !unfinished;
    }
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const std::size_t t = groups[g].task;
      improved[g] = !ended[t] && !failed[t] && outcomes[g] != static_cast<int>(Outcome::untouched);
    }
    share(comm, tasks, groups, improved);
    ended = next;
    if (std::ranges::find(ended, false) == ended.end()) break;
  }
  for (std::size_t t = 0; t < tasks.size(); ++t) good[t] = good[t] && !haveMet(*tasks[t].pairs);
  return good;
}

}  // namespace squeal::reduction
