// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/direct/direct.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/complexvector.hpp"
#include "base/system/text.hpp"
#include "eigen/direct/nearest.hpp"

namespace squeal::direct {
namespace {

/// Increases the number of eigenvalues until the band is covered or the limit is reached.
NearestPairs solveBand(NearestSolver& solver, const Settings& settings) {
  const auto& [start, limit, low, high, confirmed, criteria] = settings;
  for (PetscInt count = std::min(start, limit);; count = std::min(2 * count, limit)) {
    NearestPairs found = solver.solve(count);
    if (found.reached <= high && count < limit) continue;
    if (confirmed) addMissing(solver, count, found);
    if (found.reached <= high && count < limit) continue;
    std::erase_if(found.pairs, [low = low, high = high](const auto& pair) {
      return pair.s.imag() < low || pair.s.imag() > high || std::abs(pair.s) > high;
    });
    return found;
  }
}

/// Returns the requested number of nearest eigenvalues, and all others at the distance of the last
/// one.
NearestPairs solveCount(NearestSolver& solver, const Settings& settings) {
  NearestPairs found = solver.solve(settings.count);
  if (settings.confirmed) addMissing(solver, settings.count, found);
  if (std::ssize(found.pairs) <= settings.count) return found;
  std::vector<double> sizes;
  for (const auto& pair : found.pairs) sizes.push_back(std::abs(pair.s));
  std::sort(sizes.begin(), sizes.end());
  const double last = (1 + 1e-9) * sizes[settings.count - 1];
  std::erase_if(found.pairs, [last](const auto& pair) { return std::abs(pair.s) > last; });
  return found;
}

}  // namespace

pencil::ComplexModes solveDirect(const pencil::Pencil& pencil, const sweep::Parameters& at,
                                 Mat trial, const Settings& settings) {
  const bool banded = settings.high > 0;
  const auto solver = nearestSolver(pencil, at);
  auto [pairs, reached] = banded ? solveBand(*solver, settings) : solveCount(*solver, settings);
  std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) {
    return a.s.imag() != b.s.imag() ? a.s.imag() < b.s.imag() : a.s.real() < b.s.real();
  });
  pencil::ComplexModes point;
  point.at = at;
  if (banded)
    point.directBandTop = settings.high, point.coveredTo = std::min(reached, settings.high);
  point.accuracy = settings.criteria.accuracy;
  for (const auto& pair : pairs) {
    const double error = pencil::backwardError(pencil, at, pair.s, pair);
    point.eigenvalues.push_back({pair.s, error, NAN, error <= point.accuracy});
  }
  pencil::setVerdicts(point, pencil::Symmetry::none, settings.criteria);
  const auto wanted = pencil::shapesToStore(point, settings.criteria);
  std::vector<linalg::ComplexVector> modes;
  for (std::size_t index : wanted)
    modes.push_back(linalg::ComplexVector::copied(pairs[index].real, pairs[index].imaginary));
  pencil::storeShapes(point, trial, wanted, std::move(modes));
  return point;
}

}  // namespace squeal::direct
