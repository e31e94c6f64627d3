// SPDX-License-Identifier: BSD-2-Clause
// Steady sliding: uniform strain against the closed forms, and contact that opens against statics.
#include <gtest/gtest.h>

#include "exact/one_layer.hpp"
#include "exact/two_layers.hpp"
#include "steady/steady/steady.hpp"
#include "support/harness/largest_error.hpp"
#include "support/run/case.hpp"
#include "support/steady/contact_laws.hpp"
#include "support/steady/uniform_layers.hpp"

namespace squeal::test {
namespace {

/// All element types of the plane hold the uniform strain exactly: what is left is the solvers'
/// rounding.
const std::vector<std::string> elements{"order=1,recombine=1", "order=1,recombine=0",
                                        "order=2,recombine=1", "order=2,recombine=1,serendipity=1",
                                        "order=2,recombine=0"};

const std::string steadyOnly = " -flutter_friction 0,0.3,0.6 -modes_count 1 -modes_sturm 0";

void expectLayer(const std::string& changes, double sense) {
  const analysis::Analysis analysis = runCase("layer", changes + steadyOnly);
  ASSERT_EQ(analysis.steady.solutions.size(), 3U);
  for (const auto& solution : analysis.steady.solutions) {
    const exact::one_layer::Steady exact{solution.at.friction, depth};
    const double error =
        displacementError(analysis, solution, [&](const mesh::Point& x, const std::string&) {
          return std::array<double, 2>{sense * exact.u(x[1]), exact.v(x[1])};
        });
    print("layer %s, f = %g: displacement %.1e, imbalance %.1e, %d iterations\n", changes.c_str(),
          solution.at.friction, error, solution.imbalance, solution.iterations);
    EXPECT_TRUE(solution.converged);
    EXPECT_LT(error, 1e-10);
    expectUniformPressure(analysis, solution, exact.pressure(), exact::one_layer::period, -1,
                          sense);
  }
}

TEST(Steady, LayerCaseFile) { expectLayer("", 1); }
TEST(Steady, LayerWithOtherElements) {
  for (const auto& element : elements) expectLayer("-mesh_set nx=6,ny=3," + element, 1);
}
TEST(Steady, PlateSlidingTheOtherWay) {
  expectLayer("-mesh_set nx=6,ny=3 -contact_plate_obstacle_velocity -2,0,0", -1);
}

void expectTwoLayers(const std::string& changes) {
  const analysis::Analysis analysis = runCase("two_layers", changes + steadyOnly);
  ASSERT_EQ(analysis.steady.solutions.size(), 3U);
  for (const auto& solution : analysis.steady.solutions) {
    const exact::two_layers::Steady exact{solution.at.friction, depth};
    const double error =
        displacementError(analysis, solution, [&](const mesh::Point& x, const std::string& part) {
          return std::array<double, 2>{exact.u(x[1], part == "pad"), exact.v(x[1], part == "pad")};
        });
    print("two_layers %s, f = %g: displacement %.1e, imbalance %.1e, %d iterations\n",
          changes.c_str(), solution.at.friction, error, solution.imbalance, solution.iterations);
    EXPECT_TRUE(solution.converged);
    EXPECT_LT(error, 1e-10);
    expectUniformPressure(analysis, solution, exact.pressure(), exact::two_layers::period, 1, 1);
  }
}

TEST(Steady, TwoLayersCaseFile) { expectTwoLayers(""); }
TEST(Steady, TwoLayersWithOtherElements) {
  for (const auto& element : elements)
    expectTwoLayers("-mesh_set nx=6,ny_disc=3,ny_pad=2," + element);
  expectTwoLayers("-mesh_set nx=6,ny_disc=3,ny_pad=2,shared=1");
}

/// The layer as a slab of hex20: the consistent forces of a uniform pressure are negative at the
/// corners of its faces.
const std::string hex20 =
    "-mesh_file meshes/layer_slab.geo -constraint_layer_clamped z -mesh_set "
    "nx=6,ny=3,order=2,serendipity=1";

TEST(Steady, ClosedSerendipityFaces) {
  const analysis::Analysis analysis = runCase("layer", hex20 + steadyOnly);
  ASSERT_EQ(analysis.steady.solutions.size(), 3U);
  for (const auto& solution : analysis.steady.solutions) {
    const exact::one_layer::Steady exact{solution.at.friction, depth};
    const double error =
        displacementError(analysis, solution, [&](const mesh::Point& x, const std::string&) {
          return std::array<double, 3>{exact.u(x[1]), exact.v(x[1]), 0};
        });
    print("hex20, f = %g: displacement %.1e, smallest pressure / exact - 1: %.1e\n",
          solution.at.friction, error, solution.smallestPressure / exact.pressure() - 1);
    EXPECT_TRUE(solution.converged) << solution.reason;
    EXPECT_LT(error, 1e-10);
    expectUniformPressure(analysis, solution, exact.pressure(), exact::one_layer::period * 0.5, -1,
                          1);  // depth along z: that of one cell, 3/6
  }
}

// A block with free ends, guided along x on the side that a pressure P loads, is dragged along by
// friction on the other side. Statics alone gives what the contact transmits: Σ R_N = P L, Σ R_T =
// f P L along the velocity, and as friction acts at a distance H from the guide, which can only
// take forces along x, the centre of pressure moves by f H from the middle towards the leading end.
// Beyond a sixth of the length a linear pressure would become tension at the trailing end: the
// contact opens there. Beyond the half there is no equilibrium: the block topples.
constexpr double blockLength = 1, loadPressure = 0.01;

std::string plateOnBlock(const std::string& frictions, const std::string& mesh = "nx=16,ny=16") {
  return "-mesh_file meshes/layer.geo -mesh_set Lx=1,h=1," + mesh +
         " -material_layer_young 1 -material_layer_poisson 0.3 -material_layer_density 1 "
         "-constraint_bottom_clamped x "
         "-load_bottom_pressure 0.01"
         " -contact_plate_pad top -contact_plate_obstacle_velocity 1,0,0 -modes_count 10 "
         "-flutter_friction " +
         frictions;
}

std::string blockOnDisc(const std::string& frictions) {
  return "-mesh_file meshes/two_layers.geo -mesh_set "
         "Lx=1,h_disc=0.5,h_pad=0.8,nx=16,ny_disc=8,ny_pad=12 -material_disc_young 1 "
         "-material_disc_poisson 0.3"
         " -material_disc_density 1 -material_pad_young 0.4 -material_pad_poisson 0.25 "
         "-material_pad_density 0.6 "
         "-motion_disc_velocity 1,0,0"
         " -constraint_disc_bottom_clamped xy -constraint_pad_top_clamped x -load_pad_top_pressure "
         "0.01"
         " -contact_interface_pad pad_face -contact_interface_disc disc_face -modes_count 10 "
         "-flutter_friction " +
         frictions;
}

/// Collective. The solution satisfies every law of steady sliding, so it is the solution; it is
/// open at the trailing end and nowhere else.
void expectPartlyOpen(const analysis::Analysis& analysis, const steady::Solution& solution,
                      double height) {
  ASSERT_TRUE(solution.converged) << solution.reason;
  const Violations violation = violations(analysis, solution);
  const Transmitted sums = transmitted(analysis, solution);
  print(
      "f = %g: %d iterations, %d of %d nodes open, centre of pressure %.9f, equilibrium %.1e, "
      "imbalance %.1e\n",
      solution.at.friction, solution.iterations, static_cast<int>(solution.openNodes),
      static_cast<int>(analysis.model.contact.interfaces.totalNodes), sums.centre,
      violation.equilibrium, solution.imbalance);
  EXPECT_LE(solution.iterations, 6);
  EXPECT_LT(violation.gap, 1e-12);
  EXPECT_LT(violation.penetration, 1e-12);
  EXPECT_LT(violation.tension, 1e-9);
  EXPECT_LT(violation.complementarity, 1e-9);
  EXPECT_LT(violation.coulomb, 1e-12);
  EXPECT_LT(violation.equilibrium, 1e-9);
  EXPECT_LT(solution.imbalance, 1e-8);
  const double load = loadPressure * blockLength;
  EXPECT_NEAR(sums.normal / load, 1, 1e-9);
  EXPECT_NEAR(sums.friction / load, solution.at.friction, 1e-9);
  EXPECT_NEAR(sums.centre, blockLength / 2 - solution.at.friction * height, 1e-8);

  double lastClosed = 0, firstOpen = blockLength;
  for (std::size_t i = 0; i < solution.contact.size(); ++i) {
    const double x = analysis.model.contact.interfaces.nodes[i].position[0];
    if (solution.closed[i]) {
      lastClosed = std::max(lastClosed, x);
    } else {
      firstOpen = std::min(firstOpen, x);
      EXPECT_GT(solution.contact[i].gap, 0);
    }
  }
  // The cells of a slab have nodes at one x that open one after the other.
  EXPECT_LE(largest(lastClosed), -largest(-firstOpen) + 1e-9);  // gmsh places nodes to 1e-11
  EXPECT_GT(solution.openNodes, 0);
}

TEST(Steady, BlockUnderPlateOpens) {
  const analysis::Analysis analysis = runOptions(plateOnBlock("0.35"));
  ASSERT_EQ(analysis.steady.solutions.size(), 1U);
  expectPartlyOpen(analysis, analysis.steady.solutions[0], 1);
}

TEST(Steady, BlockOnDiscOpens) {
  const analysis::Analysis analysis = runOptions(blockOnDisc("0.35"));
  ASSERT_EQ(analysis.steady.solutions.size(), 1U);
  expectPartlyOpen(analysis, analysis.steady.solutions[0], 0.8);
}

// At f = 0.6 the centre of pressure would lie outside the block: no solution exists, which is said,
// and no flutter is computed there.
TEST(Steady, TopplingBlockHasNoSolution) {
  const analysis::Analysis analysis = runOptions(plateOnBlock("0.3,0.35,0.6"));
  ASSERT_EQ(analysis.steady.solutions.size(), 3U);
  expectPartlyOpen(analysis, analysis.steady.solutions[0], 1);
  expectPartlyOpen(analysis, analysis.steady.solutions[1], 1);
  print("f = 0.6: %s after %d iterations\n", analysis.steady.solutions[2].reason.c_str(),
        analysis.steady.solutions[2].iterations);
  EXPECT_FALSE(analysis.steady.solutions[2].converged);
  EXPECT_FALSE(analysis.converged());
  std::vector<double> solved;
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& point : segment.points) solved.push_back(point.at.friction);
  EXPECT_EQ(solved, (std::vector<double>{0.3, 0.35}));
}

// The same with hex20: the nodal forces of a pressure are of both signs, those of the combined gaps
// are not. A slab of unit depth transmits what the block in the plane does.
TEST(Steady, SerendipityBlockOpens) {
  const analysis::Analysis analysis =
      runOptions(plateOnBlock("0.35", "nx=8,ny=8,order=2,serendipity=1,depth=1") +
                 " -mesh_file meshes/layer_slab.geo -constraint_layer_clamped z");
  ASSERT_EQ(analysis.steady.solutions.size(), 1U);
  expectPartlyOpen(analysis, analysis.steady.solutions[0], 1);
}

// The consistent forces of a pressure on 3-node edges are positive at the ends and in the middle:
// quadratic cells are decided node by node in the plane.
TEST(Steady, QuadraticBlockOpens) {
  const analysis::Analysis analysis = runOptions(plateOnBlock("0.35", "order=2,nx=8,ny=8"));
  ASSERT_EQ(analysis.steady.solutions.size(), 1U);
  expectPartlyOpen(analysis, analysis.steady.solutions[0], 1);
}

TEST(Steady, TwoInterfacesOnOneBody) {
  // The layer between two plates that close in by 0.01 each and slide alike, its ends held along x:
  // without friction the strain is uniform, ε_yy = −0.02, and the pressure on both faces (λ +
  // 2μ)·0.02. A second interface is only two more options.
  const analysis::Analysis analysis = runOptions(
      "-mesh_file meshes/layer.geo -material_layer_young 1 -material_layer_poisson 0.3 "
      "-material_layer_density 1 "
      "-constraint_left_clamped x -constraint_right_clamped x "
      "-contact_upper_pad top -contact_upper_obstacle_velocity 1,0,0 "
      "-contact_upper_obstacle_displacement 0,-0.01,0 "
      "-contact_lower_pad bottom -contact_lower_obstacle_velocity 1,0,0 "
      "-contact_lower_obstacle_displacement 0,0.01,0 "
      "-modes_count 10 -flutter_friction 0,0.2");
  const double pressure = 0.7 / (1.3 * 0.4) * 0.02;  // E (1 − ν) / ((1 + ν)(1 − 2ν)) |ε|
  ASSERT_EQ(analysis.steady.solutions.size(), 2U);
  double error = 0;
  for (const auto& state : analysis.steady.solutions[0].contact)
    error = test::worse(error, std::abs(state.pressure / pressure - 1));
  EXPECT_LT(largest(error), 1e-10);  // rounding of a direct solve
  for (const auto& solution : analysis.steady.solutions) {
    ASSERT_EQ(solution.resultants.size(), 2U);
    EXPECT_LT(solution.imbalance, 1e-10);
    const auto &lower = solution.resultants[0], &upper = solution.resultants[1];
    // Mirror images about y = −1/2: equal and opposite normal forces, equal friction, f times as
    // large.
    EXPECT_NEAR(lower.normalForce[1], 3 * pressure, 1e-10 * pressure);
    EXPECT_NEAR(upper.normalForce[1], -3 * pressure, 1e-10 * pressure);
    EXPECT_NEAR(lower.frictionForce[0], solution.at.friction * 3 * pressure, 1e-10 * pressure);
    EXPECT_NEAR(upper.frictionForce[0], solution.at.friction * 3 * pressure, 1e-10 * pressure);
  }
}

// A pad of which all nodes are held is a rigid punch: the disc must bear the gaps, or a soft layer
// lie between them. The disc is strained by itself, or with the layer in series.
TEST(Steady, APunchIsHeldAtItsFace) {
  const double compliance = exact::two_layers::discThickness / exact::two_layers::disc.uniaxial();
  const std::string punch =
      "-constraint_pad_clamped xy -constraint_pad_displacement 0,-0.01,0 -modes_count 5 "
      "-flutter_friction 0,0.3 -flutter_track off -mesh_set nx=6,ny_disc=3,ny_pad=2";
  const auto pressed = [&](const std::string& options, double pressure) {
    const auto analysis = runCase("two_layers", punch + options);
    for (const auto& solution : analysis.steady.solutions) {
      ASSERT_TRUE(solution.converged) << solution.reason;
      expectUniformPressure(analysis, solution, pressure, exact::two_layers::period, 1, 1);
    }
  };
  for (const std::string mesh : {"", ",nx_pad=4", ",nx_pad=9,order=2"}) {
    pressed(mesh + " -contact_interface_slave disc", depth / compliance);
    pressed(mesh + " -contact_interface_stiffness 2", depth / (compliance + 0.5));
  }
}

}  // namespace
}  // namespace squeal::test
