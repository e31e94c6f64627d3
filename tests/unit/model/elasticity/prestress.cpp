// SPDX-License-Identifier: BSD-2-Clause
// K_σ: ∫ ∇v·σ∇v for stresses known exactly, and what a spinning body owes to its centrifugal
// stress.
#include <gtest/gtest.h>

#include <cmath>

#include "base/system/text.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using mesh::Point;
using test::form;

constexpr double young = 2, poisson = 0.3;

constexpr double h1[3][3] = {{0.31, -0.52, 0.17}, {0.23, -0.14, 0.45}, {-0.39, 0.28, 0.61}};
constexpr double h2[3][3] = {{-0.44, 0.71, 0.32}, {0.65, 0.27, -0.18}, {0.11, -0.36, 0.53}};
OwnedVec linearField(const mesh::Mesh& mesh, const double (&h)[3][3]) {
  return test::nodalField(mesh, [&](const Point& x) {
    Point u{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < static_cast<std::size_t>(mesh.dimension); ++j)
        u[i] += h[i][j] * x[j];
    return u;
  });
}

/// Σ (H σ Hᵀ)_ii for v = H2 x and the stress of u = H1 x on a unit volume; plane strain in the
/// plane.
double uniformForm(int dimension) {
  const auto size = static_cast<std::size_t>(dimension);
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)),
               mu = young / (2 * (1 + poisson));
  double trace = 0, sum = 0;
  for (std::size_t i = 0; i < size; ++i) trace += h1[i][i];
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t k = 0; k < size; ++k)
      for (std::size_t l = 0; l < size; ++l)
        sum += h2[i][k] * (mu * (h1[k][l] + h1[l][k]) + (k == l ? lambda * trace : 0)) * h2[i][l];
  return sum;
}

TEST(Prestress, UniformStressOnDistortedCells) {
  for (const int dimension : {2, 3})
    for (const std::string set : {"n=1", "recombine=0", "order=2", "order=2,serendipity=1",
                                  "recombine=0,order=2", "serendipity=1,order=2"})
      for (const std::string incompatible : {"none", "quad4,hex8"}) {
        if (set != "n=1" && incompatible != "none") continue;
        SCOPED_TRACE(formatted("%d dimensions, %s, incompatible %s", dimension, set.c_str(),
                               incompatible.c_str()));
        const bool reduced = set == "serendipity=1,order=2";
        if (reduced && dimension == 2) continue;
        const auto [mesh, bodies] =
            test::buildBodies(formatted("-mesh_file meshes/patch_%dd.geo -mesh_set ", dimension) +
                              set + test::material("body", "2", "0.3", "1") +
                              (reduced ? "-material_body_integration reduced " : "") +
                              "-elasticity_incompatible_modes " + incompatible);
        const OwnedMat k = elasticity::geometricStiffness(mesh, bodies, linearField(mesh, h1));
        const auto v = linearField(mesh, h2);
        const double expected = uniformForm(dimension);
        EXPECT_NEAR(form(v, k, v), expected, 1e-12 * std::abs(expected));
        const auto entries = test::denseCopy(k);
        for (PetscInt i = 0; i < entries.rows(); ++i)
          for (PetscInt j = 0; j < i; ++j) ASSERT_EQ(entries(i, j), entries(j, i));
        // A rigid translation is not resisted: rows add up to zero.
        for (PetscInt i = 0; i < entries.rows(); ++i) {
          double sum = 0;
          for (PetscInt j = 0; j < entries.rows(); ++j) sum += entries(i, j);
          EXPECT_NEAR(sum, 0, 1e-13);
        }
      }
}

// A bar under the uniaxial stress S: lateral motion of slope θ costs S A L θ², motion uniform along
// the bar nothing.
TEST(Prestress, StretchedBar) {
  constexpr double stress = 0.01;
  for (const std::string set : {"recombine=1", "recombine=0", "order=2,serendipity=1"}) {
    const auto [mesh, bodies] = test::buildBodies(
        "-mesh_file meshes/beam.geo -mesh_set Lx=2,Ly=0.5,Lz=0.3,nx=4,ny=2,nz=1," + set +
        test::material("beam", "2", "0.3", "1"));
    const auto u = test::nodalField(mesh, [](const Point& x) {
      return Point{stress / young * x[0], -poisson * stress / young * x[1],
                   -poisson * stress / young * x[2]};
    });
    const OwnedMat k = elasticity::geometricStiffness(mesh, bodies, u);
    const auto lateral = test::nodalField(mesh, [](const Point& x) {
      return Point{0, 0.3 * x[0], 0};
    });
    const auto uniform = test::nodalField(mesh, [](const Point& x) {
      return Point{x[1], x[2], x[1]};
    });
    EXPECT_NEAR(form(lateral, k, lateral), stress * 0.3 * 0.09, 1e-12 * stress)
        << set;  // A L = 0.3
    EXPECT_NEAR(form(uniform, k, uniform), 0, 1e-12 * stress) << set;
  }
}

// Pure bending of one row of quad4 cells, in plane stress: with its incompatible modes the stress
// is only −E κ y, y from the middle; without them the cells would also report shear. v = (0, x y):
// ∫ σ_xx y² with y from the upper side.
TEST(Prestress, IncompatibleModesBelongToTheStress) {
  constexpr double kappa = 0.01, height = 0.5, length = 3;
  const auto [mesh, bodies] =
      test::buildBodies("-mesh_file meshes/layer.geo -mesh_set Lx=3,h=0.5,nx=6,ny=1" +
                        test::material("layer", "2", "0.3", "1") +
                        "-elasticity_plane stress -elasticity_incompatible_modes quad4");
  const auto u = test::nodalField(mesh, [](const Point& x) {
    const double y = x[1] + height / 2;
    return Point{-kappa * x[0] * y, kappa / 2 * (x[0] * x[0] + poisson * y * y), 0};
  });
  const auto v = test::nodalField(mesh, [](const Point& x) { return Point{0, x[0] * x[1], 0}; });
  const OwnedMat k = elasticity::geometricStiffness(mesh, bodies, u);
  // ∫ −E κ (y + h/2) y² dy over −h < y < 0 is E κ h⁴ / 12.
  const double expected = young * kappa * std::pow(height, 4) / 12 * length;
  EXPECT_NEAR(form(v, k, v), expected, 1e-9 * expected);  // gmsh places the nodes to ten digits
}

/// K u = b with the components of the groups held at zero.
OwnedVec statics(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                 const std::map<std::string, int>& held) {
  std::vector<PetscInt> rows;
  for (const auto& [group, component] : held)
    for (PetscInt node : mesh.nodeGroups.at(group))
      rows.push_back(mesh.dimension * (mesh.firstNode + node) + component);
  OwnedMat matrix;
  OwnedVec load, u = elasticity::nodalVector(mesh);
  check(MatDuplicate(bodies.stiffness, MAT_COPY_VALUES, matrix.out()));
  check(VecDuplicate(u, load.out()));
  check(VecCopy(bodies.load, load));
  check(MatZeroRowsColumns(matrix, static_cast<PetscInt>(rows.size()), rows.data(), 1, u, load));
  test::solveDirectly(matrix, load, u);
  return u;
}

constexpr double bore = 0.8, rim = 1.2, density = 1.7, speed = 0.3;

/// The outer one of two rings that do not touch spins.
std::string spinning(int cells, const std::string& more) {
  return formatted(
             "-mesh_file meshes/cylinders.geo -mesh_set "
             "a=0.5,b=%g,c=%g,n_inner=1,n_outer=%d,n_theta=%d,",
             bore, rim, cells / 8, cells) +
         more + test::material("inner", "2", "0.3", "1") +
         test::material("outer", "2", "0.3", "1.7") +
         "-motion_outer_speed 0.3 -motion_convective on -elasticity_plane stress "
         "-constraint_sym_x_clamped x "
         "-constraint_sym_y_clamped y ";
}
const std::map<std::string, int> symmetry{{"sym_x", 0}, {"sym_y", 1}};

// The virial of the centrifugal load is the integral of the stress: ∫ σ:∇x = ∫ ρ ω² |r|². So u = k
// × r, in which every element only turns, costs nothing: uᵀ K_σ u = ω² J = −uᵀ K^R u. Exact on any
// mesh, x being one of the test functions.
TEST(Prestress, RigidRotationOfASpinningRingIsFree) {
  for (const std::string set : {"recombine=1", "recombine=0", "order=2", "order=2,serendipity=1"}) {
    for (const std::string incompatible : {"none", "quad4"}) {
      const auto [mesh, bodies] =
          test::buildBodies(spinning(16, set) + "-elasticity_incompatible_modes " + incompatible);
      const OwnedMat k =
          elasticity::geometricStiffness(mesh, bodies, statics(mesh, bodies, symmetry));
      const auto u = test::nodalField(mesh, [](const Point& x) { return Point{-x[1], x[0], 0}; });
      const double stiffness = form(u, k, u), softening = form(u, bodies.rotationStiffness, u);
      EXPECT_GT(stiffness, 0) << set;
      EXPECT_NEAR(stiffness + softening, 0, 1e-10 * stiffness)
          << set;  // the accuracy of the statics
    }
  }
}

/// vᵀ K_σ v of v = (x², 0) in the spinning ring: ∫ 4 x² σ_xx = 4 ∫ r³ (3π/4 σ_rr + π/4 σ_θθ) dr
/// with (Timoshenko and Goodier, art. 32)
///   σ_rr = (3+ν)/8 ρω² (a² + b² − a²b²/r² − r²),  σ_θθ = (3+ν)/8 ρω² (a² + b² + a²b²/r² −
///   (1+3ν)/(3+ν) r²).
double exactForm() {
  const double a2 = bore * bore, b2 = rim * rim, unit = (3 + poisson) / 8 * density * speed * speed;
  const auto moment = [](int power) {
    return (std::pow(rim, power + 1) - std::pow(bore, power + 1)) / (power + 1);
  };
  const double radial = (a2 + b2) * moment(3) - a2 * b2 * moment(1) - moment(5);
  const double tangential =
      (a2 + b2) * moment(3) + a2 * b2 * moment(1) - (1 + 3 * poisson) / (3 + poisson) * moment(5);
  return unit * (3 * M_PI * radial + M_PI * tangential);
}

TEST(Prestress, StressOfASpinningRingConverges) {
  for (const std::string set : {"recombine=1", "recombine=0", "order=2"}) {
    double error[2];
    for (int level = 0; level < 2; ++level) {
      const auto [mesh, bodies] = test::buildBodies(spinning(level ? 48 : 24, set));
      const OwnedMat k =
          elasticity::geometricStiffness(mesh, bodies, statics(mesh, bodies, symmetry));
      const auto v = test::nodalField(mesh, [](const Point& x) {
        return Point{std::hypot(x[0], x[1]) > 0.79 ? x[0] * x[0] : 0.0, 0, 0};
      });
      error[level] = std::abs(form(v, k, v) / exactForm() - 1);
    }
    const double order = std::log2(error[0] / error[1]);
    test::print("spinning ring, %s: errors %.2e, %.2e, order %.2f\n", set.c_str(), error[0],
                error[1], order);
    EXPECT_GT(order, set == "order=2" ? 2.7 : 1.8) << set;
    EXPECT_LT(error[1], set == "order=2" ? 1e-5 : 1e-2) << set;
  }
}

}  // namespace
}  // namespace squeal
