// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Eigenvalues of a case on all unknowns, and how far those of its reduced problem are from them.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "eigen/pencil/complex_modes.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/harness/largest_error.hpp"
#include "support/run/case.hpp"

namespace squeal::test {

/// Eigenvalues, a list for each point of a sweep.
using Lists = std::vector<std::vector<Complex>>;

/// The 80 lowest eigenvalues of the problem on all unknowns at each point of the sweep; solved
/// once.
inline const Lists& fullOrder(const std::string& name, const std::string& changes) {
  static std::map<std::string, Lists> known;
  auto& lists = known[name + changes];
  if (!lists.empty()) return lists;
  const analysis::Analysis analysis =
      runCase(name, changes + " -flutter_method direct -flutter_direct_count 80");
  for (const auto& point : analysis.flutter.segments.at(0).points) {
    EXPECT_LT(point.worstBackwardError(),
              1e-12);  // at the far end, where the Krylov space ends; a thousandth of it lower down
    lists.push_back(eigenvaluesOf(point));
  }
  EXPECT_FALSE(lists.empty()) << "no point to compare with";
  return lists;
}

/// By which the direct solve may err, relative to |s|: where two reduced bases agree to 1e-15, TOAR
/// was 1.2e-13 from both.
inline constexpr double directError = 3e-13;

struct Comparison {
  double worst = 0;  ///< |s − s*| / |s*|
  /// The ratio of the true error to the estimate, as far as the error of s* resolves it
  double worstRatio = 0;
  int certified = 0;
};

/// All eigenvalues of a point with those of the full order, each with one of its own.
inline Comparison compare(const pencil::ComplexModes& point, const std::vector<Complex>& exact) {
  Comparison result;
  const auto found = eigenvaluesOf(point);
  const auto match = matched(found, exact);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double error = std::abs(found[i] - match[i]) / std::abs(match[i]),
                 estimate = point.eigenvalues[i].errorEstimate();
    EXPECT_FALSE(std::isnan(error)) << found[i] << " is none of the full order";
    EXPECT_LT(error, 2 * estimate + directError)
        << found[i] << " at friction " << point.at.friction;
    result.worst = worse(result.worst, error);
    result.worstRatio = worse(result.worstRatio, (error - directError) / estimate);
    result.certified += point.eigenvalues[i].certified;
  }
  return result;
}

}  // namespace squeal::test
