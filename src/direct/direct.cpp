#include "direct/direct.hpp"

#include <algorithm>
#include <cmath>

#include "direct/nearest.hpp"
#include "linalg/complexvector.hpp"
#include "options/options.hpp"
#include "petsc/text.hpp"

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

struct Band {
  double low = 0, high = 0;  // rad/s
  bool wanted() const { return high > 0; }
  bool holds(Complex s) const { return s.imag() >= low && s.imag() <= high && std::abs(s) <= high; }
};

Band readBand() {
  const auto list = bandOption.get();
  const bool off = list == std::vector<double>{0, 0};
  if (list.size() != 2 || (!off && list[0] >= list[1]))
    throw Error("option -" + bandOption.fullName() + ": two frequencies, the lower one first");
  return {2 * M_PI * list[0], 2 * M_PI * list[1]};
}

/// Solves for more and more eigenvalues until the band is covered or the limit is reached.
NearestPairs solveBand(NearestSolver& solver, const Band& band) {
  const PetscInt limit = limitOption.get();
  for (PetscInt count = std::min<PetscInt>(countOption.get(), limit);;
       count = std::min(2 * count, limit)) {
    NearestPairs found = solver.solve(count);
    if (found.reached <= band.high && count < limit) continue;
    if (confirmOption.get()) addMissed(solver, count, found);
    if (found.reached <= band.high && count < limit) continue;
    std::erase_if(found.pairs, [&](const auto& pair) { return !band.holds(pair.s); });
    return found;
  }
}

/// Returns the `-flutter_direct_count` nearest eigenvalues, and those as near as the last of them.
NearestPairs solveCount(NearestSolver& solver) {
  const std::size_t count = countOption.get();
  NearestPairs found = solver.solve(countOption.get());
  if (confirmOption.get()) addMissed(solver, countOption.get(), found);
  if (found.pairs.size() <= count) return found;
  std::vector<double> sizes;
  for (const auto& pair : found.pairs) sizes.push_back(std::abs(pair.s));
  std::sort(sizes.begin(), sizes.end());
  std::erase_if(found.pairs,
                [&](const auto& pair) { return std::abs(pair.s) > (1 + 1e-9) * sizes[count - 1]; });
  return found;
}

}  // namespace

bool directWanted() { return methodOption.get() == "direct"; }

pencil::ComplexModes solveDirect(const pencil::Pencil& pencil, const sweep::Parameters& at,
                                 Mat trial) {
  const Band band = readBand();
  const auto solver = nearestSolver(pencil, at);
  auto [pairs, reached] = band.wanted() ? solveBand(*solver, band) : solveCount(*solver);
  std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) {
    return a.s.imag() != b.s.imag() ? a.s.imag() < b.s.imag() : a.s.real() < b.s.real();
  });
  pencil::ComplexModes point;
  point.at = at;
  if (band.wanted()) point.askedTo = band.high, point.coveredTo = std::min(reached, band.high);
  point.accuracy = pencil::accuracyAsked();
  for (const auto& pair : pairs) {
    const double error = pencil::backwardError(pencil, at, pair.s, pair);
    point.eigenvalues.push_back({pair.s, error, NAN, error <= point.accuracy});
  }
  markUnstable(point.eigenvalues);
  const auto wanted = pencil::shapesWanted(point);
  std::vector<linalg::ComplexVector> modes;
  for (std::size_t index : wanted)
    modes.push_back(linalg::ComplexVector::copied(pairs[index].real, pairs[index].imaginary));
  pencil::keepShapes(point, trial, wanted, std::move(modes));
  return point;
}

}  // namespace squeal::direct
