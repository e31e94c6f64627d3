// SPDX-License-Identifier: BSD-2-Clause
// Critical frictions of two damped elastic layers: against the problem on all unknowns, and against
// the exact waves.
#include <gtest/gtest.h>

#include <array>

#include "exact/damped_layers.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

/// With the damping of the exact waves.
analysis::Analysis run(const std::string& changes) {
  return runCase("two_layers",
                 "-elasticity_mass consistent -material_disc_rayleigh_mass 0.02 "
                 "-material_pad_rayleigh_mass 0.02 " +
                     changes);
}

const std::vector<stability::Critical>& criticals(const analysis::Analysis& analysis) {
  return analysis.flutter.segments.at(0).trackedLines.at(0).criticals;
}

// As the mesh of 9-node quadrilaterals is refined.
TEST(Critical, DampedLayersAgainstExactWaves) {
  std::vector<std::vector<double>> errors;
  for (const std::string mesh : {"nx=12,ny_disc=4,ny_pad=3", "nx=24,ny_disc=8,ny_pad=6"}) {
    const analysis::Analysis analysis =
        run("-mesh_set order=2,recombine=1,serendipity=0," + mesh +
            " -flutter_friction 0,0.05,0.1 -flutter_band 0.7 -modes_count 80");
    const auto& followed = analysis.flutter.segments.at(0).trackedLines.at(0);
    EXPECT_TRUE(followed.complete()) << followed.statement();
    errors.emplace_back();
    for (const auto& critical : followed.criticals) {
      EXPECT_TRUE(critical.converged);
      EXPECT_EQ(critical.kind, tracking::Event::Kind::crossing);
      const auto exact = exact::two_layers::closest({critical.friction, critical.angularFrequency});
      print("%s: critical friction %.8f at %.5f Hz, exact %.8f\n", mesh.c_str(), critical.friction,
            critical.angularFrequency / (2 * M_PI), exact.friction);
      errors.back().push_back(std::abs(critical.friction - exact.friction));
    }
  }
  ASSERT_GE(errors[0].size(), 2u);
  ASSERT_EQ(errors[0].size(), errors[1].size());
  expectOrder(4, 0.35, errors[0], errors[1],
              "critical frictions");  // 12 columns are few for the fourth order of the elements
}

// What is followed is what the sweep found, at every friction, and its number is accounted for.
TEST(Track, HoldsTheEigenvaluesOfTheSweep) {
  for (const std::string damping : {"0.02", "0"}) {
    const analysis::Analysis analysis =
        run("-mesh_set nx=24,ny_disc=8,ny_pad=6 -flutter_friction 0,0.05,0.1 -modes_count 60 "
            "-material_disc_rayleigh_mass " +
            damping + " -material_pad_rayleigh_mass " + damping);
    const auto& segment = analysis.flutter.segments.at(0);
    const auto& followed = segment.trackedLines.at(0);
    EXPECT_TRUE(followed.complete()) << followed.statement();
    EXPECT_EQ(followed.countExact, damping == "0");
    const auto& stations = followed.branches.stations;
    const auto inBand = [&](const auto& station) { return followed.branches.inBandAt(station); };
    EXPECT_EQ(inBand(stations.back()),
              inBand(stations.front()) + followed.branches.entered - followed.branches.left);
    ASSERT_EQ(segment.points.size(), 3u);
    for (const auto& point : segment.points) {
      std::vector<Complex> wanted, found;
      for (const auto& eigenvalue : point.eigenvalues) wanted.push_back(eigenvalue.s);
      for (const auto& station : stations)
        for (std::size_t i = 0; station.friction == point.at.friction && i < station.pairs.size();
             ++i)
          if (station.inBand[i]) found.push_back(station.pairs[i].s);
      EXPECT_EQ(found.size(), wanted.size()) << point.at.friction;
      // Both are of the reduced problem, in bases that differ by later corrections: to the accuracy
      // asked for, some times over.
      EXPECT_LT(worst(errors(wanted, found).relative), 1e-7);
    }
  }
}

// At the critical friction the eigenvalue of the problem on all unknowns is on the axis: its
// distance over the slope of the growth is the error of the friction.
TEST(Critical, IsThatOfAllUnknowns) {
  const std::string mesh = "-mesh_set nx=24,ny_disc=8,ny_pad=6 ";
  const analysis::Analysis analysis =
      run(mesh + "-flutter_friction 0,0.05,0.1 -flutter_band 0.7 -modes_count 60");
  ASSERT_GE(criticals(analysis).size(), 2u);
  for (const auto& critical : criticals(analysis)) {
    char friction[32];
    std::snprintf(friction, sizeof friction, "%.17g", critical.friction);
    const analysis::Analysis direct =
        run(mesh + "-flutter_method direct -flutter_direct_count 40 -flutter_friction " +
            std::string(friction));
    double distance = INFINITY;
    for (const Complex s : eigenvaluesOf(direct.flutter.segments.at(0).points.at(0)))
      distance = std::min(distance, std::abs(s - Complex(0, critical.angularFrequency)));
    print(
        "critical friction %.10f: error by all unknowns %.1e, estimated %.1e, backward error "
        "%.1e\n",
        critical.friction, distance / critical.slope, critical.errorEstimate,
        critical.backwardError);
    EXPECT_LT(distance / critical.slope, 1e-8 * critical.friction);
  }
}

}  // namespace
}  // namespace squeal::test
