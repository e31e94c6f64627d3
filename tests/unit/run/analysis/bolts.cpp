// SPDX-License-Identifier: BSD-2-Clause
// Pretension: a bolt and a sleeve between two rigid plates, against the closed form of two springs.
#include <gtest/gtest.h>

#include <cmath>

#include "base/system/text.hpp"
#include "eigen/modes/modes.hpp"
#include "model/contact/coupled.hpp"
#include "run/analysis/tightening.hpp"
#include "steady/steady/reactions.hpp"
#include "support/harness/messages.hpp"
#include "support/harness/scratch_folder.hpp"
#include "support/model/model.hpp"
#include "support/run/bolted_columns.hpp"

namespace squeal::test::bolted {
namespace {

constexpr double force = 3e4;  // N, of the bolt

/// A column on the sleeve that only its contact holds along z.
const char* const rider = R"(
x0 = 3; w = 2; z0 = 1; h = 0.5; Call Column;
Physical Surface("rider_low") = {s};
Physical Surface("rider_high") = {top};
Physical Volume("rider") = {volume};
)";

/// The state of the assembly under an external force that draws the plates apart.
struct State {
  double bolt = 0;   ///< tension, N
  double joint = 0;  ///< normal force of the joint, N
  PetscInt open = 0;
};

/// Collective. Returns the state of a model without friction.
steady::Solution solved(const analysis::Model& model, double pressure = 1) {
  const steady::Problem problem(*model.mesh, model.bodies, model.contact);
  const contact::CoupledSystem system(model.bodies, model.contact, model.bonded());
  return problem.solve({.friction = 0, .pressure = pressure}, system);
}

/// Collective. Returns the state with these options.
State stateWith(const std::string& options) {
  setOptions(assembly() + options);
  const auto model = tightenedModel();
  const auto solution = solved(model);
  EXPECT_TRUE(solution.converged) << solution.reason;
  EXPECT_LT(solution.imbalance, 1e-10);
  return {analysis::boltForces(model, solution).at(0),
          mesh::length(solution.resultants.at(0).normalForce), solution.openNodes};
}

std::string pulled(double load) { return formatted("-load_high_force 0,0,%.17g ", load); }

// Springs in parallel and a locked length are linear problems: their round-off is that of the
// factorisation.
constexpr double exact = 1e-9;

TEST(Bolts, ForceAndThenSeparation) {
  const std::string tightened = formatted("-bolt_b_force %.17g ", force);
  const auto atRest = stateWith(tightened);
  EXPECT_NEAR(atRest.bolt / force, 1, exact);
  EXPECT_NEAR(atRest.joint / force, 1, exact);
  // The bolt takes its share of the external force until the joint opens; then it takes all.
  const double share = boltStiffness / (boltStiffness + sleeveStiffness),
               opening = force * (1 + boltStiffness / sleeveStiffness);
  const auto loaded = stateWith(tightened + pulled(0.9 * opening));
  EXPECT_NEAR(loaded.bolt / (force + 0.9 * opening * share), 1, exact);
  EXPECT_NEAR(loaded.joint / (0.1 * force), 1, 10 * exact);
  EXPECT_EQ(loaded.open, 0);
  const auto apart = stateWith(tightened + pulled(1.1 * opening));
  EXPECT_NEAR(apart.bolt / (1.1 * opening), 1, exact);
  EXPECT_LT(apart.joint, exact * force);
  EXPECT_GT(apart.open, 0);
}

// The row of the bolt is its tension, and the section adds nothing to the sum of all forces.
TEST(Bolts, ForcesBalance) {
  setOptions(assembly() + formatted("-bolt_b_force %.17g ", force) + pulled(1e4));
  const auto model = tightenedModel();
  const auto solution = solved(model);
  const double tension = analysis::boltForces(model, solution).at(0);
  EXPECT_GT(tension, force);
  int found = 0;
  for (const auto& [kind, name, wrench] :
       steady::Reactions(*model.mesh, model.bodies, model.contact).of(solution)) {
    const auto expect = [&, row = kind + " " + name, all = wrench](const mesh::Point& at,
                                                                   const mesh::Point& value) {
      ++found;
      const auto moment = mesh::cross(at, value);
      for (std::size_t d = 0; d < 3; ++d) {
        EXPECT_NEAR(all.force[d], value[d], 1e-10 * force) << row << " " << d;
        EXPECT_NEAR(all.moment[d], moment[d], 1e-10 * force) << row << " " << d;
      }
    };
    // The axis of the bolt is at (0.5, 0.5).
    const double pull = -mesh::dot(wrench.force, model.mesh->sections[0].normal);
    if (kind == "bolt") {
      EXPECT_NEAR(pull / tension, 1, 1e-10);
      expect({0.5, 0.5, 0}, {0, 0, wrench.force[2]});
    }
    if (kind == "sum") expect({}, {});
    EXPECT_FALSE(kind == "reference" && name != "high" && name != "low") << name;
  }
  EXPECT_EQ(found, 2);
}

// The rider presses the plates together, and the bolt gives way to the sleeve, unless the pressure
// acts while the bolt is tightened. Without pressure the rider is loose.
TEST(Bolts, PartsThatOnlyPressureHolds) {
  const std::string file = writeFile("rider.geo", geometry + rider);
  const double pressure = 5e3, area = 2, pressed = pressure * area,
               share = boltStiffness / (boltStiffness + sleeveStiffness);
  const std::string options = formatted("-load_rider_high_pressure %.17g ", pressure) +
                              "-mesh_file " + file + material("rider", "2e9", "0", "1000") +
                              "-constraint_rider_high_clamped xy -contact_rider_pad rider_low "
                              "-contact_rider_disc sleeve_high -contact_rider_role frictionless ";
  const std::string tightened = formatted("-bolt_b_force %.17g ", force);
  const double shortening = force * (1 / boltStiffness + 1 / sleeveStiffness);
  const auto before = stateWith(options + formatted("-bolt_b_shortening %.17g ", shortening));
  EXPECT_NEAR(before.bolt / (force - pressed * share), 1, exact);
  EXPECT_NEAR(before.joint / (force + pressed * (1 - share)), 1, exact);
  const auto under = stateWith(options + tightened + "-bolt_under_pressure on ");
  EXPECT_NEAR(under.bolt / force, 1, exact);
  EXPECT_NEAR(under.joint / (force + pressed), 1, exact);
  const std::string failure = errorOf([&] { stateWith(options + tightened); });
  EXPECT_TRUE(contains(failure, "the step that tightens the bolts has no solution")) << failure;
  EXPECT_TRUE(contains(failure, "give -bolt_under_pressure on")) << failure;
}

TEST(Bolts, ShorteningIsTheOtherWayToSayIt) {
  // In series: the force shortens both springs.
  const double shortening = force * (1 / boltStiffness + 1 / sleeveStiffness);
  const std::string given = formatted("-bolt_b_shortening %.17g ", shortening);
  EXPECT_NEAR(stateWith(given).bolt / force, 1, exact);
  EXPECT_NEAR(stateWith(given + pulled(1000)).bolt / (force + 1000.0 / 3), 1, exact);
  // The axis only says which side is the upper one.
  EXPECT_NEAR(stateWith(given + "-bolt_b_axis 0,0,-1").bolt / force, 1, exact);
  EXPECT_NEAR(stateWith(given + "-bolt_b_axis 0.1,0,1").bolt / force, 1, exact);
}

TEST(Bolts, PressureOfTheSweepDoesNotScaleThem) {
  setOptions(assembly() + formatted("-bolt_b_force %.17g ", force) + pulled(3000));
  const auto model = tightenedModel();
  for (const double pressure : {0.0, 2.0}) {
    const double found = analysis::boltForces(model, solved(model, pressure)).at(0);
    EXPECT_NEAR(found / (force + pressure * 1000), 1, exact);
  }
}

TEST(Bolts, FrequenciesAreThoseOfTheUncutBody) {
  const auto lambda = [](const std::string& options) {
    setOptions(options + "-modes_count 4");
    const auto model = tightenedModel();
    const contact::CoupledSystem system(model.bodies, model.contact, model.bonded());
    return modes::compute(system, modes::Settings::given()).lambda;
  };
  const auto cut = lambda(assembly() + formatted("-bolt_b_force %.17g ", force));
  std::string whole = assembly();
  whole.resize(whole.find("-bolt_b_section"));
  const auto uncut = lambda(whole);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(cut[i] / uncut[i], 1, 1e-9) << i;
}

/// The tensions of two bolts and the eigenvalues of the modes.
struct Pair {
  std::vector<double> tensions;
  std::vector<double> lambda;
};

/// Collective. Returns the state of two assemblies apart from each other, with the bolts `b` and
/// `a_b`.
Pair pairWith(const std::string& options) {
  setOptions("-mesh_file " + writeFile("bolts.geo", geometry + geometryAt(9, "a_")) +
             optionsOf("") + optionsOf("a_") + options + "-modes_count 8");
  const auto model = tightenedModel();
  const auto solution = solved(model);
  const contact::CoupledSystem system(model.bodies, model.contact, steady::activeSet(solution));
  return {analysis::boltForces(model, solution),
          modes::compute(system, modes::Settings::given()).lambda};
}

// A bolt whose length is given is tightened before the others. In a second state a load of the
// sweep pulls one assembly apart, so that the frequencies depend on the contact.
TEST(Bolts, OrderOfTwoIndependentOnes) {
  const double shortening = force * (1 / boltStiffness + 1 / sleeveStiffness);
  const auto force1 = formatted("-bolt_b_force %.17g ", force),
             force2 = formatted("-bolt_a_b_force %.17g ", force),
             length1 = formatted("-bolt_b_shortening %.17g ", shortening),
             length2 = formatted("-bolt_a_b_shortening %.17g ", shortening);
  const std::string apart = formatted("-load_a_high_force 0,0,%.17g ", 10 * force);
  const auto together = pairWith(force1 + force2);
  for (const double tension : together.tensions) EXPECT_NEAR(tension / force, 1, exact);
  const auto whole = pairWith(length1 + length2);
  const auto opened = pairWith(length1 + length2 + apart);
  EXPECT_NEAR(opened.tensions[0] / (10 * force), 1, exact);  // a_b, by name
  EXPECT_LT(opened.lambda[0], 0.99 * whole.lambda[0]);
  for (const auto& order : {force1 + force2, length1 + force2, force1 + length2}) {
    const auto found = pairWith(order), pulled = pairWith(order + apart);
    for (int i = 0; i < 8; ++i) {
      EXPECT_NEAR(found.lambda[i] / whole.lambda[i], 1, 1e-9) << order << i;
      EXPECT_NEAR(pulled.lambda[i] / opened.lambda[i], 1, 1e-9) << order << i;
    }
    EXPECT_NEAR(found.tensions[0] / force, 1, exact);
    EXPECT_NEAR(found.tensions[1] / force, 1, exact);
  }
}

}  // namespace
}  // namespace squeal::test::bolted
