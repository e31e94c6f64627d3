// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep/sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/petsc/check.hpp"
#include "base/session/stages.hpp"
#include "base/system/text.hpp"

namespace squeal::sweep {
Sweep grid(const Settings& settings) {
  Sweep sweep{.frictions = settings.frictions,
              .speeds = settings.speeds,
              .pressures = settings.pressures,
              .dampings = settings.dampings};
  const double points = sweep.pointCount();
  if (points > mostPoints)
    throw Error(
        formatted("options -flutter_friction, -flutter_speed, -flutter_pressure and "
                  "-flutter_damping: %zu x %zu x %zu x %zu = %.0f "
                  "points; a sweep has at most %.0f",
                  sweep.frictions.size(), sweep.speeds.size(), sweep.pressures.size(),
                  sweep.dampings.size(), points, mostPoints));
  return sweep;
}

double Sweep::pointCount() const {
  return 1.0 * frictions.size() * speeds.size() * pressures.size() * dampings.size();
}

void warnOfLongSweep(MPI_Comm comm, const Sweep& sweep, int modes) {
  constexpr double many = 1000, perSecond = 5e10;
  if (sweep.pointCount() < many) return;
  // For a basis of m vectors, the dense problems of a point take as long as 200 m³ operations of a
  // matrix product; assume that m is 2.3 times the number of modes.
  const double hours = sweep.pointCount() * 200 * std::pow(2.3 * modes, 3) / perSecond / 3600;
  printWarning(comm, formatted("a sweep of %.0f points, %.0f steady states: their dense eigenvalue "
                               "problems will take about %.2g hours (%d free modes)",
                               sweep.pointCount(), sweep.pointCount() / sweep.dampings.size(),
                               hours, modes));
}

std::vector<Parameters> Sweep::steadyPoints() const {
  std::vector<Parameters> points;
  for (double speed : speeds)
    for (double pressure : pressures)
      for (double friction : frictions) points.push_back({friction, speed, pressure, 1});
  return points;
}

std::vector<Parameters> Sweep::points() const {
  std::vector<Parameters> points;
  for (double damping : dampings)
    for (Parameters at : steadyPoints()) {
      at.damping = damping;
      points.push_back(at);
    }
  return points;
}

std::optional<std::size_t> Sweep::earlierNeighbour(std::size_t steadyPoint) const {
  const std::size_t row = frictions.size(), plane = row * pressures.size();
  if (steadyPoint % row >= 1) return steadyPoint - 1;
  if (steadyPoint % plane >= row) return steadyPoint - row;
  if (steadyPoint >= plane) return steadyPoint - plane;
  return std::nullopt;
}

std::vector<std::vector<std::size_t>> batches(const std::vector<Parameters>& points) {
  // The ends, the middle and the quarters of a range give most of the basis; later points need only
  // one or two rounds of corrections.
  constexpr std::size_t first = 5, later = 16;
  std::array<double, allParameters.size()> ranges{};
  for (std::size_t k = 0; k < ranges.size() && !points.empty(); ++k) {
    const auto value = allParameters[k].value;
    const auto [low, high] =
        std::minmax_element(points.begin(), points.end(),
                            [&](const auto& p, const auto& q) { return p.*value < q.*value; });
    ranges[k] = (*high).*value - (*low).*value;
  }
  const auto apart = [&](std::size_t a, std::size_t b) {
    double sum = 0;
    for (std::size_t k = 0; k < ranges.size(); ++k) {
      const auto value = allParameters[k].value;
      if (ranges[k] > 0) sum += std::pow((points[a].*value - points[b].*value) / ranges[k], 2);
    }
    return sum;
  };
  std::vector<double> distance(points.size(), INFINITY);  // to the nearest point already chosen
  std::vector<std::vector<std::size_t>> result;
  std::size_t next = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].friction > points[next].friction) next = i;
  for (std::size_t chosen = 0; chosen < points.size(); ++chosen) {
    if (chosen == 0 || (chosen >= first && (chosen - first) % later == 0)) result.emplace_back();
    result.back().push_back(next);
    for (std::size_t i = 0; i < points.size(); ++i)
      distance[i] = std::min(distance[i], apart(i, next));
    distance[next] = -1;
    next = std::max_element(distance.begin(), distance.end()) - distance.begin();
  }
  return result;
}

}  // namespace squeal::sweep
