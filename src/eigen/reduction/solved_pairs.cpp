// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/solved_pairs.hpp"

#include <algorithm>
#include <ranges>

#include "algebra/linalg/serialization.hpp"
#include "algebra/linalg/spread.hpp"

namespace squeal::reduction {

void SolvedPairs::store(const std::vector<PointState>& states, PetscInt basisSize) {
  constexpr double most = 1e9;  // bytes on all ranks
  const int rank = mpi::rank(comm_), ranks = mpi::size(comm_);
  for (const auto& state : states) {
    const auto& [band, guard, improved] = state.solution.spectrum;
    const double bytes = 2.0 * sizeof(Complex) * basisSize * (band.size() + guard.size());
    const bool isRepeated = std::ranges::any_of(entries_, [&](const Entry& entry) {
      return entry.at == state.point->at && entry.set == state.point->set;
    });
    if (bytes_ + bytes > most && !isRepeated) continue;  // at() must not return the older pairs
    bytes_ += bytes;
    Entry& entry = entries_.emplace_back(Entry{.at = state.point->at,
                                               .set = state.point->set,
                                               .owner = int(entries_.size()) % ranks,
                                               .pairs = {}});
    if (rank != entry.owner) continue;
    entry.pairs = band;
    entry.pairs.insert(entry.pairs.end(), guard.begin(), guard.end());
  }
}

std::optional<std::vector<linalg::DensePair>> SolvedPairs::at(const sweep::Parameters& at,
                                                              int set) const {
  for (const auto& entry : entries_ | std::views::reverse)  // a point may have been solved again
    if (entry.at == at && entry.set == set) {
      auto pairs = entry.pairs;
      linalg::shareFrom(entry.owner, comm_, pairs, linalg::Vectors::both);
      return pairs;
    }
  return {};
}

void SolvedPairs::serialise(checkpoint::Archive& archive) {
  std::size_t count = entries_.size();
  archive.common(bytes_, count);
  entries_.resize(count);
  for (; serialised_ < count; ++serialised_) {
    auto& entry = entries_[serialised_];
    archive.common(entry.at, entry.set, entry.owner);
    archive.own(entry.pairs);
  }
}

}  // namespace squeal::reduction
