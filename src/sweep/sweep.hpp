#pragma once
/// The grid of parameters that a run goes through, and the order in which its points are best
/// solved.
#include <mpi.h>

#include <optional>
#include <vector>

#include "sweep/parameters.hpp"

namespace squeal::sweep {

/// The sweep is the grid of `-flutter_friction` × `-flutter_speed` × `-flutter_pressure` ×
/// `-flutter_damping`. Damping leaves steady sliding as it is, so that a steady state belongs to
/// all its damping factors.
struct Sweep {
  std::vector<double> frictions, speeds, pressures, dampings;  ///< ascending
  /// Steady states, damping 1: for each speed, each pressure, all frictions.
  std::vector<Parameters> steadyPoints() const;
  /// All points: for each damping, all steady states.
  std::vector<Parameters> points() const;
  /// The number of points.
  double pointCount() const;
  /// Index of a steady state that differs in one parameter by one step, and comes earlier; none for
  /// the first.
  std::optional<std::size_t> earlierNeighbour(std::size_t steadyPoint) const;
};

/// Error: an empty list, a value out of range or given twice, more than `mostPoints` points in all.
Sweep readSweep();
inline constexpr double mostPoints = 100'000;
/// Collective. A warning where the points are so many that their eigenvalue problems take long,
/// with an estimate.
void warnOfLongSweep(MPI_Comm comm, const Sweep& sweep, int modes);
/// Indices of points in the order in which one basis serves them best, in batches of 5, 16, 16, …
/// points: the largest friction first, then whatever lies farthest from the points before: of a
/// sweep over friction alone the ends, the middle and the quarters. The same on any number of
/// ranks.
std::vector<std::vector<std::size_t>> batches(const std::vector<Parameters>& points);

}  // namespace squeal::sweep
