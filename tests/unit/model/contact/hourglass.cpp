// SPDX-License-Identifier: BSD-2-Clause
// Hourglass modes of reduced integration: bodies whose supports and neighbours leave one are
// refused. Reference: the null space of the dense stiffness without the supported components.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/system/mpi.hpp"
#include "model/contact/hourglass.hpp"
#include "support/algebra/symmetric.hpp"
#include "support/harness/messages.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

std::string row(const std::string& set, const std::string& supports) {
  return "-mesh_file meshes/beam.geo -mesh_set order=2,serendipity=1,Lx=2,Ly=0.7,Lz=0.5," + set +
         test::material("beam", "2", "0.3", "1") + "-material_beam_integration reduced " + supports;
}

using Supports = std::vector<std::pair<std::string, std::string>>;  // group, components

/// Collective. Returns the number of motions without energy that these supports leave.
int nullMotions(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                const Supports& supports) {
  const auto k = test::denseCopy(bodies.stiffness);
  std::vector<char> held(k.rows(), 0);
  for (const auto& [group, components] : supports)
    for (const PetscInt node : mesh.nodeGroups.at(group))
      for (const char c : components) held[3 * (mesh.firstNode + node) + (c - 'x')] = 1;
  mpi::reduce<char>(mesh.comm, held, MPI_MAX);
  std::vector<PetscInt> free;
  for (PetscInt i = 0; i < k.rows(); ++i)
    if (!held[i]) free.push_back(i);
  linalg::DenseMatrix part(std::ssize(free), std::ssize(free));
  for (PetscInt i = 0; i < part.rows(); ++i)
    for (PetscInt j = 0; j < part.rows(); ++j) part(i, j) = k(free[i], free[j]);
  const auto values = linalg::symmetricEigenvalues(part);
  return std::ranges::count_if(values, [&](double x) { return x < 1e-12 * values.back(); });
}

/// Collective. Compares the message with the dense stiffness, and returns the number of modes.
int checkedModes(const std::string& set, const Supports& supports) {
  std::string text;
  for (const auto& [group, components] : supports)
    text += "-constraint_" + group + "_clamped " + components + " ";
  SCOPED_TRACE(set + " " + text);
  test::setOptions(row(set, text));
  auto mesh = test::readMesh();
  auto ties = test::findTies(mesh);
  auto bodies = test::assembleBodies(mesh);
  const int count = nullMotions(mesh, bodies, supports);
  const auto message =
      test::errorOf([&] { test::assembleContact(mesh, std::move(bodies), std::move(ties)); });
  if (count == 0)
    EXPECT_EQ(message, "");
  else
    test::expectMessage(message, {"singular problem: body 'beam' has " +
                                      (count == 1 ? std::string("an hourglass mode ")
                                                  : std::to_string(count) + " hourglass modes "),
                                  "-material_beam_integration full"});
  return count;
}

TEST(Hourglass, ModesAreThoseOfTheStiffness) {
  std::vector<std::string> sets{"nx=2,ny=1,nz=1", "nx=4,ny=1,nz=1", "nx=1,ny=3,nz=1",
                                "nx=3,ny=2,nz=1"};
  if (mpi::size(PETSC_COMM_WORLD) == 1) sets.push_back("nx=1,ny=1,nz=1");
  int refused = 0, accepted = 0;
  for (const auto& set : sets)
    for (const Supports& supports : {Supports{{"clamped", "xyz"}},
                                     {{"bottom", "xyz"}},
                                     {{"left", "xyz"}},
                                     {{"clamped", "xyz"}, {"tip", "xyz"}},
                                     {{"clamped", "x"}, {"left", "y"}, {"bottom", "z"}},
                                     {{"clamped", "xy"}, {"top", "yz"}}})
      ++(checkedModes(set, supports) > 0 ? refused : accepted);
  EXPECT_GE(refused, 5);
  EXPECT_GE(accepted, 10);
}

// Contact and springs are supports as well: on a rigid obstacle, a surface is held across.
TEST(Hourglass, ContactAndSpringsHoldThem) {
  const auto message = [](const std::string& supports) {
    test::setOptions(row("nx=3,ny=1,nz=1", supports));
    return test::errorOf([] { test::buildModel(); });
  };
  const std::string face = "-constraint_clamped_clamped ";
  test::expectMessage(message(face + "xyz"), {"3 hourglass modes"});
  EXPECT_EQ(message(face + "xyz -ground_bottom_stiffness 1,1,1"), "");
  for (const std::string more : {"", " -constraint_tip_clamped xy"})
    EXPECT_EQ(message(face +
                      "xy -contact_plate_pad bottom -contact_plate_role frictionless "
                      "-contact_plate_obstacle_velocity 0,0,0" +
                      more),
              message(face + "xy -constraint_bottom_clamped z" + more));
}

/// Returns "3 hourglass modes" of a message, "an hourglass mode", or nothing.
std::string countIn(const std::string& message) {
  const auto at = message.find(" has ");
  if (at == std::string::npos) return "";
  return message.substr(at + 5, message.find(" without") - at - 5);
}

// Where nodes of the contact are open, it holds nothing: the modes are those without contact.
TEST(Hourglass, OpenContactDoesNotHoldThem) {
  const std::string plate =
      " -contact_plate_pad bottom -contact_plate_role frictionless "
      "-contact_plate_obstacle_velocity 0,0,0";
  int freed = 0;
  for (const std::string supports :
       {"-ground_clamped_stiffness 1,1,1 -ground_tip_stiffness 1,0,0",
        "-ground_clamped_stiffness 1,1,1", "-ground_left_stiffness 1,1,1",
        "-ground_clamped_stiffness 1,1,1 -ground_tip_stiffness 1,1,1"}) {
    SCOPED_TRACE(supports);
    test::setOptions(row("nx=3,ny=1,nz=1", supports));
    const auto without = test::errorOf([] { test::buildModel(); });
    test::setOptions(row("nx=3,ny=1,nz=1", supports + plate));
    const auto [mesh, bodies, contact] = test::buildModel();  // closed: none
    const contact::Mask open(contact.interfaces.nodes.size(), 0);
    const auto found = contact::hourglassModes(*mesh, contact, bodies, {.closed = open});
    EXPECT_EQ(countIn(found), countIn(without));
    freed += !found.empty();
    EXPECT_EQ(test::contains(found, "open and sliding nodes"), !found.empty());
  }
  EXPECT_GE(freed, 1);
}

// Each cell of a row has one mode, also those beyond the first hundred.
TEST(Hourglass, OfManyCells) {
  test::setOptions(row("nx=150,ny=1,nz=1", "-constraint_clamped_clamped xyz"));
  EXPECT_EQ(countIn(test::errorOf([] { test::buildModel(); })), "150 hourglass modes");
}

// A tie holds as shared nodes do. A column of two cells on a clamped face has two modes, a single
// cell one, and a row of cells along its side none.
TEST(Hourglass, TiedCellsAreNeighbours) {
  const auto message = [](const std::string& set, const std::string& reduced) {
    std::string options =
        "-mesh_file meshes/two_slabs.geo -mesh_set order=2,serendipity=1,depth=1,"
        "ny_disc=1,ny_pad=1,nz=1," +
        set + test::material("disc", "2", "0.3", "1") + test::material("pad", "3", "0.2", "1") +
        "-constraint_disc_bottom_clamped xyz -contact_joint_pad pad_face "
        "-contact_joint_disc disc_face -contact_joint_role tied ";
    if (reduced != "disc") options += "-material_pad_integration reduced ";
    if (reduced != "pad") options += "-material_disc_integration reduced ";
    test::setOptions(options);
    return test::errorOf([] { test::buildModel(); });
  };
  test::expectMessage(message("nx=1", "both"), {"has 2 hourglass modes"});
  test::expectMessage(message("nx=1", "pad"), {"body 'pad' has an hourglass mode"});
  test::expectMessage(message("nx=2,nx_pad=1", "pad"), {"body 'pad' has an hourglass mode"});
  EXPECT_EQ(message("nx=3", "pad"), "");
  EXPECT_EQ(message("nx=3", "both"), "");
  EXPECT_EQ(message("nx=2,nx_pad=3", "both"), "");
}

}  // namespace
}  // namespace squeal
