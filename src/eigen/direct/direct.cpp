#include "eigen/direct/direct.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/complexvector.hpp"
#include "base/options/options.hpp"
#include "base/system/text.hpp"
#include "eigen/direct/nearest.hpp"

namespace squeal::direct {
namespace {

const ChoiceOption methodOption(
    "flutter", "flutter_method", {"reduced", "direct"}, "reduced",
    "reduced: dense problem on the free modes; direct: all unknowns, for checking");
const IntegerOption countOption("flutter", "flutter_direct_count", 100, 1, 1'000'000,
                                "number of eigenvalues nearest to zero found by the direct method, "
                                "conjugate pairs counted once");
const RealListOption bandOption(
    "flutter", "flutter_direct_band", "0,0", "Hz", nonNegative,
    "low,high: the direct method finds all eigenvalues with Im s / 2 pi between them and |s| up to "
    "2 pi high instead of a number of them; 0,0: off");
const IntegerOption limitOption(
    "flutter", "flutter_direct_limit", 2000, 1, 1'000'000,
    "most eigenvalues found by the direct method to cover -flutter_direct_band");

const FlagOption confirmOption(
    "flutter", "flutter_direct_confirm", true,
    "repeat the direct solve from another start until nothing new is found: one alone may miss "
    "multiple eigenvalues");

/// Solves for more and more eigenvalues until the band is covered or the limit is reached.
NearestPairs solveBand(NearestSolver& solver, const Options& options) {
  const auto& [start, limit, low, high, confirmed, criteria] = options;
  for (PetscInt count = std::min(start, limit);; count = std::min(2 * count, limit)) {
    NearestPairs found = solver.solve(count);
    if (found.reached <= high && count < limit) continue;
    if (confirmed) addMissed(solver, count, found);
    if (found.reached <= high && count < limit) continue;
    std::erase_if(found.pairs, [low = low, high = high](const auto& pair) {
      return pair.s.imag() < low || pair.s.imag() > high || std::abs(pair.s) > high;
    });
    return found;
  }
}

/// Returns the nearest eigenvalues, as many as are wanted, and those as near as the last of them.
NearestPairs solveCount(NearestSolver& solver, const Options& options) {
  NearestPairs found = solver.solve(options.count);
  if (options.confirmed) addMissed(solver, options.count, found);
  if (std::ssize(found.pairs) <= options.count) return found;
  std::vector<double> sizes;
  for (const auto& pair : found.pairs) sizes.push_back(std::abs(pair.s));
  std::sort(sizes.begin(), sizes.end());
  const double last = (1 + 1e-9) * sizes[options.count - 1];
  std::erase_if(found.pairs, [last](const auto& pair) { return std::abs(pair.s) > last; });
  return found;
}

}  // namespace

Options Options::given() {
  const auto band = bandOption.get();
  const bool off = band == std::vector<double>{0, 0};
  if (band.size() != 2 || (!off && band[0] >= band[1]))
    throw Error("option -" + bandOption.fullName() + ": two frequencies, the lower one first");
  Options options{};
  options.count = countOption.get();
  options.limit = limitOption.get();
  options.low = 2 * M_PI * band[0];
  options.high = 2 * M_PI * band[1];
  options.confirmed = confirmOption.get();
  options.criteria = pencil::Criteria::given();
  return options;
}

bool directWanted() { return methodOption.get() == "direct"; }

pencil::ComplexModes solveDirect(const pencil::Pencil& pencil, const sweep::Parameters& at,
                                 Mat trial, const Options& options) {
  const bool banded = options.high > 0;
  const auto solver = nearestSolver(pencil, at);
  auto [pairs, reached] = banded ? solveBand(*solver, options) : solveCount(*solver, options);
  std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) {
    return a.s.imag() != b.s.imag() ? a.s.imag() < b.s.imag() : a.s.real() < b.s.real();
  });
  pencil::ComplexModes point;
  point.at = at;
  if (banded) point.askedTo = options.high, point.coveredTo = std::min(reached, options.high);
  point.accuracy = options.criteria.accuracy;
  for (const auto& pair : pairs) {
    const double error = pencil::backwardError(pencil, at, pair.s, pair);
    point.eigenvalues.push_back({pair.s, error, NAN, error <= point.accuracy});
  }
  pencil::judge(point, pencil::Symmetry::none, options.criteria);
  const auto wanted = pencil::shapesWanted(point, options.criteria);
  std::vector<linalg::ComplexVector> modes;
  for (std::size_t index : wanted)
    modes.push_back(linalg::ComplexVector::copied(pairs[index].real, pairs[index].imaginary));
  pencil::keepShapes(point, trial, wanted, std::move(modes));
  return point;
}

}  // namespace squeal::direct
