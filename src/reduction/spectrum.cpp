#include "reduction/spectrum.hpp"

#include <algorithm>
#include <cmath>

#include "petsc/check.hpp"
#include "refinement/refinement.hpp"

namespace squeal::reduction {
namespace {

/// Smaller problems are solved in full, in no more time than improving would take.
constexpr PetscInt smallestImproved = 400;

/// The part of a residual that improving a pair may leave: a round of corrections gains a decade,
/// and what is left must be small beside that; little is asked of a pair that needs little.
constexpr double least = 0.03, enough = 0.3;

/// Improves the pairs of a spectrum. Returns no pairs if they have to be computed in full.
std::vector<linalg::DensePair> improved(const SpectrumRequest& request,
                                        const pencil::WatchedBand& band) {
  const auto& spectrum = *request.spectrum;
  if (spectrum.band.empty() || request.problem->damping.empty() || !(band.top > 0) ||
      !std::isfinite(band.top) || request.problem->order() < smallestImproved ||
      linalg::conservative(*request.problem))
    return {};
  std::vector<linalg::DensePair> pairs = spectrum.band;
  std::vector<refinement::Open> open;
  for (std::size_t j = 0; j < pairs.size(); ++j)
    if (const double ratio = request.errorRatio[j]; ratio > 1)
      open.push_back({j, std::max(least, enough / ratio)});
  pairs.insert(pairs.end(), spectrum.guard.begin(), spectrum.guard.end());
  return refinement::improve(*request.problem, pairs, open) ? pairs
                                                            : std::vector<linalg::DensePair>{};
}

/// Takes the pairs apart into those of the band and those of the guard zone.
void keep(std::vector<linalg::DensePair> pairs, const pencil::WatchedBand& band,
          Spectrum& spectrum) {
  std::ranges::sort(pairs, [](const auto& a, const auto& b) {
    return a.s.imag() != b.s.imag() ? a.s.imag() < b.s.imag() : a.s.real() < b.s.real();
  });
  spectrum.band.clear();
  spectrum.guard.clear();
  for (auto& pair : pairs)
    (band.top == 0 || band.contains(pair.s) ? spectrum.band : spectrum.guard)
        .push_back(std::move(pair));
}

}  // namespace

void solveSpectra(MPI_Comm comm, const pencil::WatchedBand& band,
                  const std::vector<SpectrumRequest>& requests) {
  std::vector<int> isImproved(requests.size(), 0);
  auto solved = linalg::spread(comm, requests.size(), linalg::Vectors::both, [&](std::size_t i) {
    auto pairs = improved(requests[i], band);
    isImproved[i] = !pairs.empty();
    if (isImproved[i]) return pairs;
    const bool damped = !requests[i].problem->damping.empty();
    return linalg::solveQuadratic(*requests[i].problem, linalg::Vectors::both, [&](Complex s) {
      return band.top == 0 || (damped ? band.watches(s) : band.contains(s));
    });
  });
  check(MPI_Allreduce(MPI_IN_PLACE, isImproved.data(), isImproved.size(), MPI_INT, MPI_MAX, comm));
  for (std::size_t i = 0; i < requests.size(); ++i) {
    keep(std::move(solved[i]), band, *requests[i].spectrum);
    requests[i].spectrum->improved = isImproved[i] != 0;
  }
}

std::vector<bool> incomplete(MPI_Comm comm, const pencil::WatchedBand& band,
                             const std::vector<SpectrumRequest>& requests) {
  std::vector<Complex> shifts;
  for (const double part : {0.25, 0.75}) shifts.emplace_back(0, part * band.top);
  const auto found =
      linalg::spread(comm, requests.size(), linalg::Vectors::right, [&](std::size_t i) {
        const auto& [problem, spectrum, errorRatio] = requests[i];
        std::vector<linalg::DensePair> pairs = spectrum->band, result;
        pairs.insert(pairs.end(), spectrum->guard.begin(), spectrum->guard.end());
        for (auto& pair : pairs)  // they may be of a smaller basis
          for (auto* vector : {&pair.q, &pair.left}) vector->resize(problem->order());
        const auto unknown = refinement::missing(*problem, pairs, shifts,
                                                 [&](Complex s) { return band.contains(s); });
        if (unknown) result.push_back({*unknown, {}});
        return result;
      });
  std::vector<bool> are;
  for (const auto& pairs : found) are.push_back(!pairs.empty());
  return are;
}

}  // namespace squeal::reduction
