// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Tracking of two eigenvalues that mix, in their common subspace.
#include <optional>
#include <vector>

#include "algebra/linalg/rayleigh_ritz.hpp"
#include "eigen/tracking/family.hpp"
#include "eigen/tracking/track.hpp"

namespace squeal::tracking {

/// Two eigenvalues at one friction.
struct PairAt {
  double friction;
  linalg::Spectrum spectrum;
  const std::vector<linalg::DensePair>& pairs() const { return spectrum.pairs(); }
};

/// Two eigenvalues at both ends of a step. Borrows the ends.
struct TraceRequest {
  const PairAt& low;
  const PairAt& high;
  std::vector<int> ids;  ///< [pair at `low`] its branch
  double isolation;      ///< distance of the mean of the two from other eigenvalues, rad/s
  double smallest;       ///< smallest step, except in the search for a change of stability
};

/// The continuation of eigenvalues over a step.
struct Trace {
  std::vector<std::size_t> mate;  ///< [pair at the lower end] its continuation at the upper end
  std::vector<Event> events = {};
  std::vector<Gap> gaps = {};
};

/// Halves a step until each of two eigenvalues is identified.
class PairTracer {
 public:
  /// Borrows the family.
  explicit PairTracer(Family& family) : family_(family) {}
  /// Collective. Returns the continuation; none if the subspace is not found within the step.
  std::optional<Trace> trace(const TraceRequest& request) const;

  static constexpr double closer = 1. / 16;  ///< fraction of a step, to approach equal eigenvalues

 private:
  struct Approach;
  Trace coalesced(const TraceRequest& request, bool merging) const;
  Trace separate(const TraceRequest& request, std::vector<std::size_t> mate, bool clear) const;
  bool appendChanges(const Event& event, Trace& trace) const;
  std::optional<Trace> traceBy(const PairAt& between, const TraceRequest& request) const;
  std::optional<Trace> traceFromEqual(const TraceRequest& request) const;
  std::optional<PairAt> within(const PairAt& equal, const PairAt& apart, double part,
                               double isolation) const;
  Approach approach(const PairAt& equal, const PairAt& apart, const TraceRequest& request) const;

  Family& family_;
};

}  // namespace squeal::tracking
