// SPDX-License-Identifier: BSD-2-Clause
// Contact between surfaces that are meshed apart: the constant-pressure patch test through all
// stages up to steady sliding, and what is reported of the interface.
#include <gtest/gtest.h>

#include <cmath>

#include "model/contact/coupled.hpp"
#include "model/mesh/vector.hpp"
#include "steady/steady/steady.hpp"
#include "support/model/blocks_apart.hpp"
#include "support/model/contact_cases.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using mesh::Point;
using test::Block;
using test::largest;

/// Errors relative to the exact displacement, pressure and force.
struct PatchErrors {
  double displacement = 0, pressure = 0, force = 0, moment = 0;
};

/// Collective. Two unit blocks, the upper one pressed down by 0.01. Their sides are free, so that
/// the stress is uniaxial and the displacement is linear in each.
PatchErrors patchTest(const std::string& file, const Block& disc, const Block& pad,
                      const std::string& more = "") {
  const bool plane = std::count(test::planeCells.begin(), test::planeCells.end(), disc.cell) > 0;
  const std::string up = plane ? "y" : "z";
  std::string options = test::blocksApart(file, disc, pad);
  for (const std::string body : {"disc", "pad"}) {
    options += " -constraint_" + body + "_x0_clamped x";
    if (!plane) options += " -constraint_" + body + "_y0_clamped y";
  }
  test::setOptions(options + " -constraint_disc_low_clamped " + up +
                   " -constraint_pad_high_clamped " + up + " -constraint_pad_high_displacement " +
                   (plane ? "0,-0.01" : "0,0,-0.01") + " -flutter_friction 0 " + more);
  const auto model = test::buildModel();
  const mesh::Mesh& mesh = *model.mesh;
  EXPECT_FALSE(model.contact.interfaces.reports.at(0).matching);
  const std::vector<unsigned char> bonded(model.contact.interfaces.nodes.size(), 1);
  const contact::CoupledSystem system(model.bodies, model.contact, {bonded, {}});
  const steady::Problem problem(mesh, model.bodies, model.contact);
  const auto solution = problem.solve({}, system);
  EXPECT_TRUE(solution.converged) << solution.reason;
  EXPECT_EQ(solution.openNodes, 0);
  // E = 1 in both; plane strain has E / (1 − ν²) and ν / (1 − ν).
  const double nu = 0.3, strain = 0.01 / 2, lateral = plane ? nu / (1 - nu) : nu,
               pressure = strain * (plane ? 1 / (1 - nu * nu) : 1);
  PatchErrors errors;
  {
    const auto u = test::allEntries(solution.displacement);
    for (PetscInt i = 0; i < mesh.ownedNodes; ++i) {
      const Point& x = mesh.coordinates[i];
      const double height = x[plane ? 1 : 2];
      const Point exact =
          plane ? Point{lateral * strain * x[0], -strain * (1 + height), 0}
                : Point{lateral * strain * x[0], lateral * strain * x[1], -strain * (1 + height)};
      for (int d = 0; d < mesh.dimension; ++d)
        errors.displacement =
            std::max(errors.displacement,
                     std::abs(u[mesh.dimension * mesh.globalNode[i] + d] - exact[d]) / 0.01);
    }
  }
  for (const auto& state : solution.contact)
    errors.pressure = std::max(errors.pressure, std::abs(state.pressure / pressure - 1));
  const Point total = solution.resultants.at(0).normalForce;
  errors.force = std::abs(total[plane ? 1 : 2] / pressure - 1);
  // The forces of contact on both sides have no moment together, and that of the pad acts at the
  // middle of its face.
  OwnedVec forces = elasticity::nodalVector(mesh);
  check(MatMult(model.bodies.stiffness, solution.displacement, forces));
  const auto r = test::allEntries(forces);
  Point moment{};
  for (PetscInt i = 0; i < mesh.ownedNodes; ++i) {
    const Point& x = mesh.coordinates[i];
    if (std::abs(x[plane ? 1 : 2]) > 1e-9) continue;
    Point force{};
    force[plane ? 1 : 2] = r[mesh.dimension * mesh.globalNode[i] + mesh.dimension - 1];
    moment = mesh::plus(moment, mesh::cross(x, force));
  }
  check(MPI_Allreduce(MPI_IN_PLACE, moment.data(), 3, MPI_DOUBLE, MPI_SUM, mesh.comm));
  errors.moment = mesh::length(moment) / pressure;
  errors.displacement = largest(errors.displacement), errors.pressure = largest(errors.pressure);
  return errors;
}

PatchErrors worst;

void expectExact(const PatchErrors& errors) {
  EXPECT_LT(errors.displacement, 1e-12);
  EXPECT_LT(errors.pressure, 1e-12);
  EXPECT_LT(errors.force, 1e-12);
  EXPECT_LT(errors.moment, 1e-12);
  worst.displacement = std::max(worst.displacement, errors.displacement);
  worst.pressure = std::max(worst.pressure, errors.pressure);
  worst.force = std::max(worst.force, errors.force);
  worst.moment = std::max(worst.moment, errors.moment);
}

void printWorst() {
  test::print("errors at most: displacement %.1e, pressure %.1e, force %.1e, moment %.1e\n",
              worst.displacement, worst.pressure, worst.force, worst.moment);
  worst = {};
}

std::string fileOf(int disc, int pad) {
  return "patch_apart_" + std::to_string(disc) + "_" + std::to_string(pad) + ".msh";
}

// In space every pair of tri3, tri6, quad4, quad8 and quad9; distorted in the plane of contact.
TEST(PatchTest, UniformPressureOnAllPairsOfFaces) {
  for (const int disc : test::solidCells)
    for (const int pad : test::solidCells) {
      SCOPED_TRACE(testing::Message() << "disc " << disc << ", pad " << pad);
      expectExact(patchTest(fileOf(disc, pad), {disc, {3, 2, 1}, {0, 0, -1}, {1, 1, 0}},
                            {pad, {2, 3, 1}, {0, 0, 0}, {1, 1, 1}}));
    }
  printWorst();
}

TEST(PatchTest, UniformPressureOnAllPairsOfLines) {
  for (const int disc : test::planeCells)
    for (const int pad : test::planeCells) {
      SCOPED_TRACE(testing::Message() << "disc " << disc << ", pad " << pad);
      expectExact(patchTest(fileOf(disc, pad), {disc, {3, 1, 2}, {0, 0, -1}, {1, 1, 0}},
                            {pad, {4, 1, 2}, {0, 0, 0}, {1, 1, 1}}));
    }
  printWorst();
}

// tri6 and quad8 (or quad9) on one slave surface share edges, which have one α.
TEST(PatchTest, UniformPressureOnMixedFaces) {
  for (const auto& [first, second] :
       {std::pair(test::wedge15, test::hex20), std::pair(test::wedge18, test::hex27),
        std::pair(test::wedge6, test::hex8)})
    for (const char* slave : {"pad", "disc"})
      expectExact(patchTest(fileOf(first, second),
                            {second, {3, 3, 1}, {0, 0, -1}, {1, 1, 0}, 0.15, first},
                            {first, {4, 2, 1}, {0, 0, 0}, {1, 1, 1}, 0.15, second},
                            std::string("-contact_face_slave ") + slave));
  printWorst();
}

// Corners are moved by up to 0.3 of a cell, so that shape functions are far from polynomials in
// space.
TEST(PatchTest, UniformPressureOnStronglyDistortedFaces) {
  for (const int cell : {test::hex8, test::hex20, test::hex27})
    expectExact(patchTest(fileOf(cell, cell), {cell, {3, 4, 1}, {0, 0, -1}, {1, 1, 0}, 0.3},
                          {cell, {4, 3, 1}, {0, 0, 0}, {1, 1, 1}, 0.3}));
  printWorst();
}

// Faces in a ratio of 4 to 5 are at the threshold of the choice; the round-off of their lengths,
// which differs from one period to the next, must not choose.
TEST(Report, RoundOffDoesNotChooseTheSlave) {
  for (const std::string length : {"3", "3.1", "0.7", "0.0447009756885618", "1.9e3"}) {
    test::setCase("two_layers", "-mesh_set nx=5,nx_pad=4,ny_disc=2,ny_pad=2,Lx=" + length);
    EXPECT_EQ(test::buildModel().contact.interfaces.slaves.at(0).surface, "pad_face") << length;
  }
}

// Interfaces of different meshes are coupled; the report says what would have to match.
TEST(Report, SaysWhyMeshesDoNotMatch) {
  test::setCase("two_layers", test::contact_cases::layers + ",nx_pad=5");
  const auto model = test::buildModel();
  const auto& report = model.contact.interfaces.reports.at(0);
  EXPECT_FALSE(report.matching);
  EXPECT_TRUE(test::contains(report.whyNot, "pad_face") &&
              test::contains(report.whyNot, "disc_face"))
      << report.whyNot;
  EXPECT_NEAR(report.coveredArea, 3, 1e-12);
  EXPECT_NEAR(report.largestGap, 0, 1e-12);
  EXPECT_EQ(report.slave.faces + report.master.faces, 11);
  EXPECT_EQ(report.slave.faces, 5);  // the pad: the disc is not finer by a fifth
  EXPECT_EQ(report.nodes, 5);        // 6, of which one is the image of another
  test::setCase("two_layers", test::contact_cases::layers + ",nx_pad=4");
  const auto finer = test::buildModel();
  EXPECT_EQ(finer.contact.interfaces.reports.at(0).slave.faces, 6);  // the disc
  EXPECT_EQ(finer.contact.interfaces.slaves.at(0).sign, -1);
  test::setCase("two_layers", test::contact_cases::layers);
  EXPECT_TRUE(test::buildModel().contact.interfaces.reports.at(0).matching);
}

}  // namespace
}  // namespace squeal
