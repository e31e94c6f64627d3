// SPDX-License-Identifier: BSD-2-Clause
// Curved tetrahedra whose Jacobian is not positive near an edge: fewer points of the stiffness.
#include <gtest/gtest.h>

#include <cmath>

#include "model/elasticity/elasticity.hpp"
#include "model/elasticity/element.hpp"
#include "model/elasticity/inertia.hpp"
#include "model/element/shape.hpp"
#include "model/mesh/mesh.hpp"
#include "support/algebra/symmetric.hpp"
#include "support/harness/messages.hpp"
#include "support/model/element_patch.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

using linalg::symmetricEigenvalues;
using mesh::Point;
using test::form;
using test::patch::density;
using test::patch::poisson;
using test::patch::young;

/// Quadratic tetrahedra of corners 0, x, y, z, each 10 m from the last, tags 7, 9, 11 and so on.
/// The node in the middle of the edge along x is moved by `inwards` along y and along z: det J
/// falls near that edge, and the volume is (1 − 2 inwards) / 6 m³.
std::string curvedTetrahedra(double inwards, int count) {
  const double x[10][3] = {
      {0, 0, 0},     {1, 0, 0},   {0, 1, 0},   {0, 0, 1},     {0.5, inwards, inwards},
      {0.5, 0.5, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {0, 0.5, 0.5}, {0.5, 0, 0.5}};
  std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 "
      "\"body\"\n$EndPhysicalNames\n$Nodes\n" +
      std::to_string(10 * count) + "\n";
  for (int cell = 0; cell < count; ++cell)
    for (int i = 0; i < 10; ++i) {
      text += std::to_string(10 * cell + i + 1) + " " + std::to_string(x[i][0] + 10 * cell);
      text += " " + std::to_string(x[i][1]) + " " + std::to_string(x[i][2]) + "\n";
    }
  text += "$EndNodes\n$Elements\n" + std::to_string(count) + "\n";
  for (int cell = 0; cell < count; ++cell) {
    text += std::to_string(7 + 2 * cell) + " 11 2 1 1";
    for (int i = 0; i < 10; ++i) text += " " + std::to_string(10 * cell + i + 1);
    text += "\n";
  }
  return text + "$EndElements\n";
}

struct CurvedCells {
  std::string message, warning;
  mesh::Mesh mesh;
  elasticity::Bodies bodies;
};

/// Collective. The warning, only on rank 0.
CurvedCells assembleCurved(double inwards, int count = 2) {
  CurvedCells cells;
  test::setOptions("-mesh_file " + test::writeFile("curved.msh", curvedTetrahedra(inwards, count)) +
                   test::material("body", std::to_string(young), std::to_string(poisson),
                                  std::to_string(density)));
  cells.mesh = test::readMesh();
  testing::internal::CaptureStderr();
  cells.message = test::errorOf([&] { cells.bodies = test::assembleBodies(cells.mesh); });
  cells.warning = testing::internal::GetCapturedStderr();
  return cells;
}

// det J is negative at one of the 14 points of degree 5 from 0.174 on, at one of the 4 points of
// the stiffness from 0.214 on.
TEST(CurvedTetrahedra, AreOfUseWhereTheStiffnessHasNoNegativePoint) {
  int rank = 0;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  for (const double inwards : {0.0, 0.16, 0.19, 0.21}) {
    const CurvedCells cells = assembleCurved(inwards);
    ASSERT_EQ(cells.message, "") << inwards;
    const std::string expected =
        "squeal: warning: 2 curved cells have a Jacobian that is not positive near an edge; "
        "stiffness is integrated at fewer "
        "points there (-mesh_straighten bad straightens such cells): "
        "cell 7 (tet10) of group 'body', cell 9 (tet10) of group 'body'\n";
    EXPECT_EQ(cells.warning, rank == 0 && inwards > 0.174 ? expected : "") << inwards;
    // The mass is that of the true volume, and positive definite, which the integral with a
    // negative det J is not from 0.18 on.
    const auto along = test::nodalField(cells.mesh, [](const Point&) { return Point{1, 0, 0}; });
    EXPECT_NEAR(form(along, cells.bodies.mass, along), 2 * density * (1 - 2 * inwards) / 6, 1e-12)
        << inwards;
    EXPECT_GT(symmetricEigenvalues(test::denseCopy(cells.bodies.mass)).front(), 0) << inwards;
    const auto stiffness = symmetricEigenvalues(test::denseCopy(cells.bodies.stiffness));
    EXPECT_LT(std::abs(stiffness[11]), 1e-12 * stiffness.back())
        << inwards;                                                // six rigid motions of each cell
    EXPECT_GT(stiffness[12], 1e-7 * stiffness.back()) << inwards;  // and no other
  }
  // det J = 1 − 8 · 0.24 ξ, at the points of degree 5 from ξ = 0.0455 to 0.7218: −0.42 in ratio.
  EXPECT_EQ(assembleCurved(0.24).message,
            "inverted elements: 2 cells have a Jacobian that is not positive; the worst "
            "ratio to its largest value is -0.42: cell 7 (tet10) of group 'body', cell 9 (tet10) "
            "of group 'body'; "
            "-mesh_straighten bad straightens the edges of such cells");
}

// The lists end after ten names, by tag; the count is of all.
TEST(CurvedTetrahedra, TenAreNamed) {
  const auto message = assembleCurved(0.24, 12).message;
  EXPECT_TRUE(test::contains(message, "inverted elements: 12 cells")) << message;
  EXPECT_TRUE(test::contains(message, "cell 25 (tet10) of group 'body', …;")) << message;
  EXPECT_FALSE(test::contains(message, "cell 27 ")) << message;
  const auto warning = assembleCurved(0.19, 12).warning;  // of rank 0
  int rank = 0;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  EXPECT_EQ(test::contains(warning, "warning: 12 curved cells have"), rank == 0) << warning;
}

// Terms with J⁻¹ take the points of the stiffness there, and G stays skew.
TEST(CurvedTetrahedra, ConvectionAndStressTakeTheSamePoints) {
  const auto nodes = [](double inwards) {
    return std::vector<Point>{
        {0, 0, 0},     {1, 0, 0},   {0, 1, 0},   {0, 0, 1},     {0.5, inwards, inwards},
        {0.5, 0.5, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {0, 0.5, 0.5}, {0.5, 0, 0.5}};
  };
  const auto& table = element::shapeTable(11);
  EXPECT_EQ(elasticity::gradientTable(table, nodes(0.16)).points(), 14);
  EXPECT_EQ(elasticity::gradientTable(table, nodes(0.19)).points(), 4);
  const std::vector<Point> velocity(10, Point{1, 2, 3});
  EXPECT_THROW(elasticity::convection(table, nodes(0.19), velocity, density),
               elasticity::InvertedElement);
  const auto convection = elasticity::convection(elasticity::gradientTable(table, nodes(0.19)),
                                                 nodes(0.19), velocity, density);
  for (std::size_t i = 0; i < 10; ++i)
    for (std::size_t j = 0; j < 10; ++j)
      EXPECT_NEAR(convection.gyroscopic[10 * i + j], -convection.gyroscopic[10 * j + i], 1e-14);
  EXPECT_THROW(elasticity::mass(table, nodes(0.6), density, elasticity::MassKind::consistent),
               elasticity::InvertedElement);
}

}  // namespace
}  // namespace squeal
