// SPDX-License-Identifier: BSD-2-Clause
// Bodies that are tied although their meshes do not match, against one body of the same shape, and
// what the roles of interfaces have in common.
#include <gtest/gtest.h>

#include <cmath>

#include "eigen/modes/modes.hpp"
#include "model/contact/coupled.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/harness/messages.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

/// Two layers of one material, held at the bottom and periodic along x.
std::string layers(const std::string& mesh) {
  return "-mesh_file meshes/two_layers.geo -mesh_set " + mesh + material("disc", "1", "0.3", "1") +
         material("pad", "1", "0.3", "1") +
         "-constraint_disc_bottom_clamped xy -constraint_disc_right_image_of disc_left "
         "-constraint_pad_right_image_of pad_left -modes_count 12 -elasticity_mass consistent ";
}
const std::string tie = "-tie_layers_slave pad_face -tie_layers_master disc_face ",
                  tieOfDisc = "-tie_layers_slave disc_face -tie_layers_master pad_face ";

std::vector<Complex> frequencies(const std::string& options) {
  setOptions(options);
  const Model model = buildModel();
  const contact::CoupledSystem system(
      model.bodies, model.contact,
      contact::ActiveSet::bonded(model.contact.interfaces.nodes.size()));
  return eigenvaluesOf(modes::compute(system, modes::Settings::given()));
}

/// One body, finely meshed: the layers share their nodes.
const std::vector<Complex>& reference() {
  static const std::vector<Complex> found =
      frequencies(layers("order=2,shared=1,nx=72,ny_disc=24,ny_pad=15"));
  return found;
}

void expectOrder(double least, const std::string& coarse, const std::string& fine,
                 const std::string& ties) {
  const auto before = errors(reference(), frequencies(layers(coarse) + ties)).relative,
             after = errors(reference(), frequencies(layers(fine) + ties)).relative;
  const double order = std::log2(rootMeanSquare(before) / rootMeanSquare(after));
  print("%s: errors up to %.1e and %.1e, order %.2f\n", coarse.c_str(), worst(before), worst(after),
        order);
  EXPECT_GT(order, least);
}

// Cells 2:3 on both sides, the slave finer and coarser than the master.
TEST(Ties, FrequenciesConvergeWithTheOrderOfTheElements) {
  for (const auto& ties : {tie, tieOfDisc}) {
    expectOrder(1.9, "nx=16,nx_pad=24,ny_disc=6,ny_pad=5", "nx=32,nx_pad=48,ny_disc=12,ny_pad=10",
                ties);
    expectOrder(3.5, "order=2,nx=8,nx_pad=12,ny_disc=4,ny_pad=3",
                "order=2,nx=16,nx_pad=24,ny_disc=8,ny_pad=6", ties);
  }
}

// Node on node, a tie is the same as shared nodes.
TEST(Ties, MatchingMeshesAreOneBody) {
  const std::string mesh = "nx=12,ny_disc=4,ny_pad=3";
  const auto tied = frequencies(layers(mesh) + tie),
             shared = frequencies(layers(mesh + ",shared=1"));
  EXPECT_LT(worst(errors(shared, tied).relative), 1e-9);  // the tolerance of the modes, squared
}

// Slaves that are held in one component stay tied in the other, and what is held is carried to the
// master: at the ends of the tie, and all along it. If either were lost, the frequencies would
// converge with the first order, or not to those of one body.
TEST(Ties, HeldComponentsOfSlavesAreCarried) {
  const auto held = [](const std::string& mesh, const std::vector<std::string>& groups) {
    std::string options = "-mesh_file meshes/two_layers.geo -mesh_set " + mesh +
                          material("disc", "1", "0.3", "1") + material("pad", "1", "0.3", "1") +
                          "-constraint_disc_bottom_clamped xy -modes_count 8 "
                          "-elasticity_mass consistent ";
    for (const auto& group : groups) options += "-constraint_" + group + "_clamped x ";
    return options;
  };
  const std::string role =
      "-contact_layers_pad pad_face -contact_layers_disc disc_face -contact_layers_role tied ";
  const std::vector<std::string> sides{"disc_left", "disc_right", "pad_left", "pad_right"};
  std::vector<std::string> all = sides;
  all.push_back("pad_face");
  for (const auto& groups : {sides, all}) {
    const auto one = frequencies(held("order=2,shared=1,nx=48,ny_disc=16,ny_pad=10", groups));
    for (const auto& ties : {tie, tieOfDisc, role}) {
      const auto error = [&](const std::string& mesh) {
        return rootMeanSquare(errors(one, frequencies(held(mesh, groups) + ties)).relative);
      };
      const double coarse = error("nx=16,nx_pad=24,ny_disc=6,ny_pad=5"),
                   fine = error("nx=32,nx_pad=48,ny_disc=12,ny_pad=10");
      print("held %s, %s: errors %.1e and %.1e, order %.2f\n", groups.back().c_str(), ties.c_str(),
            coarse, fine, std::log2(coarse / fine));
      EXPECT_GT(std::log2(coarse / fine), 1.9);
    }
  }
}

// The lowest node of the pad's side, 1/10 of its area, follows from the master of a tie whose
// meshes do not match. As the master it has its gap.
TEST(Ties, GapsThatATieTakesAreToldWithTheirArea) {
  const std::string wall =
      "-contact_wall_pad pad_left -contact_wall_obstacle_velocity 0,1,0 "
      "-contact_wall_obstacle_displacement 1e-3,0,0 ";
  const auto warning = [&](const std::string& ties) {
    setOptions("-mesh_file meshes/two_layers.geo -mesh_set nx=16,nx_pad=24,ny_disc=6,ny_pad=5" +
               material("disc", "1", "0.3", "1") + material("pad", "1", "0.3", "1") +
               "-constraint_disc_bottom_clamped xy " + wall + ties);
    return warningsOf([] { buildModel(); });
  };
  const std::string found = warning(tie);
  for (const char* part :
       {"warning: interface 'wall': 1 nodes of 'pad_left', ", "follow from tie 'layers'",
        "have no gap here", "exchange its slave and master"})
    EXPECT_NE(found.find(part), std::string::npos) << found;
  EXPECT_EQ(warning(tieOfDisc), "");
}

// A rigid motion of both bodies satisfies the tie, so that it stores no energy. The bodies rest on
// springs: a body that nothing holds is an error.
TEST(Ties, RigidMotionsAreFree) {
  for (const std::string element : {"order=1", "order=2", "order=2,serendipity=1"}) {
    setOptions(
        "-mesh_file meshes/two_slabs.geo -mesh_set nx=4,nx_pad=5,ny_disc=2,ny_pad=2,nz=2,"
        "nz_pad=3,depth=1," +
        element + material("disc", "1", "0.3", "1") + material("pad", "1", "0.3", "1") +
        "-ground_disc_bottom_stiffness 1,1,1 " + tie);
    const Model model = buildModel();
    const contact::Transformation t = model.contact.transformation({});
    const OwnedVec turned = nodalField(*model.mesh, [](const mesh::Point& x) {
      return mesh::Point{0.3 - 0.7 * x[1] + 0.2 * x[2], 0.1 + 0.7 * x[0] - 0.5 * x[2],
                         -0.4 - 0.2 * x[0] + 0.5 * x[1]};
    });
    OwnedVec x, u = elasticity::nodalVector(*model.mesh);
    check(MatCreateVecs(t.trial, x.out(), nullptr));
    check(MatMultTranspose(t.selection, turned, x));  // all but the slaves
    check(MatMult(t.trial, x, u));
    check(VecAXPY(u, -1, turned));
    PetscReal difference = 0;
    check(VecNorm(u, NORM_INFINITY, &difference));
    print("%s: %d tied nodes, a rigid motion is met to %.1e\n", element.c_str(),
          int(total(double(model.contact.interfaces.tied.size()))), double(difference));
    EXPECT_LT(difference, 1e-12);  // rounding: nodes are moved onto the master
  }
}

// Slaves that rest on each other.
TEST(Ties, CirclesAreErrors) {
  for (const std::string mesh : {"nx=4,ny_disc=2,ny_pad=2", "nx=4,nx_pad=6,ny_disc=2,ny_pad=2"}) {
    setOptions(layers(mesh) +
               "-tie_up_slave pad_face -tie_up_master disc_face -tie_down_slave disc_face "
               "-tie_down_master pad_face");
    const std::string message = errorOf([] { buildModel(); });
    // Where nodes match, the second tie says nothing new.
    const bool matching = mesh.find("nx_pad") == std::string::npos;
    EXPECT_TRUE(contains(message, matching ? "nodes are already tied by tie '"
                                           : "depend on each other in a circle") &&
                contains(message, "tie 'down'") && contains(message, "tie 'up'"))
        << message;
  }
}

std::vector<Complex> spectrum(const std::string& options) {
  const analysis::Analysis analysis =
      runCase("two_layers",
              "-mesh_set nx=12,nx_pad=18,ny_disc=4,ny_pad=4 -flutter_method direct "
              "-flutter_direct_count 20 " +
                  options);
  return eigenvaluesOf(analysis.flutter.segments.at(0).points.at(0));
}

// Closed contact that sticks is a tie; without friction it is sliding at f = 0; a factor is one on
// f.
TEST(Roles, AgreeWhereTheyMust) {
  const std::string role = "-contact_interface_role ";
  const auto sticking = spectrum(role + "sticking -flutter_friction 0.4"),
             tied = spectrum(role + "tied -flutter_friction 0.4"),
             smooth = spectrum(role + "frictionless -flutter_friction 0.4"),
             none = spectrum("-flutter_friction 0"),
             half = spectrum("-contact_interface_friction_factor 0.5 -flutter_friction 0.6"),
             less = spectrum("-flutter_friction 0.3");
  EXPECT_LT(worst(errors(tied, sticking).relative), 1e-9);
  EXPECT_LT(worst(errors(none, smooth).relative), 1e-9);
  EXPECT_LT(worst(errors(less, half).relative), 1e-9);
  EXPECT_GT(worst(errors(none, tied).relative), 1e-2);
  EXPECT_GT(worst(errors(none, less).relative), 1e-3);
}

}  // namespace
}  // namespace squeal::test
