// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/settings.hpp"

#include "base/options/options.hpp"

namespace squeal::reduction {
namespace {

const ChoiceOption basisOption(
    "flutter", "flutter_basis", {"corrected", "modal", "pod"}, "corrected",
    "corrected: free modes, static responses to friction and to residuals; pod: principal "
    "directions of the eigenvectors after each batch of points; modal: free modes only");
const RealOption toleranceOption("flutter", "flutter_tolerance", 1e-8, "", positive,
                                 "target of the estimated relative error |ds|/|s| of the "
                                 "eigenvalues in the band");
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
