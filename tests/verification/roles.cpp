// SPDX-License-Identifier: BSD-2-Clause
// Roles of interfaces: coefficients of friction of their own, and interfaces that stick up to their
// limit of friction, against closed forms, statics, and models that must agree.
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
const std::string small = "-mesh_set nx=6,ny_disc=3,ny_pad=2 ";

/// Collective. Returns the largest difference of the forces of contact, relative to the largest.
double forceDifference(const steady::Solution& a, const steady::Solution& b) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < a.contact.size(); ++i) {
    size = worse(size, std::abs(a.contact[i].normalForce));
    difference = worse(difference, std::abs(a.contact[i].normalForce - b.contact[i].normalForce));
    for (std::size_t d = 0; d < 3; ++d)
      difference = worse(difference,
                         std::abs(a.contact[i].frictionForce[d] - b.contact[i].frictionForce[d]));
  }
  return largest(difference) / largest(size);
}

/// Expects the same forces of contact and eigenvalues at the last points of two runs. What differs
/// is the order of additions: eigenvalues of these matrices know some digits less than rounding.
void expectSame(const analysis::Analysis& a, const analysis::Analysis& b, const std::string& what) {
  ASSERT_TRUE(a.converged() && b.converged()) << what;
  const double force = forceDifference(a.steady.solutions.back(), b.steady.solutions.back());
  const double eigenvalue = worst(errors(eigenvaluesOf(a.flutter.segments.back().points.back()),
                                         eigenvaluesOf(b.flutter.segments.back().points.back()))
                                      .relative);
  print("%s: forces differ by %.1e, eigenvalues by %.1e\n", what.c_str(), force, eigenvalue);
  EXPECT_LT(force, 1e-10) << what;
  EXPECT_LT(eigenvalue, 1e-10) << what;
}

// A coefficient c of all interfaces is the swept one at f = c: with the friction that turns in
// space, with convective terms and a friction law, and with prestress.
TEST(FixedFriction, IsTheSweptOneAtItsValue) {
  const std::string swept = " -flutter_friction 0.3", none = " -flutter_friction 0";
  expectSame(runCase("two_layers", small + direct + swept),
             runCase("two_layers", small + direct + "-contact_interface_friction 0.3" + none),
             "layers");
  expectSame(
      runCase("two_layers_antiplane", small + direct + swept),
      runCase("two_layers_antiplane", small + direct + "-contact_interface_friction 0.3" + none),
      "antiplane");
  const std::string moving = slider::options(1, 0) + direct;
  expectSame(runOptions(moving + swept), runOptions(moving + "-contact_face_friction 0.3" + none),
             "slider");
  const std::string stressed = small + direct + "-elasticity_prestress on ";
  expectSame(runCase("two_layers", stressed + swept),
             runCase("two_layers", stressed + "-contact_interface_friction 0.3" + none),
             "prestress");
}

// Friction damping of tri6 and quad8 faces is integrated over the faces, where a factor counts too.
TEST(FixedFriction, CountsOnQuadraticFaces) {
  const std::string moving = slider::options(2, 0.5) + " -flutter_friction ";
  const auto damping = [&](const std::string& options) {
    setOptions(options);
    const Model model = buildModel();
    const std::vector<unsigned char> all(model.contact.interfaces.nodes.size(), 1);
    const contact::CoupledSystem system(model.bodies, model.contact, {all, {}});
    const auto solution = steady::Problem(*model.mesh, model.bodies, model.contact)
                              .solve({std::stod(options.substr(options.rfind(' ')))}, system);
    EXPECT_TRUE(solution.converged) << solution.reason;
    std::vector<double> force;
    for (const auto& state : solution.contact) force.push_back(state.normalForce);
    const OwnedMat response =
        contact::distributedResponse(model.contact, solution.slip, force, solution.at.friction);
    PetscReal size = 0;
    check(MatNorm(response, NORM_FROBENIUS, &size));
    return size;
  };
  const double wanted = damping(moving + "0.2");
  EXPECT_GT(wanted, 0);
  // SNES leaves 1e-10 of the forces.
  EXPECT_NEAR(damping("-contact_face_friction 0.2 " + moving + "0") / wanted, 1, 1e-8);
  EXPECT_NEAR(damping("-contact_face_friction_factor 0.5 " + moving + "0.4") / wanted, 1, 1e-8);
}

// Derivatives with respect to all data but the swept friction, on which nothing depends, follow the
// steady state as those of the swept friction do.
TEST(FixedFriction, HasTheSensitivitiesOfTheSweptOne) {
  // On several ranks the sums of two runs are rounded differently, and the derivatives of this
  // model then take one of two values, 1e-4 apart.
  if (sizeOf() > 1) GTEST_SKIP() << "the sums of both runs agree only on one rank";
  const auto sensitivities = [](const std::string& friction) {
    const auto analysis = runOptions(slider::options(1, 0) + direct +
                                     "-flutter_sensitivities -flutter_shapes 3 " + friction);
    return analysis.flutter.segments.at(0).points.at(0).sensitivities;
  };
  const auto swept = sensitivities("-flutter_friction 0.3"),
             fixed = sensitivities("-contact_face_friction 0.3 -flutter_friction 0");
  ASSERT_EQ(swept.size(), 3u);
  ASSERT_EQ(fixed.size(), swept.size());
  double difference = 0;
  for (std::size_t i = 0; i < swept.size(); ++i) {
    ASSERT_EQ(fixed[i].derivatives.size(), swept[i].derivatives.size());
    double size = 0;
    for (const auto& derivative : swept[i].derivatives)
      size = worse(size, std::abs(derivative.value));
    EXPECT_GT(size, 0);
    for (std::size_t p = 0; p < swept[i].derivatives.size(); ++p) {
      const auto &one = swept[i].derivatives[p], &other = fixed[i].derivatives[p];
      EXPECT_EQ(one.parameter, other.parameter);
      const Complex wanted = one.parameter == "friction" ? 0 : one.value;
      difference = worse(difference, std::abs(other.value - wanted) / size);
    }
  }
  print("sensitivities differ by %.1e\n", difference);
  // Left vectors have backward errors of 1e-10, and differences of the steady state add rounding.
  EXPECT_LT(difference, 1e-7);
}

/// The layer between two plates that slide alike.
const std::string twoPlates =
    "-mesh_file meshes/layer.geo -mesh_set nx=6,ny=3 -material_layer_young 1 "
    "-material_layer_poisson 0.3 -material_layer_density 1 "
    "-constraint_left_clamped x -constraint_right_clamped x "
    "-contact_upper_pad top -contact_upper_obstacle_velocity 1,0,0 "
    "-contact_upper_obstacle_displacement 0,-0.01,0 "
    "-contact_lower_pad bottom -contact_lower_obstacle_velocity 1,0,0 "
    "-contact_lower_obstacle_displacement 0,0.01,0 -modes_count 10 ";

TEST(FixedFriction, StandsBesideASweptOne) {
  expectSame(runOptions(twoPlates + direct +
                        "-contact_lower_friction_factor 0.5 "
                        "-flutter_friction 0.4"),
             runOptions(twoPlates + direct + "-contact_lower_friction 0.2 -flutter_friction 0.4"),
             "two plates");
  // The reduced method finds the same, and follows the eigenvalues from the true problem at f = 0,
  // where they are not those of free vibration.
  const std::string sweep =
      twoPlates + "-mesh_set nx=18,ny=6 " +
      "-contact_lower_friction 0.2 -modes_count 20 -flutter_friction 0,0.2,0.4 ";
  const auto reduced = runOptions(sweep),
             full = runOptions(sweep + "-flutter_method direct -flutter_direct_count 30");
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& point = reduced.flutter.segments.at(0).points.at(i);
    EXPECT_EQ(point.uncertifiedCount(), 0);
    const auto found = eigenvaluesOf(point),
               all = eigenvaluesOf(full.flutter.segments.at(0).points.at(i));
    EXPECT_LT(worst(errors(found, all).relative), 1e-8);  // of the certificate
  }
  const auto& followed = reduced.flutter.segments.at(0).trackedLines.at(0);
  EXPECT_FALSE(followed.countExact);
  EXPECT_TRUE(followed.complete()) << followed.statement();
  EXPECT_TRUE(contains(followed.statement(), "not confirmed by a Sturm count"));
  EXPECT_EQ(followed.branches.inBandAt(followed.branches.stations.front()),
            std::ssize(reduced.flutter.segments.at(0).points.at(0).eigenvalues));
}

// Exported matrices say which of them are friction, so that modes and eigenvalues are the same.
TEST(FixedFriction, IsExported) {
  const std::string folder = SQUEAL_OUTPUT_DIR "/roles_export";
  const std::string options =
      twoPlates + "-contact_lower_friction 0.2 -flutter_friction 0,0.4 -modes_count 20 ";
  const auto written = runOptions(options + "-report_matrices " + folder);
  clearOptions();
  insertFile(PETSC_COMM_WORLD, folder + "/options.txt");
  insert(settingsOfText("-quiet"));
  const auto read = analysis::analyse(PETSC_COMM_WORLD, analysis::Settings::given());
  const auto &here = written.flutter.segments.at(0), &there = read.flutter.segments.at(0);
  // The tolerance of the modes, squared, and that of the certificate.
  EXPECT_LT(worst(errors(eigenvaluesOf(here.modes), eigenvaluesOf(there.modes)).relative), 1e-9);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT(
        worst(errors(eigenvaluesOf(here.points.at(i)), eigenvaluesOf(there.points.at(i))).relative),
        1e-8);
}

TEST(FixedFriction, IdleOptionsAreErrors) {
  const auto message = [](const std::string& options) {
    return errorOf([&] { runCase("two_layers", small + options); });
  };
  const std::string own = "-contact_interface_friction 0.3 ";
  EXPECT_TRUE(contains(message(own + "-contact_interface_friction_factor 2"), "give one of them"));
  EXPECT_TRUE(contains(message(own + "-contact_interface_role frictionless"),
                       "needs -contact_interface_role sliding or sticking"));
  EXPECT_TRUE(contains(message(own + "-contact_interface_release on"),
                       "needs -contact_interface_role sticking"));
  EXPECT_TRUE(contains(message("-contact_interface_role sticking -contact_interface_release on"),
                       "needs -contact_interface_friction"));
  EXPECT_TRUE(contains(message(own + "-flutter_friction 0.2"), "no interface has this"));
}

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
