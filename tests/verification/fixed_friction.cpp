// SPDX-License-Identifier: BSD-2-Clause
// Interfaces with coefficients of friction of their own, against models that must agree.
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

}  // namespace
}  // namespace squeal::test
