// SPDX-License-Identifier: BSD-2-Clause
// Two layers of which one carries its displacement along as it moves, and friction that follows the
// sliding speed: G, K^R and the friction law against exact waves.
#include "exact/moving_layers.hpp"

#include <gtest/gtest.h>

#include "support/eigen/characteristic_roots.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/model/exponential_law.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

namespace moving_layers = exact::moving_layers;
namespace two_layers = exact::two_layers;

const std::size_t count = 20;

std::vector<Complex> exactAt(double friction) {
  if (friction == 0) return exactValues(moving_layers::frictionless, count);
  if (friction == 0.1) return exactValues(moving_layers::friction01, count);
  if (friction == 0.3) return exactValues(moving_layers::friction03, count);
  return exactValues(moving_layers::friction05, count);
}

/// The lowest eigenvalues of the problem on all unknowns.
std::string direct(int eigenvalues) {
  return " -flutter_method direct -flutter_direct_confirm off -flutter_direct_count " +
         std::to_string(eigenvalues);
}
const std::string coarse = " -mesh_set order=2,nx=20,ny_disc=6,ny_pad=4",
                  fine = " -mesh_set order=2,nx=40,ny_disc=12,ny_pad=8";

// The tables hold 10 digits after the point; the slope of the determinant is taken by differences
// of 1e-5, which leaves more digits than needed here.
TEST(MovingLayers, TablesSolveTheCharacteristicEquation) {
  const auto waves = [](double friction) {
    return [=](int n, Complex s) { return moving_layers::characteristic(friction, n, s); };
  };
  EXPECT_LT(worstStep(moving_layers::frictionless, waves(0)), 1e-8);
  EXPECT_LT(worstStep(moving_layers::friction01, waves(0.1)), 1e-8);
  EXPECT_LT(worstStep(moving_layers::friction03, waves(0.3)), 1e-8);
  EXPECT_LT(worstStep(moving_layers::friction05, waves(0.5)), 1e-8);
}

// The program's own case, with nothing changed: 120 modes, 24 quadratic cells for up to 3
// wavelengths.
TEST(MovingLayers, CaseFile) {
  const analysis::Analysis analysis = runCase("two_layers_moving");
  ASSERT_EQ(analysis.flutter.segments.size(), 1U);
  EXPECT_EQ(analysis.flutter.segments[0].openNodes, 0);
  ASSERT_EQ(analysis.flutter.segments[0].points.size(), 4U);
  for (const auto& point : analysis.flutter.segments[0].points) {
    const Errors found = errors(exactAt(point.at.friction), eigenvaluesOf(point));
    print("f = %g, 120 modes, worst of the first 20: |s - s*|/|s*| %.1e, growth rate %.1e\n",
          point.at.friction, worst(found.relative), worst(found.growth));
    EXPECT_LT(worst(found.relative), 1e-3);
    EXPECT_LT(worst(found.growth), 1e-3);
  }
}

// Quadratic cells: the error of s is of order h⁴. With and against the motion waves differ, and by
// as much as the tables say: the double values of approximation A are split by 0.0002 to 0.4.
TEST(MovingLayers, FourthOrder) {
  std::vector<std::vector<Errors>> found(2);
  for (std::size_t level = 0; level < 2; ++level) {
    const analysis::Analysis analysis =
        runCase("two_layers_moving", direct(30) + (level == 0 ? coarse : fine));
    for (const auto& point : analysis.flutter.segments.at(0).points) {
      found[level].push_back(errors(exactAt(point.at.friction), eigenvaluesOf(point)));
      print("%s, f = %g, worst of the first 20: |s - s*|/|s*| %.1e, growth rate %.1e\n",
            level == 0 ? "coarse" : "fine", point.at.friction, worst(found[level].back().relative),
            worst(found[level].back().growth));
    }
    ASSERT_EQ(found[level].size(), 4U);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    // One by one an error may pass through zero between two meshes.
    expectOrder(4, 0.2, {rootMeanSquare(found[0][i].relative)},
                {rootMeanSquare(found[1][i].relative)}, "eigenvalues, root mean square");
    EXPECT_LT(worst(found[1][i].relative), 1e-4);
    EXPECT_LT(worst(found[1][i].growth),
              i == 0 ? 1e-8 : 1e-3);  // nothing feeds a growing wave without friction
    if (i > 0)
      expectOrder(4, 0.2, {rootMeanSquare(found[0][i].growth)},
                  {rootMeanSquare(found[1][i].growth)}, "growth rates, root mean square");
  }
}

// G and K^R in the reduced problem: corrected to the full one up to backward errors of 1e-11.
TEST(MovingLayers, ReducedProblemIsTheFullOne) {
  const std::string options =
      "-flutter_friction 0.5 -flutter_accuracy 1e-11 -mesh_set order=2,nx=12,ny_disc=4,ny_pad=3";
  const analysis::Analysis reduced = runCase("two_layers_moving", options + " -modes_count 80");
  const analysis::Analysis full = runCase("two_layers_moving", options + direct(30));
  const auto& point = reduced.flutter.segments.at(0).points.at(0);
  ASSERT_GE(point.eigenvalues.size(), 25U);
  auto wanted = eigenvaluesOf(full.flutter.segments.at(0).points.at(0));
  wanted.resize(20);
  const double difference = worst(errors(wanted, eigenvaluesOf(point)).relative);
  print("80 modes against full order: %.1e\n", difference);
  EXPECT_LT(difference, 1e-8);
}

/// The whole spectrum of the case with changes, the first of which may go on with `fine`, against
/// the waves of `sliding`.
void expectWaves(const std::string& options, const two_layers::Sliding& sliding,
                 const std::string& label) {
  const analysis::Analysis analysis = runCase("two_layers_moving", fine + options + direct(36));
  expectSpectrum(eigenvaluesOf(analysis.flutter.segments.at(0).points.at(0)),
                 {[&](int n, Complex s) { return two_layers::characteristic(sliding, n, s); }},
                 1e-3, label);
}

// Not the layers of the tables: faster, thinner pad, other friction. All waves are there and
// nothing else.
TEST(MovingLayers, AnotherSpeedAndThickness) {
  expectWaves(" -flutter_friction 0.4 -motion_disc_velocity 0.12,0",
              {.friction = 0.4, .carried = 0.12}, "W = 0.12");
  expectWaves(",h_pad=0.35 -flutter_friction 0.25 -flutter_speed 4",
              {.friction = 0.25, .carried = 0.2, .padThickness = 0.35}, "W = 0.2, thin pad");
}

// Friction that falls with speed feeds motion along the sliding direction, k = 0 included.
TEST(MovingLayers, FrictionFallsWithSpeed) {
  const ExponentialLaw law{2.5, 0.04};
  const double friction = 0.3, speed = moving_layers::velocity,
               pressure = two_layers::Steady{friction, 0.01}.pressure();
  for (const bool full : {false, true})
    expectWaves(" -flutter_friction 0.3" + law.options() + (full ? "" : " -motion_convective off"),
                {.friction = friction * law.value(speed),
                 .along = friction * law.slope(speed) * pressure,
                 .carried = full ? speed : 0},
                full ? "falling friction, full terms" : "falling friction, approximation A");
}

}  // namespace
}  // namespace squeal::test
