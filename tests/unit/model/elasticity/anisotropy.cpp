// SPDX-License-Identifier: BSD-2-Clause
// Bodies with a given stiffness matrix: the same law in two ways, frequencies of another program,
// and matrices that are refused.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/system/text.hpp"
#include "exact/orthotropic.hpp"
#include "model/material/hooke.hpp"
#include "support/algebra/dense.hpp"
#include "support/harness/messages.hpp"
#include "support/model/box_frequencies.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using mesh::Point;
using test::form;

// Positive definite and without symmetry, Pa; the nine constants are those of its orthotropic part.
const std::string
    general =
        "2.05e11,6e10,1.5e11,5.5e10,4.5e10,1.2e11,1.2e10,-9e9,7e9,4.8e10,-8e9,5e9,1.1e10,4e9,"
        "4e10,6e9,1.4e10,-1e10,-3e9,6e9,3.6e10",
    orthotropic = "2.05e11,6e10,1.5e11,5.5e10,4.5e10,1.2e11,4.8e10,4e10,3.6e10",
    turned = " -material_beam_orientation 1,0.5,0.2,-0.3,1,0.4 ",
    density = " -material_beam_density 7850 ";

// CalculiX 2.20, *ELASTIC, TYPE=ANISO and TYPE=ORTHO with *ORIENTATION 1,0.5,0.2,-0.3,1,0.4:
// eigenvalues of the stiffness of C3D20 or C3D20R and the mass of C3D20 that it writes with
// *FREQUENCY, SOLVER=MATRIXSTORAGE.
TEST(Anisotropy, FrequenciesOfABoxAreThoseOfCalculiX) {
  const std::string reduced = " -material_beam_integration reduced ",
                    anisotropicBox = "-material_beam_anisotropic " + general + turned + density,
                    orthotropicBox = "-material_beam_orthotropic " + orthotropic + turned + density;
  test::expectFrequencies(anisotropicBox, {1269.221582, 2373.525521, 4808.180535, 6565.010290,
                                           9752.818121, 10660.930276, 14261.701912, 15588.234401});
  test::expectFrequencies(anisotropicBox + reduced,
                          {1262.275366, 2361.244687, 4772.651748, 6507.006388, 9720.539760,
                           10619.265221, 14124.486213, 15396.895210});
  test::expectFrequencies(orthotropicBox, {1365.832237, 2515.780129, 4872.059309, 7165.652863,
                                           10304.499813, 11075.195014, 14585.604637, 17082.747476});
  test::expectFrequencies(orthotropicBox + reduced,
                          {1359.664825, 2505.844261, 4836.198672, 7117.863810, 10275.682644,
                           11044.697928, 14461.045198, 16930.905441});
}

/// The indices of the rows of the constants.
constexpr std::size_t first[] = {0, 1, 2, 0, 0, 1}, second[] = {0, 1, 2, 1, 2, 2};

/// The law of exact/orthotropic.hpp in its axes, C[i][j][k][l].
double component(std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
  using namespace exact::orthotropic;
  const auto hooke = material::orthotropic({e1, e2, e3, nu12, nu13, nu23, g12, g13, g23});
  if (i == j && k == l) return hooke(int(i), int(k));
  if (i == j || k == l || i + j != k + l) return 0;
  return i + j == 1 ? g12 : i + j == 2 ? g13 : g23;
}

/// Returns the 21 constants of that law in axes with which the material's have the components
/// `axes`, C'_abcd = Q_ia Q_jb Q_kc Q_ld C_ijkl.
std::string turnedConstants(const material::Axes& axes) {
  std::vector<std::string> words;
  for (std::size_t column = 0; column < 6; ++column)
    for (std::size_t row = 0; row <= column; ++row) {
      double sum = 0;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t l = 0; l < 3; ++l)
              sum += axes[i][first[row]] * axes[j][second[row]] * axes[k][first[column]] *
                     axes[l][second[column]] * component(i, j, k, l);
      words.push_back(formatted("%.17g", sum));
    }
  return joined(words, ",");
}

// Rotation by 0.7 about (1, 2, 2)/3.
material::Axes rotation() {
  const double n[] = {1.0 / 3, 2.0 / 3, 2.0 / 3}, c = std::cos(0.7), s = std::sin(0.7);
  material::Axes axes{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      axes[i][j] = (i == j ? c : 0) + (1 - c) * n[i] * n[j];
      if (i != j) axes[i][j] += ((j + 3 - i) % 3 == 1 ? s : -s) * n[3 - i - j];
    }
  return axes;
}

TEST(Anisotropy, TurnedTensorIsTheOrthotropicOneWithTurnedAxes) {
  const auto axes = rotation();
  const std::string box =
      "-mesh_file meshes/beam.geo -mesh_set "
      "order=2,serendipity=1,Lx=1,Ly=0.9,Lz=0.8,nx=1,ny=2,nz=1 -constraint_clamped_clamped xyz "
      "-material_beam_density 1 ";
  const auto one = test::frequenciesOf(
      test::buildBodies(box + "-material_beam_anisotropic " + turnedConstants(axes)));
  const auto other = test::frequenciesOf(test::buildBodies(
      box + "-material_beam_engineering_constants " + exact::orthotropic::constants +
      formatted(" -material_beam_orientation %.17g,%.17g,%.17g,%.17g,%.17g,%.17g", axes[0][0],
                axes[0][1], axes[0][2], axes[1][0], axes[1][1], axes[1][2])));
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(one[i] / other[i], 1, 1e-12) << i;
}

std::string patch(int dimension, const std::string& law) {
  return formatted("-mesh_file meshes/patch_%dd.geo -material_body_density 1 ", dimension) + law;
}

void expectSameStiffness(const std::string& one, const std::string& other) {
  const auto a = test::denseCopy(test::buildBodies(one).bodies.stiffness),
             b = test::denseCopy(test::buildBodies(other).bodies.stiffness);
  EXPECT_LT(test::largestDifference(a, b), 1e-13 * test::largestEntry(a)) << one << " / " << other;
}

/// Returns the nine constants of exact/orthotropic.hpp.
std::string nineConstants() {
  std::vector<std::string> words;
  for (std::size_t column = 0; column < 3; ++column)
    for (std::size_t row = 0; row <= column; ++row)
      words.push_back(formatted("%.17g", component(row, row, column, column)));
  for (std::size_t row = 3; row < 6; ++row)
    words.push_back(
        formatted("%.17g", component(first[row], second[row], first[row], second[row])));
  return joined(words, ",");
}

TEST(Anisotropy, MatrixIsTheSameAsEngineeringConstants) {
  const std::string engineering = formatted("-material_body_engineering_constants %s",
                                            exact::orthotropic::constants),
                    nine = "-material_body_orthotropic " + nineConstants(),
                    all = "-material_body_anisotropic " +
                          turnedConstants({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}),
                    inSpace = " -material_body_orientation 1,2,0.5,-1,0.3,2 ",
                    around = " -material_body_cylindrical 0.1,0.2,0,1,2,3 ",
                    inPlane = " -material_body_orientation 1,2,0,-1,0.3,0 ",
                    ring = " -material_body_cylindrical 0.1,-0.2,0,0,0,1 ";
  for (const auto& matrix : {nine, all}) {
    for (const auto& axes : {std::string(), inSpace, around})
      expectSameStiffness(patch(3, engineering + axes), patch(3, matrix + axes));
    for (const auto& axes : {std::string(), inPlane, ring})
      for (const std::string plane : {" -elasticity_plane strain", " -elasticity_plane stress"})
        expectSameStiffness(patch(2, engineering + axes + plane), patch(2, matrix + axes + plane));
  }
}

// A monoclinic material, symmetric about the plane: D1112, D2212, D3312 and D1323 are not zero. The
// energy of u = ε x on the unit square is ε:D:ε, with the least ε_zz energy in plane stress.
TEST(Anisotropy, MonoclinicEnergyInThePlane) {
  const std::string law =
      "-material_body_anisotropic 5,1,4,1.5,0.7,3,0.6,-0.4,0.3,2,0,0,0,0,1.5,0,"
      "0,0,0,0.2,1.2 ";
  const double e[] = {0.7, -0.5, 0.9};  // xx, yy, xy
  const double inPlane = 5 * e[0] * e[0] + 4 * e[1] * e[1] + 2 * e[2] * e[2] +
                         2 * (1 * e[0] * e[1] + 0.6 * e[0] * e[2] - 0.4 * e[1] * e[2]),
               across = 1.5 * e[0] + 0.7 * e[1] + 0.3 * e[2];
  for (const auto& [plane, energy] :
       {std::pair{"strain", inPlane}, {"stress", inPlane - across * across / 3}}) {
    const auto [mesh, bodies] = test::buildBodies(patch(2, law + "-elasticity_plane " + plane));
    const auto u = test::nodalField(mesh, [&](const Point& x) {
      return Point{e[0] * x[0] + e[2] / 2 * x[1], e[2] / 2 * x[0] + e[1] * x[1], 0};
    });
    EXPECT_NEAR(form(u, bodies.stiffness, u), energy, 1e-12 * energy) << plane;
  }
}

// The mean moduli do not depend on the axes of the constants.
TEST(Anisotropy, NearlyIncompressibleBodiesAreReportedInAnyAxes) {
  const auto warning = [](const std::string& law) {
    return test::warningsOf([&] {
      test::buildBodies(
          "-mesh_file meshes/beam.geo -mesh_set nx=2,ny=1,nz=1 -material_beam_density 1 "
          "-elasticity_incompatible_modes none " +
          law);
    });
  };
  const auto expected = warning("-material_beam_young 1 -material_beam_poisson 0.4999");
  EXPECT_TRUE(test::contains(expected, "a Poisson's ratio of 0.4999"));
  const auto hooke = material::isotropic(1, 0.4999, 3, false);
  const double a = hooke(0, 0), b = hooke(0, 1), g = hooke(3, 3);
  EXPECT_EQ(warning("-material_beam_orthotropic " +
                    formatted("%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g", a, b, a, b,
                              b, a, g, g, g)),
            expected);
}

TEST(Anisotropy, RejectsWhatIsNoLaw) {
  const auto message = [](int dimension, const std::string& law) {
    return test::errorOf([&] { test::buildBodies(patch(dimension, law)); });
  };
  const auto expect = [&](const std::string& law, const std::string& part, int dimension = 3) {
    EXPECT_TRUE(test::contains(message(dimension, law), part))
        << law << ": " << message(dimension, law);
  };
  const std::string nine = "-material_body_orthotropic ", all = "-material_body_anisotropic ",
                    good = nine + "3,1,3,1,1,3,1,1,1 ", every = all + general + " ";
  ASSERT_EQ(message(3, good), "");
  ASSERT_EQ(message(3, every), "");
  // Numbers.
  expect(nine + "3,1,3,1,1,3,1,1",
         "option -material_body_orthotropic: 9 numbers are required, 8 are given");
  expect(all + "3,1,3,1,1,3,1,1,1",
         "option -material_body_anisotropic: 21 numbers are required, 9 are given");
  // Positive energy.
  expect(nine + "3,1,0,1,1,3,1,1,1",
         "option -material_body_orthotropic: the strain energy is not positive for every strain: "
         "D2222 must be > 0");
  expect(nine + "3,1,3,1,1,3,1,0,1", "D1313 must be > 0");
  expect(nine + "3,3,3,1,1,3,1,1,1", "first 2 rows and columns");
  expect(nine + "3,-1.5,3,-1.5,-1.5,3,1,1,1", "first 3 rows and columns");
  expect(all + "3,1,3,1,1,3,0,0,0,1,0,0,0,1,1,0,0,0,0,0,1", "first 5 rows and columns");
  expect(all + "3,1,3,1,1,3,0,0,0,1,0,0,0,0,1,2,0,0,0,0,1",
         "option -material_body_anisotropic: the strain energy is not positive for every strain: "
         "the determinant of the first 6 rows");
  // Two laws.
  for (const std::string other : {"-material_body_young 1", "-material_body_poisson 0.3",
                                  "-material_body_transverse 1,1,0,0,1",
                                  "-material_body_engineering_constants 1,1,1,0.3,0.3,0.3,1,1,1"}) {
    expect(good + other, "exclude each other");
    expect(every + other, "exclude each other");
  }
  expect(good + every,
         "options -material_body_orthotropic and -material_body_anisotropic exclude each other");
  // Axes without such a law, and a plane that the material couples with the strains across it.
  expect("-material_body_young 1 -material_body_poisson 0.3 -material_body_orientation 1,0,0,0,1,0",
         "_orthotropic or _anisotropic");
  expect(every, "option -material_body_anisotropic: the material must be symmetric about the plane",
         2);
  expect(every + "-material_body_cylindrical 0,0,0,0,0,1",
         "option -material_body_anisotropic: the material must be symmetric about the plane", 2);
  expect(nine + "3,1,4,1,1,3,1,1,1 -material_body_orientation 1,0,1,0,1,1", "normal to the plane",
         2);
  // A law without a density, and a density without a law.
  EXPECT_TRUE(test::contains(test::errorOf([&] {
                               test::setOptions("-material_body_orthotropic 3,1,3,1,1,3,1,1,1");
                               material::Settings::given();
                             }),
                             "-material_body_density"));
  EXPECT_TRUE(test::contains(test::errorOf([] {
                               test::setOptions("-material_body_density 1");
                               material::Settings::given();
                             }),
                             "_orthotropic, _anisotropic"));
}

}  // namespace
}  // namespace squeal
