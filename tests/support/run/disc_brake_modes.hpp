// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The unstable modes of the disc brake on meshes that match and on meshes that do not.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/eigen/spectrum.hpp"
#include "support/run/case.hpp"

namespace squeal::test {

/// Collective. The unstable eigenvalues of the case disc_brake at f = 0.4 up to a band, Hz.
inline std::vector<Complex> unstable(const std::string& mesh, const std::string& options) {
  const analysis::Analysis analysis =
      runCase("disc_brake", "-flutter_friction 0.4 -mesh_set " + mesh + options);
  EXPECT_TRUE(analysis.converged());
  EXPECT_EQ(analysis.model.contact.interfaces.reports.at(0).matching,
            mesh.find("apart=1") == std::string::npos);
  std::vector<Complex> found;
  for (Complex s : eigenvaluesOf(analysis.flutter.segments.at(0).points.at(0)))
    if (s.real() > 1) found.push_back(s);  // 1/s: others are stable within round-off
  print("%s%s\n", mesh.c_str(), options.c_str());
  for (Complex s : found) print("  %.2f Hz, %.2f 1/s\n", s.imag() / (2 * M_PI), s.real());
  return found;
}

/// How far two lists are apart at most, relative to frequency and to growth.
struct Distance {
  double frequency = 0, growth = 0;
};

/// Checks that the same modes are unstable, with frequencies within 0.2 % and growth rates within
/// 5 % or twice the change by `refined`, a finer mesh that matches, whichever is larger; it may be
/// empty.
inline Distance expectSameModes(const std::vector<Complex>& found,
                                const std::vector<Complex>& matching,
                                const std::vector<Complex>& refined = {}) {
  EXPECT_EQ(found.size(), matching.size());
  EXPECT_FALSE(matching.empty());
  const auto mine = matched(matching, found), finer = matched(matching, refined);
  Distance worst;
  for (std::size_t i = 0; i < matching.size(); ++i) {
    const double growth = matching[i].real(), frequency = matching[i].imag();
    const double own = refined.empty() ? 0 : 2 * std::abs(finer[i].real() - growth);
    const double ofFrequency = std::abs(mine[i].imag() / frequency - 1),
                 ofGrowth = std::abs(mine[i].real() - growth);
    EXPECT_LT(ofFrequency, 2e-3) << frequency / (2 * M_PI) << " Hz";
    EXPECT_LT(ofGrowth, std::max(0.05 * growth, own)) << frequency / (2 * M_PI) << " Hz";
    worst.frequency = worse(worst.frequency, ofFrequency);
    worst.growth = worse(worst.growth, ofGrowth / growth);
  }
  print("largest difference: frequency %.2e, growth rate %.2e\n", worst.frequency, worst.growth);
  return worst;
}

}  // namespace squeal::test
