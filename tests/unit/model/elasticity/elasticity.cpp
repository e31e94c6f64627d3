// SPDX-License-Identifier: BSD-2-Clause
// K, M and loads of every element on distorted cells: what holds exactly whatever the shape.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/elasticity/elasticity.hpp"
#include "model/elasticity/element.hpp"
#include "model/elasticity/inertia.hpp"
#include "model/element/shape.hpp"
#include "model/mesh/mesh.hpp"
#include "support/algebra/symmetric.hpp"
#include "support/model/element_patch.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using linalg::symmetricEigenvalues;
using mesh::Point;
using test::asymmetry;
using test::form;
using test::patch::density;
using test::patch::Patch;
using test::patch::poisson;
using test::patch::young;

INSTANTIATE_TEST_SUITE_P(Elements, Patch, testing::ValuesIn(test::patch::elements),
                         [](const auto& info) { return std::string(info.param.label); });

// Strain energy vanishes for rigid motions and for nothing else: no spurious mode from quadrature,
// none from the incompatible modes.
TEST_P(Patch, KernelOfStiffnessIsRigidMotions) {
  build();
  const auto stiffness = test::denseCopy(bodies.stiffness);
  EXPECT_LT(asymmetry(stiffness), 1e-14);  // rounding: products are summed in another order
  const auto eigenvalues = symmetricEigenvalues(stiffness);
  OwnedVec force = elasticity::nodalVector(mesh);
  const auto motions = rigidMotions();
  for (const auto& motion : motions) {
    PetscReal size = 0, rest = 0;
    check(MatMult(bodies.stiffness, motion, force));
    check(VecNorm(motion, NORM_2, &size));
    check(VecNorm(force, NORM_2, &rest));
    EXPECT_LT(rest, 1e-13 * eigenvalues.back() * size);
  }
  EXPECT_LT(std::abs(eigenvalues[motions.size() - 1]), 1e-13 * eigenvalues.back());
  EXPECT_GT(eigenvalues[motions.size()],
            1e-4 * eigenvalues.back());  // the first strained mode of some hundred unknowns, well
                                         // apart from zero
}

/// Solves K u = 0 inside for the values of `u` on the boundary, which replace those inside.
void solveInside(const mesh::Mesh& mesh, Mat stiffness, Vec u) {
  std::vector<PetscInt> rows;
  for (PetscInt node : mesh.nodeGroups.at("boundary"))
    for (int d = 0; d < mesh.dimension; ++d)
      rows.push_back(mesh.dimension * (mesh.firstNode + node) + d);
  OwnedMat matrix;
  OwnedVec rhs, boundary;
  check(MatDuplicate(stiffness, MAT_COPY_VALUES, matrix.out()));
  check(VecDuplicate(u, rhs.out()));
  check(VecDuplicate(u, boundary.out()));
  std::vector<double> values(rows.size());
  check(VecGetValues(u, static_cast<PetscInt>(rows.size()), rows.data(), values.data()));
  check(VecSetValues(boundary, static_cast<PetscInt>(rows.size()), rows.data(), values.data(),
                     INSERT_VALUES));
  check(VecAssemblyBegin(boundary));
  check(VecAssemblyEnd(boundary));
  check(MatZeroRowsColumns(matrix, static_cast<PetscInt>(rows.size()), rows.data(), 1, boundary,
                           rhs));
  test::solveDirectly(matrix, rhs, u);
}

/// u = H x with nothing special about H.
constexpr double gradient[3][3] = {{0.31, -0.52, 0.17}, {0.23, -0.14, 0.45}, {-0.39, 0.28, 0.61}};
Point linearField(const Point& x, int dimension) {
  Point u{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i)
    for (std::size_t j = 0; j < static_cast<std::size_t>(dimension); ++j)
      u[i] += gradient[i][j] * x[j];
  return u;
}

/// ½ σ:ε per unit volume times two, from λ and μ (plane stress: λ replaced by 2λμ / (λ + 2μ)).
double energyDensity(int dimension, bool planeStress) {
  double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), trace = 0, square = 0;
  const double mu = young / (2 * (1 + poisson));
  if (planeStress) lambda = 2 * lambda * mu / (lambda + 2 * mu);
  for (int i = 0; i < dimension; ++i) {
    trace += gradient[i][i];
    for (int j = 0; j < dimension; ++j)
      square += std::pow((gradient[i][j] + gradient[j][i]) / 2, 2);
  }
  return lambda * trace * trace + 2 * mu * square;
}

void constantStrain(const mesh::Mesh& mesh, const elasticity::Bodies& bodies, double energy) {
  const auto exact =
      test::nodalField(mesh, [&](const Point& x) { return linearField(x, mesh.dimension); });
  const auto inside = static_cast<double>(mesh.totalNodes) -
                      test::total(static_cast<double>(mesh.nodeGroups.at("boundary").size()));
  ASSERT_GE(inside, 1);
  OwnedVec u =
      test::nodalField(mesh, [&](const Point& x) { return linearField(x, mesh.dimension); });
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)  // what the solver is not to see
    if (const auto& boundary = mesh.nodeGroups.at("boundary");
        std::find(boundary.begin(), boundary.end(), node) == boundary.end())
      for (int d = 0; d < mesh.dimension; ++d)
        check(VecSetValue(u, mesh.dimension * (mesh.firstNode + node) + d, 1e3, INSERT_VALUES));
  check(VecAssemblyBegin(u));
  check(VecAssemblyEnd(u));
  solveInside(mesh, bodies.stiffness, u);
  EXPECT_NEAR(form(u, bodies.stiffness, u), energy, 1e-12 * energy);
  PetscReal size = 0, error = 0;
  check(VecNorm(exact, NORM_INFINITY, &size));
  check(VecAXPY(u, -1, exact));
  check(VecNorm(u, NORM_INFINITY, &error));
  EXPECT_LT(error, 1e-12 * size);
}

TEST_P(Patch, ReproducesConstantStrain) {
  build();
  constantStrain(mesh, bodies, energyDensity(dimension(), false));
  if (dimension() == 3) return;
  build("-elasticity_plane stress");
  constantStrain(mesh, bodies, energyDensity(2, true));
}

TEST_P(Patch, MassIsDensityTimesVolume) {
  for (const char* kind : {"consistent", "higher_order"}) {
    build(std::string("-elasticity_mass ") + kind);
    for (int i = 0; i < dimension(); ++i)
      for (int j = 0; j < dimension(); ++j)
        EXPECT_NEAR(form(unit(i), bodies.mass, unit(j)), i == j ? density : 0, 1e-12) << kind;
    const auto mass = test::denseCopy(bodies.mass);
    EXPECT_LT(asymmetry(mass), 1e-14) << kind;
    const auto eigenvalues = symmetricEigenvalues(mass);
    EXPECT_GT(eigenvalues.front(), 1e-4 * eigenvalues.back()) << kind;
  }
}

// ∮ p n dA = 0 and ∮ x × p n dA = 0 on the closed surface; ∮ x_i n_j dA = δ_ij V gives the
// magnitude and the sign.
TEST_P(Patch, PressureOnClosedBoundary) {
  constexpr double pressure = 2.5;
  build("-load_boundary_pressure 2.5");
  for (const auto& motion : rigidMotions())
    EXPECT_NEAR(test::dot(motion, bodies.load), 0, 1e-13 * pressure);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const auto field = test::nodalField(mesh, [&](const Point& x) {
        Point u{};
        u[j] = x[i];
        return u;
      });
      EXPECT_NEAR(test::dot(field, bodies.load),
                  i == j && i < static_cast<std::size_t>(dimension()) ? -pressure : 0,
                  1e-13 * pressure);
    }
}

// ∫ ρ ω² r dV = m ω² r(centre of mass), r from the axis.
TEST_P(Patch, CentrifugalForceIsThatOfTheCentreOfMass) {
  constexpr double speed = 3;
  const std::string axis =
      dimension() == 2 ? "0,0,1" : "2,4,4";  // not a unit vector: the program makes it one
  const Point k = dimension() == 2 ? Point{0, 0, 1} : Point{1.0 / 3, 2.0 / 3, 2.0 / 3},
              origin{-1, 0.7, dimension() == 2 ? 0 : 0.2};
  const std::string motion =
      "-motion_body_speed 3 -motion_body_axis " + axis + " -motion_body_origin -1,0.7,0.2 ";
  build(motion);
  Point r{0.5 - origin[0], 0.5 - origin[1], dimension() == 2 ? 0 : 0.5 - origin[2]};
  const double along = test::dot(r, k), unitForce = density * speed * speed;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension()); ++d)
    EXPECT_NEAR(test::dot(unit(static_cast<int>(d)), bodies.load),
                unitForce * (r[d] - along * k[d]),
                2e-12 * unitForce);  // gmsh's points for tetrahedra have 13 digits
  build(motion + "-load_centrifugal off");
  PetscReal size = 1;
  check(VecNorm(bodies.load, NORM_INFINITY, &size));
  EXPECT_EQ(size, 0);
}

// On one plane face: total force −p A n, its centre that of the face.
TEST(Load, PressureOnOneFace) {
  for (const std::string set :
       {"recombine=1", "recombine=0", "order=2", "order=2,serendipity=1", "order=2,recombine=0"}) {
    test::setOptions("-mesh_file meshes/beam.geo -mesh_set Lx=2,Ly=0.5,Lz=0.3,nx=4,ny=2,nz=1," +
                     set + test::material("beam", "1", "0.3", "1") + "-load_top_pressure 7");
    const auto mesh = test::readMesh();
    const auto bodies = test::assembleBodies(mesh);
    const auto work = [&](const auto& field) {
      return test::dot(test::nodalField(mesh, field), bodies.load);
    };
    EXPECT_NEAR(work([](const Point&) { return Point{1, 0, 0}; }), 0, 1e-13) << set;
    EXPECT_NEAR(work([](const Point&) { return Point{0, 1, 0}; }), 0, 1e-13) << set;
    EXPECT_NEAR(work([](const Point&) {
                  return Point{0, 0, 1};
                }),
                -7.0, 1e-12)
        << set;  // 7 Pa · 2 m · 0.5 m
    EXPECT_NEAR(work([](const Point& x) {
                  return Point{0, 0, x[0]};
                }),
                -7.0, 1e-12)
        << set;  // centre at x = 1
    EXPECT_NEAR(work([](const Point& x) { return Point{0, 0, x[1]}; }), 0, 1e-12) << set;
  }
}

/// The unit square of four quadrangles; the nodes of the last one, tag 104, run clockwise if
/// `inverted`.
std::string fourCells(bool inverted) {
  std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 "
      "\"lining\"\n$EndPhysicalNames\n$Nodes\n9\n";
  for (int i = 0; i < 9; ++i)
    text += std::to_string(i + 1) + " " + std::to_string(0.5 * (i % 3)) + " " +
            std::to_string(0.5 * (i / 3)) + " 0\n";
  text +=
      "$EndNodes\n$Elements\n4\n101 3 2 1 1 1 2 5 4\n102 3 2 1 1 2 3 6 5\n103 3 2 1 1 4 5 8 7\n104 "
      "3 2 1 1 ";
  return text + (inverted ? "5 8 9 6" : "5 6 9 8") + "\n$EndElements\n";
}

TEST(Elasticity, NamesAnInvertedElementOnAllRanks) {
  for (const bool inverted : {false, true}) {
    const auto file =
        test::writeFile(inverted ? "inverted.msh" : "four_cells.msh", fourCells(inverted));
    test::setOptions("-mesh_file " + file + test::material("lining", "1", "0.3", "1"));
    const auto mesh = test::readMesh();
    const auto message = test::errorOf([&] { test::assembleBodies(mesh); });
    if (!inverted) {
      EXPECT_EQ(message, "");
      continue;
    }
    EXPECT_TRUE(test::contains(message, "inverted")) << message;
    EXPECT_TRUE(test::contains(message, "'lining'")) << message;
    EXPECT_TRUE(test::contains(message, "cell 104")) << message;
  }
}

// ρ V (1 + δᵢⱼ) / ((d + 1) (d + 2)), the closed formula of linear simplices (Zienkiewicz and
// Taylor, The Finite Element Method). The rules of gmsh for them have a point of negative weight,
// which is not a fold.
TEST(Mass, LinearSimplicesHaveTheClosedFormula) {
  const std::vector<Point> triangle{{0, 0, 0}, {1.2, 0.1, 0}, {0.2, 0.8, 0}},
      tetrahedron{{0, 0, 0}, {2, 0, 0}, {1, 3, 0}, {0, 1, 4}};
  for (const auto& [type, nodes, volume] : {std::tuple{2, triangle, 0.47}, {4, tetrahedron, 4.0}}) {
    const auto& table = element::shapeTable(type);
    EXPECT_LT(*std::min_element(table.weight.begin(), table.weight.end()), 0) << type;
    const auto mass = elasticity::mass(table, nodes, density, elasticity::MassKind::consistent);
    const std::size_t n = nodes.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        EXPECT_NEAR(mass[i * n + j],
                    density * volume * (i == j ? 2 : 1) / static_cast<double>(n * (n + 1)),
                    1e-11 * density * volume);  // gmsh's points have 13 digits
  }
}

// On straight cells both rules are exact: the integrand is of degree 2.
TEST(StiffnessRule, IsExactOnStraightCells) {
  const std::vector<Point> tetrahedron{
      {0, 0, 0}, {1.1, 0.2, 0}, {0.1, 0.9, -0.2}, {0.3, -0.1, 1.3}},
      triangle{{0, 0, 0}, {1.2, 0.1, 0}, {0.2, 0.8, 0}};
  const auto middle = [](const Point& a, const Point& b) {
    return Point{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
  };
  auto tet10 = tetrahedron, tri6 = triangle;
  for (const auto& [i, j] :
       {std::pair{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}})  // gmsh's order of the edges
    tet10.push_back(middle(tetrahedron[i], tetrahedron[j]));
  for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {2, 0}})
    tri6.push_back(middle(triangle[i], triangle[j]));
  for (const auto& [type, nodes, points] : {std::tuple{11, tet10, 4}, {9, tri6, 3}}) {
    const auto& rule = element::stiffnessTable(type);
    EXPECT_EQ(rule.points(), points);
    const material::Law law{material::isotropic(young, poisson, rule.dimension, false), {}};
    const auto few = elasticity::stiffness(rule, nodes, law, false),
               many = elasticity::stiffness(element::shapeTable(type), nodes, law, false);
    const double largest = *std::max_element(many.begin(), many.end());
    for (std::size_t i = 0; i < many.size(); ++i)
      EXPECT_NEAR(few[i], many[i], 1e-11 * largest);  // gmsh's points for tetrahedra have 13 digits
  }
  for (int type : {2, 3, 4, 5, 6, 7, 10, 12, 13, 14, 16, 17, 18, 19})
    EXPECT_EQ(&element::stiffnessTable(type), &element::shapeTable(type)) << type;
}

// ∫ uᵃ vᵇ wᶜ over the pyramid |u|, |v| ≤ 1 − w, 0 ≤ w ≤ 1, and closed in Gamma functions: the
// points are those of the collapsed cube, and their weights sum to its volume.
TEST(PyramidRule, IntegratesPolynomialsExactly) {
  for (int type : {7, 14, 19}) {
    const auto& table = element::shapeTable(type);
    const int degree = 2 * table.order + 1;
    for (int a = 0; a <= degree; ++a)
      for (int b = 0; a + b <= degree; ++b)
        for (int c = 0; a + b + c <= degree; ++c) {
          double sum = 0;
          for (int q = 0; q < table.points(); ++q) {
            const double* u = &table.point[3 * q];
            sum += table.weight[q] * std::pow(u[0], a) * std::pow(u[1], b) * std::pow(u[2], c);
          }
          const bool odd = a % 2 == 1 || b % 2 == 1;
          const double exact = 4.0 / (a + 1) / (b + 1) * std::tgamma(c + 1) *
                               std::tgamma(a + b + 3) / std::tgamma(a + b + c + 4);
          EXPECT_NEAR(sum, odd ? 0 : exact, 1e-13) << table.name << " " << a << b << c;
        }
  }
}

}  // namespace
}  // namespace squeal
