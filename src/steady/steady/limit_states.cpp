// SPDX-License-Identifier: BSD-2-Clause
#include "steady/steady/limit_states.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/system/mpi.hpp"

namespace squeal::steady {

bool isOnActiveSet(const contact::Contact& contact, const Solution& solution,
                   const contact::ActiveSet& set) {
  constexpr double roundOff = 1e-8;  // as for `negligibleForce`
  PetscReal largest = 0;
  check(VecNorm(solution.displacement, NORM_INFINITY, &largest));
  const contact::ActiveSet own = activeSet(solution);
  bool fits = true;
  for (std::size_t i = 0; i < own.closed.size(); ++i) {
    if (own.closed[i] == set.closed[i] && own.released[i] == set.released[i]) continue;
    const ContactState& state = solution.contact[i];
    fits = fits && contact.interfaces.nodes[i].role != interfaces::Role::sticking &&
           std::abs(state.normalForce) <= 10 * solution.negligibleForce &&
           std::abs(state.coefficient) <= roundOff * largest;
  }
  return mpi::all(contact.mesh->comm, fits);
}

std::optional<Solution> onActiveSet(const contact::Contact& contact, Solution solution,
                                    const contact::ActiveSet& set) {
  if (!isOnActiveSet(contact, solution, set)) return {};
  solution.closed = set.closed;
  solution.openNodes =
      mpi::sum(contact.mesh->comm, static_cast<PetscInt>(std::ranges::count(set.closed, 0)));
  return solution;
}

}  // namespace squeal::steady
