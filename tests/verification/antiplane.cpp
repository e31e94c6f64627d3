// SPDX-License-Identifier: BSD-2-Clause
// Layers that slide on each other, as slabs free to move across the sliding direction too: friction
// damps these motions. The slabs' spectrum holds the waves in the plane as well.
#include "exact/antiplane.hpp"

#include <gtest/gtest.h>

#include "exact/moving_layers.hpp"
#include "support/eigen/characteristic_roots.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/model/exponential_law.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

namespace antiplane = exact::antiplane;
namespace moving_layers = exact::moving_layers;
namespace two_layers = exact::two_layers;

const std::string coarse = " -mesh_set order=2,nx=20,ny_disc=6,ny_pad=4",
                  medium = " -mesh_set order=2,nx=24,ny_disc=7,ny_pad=5",
                  fine = " -mesh_set order=2,nx=40,ny_disc=12,ny_pad=8";
const std::string direct =
    " -steady_uniqueness off -flutter_method direct -flutter_direct_count 40";
// Corrected as far as the 40 waves below reach, to two digits more than these meshes give.
const std::string reduced =
    " -steady_uniqueness off -flutter_method reduced -flutter_band 0.68 -flutter_accuracy 1e-7";

const std::size_t count = 20;

/// The first of the anti-plane waves, then the first of those in the plane.
std::vector<Complex> exactAt(double friction, bool full) {
  const bool low = friction == 0.1;
  auto all = full ? exactValues(low ? antiplane::moving01 : antiplane::moving03, count)
                  : exactValues(low ? antiplane::friction01 : antiplane::friction03, count);
  const auto plane =
      full ? exactValues(low ? moving_layers::friction01 : moving_layers::friction03, count)
           : exactValues(low ? two_layers::friction01 : two_layers::friction03, count);
  all.insert(all.end(), plane.begin(), plane.end());
  return all;
}

std::vector<double> acrossOf(const std::vector<double>& values) {
  return {values.begin(), values.begin() + count};
}

/// Both families of waves.
std::vector<Characteristic> families(const two_layers::Sliding& sliding) {
  return {[=](int n, Complex s) { return two_layers::characteristic(sliding, n, s); },
          [=](int n, Complex s) { return antiplane::characteristic(sliding, n, s); }};
}

// The tables hold 10 digits after the point; the slope of the determinant is taken by differences
// of 1e-5, which leaves more digits than needed here.
TEST(Antiplane, TablesSolveTheCharacteristicEquation) {
  const auto waves = [](double friction, bool full) {
    return [=](int n, Complex s) {
      return antiplane::characteristic(antiplane::sliding(friction, full), n, s);
    };
  };
  EXPECT_LT(worstStep(antiplane::friction01, waves(0.1, false)), 1e-8);
  EXPECT_LT(worstStep(antiplane::friction03, waves(0.3, false)), 1e-8);
  EXPECT_LT(worstStep(antiplane::moving01, waves(0.1, true)), 1e-8);
  EXPECT_LT(worstStep(antiplane::moving03, waves(0.3, true)), 1e-8);
}

/// Quadratic cells: the error of s is of order h⁴. One by one an error may pass through zero
/// between two meshes.
void expectFourthOrder(bool full) {
  std::vector<std::vector<Errors>> found(2);
  for (std::size_t level = 0; level < 2; ++level) {
    const analysis::Analysis analysis = runCase(
        "two_layers_antiplane", std::string("-flutter_friction 0.1,0.3 -motion_convective ") +
                                    (full ? "on" : "off") + reduced + (level == 0 ? coarse : fine));
    ASSERT_NEAR(analysis.steady.solutions.at(0).smallestPressure, antiplane::pressure,
                1e-10 * antiplane::pressure);
    for (const auto& point : analysis.flutter.segments.at(0).points) {
      found[level].push_back(errors(exactAt(point.at.friction, full), eigenvaluesOf(point)));
      const Errors& last = found[level].back();
      print(
          "%s mesh, %s, f = %g, worst of 20 anti-plane waves: |s - s*|/|s*| %.1e, growth rate "
          "%.1e; of all 40: %.1e, "
          "%.1e\n",
          level == 0 ? "coarse" : "fine", full ? "full terms" : "approximation A",
          point.at.friction, worst(acrossOf(last.relative)), worst(acrossOf(last.growth)),
          worst(last.relative), worst(last.growth));
    }
    ASSERT_EQ(found[level].size(), 2U);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    expectOrder(4, 0.2, {rootMeanSquare(acrossOf(found[0][i].relative))},
                {rootMeanSquare(acrossOf(found[1][i].relative))},
                "anti-plane eigenvalues, root mean square");
    expectOrder(4, 0.2, {rootMeanSquare(acrossOf(found[0][i].growth))},
                {rootMeanSquare(acrossOf(found[1][i].growth))},
                "their growth rates, root mean square");
    EXPECT_LT(worst(found[1][i].relative), 1e-4);
    EXPECT_LT(worst(found[1][i].growth), 1e-3);
  }
}

/// `cells` of 20 nodes or tetrahedra: elements of second order have eigenvalues of order 4.
void expectFourthOrderOf(const std::string& cells, const std::vector<std::string>& meshes) {
  std::vector<Errors> found;
  for (const auto& mesh : meshes) {
    const analysis::Analysis analysis =
        runCase("two_layers_antiplane",
                "-flutter_friction 0.3 -modes_count 60 -mesh_set order=2," + cells + mesh);
    found.push_back(errors(exactValues(antiplane::friction03, 8),
                           eigenvaluesOf(analysis.flutter.segments.at(0).points.at(0))));
    print("%s%s: worst of 8 anti-plane waves: %.1e, growth rate %.1e\n", cells.c_str(),
          mesh.c_str(), worst(found.back().relative), worst(found.back().growth));
  }
  EXPECT_LT(worst(found[1].relative), 2e-4);
  const auto order = [&](const std::vector<double>& coarse, const std::vector<double>& fine) {
    return std::log(rootMeanSquare(coarse) / rootMeanSquare(fine)) / std::log(1.5);
  };
  const double ofValues = order(found[0].relative, found[1].relative),
               ofGrowth = order(found[0].growth, found[1].growth);
  print("%s orders %.2f, growth %.2f\n", cells.c_str(), ofValues, ofGrowth);
  EXPECT_NEAR(ofValues, 4, 0.3);
  EXPECT_NEAR(ofGrowth, 4, 0.5);
}

// Where nodal forces are not positive under pressure, the damping is integrated over the faces.
TEST(Antiplane, FourthOrderOnSerendipityFaces) {
  expectFourthOrderOf("serendipity=1,", {"nx=16,ny_disc=6,ny_pad=4", "nx=24,ny_disc=9,ny_pad=6"});
}
TEST(Antiplane, FourthOrderOnTetrahedra) {
  expectFourthOrderOf("shape=0,depth=0.2,",
                      {"nx=16,ny_disc=6,ny_pad=4", "nx=24,ny_disc=9,ny_pad=6"});
}

TEST(Antiplane, FourthOrderWithApproximationA) { expectFourthOrder(false); }
TEST(Antiplane, FourthOrderWithFullTerms) { expectFourthOrder(true); }

// Not the layers of the tables: another speed, pad and pressure. All waves of both families are
// there and nothing else.
TEST(Antiplane, AnotherSpeedAndThickness) {
  const double friction = 0.2, speed = 0.12, thickness = 0.45;
  const double pressure = two_layers::Steady{friction, 0.03, thickness}.pressure();
  const analysis::Analysis analysis =
      runCase("two_layers_antiplane", medium +
                                          ",h_pad=0.45 -flutter_friction 0.2 -motion_convective on"
                                          " -motion_disc_velocity 0.12,0,0"
                                          " -constraint_pad_top_displacement 0,-0.03,0" +
                                          direct);
  expectSpectrum(eigenvaluesOf(analysis.flutter.segments.at(0).points.at(0)),
                 families({.friction = friction,
                           .across = friction * pressure / speed,
                           .carried = speed,
                           .padThickness = thickness}),
                 1e-3, "W = 0.12, pad 0.45");
}

// Friction that falls with speed: f φ in both families, f φ' feeds those in the plane.
TEST(Antiplane, FrictionFallsWithSpeed) {
  const ExponentialLaw law{2.5, 0.04};
  const double friction = 0.2, speed = antiplane::velocity, pressure = antiplane::pressure;
  const analysis::Analysis analysis =
      runCase("two_layers_antiplane", medium + " -flutter_friction 0.2" + law.options() + direct);
  expectSpectrum(eigenvaluesOf(analysis.flutter.segments.at(0).points.at(0)),
                 families({.friction = friction * law.value(speed),
                           .along = friction * law.slope(speed) * pressure,
                           .across = friction * law.value(speed) * pressure / speed}),
                 1e-3, "falling friction");
}

// The linearised problem depends only on value and slope at the sliding speed.
TEST(Antiplane, TangentOfTheFrictionLaw) {
  const ExponentialLaw law{2.5, 0.04};
  for (const char* convective : {"off", "on"}) {
    const std::string common =
        std::string(
            "-flutter_friction 0.2 -flutter_method direct -flutter_direct_count 30"
            " -mesh_set order=2,nx=6,ny_disc=2,ny_pad=2 -motion_convective ") +
        convective;
    const analysis::Analysis curve = runCase("two_layers_antiplane", common + law.options());
    const analysis::Analysis tangent =
        runCase("two_layers_antiplane", common + law.tangentOptions(antiplane::velocity));
    const double difference =
        worst(errors(eigenvaluesOf(curve.flutter.segments.at(0).points.at(0)),
                     eigenvaluesOf(tangent.flutter.segments.at(0).points.at(0)))
                  .relative);
    print("table with the same tangent, convective terms %s: %.1e\n", convective, difference);
    EXPECT_LT(difference, 1e-8);
  }
}

// Friction of a given direction neither damps nor drives the motion across it.
TEST(Antiplane, NoDampingWhereItIsOff) {
  const analysis::Analysis analysis =
      runCase("two_layers_antiplane",
              coarse + " -flutter_friction 0.3 -flutter_friction_damping off" + direct);
  const auto found = eigenvaluesOf(analysis.flutter.segments.at(0).points.at(0));
  auto undamped = rootsNear(found, {families({.friction = 0.3})[1]}, 4);
  std::erase_if(undamped, [](Complex s) { return std::abs(s) > 4; });
  ASSERT_GE(undamped.size(), 15U);
  const Errors difference = errors(undamped, found);
  print("no friction damping, %zu anti-plane waves: |s - s*|/|s*| %.1e, growth rates %.1e\n",
        undamped.size(), worst(difference.relative), worst(difference.growth));
  EXPECT_LT(worst(difference.relative), 3e-3);
  EXPECT_LT(worst(difference.growth), 1e-9);
}

}  // namespace
}  // namespace squeal::test
