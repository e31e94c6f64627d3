// SPDX-License-Identifier: BSD-2-Clause
// A soft layer on the sliding surface of two elastic layers, -contact_<interface>_stiffness: exact
// steady sliding, convergence to the exact waves, the limit of hard contact, and a layer of solid
// cells of the same stiffness.
#include <gtest/gtest.h>

#include <cmath>

#include "base/petsc/arrays.hpp"
#include "base/system/text.hpp"
#include "exact/two_layers.hpp"
#include "support/eigen/characteristic_roots.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/run/case.hpp"
#include "support/steady/uniform_layers.hpp"

namespace squeal::test {
namespace {

namespace two_layers = exact::two_layers;

/// As stiff as 0.3 m of the pad: the waves of hard contact are far away.
constexpr double stiffness = 1.5;
constexpr double friction = 0.3, velocity = 0.05;
constexpr std::size_t count = 12;

const std::string soft = " -contact_interface_stiffness 1.5 ";
const std::string full =
    " -elasticity_mass consistent -flutter_friction 0.3 -flutter_method direct"
    " -flutter_direct_count 24 ";

std::vector<Complex> eigenvalues(const std::string& name, const std::string& options) {
  const analysis::Analysis analysis = runCase(name, options);
  EXPECT_TRUE(analysis.converged());
  return eigenvaluesOf(analysis.flutter.segments.at(0).points.at(0));
}

/// The lowest roots of the characteristic equation, which Newton's method finds from computed
/// eigenvalues.
std::vector<Complex> exactNear(const std::vector<Complex>& found, double carried) {
  const Characteristic characteristic = [=](int n, Complex s) {
    return two_layers::characteristic(
        {.friction = friction, .carried = carried, .softness = 1 / stiffness}, n, s);
  };
  auto roots = rootsNear(found, {characteristic}, 9);
  std::sort(roots.begin(), roots.end(), [](Complex a, Complex b) { return a.imag() < b.imag(); });
  EXPECT_GE(roots.size(), count);
  roots.resize(std::min(roots.size(), count));
  return roots;
}

/// Expects the order of the root mean square errors: single growth rates change sign between two
/// meshes. Cells of the fine mesh are smaller by `ratio`.
void expectConvergence(const std::string& name, double carried, double least, double ratio,
                       const std::string& coarse, const std::string& fine) {
  const auto coarseFound = eigenvalues(name, soft + full + "-mesh_set " + coarse),
             fineFound = eigenvalues(name, soft + full + "-mesh_set " + fine);
  const auto wanted = exactNear(fineFound, carried);
  const Errors before = errors(wanted, coarseFound), after = errors(wanted, fineFound);
  const double frequency =
                   std::log(rootMeanSquare(before.frequency) / rootMeanSquare(after.frequency)) /
                   std::log(ratio),
               growth = std::log(rootMeanSquare(before.growth) / rootMeanSquare(after.growth)) /
                        std::log(ratio);
  print("%s %s: errors of frequencies %.1e, of growth rates %.1e, orders %.2f, %.2f\n",
        name.c_str(), fine.c_str(), worst(after.frequency, count), worst(after.growth, count),
        frequency, growth);
  EXPECT_GT(frequency, least);
  EXPECT_GT(growth, least);
}

// Uniform strain is in the space of all cells, of matching and other meshes.
TEST(SoftLayer, SteadySlidingIsExact) {
  for (const std::string mesh :
       {"nx=6,ny_disc=3,ny_pad=2", "nx=6,ny_disc=3,ny_pad=2,recombine=0",
        "nx=6,ny_disc=2,ny_pad=2,order=2,serendipity=1", "nx=6,nx_pad=4,ny_disc=3,ny_pad=2",
        "nx=6,nx_pad=9,ny_disc=2,ny_pad=2,order=2"}) {
    const auto analysis = runCase("two_layers", soft + "-flutter_friction 0.5 -mesh_set " + mesh +
                                                    " -modes_count 5 -flutter_track off");
    const auto& solution = analysis.steady.solutions.at(0);
    const two_layers::Steady exact{.friction = 0.5, .depth = depth, .softness = 1 / stiffness};
    ASSERT_TRUE(solution.converged) << solution.reason;
    expectUniformPressure(analysis, solution, exact.pressure(), two_layers::period, 1, 1);
    double error = 0;  // of the layer nodes, which move with the disc along the normal, and others
    const auto& model = analysis.model;
    std::vector<unsigned char> isLayer(model.mesh->ownedNodes, 0);
    for (const auto& [node, layer] : model.mesh->layers) isLayer[layer] = 1;
    const ReadArray u(solution.displacement);
    for (PetscInt node = 0; node < model.mesh->ownedNodes; ++node) {
      if (isLayer[node]) continue;
      const double y = model.mesh->coordinates[node][1];
      const bool inPad = model.mesh->partName[model.mesh->nodePart[node]] == "pad";
      error = worse(error, std::abs(u[2 * node] - exact.u(y, inPad)));
      error = worse(error, std::abs(u[2 * node + 1] - exact.v(y, inPad)));
    }
    print("%s: displacement %.1e of %g\n", mesh.c_str(), largest(error), depth);
    EXPECT_LT(largest(error), 1e-10 * depth) << mesh;
  }
}

TEST(SoftLayer, SecondOrderWithQuad4) {
  expectConvergence("two_layers", 0, 1.9, 2, "nx=24,ny_disc=8,ny_pad=5",
                    "nx=48,ny_disc=16,ny_pad=10");
}

// Moving matter: the layer moves with the pad along the face, so that its gap is that of the pad.
TEST(SoftLayer, FourthOrderWithMovingQuad8) {
  expectConvergence("two_layers_moving", velocity, 3.6, 2,
                    "order=2,serendipity=1,nx=12,ny_disc=4,ny_pad=3",
                    "order=2,serendipity=1,nx=24,ny_disc=8,ny_pad=6");
}

// Cells 2:3, the layer on either side.
TEST(SoftLayer, SecondOrderWithoutMatchingNodes) {
  for (const std::string slave : {"pad", "disc"})
    expectConvergence(
        "two_layers_moving", velocity, 1.9, 1.5,
        "order=1,nx=24,nx_pad=36,ny_disc=8,ny_pad=6 -contact_interface_slave " + slave,
        "order=1,nx=36,nx_pad=54,ny_disc=12,ny_pad=9 -contact_interface_slave " + slave);
}

TEST(SoftLayer, FourthOrderWithoutMatchingNodes) {
  for (const std::string slave : {"pad", "disc"})
    expectConvergence(
        "two_layers_moving", velocity, 3.5, 1.5,
        "order=2,nx=14,nx_pad=10,ny_disc=6,ny_pad=4 -contact_interface_slave " + slave,
        "order=2,nx=21,nx_pad=15,ny_disc=9,ny_pad=6 -contact_interface_slave " + slave);
}

/// The largest distance of the lowest eigenvalues of two models.
double distance(const std::vector<Complex>& wanted, const std::vector<Complex>& found) {
  std::vector<Complex> lowest(wanted.begin(), wanted.begin() + count);
  return worst(errors(lowest, found).relative, count);
}

// First order in 1/k: the next term is a thousandth of it.
TEST(SoftLayer, TendsToHardContactWithItsStiffness) {
  const std::string mesh = full + "-mesh_set nx=12,ny_disc=4,ny_pad=3 ";
  const auto hard = eigenvalues("two_layers", mesh);
  const double soft = distance(
                   hard, eigenvalues("two_layers", mesh + "-contact_interface_stiffness 1e3")),
               stiff = distance(
                   hard, eigenvalues("two_layers", mesh + "-contact_interface_stiffness 1e4"));
  print("distance to hard contact: k = 1e3 %.3e, 1e4 %.3e\n", soft, stiff);
  EXPECT_GT(soft, 1e-5);
  EXPECT_NEAR(soft / stiff, 10, 0.1);
}

// A layer of solid cells of the thickness t with the modulus k t across it, hardly any mass and a
// shear stiffness k/t that grows as it thins: the difference is of first order in t, as what it
// resists along the face is.
TEST(SoftLayer, IsTheLimitOfThinSolidLayers) {
  const std::string mesh = full + "-mesh_set nx=12,ny_disc=4,ny_pad=3";
  const auto layer = eigenvalues("two_layers", soft + mesh);
  std::vector<double> found;
  for (const double t : {0.02, 0.01}) {
    const double e = stiffness * t, g = stiffness;
    found.push_back(distance(
        layer, eigenvalues("two_layers", mesh + formatted(",h_soft=%g -material_soft_density 1e-9 "
                                                          "-material_soft_engineering_constants "
                                                          "%g,%g,%g,0,0,0,%g,%g,%g",
                                                          t, e, e, e, g, g, g))));
    print("solid layer of %g m: difference %.2e\n", t, found.back());
  }
  EXPECT_LT(found[1], 0.01);
  EXPECT_NEAR(found[0] / found[1], 2, 0.15);
}

}  // namespace
}  // namespace squeal::test
