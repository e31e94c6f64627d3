// SPDX-License-Identifier: BSD-2-Clause
// Interfaces that stick up to their limit of friction, against closed forms and statics.
#include <gtest/gtest.h>

#include <cmath>

#include "base/options/settings.hpp"
#include "base/system/text.hpp"
#include "model/contact/coupled.hpp"
#include "model/contact/response.hpp"
#include "steady/steady/steady.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/harness/ranks.hpp"
#include "support/model/coupled_contact.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"
#include "support/steady/contact_laws.hpp"
#include "support/steady/strained_slider.hpp"

namespace squeal::test {
namespace {

/// Direct eigenvalues, all of small problems by LAPACK.
const std::string direct = " -flutter_method direct -flutter_direct_count 20 -flutter_track off ";

// Two layers in series, periodic along the surface: the top moves by (a, −δ), and the strains are
// uniform. On h of E and ν the stresses are p = M δ / h and q = G a / h.
constexpr double period = 3;
struct Series {
  double shear = 0, press = 0;  ///< compliances, m/Pa: Σ h/G and Σ h/M

  Series() {
    for (const auto& [h, young, nu] : {std::array{1.0, 1.0, 0.3}, std::array{0.6, 0.4, 0.25}}) {
      shear += h * 2 * (1 + nu) / young;
      press += h * (1 + nu) * (1 - 2 * nu) / (young * (1 - nu));
    }
  }
  double pressure() const { return 0.01 / press; }
};

/// Layers in the plane or in space, with linear and quadratic faces that match or do not.
struct Layers {
  std::string mesh;
  bool solid = false;

  std::string options(const std::string& more) const {
    return "-mesh_set " + mesh +
           (solid ? ",nz=1,depth=0.7 -constraint_pad_top_displacement 0.004,-0.01,0.003"
                  : " -constraint_pad_top_displacement 0.004,-0.01,0") +
           " -flutter_friction 0 -modes_count 5 -contact_interface_role sticking " + more;
  }
  analysis::Analysis run(const std::string& more) const {
    return runCase(solid ? "two_layers_antiplane" : "two_layers", options(more));
  }
  double aside() const { return solid ? 0.005 : 0.004; }
  double area() const { return period * (solid ? 0.7 : 1); }
  /// The direction of the pull.
  mesh::Point pull() const { return {solid ? 0.8 : 1, 0, solid ? 0.6 : 0}; }
};
const Layers allLayers[] = {{"nx=6,ny_disc=3,ny_pad=2"},
                            {"nx=6,nx_pad=9,ny_disc=3,ny_pad=2"},
                            {"order=2,nx=4,ny_disc=2,ny_pad=2"},
                            {"order=2,nx=4,nx_pad=6,ny_disc=2,ny_pad=2,serendipity=1"},
                            {"order=1,nx=3,nx_pad=4,ny_disc=2,ny_pad=1", true},
                            {"order=2,nx=3,ny_disc=1,ny_pad=1,serendipity=1", true},
                            {"order=2,nx=3,nx_pad=4,ny_disc=1,ny_pad=1,shape=0", true}};

TEST(Sticking, TellsTheLeastFriction) {
  const Series exact;
  for (const auto& layers : allLayers)
    for (const double part : {0.9, 1.1}) {
      const double traction = layers.aside() / exact.shear, needed = traction / exact.pressure();
      const auto analysis = layers.run("-contact_interface_friction " + shortest(part * needed));
      const auto& solution = analysis.steady.solutions.at(0);
      ASSERT_TRUE(solution.converged) << solution.reason;
      const auto& resultant = solution.resultants.at(0);
      // Uniform strain is in the space of all elements, so that rounding of the solvers is left;
      // gmsh places nodes to 1e-11.
      EXPECT_NEAR(resultant.leastFriction / needed, 1, 1e-9) << layers.mesh;
      EXPECT_NEAR(dot(resultant.frictionForce, layers.pull()) / (traction * layers.area()), -1,
                  1e-9)
          << layers.mesh;
      EXPECT_EQ(resultant.overLimit, part < 1 ? analysis.model.contact.interfaces.totalNodes : 0)
          << layers.mesh;
      EXPECT_EQ(resultant.released, 0);
      EXPECT_EQ(solution.revisions, 0);
    }
}

// Pulled by more than f p, all nodes slide: the traction is f p, and the jump what the layers do
// not take. They vibrate like a contact without friction.
TEST(Sticking, ReleasedNodesCarryTheirFriction) {
  const Series exact;
  for (const auto& layers : allLayers) {
    const double friction = 0.7 * layers.aside() / exact.shear / exact.pressure();
    const auto analysis = layers.run("-contact_interface_friction " + shortest(friction) + direct +
                                     " -contact_interface_release on");
    const auto& solution = analysis.steady.solutions.at(0);
    ASSERT_TRUE(solution.converged) << solution.reason;
    const auto& resultant = solution.resultants.at(0);
    const double press = exact.pressure() * layers.area();
    EXPECT_EQ(resultant.released, analysis.model.contact.interfaces.totalNodes) << layers.mesh;
    EXPECT_NEAR(dot(resultant.frictionForce, layers.pull()) / (friction * press), -1, 1e-9)
        << layers.mesh;
    EXPECT_NEAR(resultant.normalForce[1] / press, 1, 1e-9) << layers.mesh;
    EXPECT_LT(solution.imbalance, 1e-10);
    const OwnedVec jump = elasticity::nodalVector(*analysis.model.mesh);
    check(MatMult(analysis.model.contact.sliding.jump, solution.displacement, jump));
    const auto jumps = allEntries(jump);
    const double slid = layers.aside() - friction * exact.pressure() * exact.shear;
    const int dimension = analysis.model.mesh->dimension;
    for (const auto& node : analysis.model.contact.interfaces.nodes)
      EXPECT_NEAR(dot(at(jumps, node.globalNode, dimension), layers.pull()) / slid, 1, 1e-8)
          << layers.mesh;
    const auto smooth = layers.run(direct + "-contact_interface_role frictionless");
    EXPECT_LT(worst(errors(eigenvaluesOf(smooth.flutter.segments.at(0).points.at(0)),
                           eigenvaluesOf(analysis.flutter.segments.at(0).points.at(0)))
                        .relative),
              1e-9)
        << layers.mesh;
  }
}

/// A block on a layer, pressed by p and held along x by springs, which a pressure on its end pulls.
std::string block(const std::string& mesh, const std::string& options) {
  return "-mesh_file meshes/two_layers.geo -mesh_set Lx=1,h_disc=0.5,h_pad=0.4," + mesh +
         material("disc", "1", "0.3", "1") + material("pad", "1", "0.3", "1") +
         "-constraint_disc_bottom_clamped xy -load_pad_top_pressure 0.01 "
         "-contact_interface_pad pad_face -contact_interface_disc disc_face "
         "-contact_interface_role sticking -flutter_friction 0 -modes_count 5 " +
         options + " ";
}
const std::string blocks[] = {"nx=8,ny_disc=4,ny_pad=4", "nx=8,nx_pad=12,ny_disc=4,ny_pad=4",
                              "order=2,nx=6,ny_disc=3,ny_pad=3"};

TEST(Sticking, WholeBlockSlides) {
  for (const auto& mesh : blocks) {
    // The end of height 0.4 is pulled by 0.002, the friction is 0.1 · 0.01.
    const std::string options =
        block(mesh,
              "-load_pad_left_pressure 0.005 -contact_interface_friction 0.1 "
              "-contact_interface_release on");
    const auto analysis = runOptions(options + "-ground_pad_top_stiffness 0.01,0");
    const auto& solution = analysis.steady.solutions.at(0);
    ASSERT_TRUE(solution.converged) << solution.reason;
    const auto& resultant = solution.resultants.at(0);
    print("%s: %d revisions, friction %.12f, imbalance %.1e\n", mesh.c_str(), solution.revisions,
          resultant.frictionForce[0] / 0.001, solution.imbalance);
    EXPECT_EQ(resultant.released,
              analysis.model.contact.interfaces.totalNodes - solution.openNodes);
    EXPECT_NEAR(resultant.frictionForce[0], -0.1 * 0.01, 1e-12);
    EXPECT_NEAR(resultant.normalForce[1], 0.01, 1e-11);
    EXPECT_LT(solution.imbalance, 1e-10);
    // Without springs nothing holds the block once all nodes slide.
    const auto loose = runOptions(options);
    EXPECT_FALSE(loose.converged());
    EXPECT_TRUE(contains(loose.steady.solutions.at(0).reason, "body 'pad' can move rigidly"))
        << loose.steady.solutions.at(0).reason;
  }
}

// A part slides: each node satisfies the law of friction, with its slip against the force.
TEST(Sticking, PartOfABlockSlides) {
  for (const auto& mesh : blocks) {
    const auto analysis =
        runOptions(block(mesh,
                         "-load_pad_left_pressure 0.0025 -contact_interface_friction 0.12 "
                         "-contact_interface_release on"));
    const auto& solution = analysis.steady.solutions.at(0);
    ASSERT_TRUE(solution.converged) << solution.reason;
    const auto& resultant = solution.resultants.at(0);
    print("%s: %d of %d nodes slide, %d open, %d unheld, %d revisions, imbalance %.1e\n",
          mesh.c_str(), int(resultant.released), int(analysis.model.contact.interfaces.totalNodes),
          int(solution.openNodes), int(resultant.unheld), solution.revisions, solution.imbalance);
    EXPECT_GT(resultant.released, 0);
    EXPECT_LT(resultant.released,
              analysis.model.contact.interfaces.totalNodes - solution.openNodes);
    EXPECT_EQ(resultant.overLimit, 0);
    EXPECT_NEAR(resultant.frictionForce[0], -0.4 * 0.0025, 1e-12);
    EXPECT_LT(solution.imbalance, 1e-10);
    const OwnedVec jump = elasticity::nodalVector(*analysis.model.mesh);
    check(MatMult(analysis.model.contact.sliding.jump, solution.displacement, jump));
    const auto jumps = allEntries(jump);
    for (std::size_t i = 0; i < solution.contact.size(); ++i) {
      const auto& state = solution.contact[i];
      const double slid = jumps[2 * static_cast<std::size_t>(
                                        analysis.model.contact.interfaces.nodes[i].globalNode)];
      EXPECT_LE(std::abs(state.frictionForce[0]), 0.12 * state.normalForce + 1e-9) << mesh;
      EXPECT_LE(slid * state.frictionForce[0], 1e-15) << mesh;
      if (solution.sticking.holds[i] == steady::Hold::held) {
        EXPECT_LT(std::abs(slid), 1e-14);
      }
    }
  }
}

// A guided block that is drawn aside rocks and opens at one end. The nodes that are open there
// carry nothing, and statics alone places the pressure: N x = N L/2 − T H.
TEST(Sticking, OpenNodesAreFree) {
  for (const auto& mesh : blocks) {
    const auto analysis = runOptions(
        block(mesh, "-constraint_pad_top_clamped x -constraint_pad_top_displacement 0.04,0,0"));
    const auto& solution = analysis.steady.solutions.at(0);
    ASSERT_TRUE(solution.converged) << solution.reason;
    const Transmitted sums = transmitted(analysis, solution);
    double left = 0;
    for (std::size_t i = 0; i < solution.contact.size(); ++i) {
      const auto& state = solution.contact[i];
      if (!solution.closed[i] && !analysis.model.contact.interfaces.gapBasis)
        left = worse(left, std::abs(state.frictionForce[0]));
    }
    print("%s: %d of %d nodes open, %d unheld, %d revisions, T/N %.4f, imbalance %.1e\n",
          mesh.c_str(), int(solution.openNodes), int(analysis.model.contact.interfaces.totalNodes),
          int(solution.resultants.at(0).unheld), solution.revisions, sums.friction / sums.normal,
          solution.imbalance);
    EXPECT_GT(solution.openNodes, 0);
    EXPECT_LT(largest(left), 1e-11 * 0.01);  // the tolerance of the solver, of the load
    EXPECT_NEAR(sums.normal / 0.01, 1, 1e-10);
    EXPECT_LT(solution.imbalance, 1e-10);
    EXPECT_NEAR(sums.normal * (sums.centre - 0.5), -sums.friction * 0.4, 1e-9 * 0.01);
  }
}

}  // namespace
}  // namespace squeal::test
