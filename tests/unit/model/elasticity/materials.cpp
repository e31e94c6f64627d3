// SPDX-License-Identifier: BSD-2-Clause
// Orthotropic bodies: energies of affine displacements, and the same law said in two ways.
#include <gtest/gtest.h>

#include <cmath>

#include "base/system/text.hpp"
#include "exact/orthotropic.hpp"
#include "support/algebra/dense.hpp"
#include "support/harness/largest_error.hpp"
#include "support/harness/messages.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using exact::orthotropic::g12;
using exact::orthotropic::Matrix;
using exact::orthotropic::product;
using exact::orthotropic::strainOf;
using exact::orthotropic::toMesh;
using mesh::Point;
using test::form;

const std::string orthotropic =
    std::string("-material_body_engineering_constants ") + exact::orthotropic::constants + " ";

std::string patch(int dimension, const std::string& set, const std::string& law) {
  return formatted(
             "-mesh_file meshes/patch_%dd.geo -elasticity_incompatible_modes quad4,hex8 "
             "-material_body_density 1 ",
             dimension) +
         (set.empty() ? "" : "-mesh_set " + set + " ") + law;
}

/// The energy of u = ε x on the unit square or cube is σ:ε.
void expectEnergy(const std::string& options, const Matrix& stress, const Matrix& axes) {
  const auto [mesh, bodies] = test::buildBodies(
      options + formatted("-material_body_orientation %.17g,%.17g,%.17g,%.17g,%.17g,%.17g ",
                          2 * axes[0][0], 2 * axes[0][1], 2 * axes[0][2],
                          axes[1][0] - 0.3 * axes[0][0], axes[1][1] - 0.3 * axes[0][1],
                          axes[1][2] - 0.3 * axes[0][2]));
  const Matrix strain = strainOf(stress), e = toMesh(strain, axes);
  const auto u = test::nodalField(mesh, [&](const Point& x) {
    Point value{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < static_cast<std::size_t>(mesh.dimension); ++j)
        value[i] += e[i][j] * x[j];
    return value;
  });
  const double energy = product(stress, strain);
  EXPECT_NEAR(form(u, bodies.stiffness, u), energy, 1e-12 * energy) << options;
}

// Each axis of the material in turn is normal to the plane, the others are turned by 0.4.
TEST(Orthotropy, EnergyOfAffineDisplacementsInThePlane) {
  const double c = std::cos(0.4), s = std::sin(0.4);
  for (std::size_t normal = 0; normal < 3; ++normal)
    for (const std::string plane : {"strain", "stress"})
      for (const char* set : {"", "order=2,recombine=0"}) {
        SCOPED_TRACE(formatted("normal %d, plane %s", static_cast<int>(normal), plane.c_str()));
        const std::size_t a = (normal + 1) % 3, b = (normal + 2) % 3;
        Matrix axes{}, stress{};
        axes[normal] = {0, 0, 1}, axes[a] = {c, s, 0}, axes[b] = {-s, c, 0};
        stress[a][a] = 0.7, stress[b][b] = -0.5, stress[a][b] = stress[b][a] = 0.9;
        if (plane == "strain") {  // the stress across the plane that undoes the strain across it
          Matrix one{};
          one[normal][normal] = 1;
          stress[normal][normal] =
              -strainOf(stress)[normal][normal] / strainOf(one)[normal][normal];
        }
        expectEnergy(patch(2, set, orthotropic + "-elasticity_plane " + plane + " "), stress, axes);
      }
}

// Rotation by 0.7 about (1, 2, 2)/3.
Matrix turnedAxes() {
  const double k[] = {1.0 / 3, 2.0 / 3, 2.0 / 3}, c = std::cos(0.7), s = std::sin(0.7);
  return {{{c + (1 - c) * k[0] * k[0], (1 - c) * k[0] * k[1] + s * k[2],
            (1 - c) * k[0] * k[2] - s * k[1]},
           {(1 - c) * k[1] * k[0] - s * k[2], c + (1 - c) * k[1] * k[1],
            (1 - c) * k[1] * k[2] + s * k[0]},
           {(1 - c) * k[2] * k[0] + s * k[1], (1 - c) * k[2] * k[1] - s * k[0],
            c + (1 - c) * k[2] * k[2]}}};
}

TEST(Orthotropy, EnergyOfAffineDisplacementsInSpace) {
  const Matrix stress{{{0.7, -0.4, 0.9}, {-0.4, 1.1, 0.6}, {0.9, 0.6, -0.5}}};
  for (const char* set : {"", "order=2", "recombine=0", "recombine=0,order=2"})
    expectEnergy(patch(3, set, orthotropic), stress, turnedAxes());
}

void expectSameStiffness(const std::string& one, const std::string& other) {
  const auto a = test::denseCopy(test::buildBodies(one).bodies.stiffness),
             b = test::denseCopy(test::buildBodies(other).bodies.stiffness);
  EXPECT_LT(test::largestDifference(a, b), 1e-13 * test::largestEntry(a)) << one << " / " << other;
}

TEST(Orthotropy, IsotropicLawAsEngineeringConstants) {
  const std::string isotropic = "-material_body_young 2 -material_body_poisson 0.25 ",
                    constants =
                        "-material_body_engineering_constants 2,2,2,0.25,0.25,0.25,0.8,0.8,0.8 ",
                    turned = "-material_body_orientation 1,2,0.5,-1,0.3,2 ",
                    cylindrical = "-material_body_cylindrical 0.1,0.2,0,1,2,3 ";
  expectSameStiffness(patch(3, "", isotropic), patch(3, "", constants));
  expectSameStiffness(patch(3, "", isotropic), patch(3, "", constants + turned));
  expectSameStiffness(patch(3, "order=2", isotropic), patch(3, "order=2", constants + cylindrical));
  for (const std::string plane : {"-elasticity_plane strain ", "-elasticity_plane stress "})
    expectSameStiffness(patch(2, "", isotropic + plane), patch(2, "", constants + plane + turned));
}

TEST(Orthotropy, TransverseIsotropyAsEngineeringConstants) {
  const std::string transverse = "-material_body_transverse 3,0.8,0.3,0.4,0.6 ",
                    turned = "-material_body_orientation 1,2,0.5,-1,0.3,2 ";
  expectSameStiffness(
      patch(3, "", transverse + turned),
      patch(3, "",
            formatted("-material_body_engineering_constants 3,3,0.8,0.3,0.4,0.4,%.17g,0.6,0.6 ",
                      3 / 2.6) +
                turned));
  // Isotropic in the plane 1-2: turning that plane about axis 3 changes nothing.
  expectSameStiffness(
      patch(3, "", transverse),
      patch(3, "", transverse + "-material_body_orientation 0.6,0.8,0,-0.8,0.6,0 "));
}

// u = x e_x stretches radially by cos², tangentially by sin², and shears by −2 sin cos: the mean of
// its energy over all directions is 3/8 (D11 + D22) + 1/4 D12 + 1/2 D66. On 12 equal sectors the
// sum over quadrature points is the exact mean, harmonics being of order 4 at most.
// Linear cells of a nearly incompressible body lock.
TEST(Incompressible, LinearCellsAreToldWithTheRatio) {
  const auto warning = [](const std::string& material, const std::string& more) {
    return test::warningsOf([&] {
      test::buildBodies("-mesh_file meshes/beam.geo -mesh_set nx=2,ny=1,nz=1" + more +
                        " -material_beam_density 1 " + material);
    });
  };
  const std::string rubber = "-material_beam_young 1 -material_beam_poisson 0.4999",
                    modes = " -elasticity_incompatible_modes ";
  EXPECT_EQ(warning(rubber, modes + "none"),
            "squeal: warning: body 'beam', with a Poisson's ratio of 0.4999, has 2 linear cells, "
            "which lock above 0.49: use a mesh of second order\n");
  EXPECT_EQ(warning(rubber, modes + "hex8"), "");
  EXPECT_EQ(warning(rubber, ",order=2"), "");
  EXPECT_EQ(warning("-material_beam_young 1 -material_beam_poisson 0.49", modes + "none"), "");
  const std::string orthotropic =
      "-material_beam_engineering_constants 1,1,1,0.4999,0.4999,0.4999,0.3334,0.3334,0.3334";
  EXPECT_TRUE(test::contains(warning(orthotropic, modes + "none"), "a Poisson's ratio of 0.4999"));
}

TEST(Orthotropy, CylindricalAxesOnARing) {
  const auto [d11, d22, d12] = exact::orthotropic::planeStrain();
  const double stretch = 3.0 / 8 * (d11 + d22) + d12 / 4 + g12 / 2, swelling = d11 + d22 + 2 * d12;
  const std::string axes = "-material_body_cylindrical 0,0,0.3,0,0,2 ";
  const auto rename = [](std::string options, const std::string& body) {
    for (auto at = options.find("body"); at != std::string::npos; at = options.find("body"))
      options.replace(at, 4, body);
    return options;
  };
  const std::string density = "-material_body_density 1 ", law = orthotropic + axes + density;
  const auto check = [&](const std::string& options, double volume) {
    const auto [mesh, bodies] = test::buildBodies(options);
    const auto alongX = test::nodalField(mesh, [](const Point& x) { return Point{x[0], 0, 0}; });
    const auto outwards = test::nodalField(mesh, [](const Point& x) {
      return Point{x[0], x[1], 0};
    });
    EXPECT_NEAR(form(alongX, bodies.stiffness, alongX), stretch * volume, 1e-12 * stretch * volume)
        << options;
    EXPECT_NEAR(form(outwards, bodies.stiffness, outwards), swelling * volume,
                1e-12 * swelling * volume)
        << options;
  };
  const double sector = std::sin(2 * M_PI / 12) / 2;  // area of a triangle of unit sides
  check(
      "-mesh_file meshes/cylinders.geo -mesh_set "
      "a=0.5,b=0.8,c=1.2,n_inner=2,n_outer=2,n_theta=12 " +
          rename(law, "inner") + rename(law, "outer"),
      12 * sector * (1.2 * 1.2 - 0.5 * 0.5));
  check(
      "-mesh_file meshes/ring.geo -mesh_set R=1,thickness=0.4,width=0.3,n_theta=12 "
      "-elasticity_incompatible_modes none " +
          rename(law, "ring"),
      12 * sector * (1.2 * 1.2 - 0.8 * 0.8) * 0.3);
}

TEST(Orthotropy, RejectsWhatIsNoLaw) {
  const auto message = [](const std::string& law) {
    return test::errorOf([&] { test::buildBodies(patch(2, "", law)); });
  };
  const auto expect = [&](const std::string& law, const std::string& part) {
    EXPECT_TRUE(test::contains(message(law), part)) << law << ": " << message(law);
  };
  ASSERT_EQ(message(orthotropic), "");
  expect(orthotropic + "-material_body_young 1", "-material_body_young exclude each other");
  expect(orthotropic + "-material_body_transverse 1,1,0.3,0.3,1",
         "-material_body_transverse exclude each other");
  expect("-material_body_engineering_constants 1,1,1,0.3,0.3,0.3,1,1", "9 numbers");
  expect("-material_body_transverse 1,1,0.3,0.3", "5 numbers");
  expect("-material_body_engineering_constants 1,1,1,0.3,0.3,0.3,1,1,0", "all moduli must be > 0");
  expect("-material_body_engineering_constants 1,4,1,0.6,0.3,0.3,1,1,1",
         "|nu12| must be < sqrt(E1/E2)");
  expect("-material_body_engineering_constants 1,1,1,0.6,0.6,0.6,1,1,1",
         "-material_body_engineering_constants: the strain energy");
  expect("-material_body_transverse 1,1,0.3,1.2,1", "|nu13|");
  expect("-material_body_young 1 -material_body_poisson 0.3 -material_body_orientation 1,0,0,0,1,0",
         "needs -material_body_engineering");
  expect(orthotropic + "-material_body_orientation 1,0,0,-2,0,0", "parallel");
  expect(orthotropic + "-material_body_orientation 1,0,1,0,1,0", "normal to the plane");
  expect(orthotropic + "-material_body_cylindrical 0,0,0,1,0,0", "must be 0,0,1");
  expect(orthotropic + "-material_body_cylindrical 0,0,0,0,0,0", "no length");
  expect(
      orthotropic + "-material_body_orientation 1,0,0,0,1,0 -material_body_cylindrical 0,0,0,0,0,1",
      "exclude each other");
  expect(orthotropic + "-material_other_orientation 1,0,0,0,1,0", "-material_other_young");
}

}  // namespace
}  // namespace squeal
