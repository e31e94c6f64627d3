// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Joins the eigenvalues at both ends of a step group by group.
#include <optional>
#include <vector>

#include "eigen/pencil/band.hpp"
#include "eigen/tracking/family.hpp"
#include "eigen/tracking/join.hpp"
#include "eigen/tracking/pair_tracer.hpp"
#include "eigen/tracking/step.hpp"

namespace squeal::tracking {

/// Joins the eigenvalues of two stations whose subspaces overlap.
class StepJoiner {
 public:
  /// Borrows the family and the band.
  StepJoiner(Family& family, const pencil::WatchedBand& band) : family_(family), band_(band) {}
  /// Collective. Joins two stations of the family.
  StepResult join(const SolvedStation& a, const SolvedStation& b) const;
  /// Collective. Joins the last station of one piece of a path, whose family is `before`, to the
  /// first station of the next piece.
  StepResult jump(Family& before, const SolvedStation& a, const SolvedStation& b) const;

 private:
  /// Both ends of a step, with their spectra in common coordinates; borrowed.
  struct Ends {
    const SolvedStation& a;
    const SolvedStation& b;
    const linalg::Spectrum& here;
    const linalg::Spectrum& there;
  };
  bool matters(const Ends& ends, const Group& group) const;
  bool lasts(const Ends& ends, const Group& group) const;
  double isolation(const Ends& ends, const Group& group) const;
  void joinSingle(const Ends& ends, const Group& group, StepResult& step) const;
  void joinUncertain(const Ends& ends, const Group& group, bool counts, StepResult& step) const;
  void joinAcrossJump(const Ends& ends, const Group& group, StepResult& step) const;
  std::optional<Trace> traced(const Ends& ends, const Group& group) const;
  std::optional<std::vector<Event>> splittings(const Ends& ends, const Group& group,
                                               const std::vector<std::size_t>& mate) const;

  Family& family_;
  const pencil::WatchedBand& band_;
};

}  // namespace squeal::tracking
