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

namespace squeal {
namespace {

/// Bars of length 1 along z with Poisson's ratio 0, so that they are springs: the bolt with the
/// area 1, cut by `section` at its middle, and the sleeve with the area 2, of two halves that touch
/// there.
const char* const column = R"(
Geometry.AutoCoherence = 0;  // the halves of the sleeve touch, they are not joined
Macro Column  // x0, w, z0, h -> s (bottom), top, volume
  p = newp;
  Point(p) = {x0, 0, z0}; Point(p+1) = {x0+w, 0, z0};
  Point(p+2) = {x0+w, 1, z0}; Point(p+3) = {x0, 1, z0};
  l = newl;
  Line(l) = {p, p+1}; Line(l+1) = {p+1, p+2}; Line(l+2) = {p+2, p+3}; Line(l+3) = {p+3, p};
  Transfinite Curve{l:l+3} = 3;
  k = newll; Curve Loop(k) = {l:l+3};
  s = news; Plane Surface(s) = {k}; Transfinite Surface{s}; Recombine Surface{s};
  e[] = Extrude{0, 0, h}{ Surface{s}; Layers{2}; Recombine; };
  top = e[0]; volume = e[1];
Return
)";

/// @ begins the names of the assembly.
const char* const columns = R"(
x0 = X; w = 1; z0 = 0; h = 0.5; Call Column;
bottom = s; middle = top; lower = volume;
e[] = Extrude{0, 0, 0.5}{ Surface{middle}; Layers{2}; Recombine; };
Physical Surface("@bolt_low") = {bottom};
Physical Surface("@bolt_high") = {e[0]};
Physical Surface("@section") = {middle};
Physical Volume("@bolt") = {lower, e[1]};
x0 = X + 3; w = 2; z0 = 0; h = 0.5; Call Column;
Physical Surface("@sleeve_low") = {s};
Physical Surface("@joint_low") = {top};
Physical Volume("@sleeve_a") = {volume};
z0 = 0.5; Call Column;
Physical Surface("@joint_high") = {s};
Physical Surface("@sleeve_high") = {top};
Physical Volume("@sleeve_b") = {volume};
)";

constexpr double boltStiffness = 2e9, sleeveStiffness = 4e9, force = 3e4;

/// Returns the text with a beginning of all names in place of @.
std::string named(std::string text, const std::string& beginning) {
  for (std::size_t at = 0; (at = text.find('@', at)) != std::string::npos; at += beginning.size())
    text.replace(at, 1, beginning);
  return text;
}

/// Returns the geometry of an assembly at X, with this beginning of names.
std::string geometryAt(int x, const std::string& beginning) {
  return formatted("X = %d;", x) + named(columns, beginning);
}

const std::string geometry = column + geometryAt(0, "");

/// Returns the options of an assembly. The plates are reference nodes: `low` is held, `high` moves
/// along z.
std::string optionsOf(const std::string& beginning) {
  std::string options;
  for (const std::string body : {"bolt", "sleeve_a", "sleeve_b"})
    options += test::material(beginning + body, "2e9", "0", "1000");
  return options + named(
                       "-reference_@low_position 1,0.5,0 -coupling_@low_reference @low "
                       "-coupling_@low_nodes @bolt_low,@sleeve_low -constraint_@low_clamped xyz "
                       "-constraint_@low_clamped_rotation xyz "
                       "-reference_@high_position 1,0.5,1 -coupling_@high_reference @high "
                       "-coupling_@high_nodes @bolt_high,@sleeve_high "
                       "-constraint_@high_clamped xy -constraint_@high_clamped_rotation xyz "
                       "-contact_@joint_pad @joint_high -contact_@joint_disc @joint_low "
                       "-contact_@joint_role frictionless -bolt_@b_section @section ",
                       beginning);
}

/// Collective. Returns the options of one assembly with its mesh.
std::string assembly() {
  return "-mesh_file " + test::writeFile("bolt.geo", geometry) + optionsOf("");
}

/// A column on the sleeve that only its contact holds along z.
const char* const rider = R"(
x0 = 3; w = 2; z0 = 1; h = 0.5; Call Column;
Physical Surface("rider_low") = {s};
Physical Surface("rider_high") = {top};
Physical Volume("rider") = {volume};
)";

/// Collective. Returns the model of the options in force with tightened bolts.
analysis::Model tightenedModel() {
  const auto settings = analysis::ModelSettings::given();
  auto model = analysis::buildModel(PETSC_COMM_WORLD, settings);
  analysis::requireSupports(model);
  analysis::tightenBolts(model, settings.constraints);
  return model;
}

/// The state of the assembly under an external force that draws the plates apart.
struct State {
  double bolt = 0;   ///< tension, N
  double joint = 0;  ///< normal force of the joint, N
  PetscInt open = 0;
};

/// Collective. Returns the state with these options.
State stateWith(const std::string& options) {
  test::setOptions(assembly() + options);
  const auto model = tightenedModel();
  const steady::Problem problem(*model.mesh, model.bodies, model.contact);
  const contact::CoupledSystem system(model.bodies, model.contact, model.bonded());
  const auto solution = problem.solve({.friction = 0}, system);
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
  test::setOptions(assembly() + formatted("-bolt_b_force %.17g ", force) + pulled(1e4));
  const auto model = tightenedModel();
  const steady::Problem problem(*model.mesh, model.bodies, model.contact);
  const contact::CoupledSystem system(model.bodies, model.contact, model.bonded());
  const auto solution = problem.solve({.friction = 0}, system);
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
  const std::string file = test::writeFile("rider.geo", geometry + rider);
  const double pressure = 5e3, area = 2, pressed = pressure * area,
               share = boltStiffness / (boltStiffness + sleeveStiffness);
  const std::string options = formatted("-load_rider_high_pressure %.17g ", pressure) +
                              "-mesh_file " + file + test::material("rider", "2e9", "0", "1000") +
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
  const std::string failure = test::errorOf([&] { stateWith(options + tightened); });
  EXPECT_TRUE(test::contains(failure, "the step that tightens the bolts has no solution"))
      << failure;
  EXPECT_TRUE(test::contains(failure, "give -bolt_under_pressure on")) << failure;
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
  test::setOptions(assembly() + formatted("-bolt_b_force %.17g ", force) + pulled(3000));
  const auto model = tightenedModel();
  const steady::Problem problem(*model.mesh, model.bodies, model.contact);
  const contact::CoupledSystem system(model.bodies, model.contact, model.bonded());
  for (const double pressure : {0.0, 2.0}) {
    const auto solution = problem.solve({.friction = 0, .pressure = pressure}, system);
    EXPECT_NEAR(analysis::boltForces(model, solution).at(0) / (force + pressure * 1000), 1, exact);
  }
}

TEST(Bolts, FrequenciesAreThoseOfTheUncutBody) {
  const auto lambda = [](const std::string& options) {
    test::setOptions(options + "-modes_count 4");
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
  test::setOptions("-mesh_file " + test::writeFile("bolts.geo", geometry + geometryAt(9, "a_")) +
                   optionsOf("") + optionsOf("a_") + options + "-modes_count 8");
  const auto model = tightenedModel();
  const steady::Problem problem(*model.mesh, model.bodies, model.contact);
  const contact::CoupledSystem bonded(model.bodies, model.contact, model.bonded());
  const auto solution = problem.solve({.friction = 0}, bonded);
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

TEST(Bolts, SectionMustCutThroughItsBody) {
  // A bar of 2 × 1 cells in two layers, with a section below one of the two cells above it.
  const std::string file = test::writeFile("notch.geo", R"(
Point(1) = {0, 0, 0}; Point(2) = {0, 1, 0}; Line(1) = {1, 2}; Transfinite Curve{1} = 2;
a[] = Extrude{1, 0, 0}{ Line{1}; Layers{1}; Recombine; };
b[] = Extrude{1, 0, 0}{ Line{a[0]}; Layers{1}; Recombine; };
c[] = Extrude{0, 0, 1}{ Surface{a[1]}; Layers{1}; Recombine; };
d[] = Extrude{0, 0, 1}{ Surface{b[1]}; Layers{1}; Recombine; };
e[] = Extrude{0, 0, 1}{ Surface{c[0]}; Layers{1}; Recombine; };
f[] = Extrude{0, 0, 1}{ Surface{d[0]}; Layers{1}; Recombine; };
Physical Volume("bolt") = {c[1], d[1], e[1], f[1]};
Physical Surface("low") = {a[1], b[1]};
Physical Surface("notch") = {c[0]};
Physical Surface("section") = {c[0], d[0]};
)");
  const auto message = [&](const std::string& section) {
    test::setOptions("-mesh_file " + file + test::material("bolt", "1e9", "0.3", "1000") +
                     "-constraint_low_clamped xyz -bolt_b_force 1 -bolt_b_section " + section);
    return test::errorOf([] { tightenedModel(); });
  };
  EXPECT_NE(message("notch").find("option -bolt_b_section notch: the section does not cut through "
                                  "its body: cells on both sides of it share the node at"),
            std::string::npos)
      << message("notch");
  // Cut through, the upper half is loose: nothing holds the bolt against its force.
  EXPECT_NE(message("section").find("body 'bolt' can move rigidly"), std::string::npos)
      << message("section");
  EXPECT_NE(message("section").find("as the section of bolt 'b' opens, so the part of the body on "
                                    "one side of it is loose"),
            std::string::npos)
      << message("section");
}

// A bar of three cells, clamped at its ends: the part between two sections is loose.
TEST(Bolts, InSeriesAreNamed) {
  test::setOptions("-mesh_file " + test::writeFile("series.geo", R"(
Point(1) = {0, 0, 0}; Point(2) = {0, 1, 0}; Line(1) = {1, 2}; Transfinite Curve{1} = 2;
a[] = Extrude{1, 0, 0}{ Line{1}; Layers{1}; Recombine; };
b[] = Extrude{0, 0, 1}{ Surface{a[1]}; Layers{1}; Recombine; };
c[] = Extrude{0, 0, 1}{ Surface{b[0]}; Layers{1}; Recombine; };
d[] = Extrude{0, 0, 1}{ Surface{c[0]}; Layers{1}; Recombine; };
Physical Volume("bolt") = {b[1], c[1], d[1]};
Physical Surface("low") = {a[1]};
Physical Surface("high") = {d[0]};
Physical Surface("one") = {b[0]};
Physical Surface("two") = {c[0]};
)") + test::material("bolt", "1e9", "0.3", "1000") +
                   "-constraint_low_clamped xyz -constraint_high_clamped xyz -bolt_b_section one "
                   "-bolt_b_force 1 -bolt_c_section two -bolt_c_force 1");
  const std::string found = test::errorOf([] { tightenedModel(); });
  EXPECT_TRUE(test::contains(found, "body 'bolt' can move rigidly")) << found;
  EXPECT_TRUE(test::contains(found,
                             "as the sections of bolts 'b' and 'c' open, so the parts between "
                             "or beyond them are loose"))
      << found;
}

// The bolt is 1 m long: a tenth of it is the limit of small strains.
TEST(Bolts, LargeShorteningIsReported) {
  const auto warnings = [](const std::string& options) {
    test::setOptions(assembly() + options);
    return test::warningsOf([] { tightenedModel(); });
  };
  EXPECT_EQ(warnings("-bolt_b_shortening 0.099"), "");
  const std::string given = warnings("-bolt_b_shortening 0.2"),
                    found = warnings(formatted("-bolt_b_force %g", 0.3 * boltStiffness));
  EXPECT_TRUE(test::contains(given,
                             "bolt 'b' becomes 0.2 m shorter, 0.2 times the length of its "
                             "body 'bolt' along it, 1 m"))
      << given;
  EXPECT_TRUE(test::contains(given, "-bolt_b_shortening")) << given;
  // The bolt and the sleeve are springs: F (1/k_b + 1/k_s), k_s = 2 k_b, gives 0.45 m.
  EXPECT_TRUE(test::contains(found, "bolt 'b' becomes 0.45 m shorter")) << found;
  EXPECT_TRUE(test::contains(found, "-bolt_b_force")) << found;
}

TEST(Bolts, FaultsAreNamed) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"-bolt_b_shortening 1 -bolt_under_pressure on",
       "option -bolt_under_pressure needs -bolt_<name>_force"},
      {"", "option -bolt_b_section: give either -bolt_b_force or -bolt_b_shortening"},
      {"-bolt_b_force 1 -bolt_b_shortening 1",
       "option -bolt_b_section: give either -bolt_b_force or -bolt_b_shortening"},
      {"-bolt_b_force 1 -bolt_c_force 1", "option -bolt_c_force needs -bolt_c_section"},
      {"-bolt_b_force 1 -bolt_c_force 1 -bolt_c_section nothing",
       "option -bolt_c_section nothing names group 'nothing', which is not in the mesh"},
      {"-bolt_b_force 1 -bolt_c_force 1 -bolt_c_section bolt_low",
       "option -bolt_c_section bolt_low: a face of the section has 0 cells of a body below and 1 "
       "above"},
      {"-bolt_b_force 1 -bolt_c_force 1 -bolt_c_section bolt",
       "group 'bolt' has dimension 3; a boundary of dimension 2 is wanted"},
      {"-bolt_b_force 1 -bolt_b_axis 0,0,0", "option -bolt_b_axis: must not be zero"},
      {"-bolt_b_force 1 -bolt_b_axis 1,0,0.05",
       "option -bolt_b_axis: the axis lies across the normal of the section, (0, 0, 1)"},
      {"-bolt_b_force 1 -bolt_c_force 1 -bolt_c_section section",
       "option -bolt_c_section section: the bolt 'b' has this section already"},
  };
  for (const auto& [options, message] : faults) {
    const std::string found = test::errorOf([&, &text = options] {
      test::setOptions(assembly() + text);
      tightenedModel();
    });
    EXPECT_NE(found.find(message), std::string::npos) << options << "\n  " << found;
  }
}

// The nodes of a section are doubled: for other options its group would mean its lower side.
TEST(Bolts, OnlyTheBoltUsesItsSection) {
  const std::string rule = "(-bolt_b_section section), whose nodes are doubled";
  for (const std::string option :
       {"-constraint_section_clamped z", "-load_section_pressure 1", "-load_section_force 0,0,1",
        "-ground_section_stiffness 0,0,1", "-mass_section_total 1",
        "-contact_c_pad section -contact_c_disc sleeve_low",
        "-tie_t_slave sleeve_high -tie_t_master section"}) {
    const std::string found = test::errorOf([&] {
      test::setOptions(assembly() + "-bolt_b_force 1 " + option);
      tightenedModel();
    });
    EXPECT_TRUE(test::contains(found, "group 'section' is the section of the bolt 'b' " + rule))
        << option << ": " << found;
    EXPECT_TRUE(test::contains(found, "option " + option.substr(0, option.find('_')))) << found;
  }
  // The same faces under another name.
  std::string again = geometry;
  again.insert(again.find("Physical Volume"), "Physical Surface(\"copy\") = {middle};\n");
  const auto message = [&](const std::string& options) {
    return test::errorOf([&] {
      test::setOptions("-mesh_file " + test::writeFile("copy.geo", again) + optionsOf("") +
                       "-bolt_b_force 1 " + options);
      tightenedModel();
    });
  };
  EXPECT_TRUE(test::contains(message("-constraint_copy_clamped z"),
                             "option -constraint_copy_clamped: group 'copy' has a face of the "
                             "section of the bolt 'b' " +
                                 rule));
  // A position means both sides.
  EXPECT_EQ(message("-reference_r_centre_of copy -coupling_c_reference high -coupling_c_nodes r"),
            "");
}

}  // namespace
}  // namespace squeal
