// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The grid of parameters of a run, and the order in which its points are solved.
#include <mpi.h>

#include <optional>
#include <vector>

#include "eigen/sweep/parameters.hpp"
#include "eigen/sweep/settings.hpp"

namespace squeal::sweep {

/// The sweep is the grid of `-flutter_friction` × `-flutter_speed` × `-flutter_pressure` ×
/// `-flutter_damping`. Steady sliding does not depend on damping, so all damping factors share one
/// steady state.
struct Sweep {
  std::vector<double> frictions, speeds, pressures, dampings;  ///< ascending
  /// Returns one point for each steady state; its damping factor is 1. The friction varies
  /// fastest, the speed slowest.
  std::vector<Parameters> steadyPoints() const;
  /// Returns all points: for each damping, the points of all steady states.
  std::vector<Parameters> points() const;
  /// Returns the number of points.
  double pointCount() const;
  /// Returns the index of an earlier steady state that differs in one parameter by one step; none
  /// for the first.
  std::optional<std::size_t> earlierNeighbour(std::size_t steadyPoint) const;
};

/// The maximum number of points of a sweep.
inline constexpr double mostPoints = 100'000;
/// Not collective. Returns the grid of the settings. Throws Error if it has more than `mostPoints`
/// points.
Sweep grid(const Settings& settings);
/// Collective. Warns about a sweep of at least 1000 points, with an estimate of the time for its
/// eigenvalue problems. `modes` is the number of free modes.
void warnOfLongSweep(MPI_Comm comm, const Sweep& sweep, int modes);
/// Returns the indices of the points in the order in which they are solved with one growing basis,
/// in batches of 5, 16, 16, … points. The first point has the largest friction. Each next point is
/// the one farthest from all preceding points, with every parameter scaled to its range. If only
/// the friction is swept, in equal steps, the first batch is the ends, the middle and the quarter
/// points. The order does not depend on the number of ranks.
std::vector<std::vector<std::size_t>> batches(const std::vector<Parameters>& points);

}  // namespace squeal::sweep
