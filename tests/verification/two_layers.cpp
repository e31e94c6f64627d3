// SPDX-License-Identifier: BSD-2-Clause
// Two elastic layers, deformable on deformable: convergence of frequencies and growth rates to the
// exact waves.
#include "exact/two_layers.hpp"

#include <gtest/gtest.h>

#include "support/eigen/characteristic_roots.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

namespace two_layers = exact::two_layers;

const std::vector<double> frictions{0.1, 0.3, 0.5};

std::vector<Complex> exactAt(double friction, std::size_t count) {
  if (friction == 0.1) return exactValues(two_layers::friction01, count);
  if (friction == 0.3) return exactValues(two_layers::friction03, count);
  return exactValues(two_layers::friction05, count);
}

// The tables hold 10 digits after the point; the slope of the determinant is taken by differences
// of 1e-5, which leaves more digits than needed here.
TEST(TwoLayers, TablesSolveTheCharacteristicEquation) {
  const auto waves = [](double friction) {
    return [=](int n, Complex s) { return two_layers::characteristic({friction}, n, s); };
  };
  EXPECT_LT(worstStep(two_layers::friction01, waves(0.1)), 1e-8);
  EXPECT_LT(worstStep(two_layers::friction03, waves(0.3)), 1e-8);
  EXPECT_LT(worstStep(two_layers::friction05, waves(0.5)), 1e-8);
}

// The program's own case, with nothing changed: bilinear cells, higher-order mass, 200 modes. With
// cells of the same size and the same mass matrix as in the case `layer`, it is held to the same
// bounds: 1 % in |s|, 0.01 in growth rate.
TEST(TwoLayers, CaseFile) {
  const analysis::Analysis analysis = runCase("two_layers");
  ASSERT_EQ(analysis.flutter.segments.size(), 1U);
  EXPECT_EQ(analysis.flutter.segments[0].openNodes, 0);
  ASSERT_EQ(analysis.flutter.segments[0].points.size(), 4U);
  for (const auto& point : analysis.flutter.segments[0].points) {
    if (point.at.friction == 0) continue;
    const Errors found = errors(exactAt(point.at.friction, 30), eigenvaluesOf(point));
    print("f = %g, 200 modes: worst of the first 30: |s| %.3f %%, growth rate %.4f\n",
          point.at.friction, 100 * worst(found.modulus), worst(found.growth));
    EXPECT_LT(worst(found.modulus), 0.01) << "f = " << point.at.friction;
    EXPECT_LT(worst(found.growth), 0.01) << "f = " << point.at.friction;
  }
}

/// The lowest eigenvalues of the problem on all unknowns, so that no modal basis adds to the error
/// of the mesh; [friction].
std::vector<Errors> fullOrder(const std::string& mesh, std::size_t count) {
  const analysis::Analysis analysis =
      runCase("two_layers",
              "-mesh_set " + mesh + " -elasticity_mass consistent -flutter_friction 0.1,0.3,0.5" +
                  " -flutter_method direct -flutter_direct_count " + std::to_string(count + 12));
  std::vector<Errors> result;
  for (std::size_t i = 0; i < frictions.size(); ++i) {
    result.push_back(errors(exactAt(frictions[i], count),
                            eigenvaluesOf(analysis.flutter.segments.at(0).points.at(i))));
    print("%s, f = %g, worst of the first %zu: frequency %.1e, growth rate %.1e\n", mesh.c_str(),
          frictions[i], count, worst(result.back().frequency), worst(result.back().growth));
  }
  return result;
}

/// Frequencies one by one. Growth rates together: where the leading terms of an error cancel it
/// changes sign between two meshes, and the quotient of its values says nothing. Waves with k = 0
/// neither grow nor decay, and the mesh keeps that.
void expectConvergence(const std::vector<std::string>& meshes, double expected, double tolerance) {
  const std::size_t count = 12;
  std::vector<std::vector<Errors>> found;
  for (const auto& mesh : meshes) found.push_back(fullOrder(mesh, count));
  for (std::size_t level = 0; level + 1 < meshes.size(); ++level)
    for (std::size_t i = 0; i < frictions.size(); ++i) {
      const Errors &coarse = found[level][i], &fine = found[level + 1][i];
      const auto wanted = exactAt(frictions[i], count);
      for (std::size_t j = 0; j < count; ++j)
        EXPECT_TRUE(wanted[j].real() != 0 || fine.growth[j] < 1e-9)
            << "growth rate of wave " << j + 1 << " wrong by " << fine.growth[j];
      expectOrder(expected, tolerance, coarse.frequency, fine.frequency, "frequencies");
      expectOrder(expected, tolerance, {rootMeanSquare(coarse.growth)},
                  {rootMeanSquare(fine.growth)}, "growth rates, root mean square");
    }
}

TEST(TwoLayers, SecondOrderWithQuad4) {
  expectConvergence(
      {"nx=24,ny_disc=8,ny_pad=5", "nx=48,ny_disc=16,ny_pad=10", "nx=96,ny_disc=32,ny_pad=20"}, 2,
      0.05);
}

// The error of s² is of order h⁴.
void expectFourthOrder(const std::string& element, const std::string& coarse,
                       const std::string& fine) {
  expectConvergence({"order=2," + element + coarse, "order=2," + element + fine}, 4, 0.15);
}

const std::string coarse = ",nx=20,ny_disc=7,ny_pad=5", fine = ",nx=40,ny_disc=14,ny_pad=10";

TEST(TwoLayers, FourthOrderWithQuad9) {
  expectFourthOrder("recombine=1,serendipity=0", coarse, fine);
}
TEST(TwoLayers, FourthOrderWithQuad8) {
  expectFourthOrder("recombine=1,serendipity=1", coarse, fine);
}
// Triangles have errors six times as large, and their orders settle on finer meshes.
TEST(TwoLayers, FourthOrderWithTri6) {
  expectFourthOrder("recombine=0,serendipity=0", ",nx=24,ny_disc=8,ny_pad=6",
                    ",nx=48,ny_disc=16,ny_pad=12");
}

// One set of interface nodes in the mesh or two at the same places: the same matrices, in another
// order of the unknowns.
TEST(TwoLayers, SharedInterfaceNodes) {
  const std::string options =
      "-flutter_friction 0.5 -flutter_method direct -flutter_direct_count 30 -mesh_set "
      "nx=12,ny_disc=4,ny_pad=3";
  const analysis::Analysis twofold = runCase("two_layers", options),
                           shared = runCase("two_layers", options + ",shared=1");
  const auto wanted = eigenvaluesOf(twofold.flutter.segments.at(0).points.at(0));
  const double difference =
      worst(errors(wanted, eigenvaluesOf(shared.flutter.segments.at(0).points.at(0))).relative);
  print("shared against twofold interface nodes: %.1e\n", difference);
  EXPECT_LT(difference, 1e-9);
}

}  // namespace
}  // namespace squeal::test
