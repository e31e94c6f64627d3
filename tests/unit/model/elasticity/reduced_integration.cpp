// SPDX-License-Identifier: BSD-2-Clause
// hex20 with reduced integration: the rank of its stiffness, frequencies of another program, and
// bodies that cannot have it. The patch tests are those of all elements, in elasticity.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "algebra/linalg/symmetric.hpp"
#include "base/system/mpi.hpp"
#include "model/elasticity/element.hpp"
#include "model/elasticity/hourglass.hpp"
#include "model/element/shape.hpp"
#include "support/algebra/dense.hpp"
#include "support/algebra/symmetric.hpp"
#include "support/harness/messages.hpp"
#include "support/model/box_frequencies.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using mesh::Point;

constexpr int hex20 = 17;
const std::string reduced = " -material_beam_integration reduced ";

/// Returns a box of hex20 with every node moved by up to `amount`.
elasticity::ExposedCell movedCell(double amount) {
  const auto& table = element::shapeTable(hex20);
  static constexpr int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                     {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  std::mt19937 generator(1);
  elasticity::ExposedCell cell{};
  for (std::size_t i = 0; i < cell.point.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) {
      for (int c = 0; c < 8; ++c)
        cell.point[i][d] += (0.5 + 0.1 * d) * table.cornerValue[i * 8 + c] * sign[c][d];
      cell.point[i][d] += amount * test::uniform(generator);
    }
  return cell;
}

std::vector<double> eigenvaluesOf(const element::ShapeTable& rule,
                                  const elasticity::ExposedCell& cell) {
  const material::Law law{material::isotropic(2, 0.3, 3, false), {}};
  const auto k = elasticity::stiffness(rule, {cell.point.begin(), cell.point.end()}, law, false);
  return linalg::symmetricEigenvalues(test::square(k));
}

// 48 = 8 points × 6 strains; 6 rigid motions and 6 hourglass modes remain of 60.
TEST(ReducedIntegration, StiffnessOfOneCellHasRank48) {
  for (const double amount : {0.0, 0.02, 0.05}) {
    const auto cell = movedCell(amount);
    const auto few = eigenvaluesOf(*element::underintegratedTable(hex20), cell),
               full = eigenvaluesOf(element::shapeTable(hex20), cell);
    const auto zeros = [](const std::vector<double>& values) {
      return std::ranges::count_if(values,
                                   [&](double x) { return std::abs(x) < 1e-13 * values.back(); });
    };
    EXPECT_EQ(zeros(few), 12) << amount;
    EXPECT_EQ(zeros(full), 6) << amount;
    EXPECT_GT(few[12], 1e-3 * few.back()) << amount;
  }
}

TEST(ReducedIntegration, BasisWithoutStrainContainsRigidMotions) {
  const auto cell = movedCell(0.05);
  const auto basis = elasticity::strainlessBasis(cell);
  ASSERT_EQ(basis.columns(), 12);
  const auto gram = linalg::transposedProduct(basis, basis);
  for (int motion = 0; motion < 6; ++motion) {
    linalg::DenseMatrix u(60, 1);
    double square = 0, inside = 0;
    for (int i = 0; i < 20; ++i)
      for (int d = 0; d < 3; ++d) {
        Point axis{};
        axis[motion % 3] = 1;
        u(3 * i + d, 0) = motion < 3 ? axis[d] : mesh::cross(axis, cell.point[i])[d];
        square += u(3 * i + d, 0) * u(3 * i + d, 0);
      }
    const auto parts = linalg::transposedProduct(basis, u);
    for (int m = 0; m < 12; ++m) {
      EXPECT_NEAR(gram(m, m), 20, 1e-12);
      inside += parts(m, 0) * parts(m, 0) / gram(m, m);
    }
    EXPECT_NEAR(inside, square, 1e-12 * square);
  }
}

// The cantilever of box_frequencies.hpp in steel. CalculiX 2.20 has written the stiffness of C3D20R
// and the mass of C3D20 (*FREQUENCY, SOLVER=MATRIXSTORAGE), whose eigenvalues are these.
TEST(ReducedIntegration, FrequenciesOfABoxAreThoseOfCalculiX) {
  const std::string steel = test::material("beam", "2.1e11", "0.3", "7850");
  test::expectFrequencies(steel + reduced,
                          {1661.137896, 3050.671625, 6259.591009, 8976.714633, 12933.163860,
                           13048.470828, 18880.527999, 21772.704851});
  test::expectFrequencies(steel, {1671.664797, 3066.896764, 6314.158171, 9061.740390, 12986.554546,
                                  13083.568660, 19070.010171, 22051.305390});
}

// CalculiX itself integrates the mass of C3D20R at the 2×2×2 points as well: its rank in one cell
// is 8 of 20 per component. Abaqus has the mass of full integration, as here. What C3D20R of
// CalculiX 2.20 prints differs by the mass: 0.003 % at the lowest mode, 0.6 % at the eighth.
TEST(ReducedIntegration, FullMassChangesLittle) {
  const auto found =
      test::boxFrequencies(test::material("beam", "2.1e11", "0.3", "7850") + reduced);
  const double printed[] = {1661.190, 3050.756, 6260.009, 8985.054,
                            12942.93, 13049.07, 18907.92, 21903.00};
  for (std::size_t i = 0; i < std::size(printed); ++i) {
    EXPECT_LT(found[i], printed[i]) << i;
    EXPECT_GT(found[i], (1 - 0.007) * printed[i]) << i;
  }
}

TEST(ReducedIntegration, PartOfABodyIsItsStiffness) {
  const auto [mesh, bodies] =
      test::buildBodies("-mesh_file meshes/beam.geo -mesh_set " + test::smallBox +
                        test::material("beam", "2", "0.3", "1") + reduced);
  const auto part = elasticity::materialPart(mesh, bodies, 0);
  const auto whole = test::denseCopy(bodies.stiffness);
  EXPECT_LT(test::largestDifference(test::denseCopy(part.stiffness), whole),
            1e-14 * test::largestEntry(whole));
}

// The stress that a displacement of no low degree causes is that at the 2×2×2 points.
TEST(ReducedIntegration, GeometricStiffnessHasTheSamePoints) {
  const auto [mesh, bodies] =
      test::buildBodies("-mesh_file meshes/beam.geo -mesh_set " + test::smallBox +
                        test::material("beam", "2", "0.3", "1") + reduced);
  const auto field = [](double a) {
    return [a](const Point& x) {
      return Point{std::sin(a * x[0] + 90 * x[1]), std::cos(70 * x[1] - a * x[2]),
                   std::sin(60 * x[2] + 30 * x[0])};
    };
  };
  const auto u = test::nodalField(mesh, field(40)), v = test::nodalField(mesh, field(50));
  const auto energy = [&](const element::ShapeTable& rule) {
    double sum = 0;
    for (const auto& block : mesh.cells)
      for (std::size_t e = 0; e < block.tag.size(); ++e) {
        std::vector<Point> points;
        std::vector<double> displacement;
        std::vector<Point> other;
        for (const PetscInt node : block.nodesOf(e)) {
          points.push_back(mesh.coordinates[node]);
          for (const double value : field(40)(points.back())) displacement.push_back(value);
          other.push_back(field(50)(points.back()));
        }
        const auto k = elasticity::geometricStiffness(rule, points, bodies.materials[0].law, false,
                                                      displacement);
        for (std::size_t i = 0; i < 20; ++i)
          for (std::size_t j = 0; j < 20; ++j) sum += k[20 * i + j] * mesh::dot(other[i], other[j]);
      }
    return test::total(sum);
  };
  const OwnedMat k = elasticity::geometricStiffness(mesh, bodies, u);
  const double found = test::form(v, k, v), few = energy(*element::underintegratedTable(hex20)),
               full = energy(element::shapeTable(hex20));
  EXPECT_NEAR(found, few, 1e-12 * std::abs(few));
  EXPECT_GT(std::abs(found - full), 1e-3 * std::abs(full));
}

TEST(ReducedIntegration, OtherCellsAreRefusedByName) {
  const auto message = [](const std::string& set) {
    return test::errorOf([&] {
      test::buildBodies("-mesh_file meshes/beam.geo -mesh_set nx=2,ny=2,nz=2" + set +
                        test::material("beam", "1", "0.3", "1") + reduced);
    });
  };
  EXPECT_EQ(message(""),
            "option -material_beam_integration reduced: body 'beam' has hex8 cells, and only hex20 "
            "cells have reduced integration; use incompatible modes "
            "(-elasticity_incompatible_modes hex8) or hex20");
  test::expectMessage(message(",order=2"), {"-material_beam_integration", "'beam'", "hex27"});
  test::expectMessage(message(",order=2,recombine=0"), {"'beam' has tet10 cells", "use full"});
  EXPECT_EQ(message(",order=2,serendipity=1"), "");
  EXPECT_TRUE(test::contains(test::errorOf([] {
                               test::buildBodies(
                                   "-mesh_file meshes/patch_2d.geo -mesh_set order=2,serendipity=1 "
                                   "-material_body_integration reduced" +
                                   test::material("body", "1", "0.3", "1"));
                             }),
                             "body 'body' has quad8 cells"));
  // A name without a material, and an unknown rule.
  EXPECT_TRUE(test::contains(test::errorOf([] {
                               test::setOptions("-material_pad_integration reduced" +
                                                test::material("beam", "1", "0.3", "1"));
                               material::Settings::given();
                             }),
                             "-material_pad_young"));
  EXPECT_TRUE(test::contains(test::errorOf([] {
                               test::setOptions("-material_beam_integration some" +
                                                test::material("beam", "1", "0.3", "1"));
                               material::Settings::given();
                             }),
                             "full or reduced"));
}

// Only the cells around an edge inside the body hold each other.
TEST(ReducedIntegration, CellsWithoutAnEdgeInsideAreReported) {
  const auto warning = [](const std::string& set, const std::string& more) {
    return test::warningsOf([&] {
      test::buildBodies("-mesh_file meshes/beam.geo -mesh_set order=2,serendipity=1," + set +
                        test::material("beam", "1", "0.3", "1") + more);
    });
  };
  EXPECT_EQ(warning("nx=2,ny=2,nz=1", reduced), "");
  EXPECT_EQ(warning("nx=12,ny=1,nz=1", ""), "");
  const auto row = warning("nx=12,ny=1,nz=1", reduced);
  test::expectMessage(row.substr(0, row.size() - 1),
                      {"squeal: warning: body 'beam' has 12 hex20 cells with reduced integration",
                       "-material_beam_integration full: cells ", ", …"});
  if (mpi::size(PETSC_COMM_WORLD) == 1) {
    EXPECT_TRUE(test::contains(warning("nx=1,ny=1,nz=1", reduced), "has 1 hex20 cell with"));
  }
}

}  // namespace
}  // namespace squeal
