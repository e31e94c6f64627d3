// SPDX-License-Identifier: BSD-2-Clause
// The change of variables that carries contact: kinematics T and friction E.
#include <gtest/gtest.h>

#include <cmath>

#include "support/algebra/sparse.hpp"
#include "support/harness/largest_error.hpp"
#include "support/model/contact_cases.hpp"
#include "support/model/coupled_contact.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

using mesh::Point;
using test::at;
using test::Coupled;
using test::coupled;
using test::frictionTest;
using test::product;
using test::randomEntries;
using test::contact_cases::ballInShell;
using test::contact_cases::setCylinders;
using test::contact_cases::setLayers;

// n·u_P = n·u_D + g at every pad node, whatever the unknowns are, with g = E h on tri6 faces.
void gapIsTheUnknown(const Coupled& c) {
  ASSERT_GT(c.nodes.size(), 0u);
  const auto x = randomEntries(c.transformation.columns, 7), u = product(c.transformation.trial, x);
  std::vector<double> unknown;
  for (const PetscInt column : c.transformation.gapColumn) {
    ASSERT_GE(column, 0);
    unknown.push_back(x[column]);
  }
  const auto gap = c.model.contact.nodalGap(unknown);
  for (std::size_t i = 0; i < gap.size(); ++i) {
    const auto& node = c.model.contact.interfaces.nodes[i];
    Point jump = at(u, node.globalNode, c.dimension());
    if (node.master >= 0) jump = test::minus(jump, at(u, node.master, c.dimension()));
    EXPECT_NEAR(test::dot(node.normal, jump), gap[i], 1e-14);
  }
  // Every column counts: TᵀT of a change of variables is regular.
  OwnedMat gram;
  check(MatTransposeMatMult(c.transformation.trial, c.transformation.trial, MAT_INITIAL_MATRIX,
                            PETSC_DEFAULT, gram.out()));
  for (double diagonal : [&] {
         OwnedVec d;
         check(MatCreateVecs(gram, d.out(), nullptr));
         check(MatGetDiagonal(gram, d));
         return test::allEntries(d);
       }())
    EXPECT_GT(diagonal, 0.6 * 0.6 - 1e-12);  // (1 − 2α)² for the gap of a middle node of a tri6
}

TEST(Trial, GapIsTheUnknownOnLayers) {
  setLayers();
  const auto c = coupled();
  EXPECT_EQ(c.nodes.size(), 6u);
  // Unknowns: 2 · 6 · 4 disc nodes less 12 held, 2 · 6 · 3 pad nodes less 12 held.
  EXPECT_EQ(c.transformation.columns, 60);
  gapIsTheUnknown(c);
  const auto u = product(c.transformation.trial, randomEntries(c.transformation.columns, 8));
  const auto& mesh = *c.model.mesh;
  for (const auto& image : mesh.images)
    for (int d = 0; d < 2; ++d)
      EXPECT_EQ(u[2 * (mesh.firstNode + image.node) + d], u[2 * image.primary + d]);
  const auto offset = test::allEntries(c.model.contact.kinematics.offset);
  for (const char* group : {"disc_bottom", "pad_top"})
    for (PetscInt node : mesh.nodeGroups.at(group)) {
      EXPECT_EQ(at(u, mesh.firstNode + node, 2), (Point{}));
      EXPECT_EQ(at(offset, mesh.firstNode + node, 2),
                (Point{0, std::string(group) == "pad_top" ? -0.01 : 0.0, 0}));
    }
}

TEST(Trial, GapIsTheUnknownOnCurvedFaces) {
  setCylinders();
  gapIsTheUnknown(coupled());
  for (const int order : {1, 2}) {
    test::setOptions(ballInShell(order));
    gapIsTheUnknown(coupled());
  }
}

// A rigid plate: the gap is counted from its displaced face.
TEST(Trial, ObstacleMovesTheFace) {
  test::setCase("layer", "-mesh_set nx=6,ny=3 -contact_plate_obstacle_displacement 0.3,-0.02,0");
  const auto c = coupled();
  gapIsTheUnknown(c);
  const auto offset = test::allEntries(c.model.contact.kinematics.offset);
  for (const auto& node : c.nodes) {
    EXPECT_NEAR(node.normal[1], -1, 1e-14);  // from the plate to the layer
    EXPECT_NEAR(at(offset, node.pad, 2)[1], -0.02, 1e-16);
    EXPECT_NEAR(at(offset, node.pad, 2)[0], 0, 1e-16);
  }
}

// The work of forces R on the pad and −R on the disc at one node in a virtual motion T δx, tested
// with L(f) = T + f E:
//   δx·L(f)ᵀ r = R·[δu] + f R_N τ·[δu],   [δu] = δu_P − δu_D,   R_N = R·n.
// So with Coulomb's R_T = −f R_N τ only the row of the gap is left, and it holds R_N.
void frictionOfTheNormalForce(const Coupled& c) {
  const int dimension = c.dimension();
  ASSERT_GT(c.nodes.size(), 0u);
  const auto dx = randomEntries(c.transformation.columns, 11),
             du = product(c.transformation.trial, dx);
  const auto pattern = randomEntries(static_cast<PetscInt>(6 * c.nodes.size()), 12);
  for (std::size_t k = 0; k < c.nodes.size(); k += 3) {
    const auto& node = c.nodes[k];
    ASSERT_NEAR(test::dot(node.slip, node.slip), 1, 1e-14);
    EXPECT_NEAR(test::dot(node.slip, node.normal), 0, 1e-14);
    for (const double friction : {0.0, 0.3, 1.7}) {
      const double normalForce = pattern[6 * k + 3];
      Point any{pattern[6 * k], pattern[6 * k + 1], dimension == 3 ? pattern[6 * k + 2] : 0},
          coulomb{};
      for (std::size_t d = 0; d < 3; ++d)
        coulomb[d] = normalForce * (node.normal[d] - friction * node.slip[d]);
      for (const bool slides : {false, true}) {
        const Point& force = slides ? coulomb : any;
        std::vector<double> r(static_cast<std::size_t>(dimension * c.model.mesh->totalNodes), 0.0);
        for (int d = 0; d < dimension; ++d) {
          r[dimension * node.pad + d] = force[d];
          if (node.master >= 0) r[dimension * node.master + d] = -force[d];
        }
        auto rows = product(c.transformation.trial, r, true);
        const auto part = product(c.friction, r, true);
        double work = 0;
        for (std::size_t i = 0; i < rows.size(); ++i)
          rows[i] += friction * part[i], work += rows[i] * dx[i];
        const Point jump = c.jump(du, node);
        const double rn = test::dot(force, node.normal);
        EXPECT_NEAR(work, test::dot(force, jump) + friction * rn * test::dot(node.slip, jump),
                    1e-13);
        EXPECT_NEAR(rows[node.gapColumn], rn, 1e-14);
        for (std::size_t i = 0; i < rows.size(); ++i)
          if (slides && static_cast<PetscInt>(i) != node.gapColumn) {
            EXPECT_NEAR(rows[i], 0, 1e-14) << "row " << i;
          }
      }
    }
  }
}

TEST(TestFunctions, FrictionJoinsTheTangentialRows) {
  setLayers();
  frictionOfTheNormalForce(coupled());
  setCylinders();
  frictionOfTheNormalForce(coupled());
  test::setCase("layer", "-mesh_set nx=6,ny=3");
  frictionOfTheNormalForce(coupled());
  test::setOptions(ballInShell(1) + "-motion_ball_axis 1,2,3");  // an axis that meets no node
  frictionOfTheNormalForce(coupled());
}

// Open nodes: E vanishes where nothing slides; closed gaps have no column.
TEST(TestFunctions, OnlySlidingNodesCarryFriction) {
  setLayers();
  const auto c = coupled();
  EXPECT_EQ(c.nodes.size(), 6u);
  std::vector<unsigned char> open, closed;
  for (const auto& node : c.model.contact.interfaces.nodes)
    open.push_back(node.position[0] < 0.75), closed.push_back(!open.back());
  const auto part = c.model.contact.transformation({closed, {}});
  EXPECT_EQ(part.columns, 54 + 2);  // nodes at x = 0 and 0.5 keep their gaps
  for (std::size_t i = 0; i < open.size(); ++i) EXPECT_EQ(part.gapColumn[i] >= 0, open[i] == 1);
  const auto friction = test::denseCopy(frictionTest(c.model.contact, part, closed));
  for (const auto& node : c.nodes) {
    double size = 0;
    for (PetscInt j = 0; j < friction.columns(); ++j)
      for (PetscInt d = 0; d < 2; ++d)
        size = test::worse(size, std::abs(friction(2 * node.pad + d, j)));
    EXPECT_EQ(size, node.position[0] < 0.75 ? 0 : 1);
  }
}

}  // namespace
}  // namespace squeal
