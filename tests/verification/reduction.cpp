// SPDX-License-Identifier: BSD-2-Clause
// The reduced problem against the one on all unknowns: its eigenvalues, and what it says of their
// errors.
#include <gtest/gtest.h>

#include "support/eigen/full_order.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/harness/largest_error.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

std::vector<Complex> nearestToZero(std::vector<Complex> list, std::size_t count) {
  std::sort(list.begin(), list.end(),
            [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
  list.resize(std::min(count, list.size()));
  return list;
}

/// Each point of the corrected sweep: the first `first` eigenvalues are there, and all that are
/// listed are certified, right to 1e-8 and not further off than estimated.
void expectFullOrder(const std::string& name, const std::string& changes, std::size_t first,
                     const std::string& method = "corrected") {
  const auto& exact = fullOrder(name, changes);
  const analysis::Analysis reduced =
      runCase(name, changes + " -modes_count 60 -flutter_track off -flutter_basis " + method);
  const auto& segment = reduced.flutter.segments.at(0);
  ASSERT_EQ(segment.points.size(), exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const auto& point = segment.points[i];
    const Comparison all = compare(point, exact[i]);
    const double lowest =
        worst(errors(nearestToZero(exact[i], first), eigenvaluesOf(point)).relative);
    print(
        "%s, %s, friction %g: %zu of %d unknowns, first %zu off by %.1e, all by %.1e, error / "
        "estimate %.2f\n",
        name.c_str(), method.c_str(), point.at.friction, point.eigenvalues.size(),
        static_cast<int>(segment.unknowns), first, lowest, all.worst, all.worstRatio);
    EXPECT_LT(lowest, 1e-8);
    EXPECT_LT(all.worst, 1e-8);
    EXPECT_EQ(all.certified, static_cast<int>(point.eigenvalues.size()));
    EXPECT_EQ(point.uncertifiedCount(), 0);
  }
}

TEST(Reduction, LayerFromSixtyModes) {
  expectFullOrder("layer", "-flutter_friction 0.2,0.4,0.6", 30);
}
TEST(Reduction, TwoLayersFromSixtyModes) {
  expectFullOrder("two_layers", "-flutter_friction 0.1,0.3,0.5", 30);
}

/// Checks the estimates of uncorrected free modes, whose eigenvalues are wrong by up to a few
/// thousandths: for all eigenvalues with an estimate below 1 %, and to first order.
void expectEstimated(const std::string& name, const std::string& changes) {
  const auto& exact = fullOrder(name, changes);
  const analysis::Analysis modal =
      runCase(name, changes + " -modes_count 60 -flutter_basis modal -flutter_track off");
  const auto& points = modal.flutter.segments.at(0).points;
  ASSERT_EQ(points.size(), exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    std::vector<Complex> found;
    std::vector<double> estimates;
    for (const auto& eigenvalue : points[i].eigenvalues)
      if (eigenvalue.errorEstimate() < 0.01)
        found.push_back(eigenvalue.s), estimates.push_back(eigenvalue.errorEstimate());
    const Errors all = errors(found, exact[i]);
    double ratio = 0;
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_LT(all.relative[k], 2 * estimates[k] + directError)
          << found[k] << " at friction " << points[i].at.friction;
      ratio = test::worse(ratio, (all.relative[k] - directError) / estimates[k]);
    }
    print(
        "%s %s, free modes, friction %g: %zu of %zu estimated below 1 %%, worst error %.1e, error "
        "/ estimate up to %.2f\n",
        name.c_str(), changes.c_str(), points[i].at.friction, found.size(),
        points[i].eigenvalues.size(), worst(all.relative), ratio);
    EXPECT_GE(found.size(), 10U);
    EXPECT_GT(worst(all.relative), 1e-6);  // there is an error to estimate
    for (const auto& eigenvalue : points[i].eigenvalues)
      EXPECT_FALSE(eigenvalue.certified && eigenvalue.errorEstimate() > 1e-8);
  }
}

const std::string coarse = "-mesh_set nx=18,ny_disc=6,ny_pad=4 -flutter_friction 0.1:0.5:0.1";
const std::string damping =
    " -material_pad_rayleigh_stiffness 0.01 -material_disc_rayleigh_mass 0.02";

TEST(Reduction, WithDamping) { expectFullOrder("two_layers", coarse + damping, 30); }

TEST(Reduction, ErrorsOfFreeModesAreEstimated) {
  for (const auto& damped : {std::string(), damping})
    expectEstimated("two_layers", coarse + damped);
}

TEST(Reduction, ProperOrthogonalDecomposition) {
  for (const auto& damped : {std::string(), damping})
    expectFullOrder("two_layers", coarse + damped, 30, "pod");
}

}  // namespace
}  // namespace squeal::test
