// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/spectrum.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "algebra/linalg/spread.hpp"
#include "base/petsc/check.hpp"
#include "eigen/reduction/eigenpair_correction.hpp"
#include "eigen/reduction/missing.hpp"
#include "eigen/reduction/undamped_correction.hpp"

namespace squeal::reduction {
namespace {

/// Bounds of the fraction of a residual that may remain after improving a pair. A round of
/// corrections gains a decade, and the remainder must be small compared with that. A pair near its
/// tolerance needs less.
constexpr double least = 0.03, enough = 0.3;
/// A left vector counts only in the product of two errors.
constexpr double leastOfLeft = 0.1;

/// True if the pairs of an earlier, smaller basis can be improved.
bool canImprove(const SpectrumRequest& request, const pencil::WatchedBand& band) {
  return !request.spectrum->band.empty() && band.top > 0 && std::isfinite(band.top) &&
         request.problem->order() >= smallestImproved && !linalg::conservative(*request.problem);
}

/// Returns all pairs of a spectrum, those of the band first.
std::vector<linalg::DensePair> allPairs(const Spectrum& spectrum) {
  std::vector<linalg::DensePair> pairs = spectrum.band;
  pairs.insert(pairs.end(), spectrum.guard.begin(), spectrum.guard.end());
  return pairs;
}

std::vector<UnconvergedPair> openOf(const SpectrumRequest& request) {
  const Spectrum& spectrum = *request.spectrum;
  std::vector<UnconvergedPair> open;
  for (std::size_t j = 0; j < spectrum.band.size(); ++j)
    if (const double ratio = request.errorRatio[j]; ratio > 1)
      open.push_back({j, std::max(least, enough / ratio), leastOfLeft});
  return open;
}

/// Replaces a spectrum by these pairs, those of the band and those of the guard zone.
void replace(Spectrum& spectrum, std::vector<linalg::DensePair> pairs,
             const pencil::WatchedBand& band, bool improved) {
  std::ranges::sort(pairs, [](const auto& a, const auto& b) {
    return a.s.imag() != b.s.imag() ? a.s.imag() < b.s.imag() : a.s.real() < b.s.real();
  });
  spectrum = {.band = {}, .guard = {}, .improved = improved};
  for (auto& pair : pairs)
    (band.top == 0 || band.contains(pair.s) ? spectrum.band : spectrum.guard)
        .push_back(std::move(pair));
}

}  // namespace

void solveSpectra(MPI_Comm comm, const pencil::WatchedBand& band,
                  const std::vector<SpectrumRequest>& requests) {
  std::vector<const SpectrumRequest*> damped, undamped, inFull;
  std::vector<std::vector<linalg::DensePair>> pairs;  // [damped]
  for (const auto& request : requests) {
    if (!canImprove(request, band)) {
      inFull.push_back(&request);
    } else if (request.problem->damping.empty()) {
      undamped.push_back(&request);
    } else {
      damped.push_back(&request);
      pairs.push_back(allPairs(*request.spectrum));
    }
  }
  std::vector<CorrectionTask> tasks;
  for (std::size_t i = 0; i < damped.size(); ++i)
    tasks.push_back({damped[i]->problem, &pairs[i], openOf(*damped[i])});
  const auto improved = correctPairs(comm, tasks);
  for (std::size_t i = 0; i < damped.size(); ++i) {
    if (improved[i])
      replace(*damped[i]->spectrum, std::move(pairs[i]), band, true);
    else
      inFull.push_back(damped[i]);
  }
  const linalg::EigenvalueFilter watched = [&](Complex s) {
    return band.top == 0 || band.watches(s);
  };
  const std::size_t improvable = undamped.size();
  auto rest = std::move(undamped);
  rest.insert(rest.end(), inFull.begin(), inFull.end());
  auto solved = linalg::spread(comm, rest.size(), linalg::Vectors::both, [&](std::size_t i) {
    const SpectrumRequest& request = *rest[i];
    if (i < improvable)
      if (auto better = correctedUndamped(*request.problem, allPairs(*request.spectrum),
                                          openOf(request), watched))
        return std::move(*better);
    return linalg::solveQuadratic(*request.problem, linalg::Vectors::both, watched);
  });
  for (std::size_t i = 0; i < solved.size(); ++i)
    replace(*rest[i]->spectrum, std::move(solved[i]), band, i < improvable);
}

std::vector<bool> incomplete(MPI_Comm comm, const pencil::WatchedBand& band,
                             const std::vector<SpectrumRequest>& requests) {
  constexpr std::array places{0.25, 0.75};  // of shifts, in parts of the band
  const auto found = linalg::spread(
      comm, requests.size() * places.size(), linalg::Vectors::right, [&](std::size_t i) {
        const auto& [problem, spectrum, errorRatio] = requests[i / places.size()];
        std::vector<linalg::DensePair> pairs = allPairs(*spectrum), result;
        for (auto& pair : pairs)  // they may belong to a smaller basis
          for (auto* vector : {&pair.q, &pair.left}) vector->resize(problem->order());
        const Complex shift(0, places[i % places.size()] * band.top);
        const auto unknown =
            findMissing(*problem, pairs, shift, [&](Complex s) { return band.contains(s); });
        if (unknown) result.push_back({*unknown, {}});
        return result;
      });
  std::vector<bool> are(requests.size(), false);
  for (std::size_t i = 0; i < found.size(); ++i)
    are[i / places.size()] = are[i / places.size()] || !found[i].empty();
  return are;
}

}  // namespace squeal::reduction
