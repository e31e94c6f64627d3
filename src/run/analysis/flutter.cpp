// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/flutter.hpp"

#include <algorithm>
#include <iterator>

#include "base/session/stages.hpp"

namespace squeal::analysis {

void Flutter::addFailure(MPI_Comm comm, const std::string& reason) {
  printWarning(comm, reason);
  failures.push_back(reason);
}

void Flutter::append(Flutter more) {
  const auto move = [](auto& from, auto& to) { std::ranges::move(from, std::back_inserter(to)); };
  move(more.segments, segments);
  move(more.onsets, onsets);
  move(more.regimes, regimes);
  move(more.failures, failures);
  complete = more.complete;
}

}  // namespace squeal::analysis
