// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/settings.hpp"

#include "base/options/options.hpp"

namespace squeal::reduction {
namespace {

const ChoiceOption basisOption(
    "flutter", "flutter_basis", {"corrected", "modal", "pod"}, "corrected",
    "vectors of the basis; corrected: free modes, and static responses to friction and to "
    "residuals; modal: only free modes; pod: as corrected, but after each batch of points the "
    "basis is reduced to the principal directions of the eigenvectors");
const RealOption toleranceOption(
    "flutter", "flutter_tolerance", 1e-8, "", positive,
    "largest estimated relative error |ds|/|s| that a certified eigenvalue may have; corrections "
    "aim at it for all eigenvalues in the band");
const IntegerOption roundsOption("flutter", "flutter_rounds", 15, 0, 10'000,
                                 "largest number of correction rounds per batch of points");
const IntegerOption growthOption(
    "flutter", "flutter_growth", 1000, 0, 1'000'000,
    "largest number of vectors that corrections add to the basis per batch of points");

}  // namespace

Settings Settings::given(const pencil::Settings& problem) {
  const std::string basis = basisOption.get();
  return {.corrected = basis != "modal",
          .compressed = basis == "pod",
          .tolerance = toleranceOption.get(),
          .rounds = roundsOption.get(),
          .growth = growthOption.get(),
          .criteria = problem.criteria,
          .band = problem.band};
}

}  // namespace squeal::reduction
