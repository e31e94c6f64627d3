// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Steady sliding is found at all steady points of a sweep, and what the contact does between them.
#include <memory>
#include <vector>

#include "model/contact/active_set.hpp"
#include "model/contact/coupled.hpp"
#include "run/analysis/analysis.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::analysis {

/// The associated system of the active set in force, which is rebuilt when the set changes.
class CurrentSystem {
 public:
  /// Borrows the analysis during the life of the object.
  explicit CurrentSystem(const Analysis& analysis) : analysis_(analysis) {}
  /// Collective. Returns the system of an active set, borrowed until the next call. Its K0 is
  /// factorised when that is first asked for.
  const contact::CoupledSystem& of(const contact::ActiveSet& active);

 private:
  const Analysis& analysis_;
  std::unique_ptr<contact::CoupledSystem> system_;
};

/// Collective. Adds to the analysis the steady states at all steady points, each started from the
/// active set of a neighbour, and the path of the contact between them. A point without a solution
/// gives a warning. Throws Error as steady::Problem::solve() does, and if a displacement is not a
/// finite number.
void steadySweep(Analysis& analysis, CurrentSystem& system);

}  // namespace squeal::analysis
