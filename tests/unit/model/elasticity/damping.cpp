// SPDX-License-Identifier: BSD-2-Clause
// C of the materials, springs and dashpots to the ground.
#include <gtest/gtest.h>
#include <petscsys.h>  // before the next header, which needs it

#include <petscblaslapack.h>

#include <cmath>

#include "model/elasticity/elasticity.hpp"
#include "support/algebra/dense.hpp"
#include "support/harness/largest_error.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

/// Two layers: bodies disc and pad, one of them damped or none.
std::string layers(const std::string& more) {
  return "-mesh_file meshes/two_layers.geo -mesh_set nx=4,ny_disc=2,ny_pad=2,recombine=0" +
         test::material("disc", "2", "0.3", "1.5") + test::material("pad", "3", "0.2", "0.7") +
         more;
}

/// Largest entry of C − α M − β K, relative to that of C.
double deviation(Mat damping, Mat mass, double alpha, Mat stiffness, double beta) {
  const auto c = test::denseCopy(damping);
  auto rest = c;
  linalg::addScaled(rest, -alpha, test::denseCopy(mass));
  linalg::addScaled(rest, -beta, test::denseCopy(stiffness));
  return test::largestEntry(rest) / test::largestEntry(c);
}

constexpr double rounding = 1e-14;

TEST(Damping, RayleighPerBody) {
  const auto [mesh, bodies] = test::buildBodies(
      layers("-material_disc_rayleigh_mass 0.7 -material_disc_rayleigh_stiffness 0.02 "
             "-material_pad_rayleigh_mass 0.7 -material_pad_rayleigh_stiffness 0.02"));
  EXPECT_LT(deviation(bodies.damping, bodies.mass, 0.7, bodies.stiffness, 0.02), rounding);
  // One body alone: the other one moves without resistance.
  const auto [sameMesh, one] = test::buildBodies(
      layers("-material_disc_rayleigh_mass 0.7 -material_disc_rayleigh_stiffness 0.02"));
  const auto stretch = [&](bool disc) {  // the layers do not share nodes: y < 0 is the disc, and a
                                         // field linear in |y| vanishes at y = 0
    return test::nodalField(sameMesh, [&](const mesh::Point& x) {
      return mesh::Point{0, (x[1] < 0) == disc ? x[1] : 0.0, 0};
    });
  };
  EXPECT_EQ(test::form(stretch(false), one.damping, stretch(false)), 0);
  const auto u = stretch(true);
  const double expected = 0.7 * test::form(u, one.mass, u) + 0.02 * test::form(u, one.stiffness, u);
  EXPECT_NEAR(test::form(u, one.damping, u), expected, rounding * expected);
}

TEST(Damping, LossFactorIsExactAtItsFrequency) {
  const auto [mesh, bodies] =
      test::buildBodies(layers("-material_disc_loss_factor 0.1 -material_disc_loss_frequency 50 "
                               "-material_pad_loss_factor 0.2 -material_pad_loss_frequency 100"));
  EXPECT_LT(deviation(bodies.damping, bodies.mass, 0, bodies.stiffness, 0.1 / (2 * M_PI * 50)),
            rounding);
}

TEST(Damping, IsEmptyIfNothingDamps) {
  EXPECT_FALSE(test::buildBodies(layers("")).bodies.damping);
  EXPECT_FALSE(
      test::buildBodies(layers("-material_pad_rayleigh_mass 0 -ground_pad_top_damping 0,0"))
          .bodies.damping);
  EXPECT_FALSE(test::buildBodies(layers("")).bodies.springs);
}

TEST(Damping, RejectsWhatIsIncomplete) {
  EXPECT_TRUE(test::contains(
      test::errorOf([] { test::buildBodies(layers("-material_pad_loss_factor 0.1")); }),
      "-material_pad_loss_frequency"));
  EXPECT_TRUE(test::contains(
      test::errorOf([] { test::buildBodies(layers("-material_pad_loss_frequency 10")); }),
      "-material_pad_loss_factor"));
  EXPECT_TRUE(test::contains(
      test::errorOf([] { test::buildBodies(layers("-material_pas_rayleigh_mass 1")); }),
      "-material_pas_young"));
  EXPECT_TRUE(test::contains(
      test::errorOf([] { test::buildBodies(layers("-material_pad_rayleigh_mass -1")); }), ">= 0"));
  EXPECT_TRUE(test::contains(
      test::errorOf([] { test::buildBodies(layers("-ground_pad_top_stiffness 1,-1")); }), ">= 0"));
  EXPECT_TRUE(
      test::contains(test::errorOf([] { test::buildBodies(layers("-ground_pad_top_damping 1")); }),
                     "2 components"));
  EXPECT_TRUE(test::contains(
      test::errorOf([] { test::buildBodies(layers("-ground_nowhere_stiffness 1,1")); }),
      "nowhere"));
}

TEST(Ground, IsSharedByTheNodesOfTheGroup) {
  const auto [mesh, bodies] =
      test::buildBodies(layers("-ground_pad_top_stiffness 5,7 -ground_pad_top_damping 0.5,0.25"));
  const auto [sameMesh, free] = test::buildBodies(layers(""));
  auto k = test::denseCopy(bodies.stiffness);
  const auto c = test::denseCopy(bodies.damping), k0 = test::denseCopy(free.stiffness);
  const auto springs = test::denseCopy(bodies.springs);
  linalg::addScaled(k, -1, k0);
  int supported = 0;
  for (PetscInt i = 0; i < k.rows(); ++i)
    for (PetscInt j = 0; j < k.rows(); ++j) {
      const bool grounded = i == j && springs(i, i) > 0;
      supported += grounded;
      EXPECT_NEAR(k(i, j),
                  !grounded ? 0.0
                  : i % 2   ? 7.0 / 5
                            : 1.0,
                  1e-14 * test::largestEntry(k0));  // 5 nodes
      EXPECT_EQ(c(i, j), !grounded ? 0.0 : i % 2 ? 0.25 / 5 : 0.1);
    }
  EXPECT_EQ(supported, 10);
}

// A periodic image is its primary: the total remains that of the options.
TEST(Ground, CountsImagesOnce) {
  const auto [mesh, bodies] = test::buildBodies(
      layers("-constraint_pad_right_image_of pad_left -ground_pad_top_stiffness 5,7"));
  double sum = 0;
  const auto springs = test::denseCopy(bodies.springs);
  for (PetscInt i = 0; i < springs.rows(); ++i) sum += springs(i, i);
  EXPECT_NEAR(sum, 12, 1e-14 * 12);
}

/// Angular frequencies of K u = ω² M u.
std::vector<double> frequencies(const elasticity::Bodies& bodies) {
  auto k = test::denseCopy(bodies.stiffness), m = test::denseCopy(bodies.mass);
  PetscBLASInt type = 1, n = k.rows(), length = 40 * n, info = 0;
  std::vector<double> values(n), work(length);
  LAPACKsygv_(&type, "N", "U", &n, k.data(), &n, m.data(), &n, values.data(), work.data(), &length,
              &info);
  EXPECT_EQ(info, 0);
  for (auto& value : values) value = std::sqrt(std::max(value, 0.0));
  return values;
}

// A block on soft springs at both ends is held, and rides on them as a rigid mass: ω = √(k/m) in
// each direction, ω = √(3 k/m) about each axis, as the corners lie √3 radii of gyration from it.
// Its own elasticity is in series: relative error O(k / E L).
TEST(Ground, CarriesABlockOnSprings) {
  constexpr double k = 2e-7, mass = 3.0;
  const std::string
      block = "-mesh_file meshes/beam.geo -mesh_set Lx=1,Ly=1,Lz=1,nx=2,ny=1,nz=1" +
              test::material("beam", "1", "0.3", "3"),
      springs = "-ground_clamped_stiffness 1e-7,1e-7,1e-7 -ground_tip_stiffness 1e-7,1e-7,1e-7";
  test::setOptions(block);
  EXPECT_TRUE(test::contains(test::errorOf([] { test::buildModel(); }), "'beam' can move rigidly"));
  test::setOptions(block + "-ground_clamped_stiffness 1e-7,0,0 -ground_tip_stiffness 1e-7,0,0");
  EXPECT_TRUE(test::contains(test::errorOf([] { test::buildModel(); }), "'beam' can move rigidly"));
  test::setOptions(block + springs);
  ASSERT_EQ(test::errorOf([] { test::buildModel(); }), "");
  const auto found = frequencies(test::buildBodies(block + springs).bodies);
  for (std::size_t i = 0; i < 6; ++i) {
    const double expected = std::sqrt((i < 3 ? 1 : 3) * k / mass);
    EXPECT_NEAR(found[i], expected, 1e-6 * expected);
  }
  EXPECT_GT(found[6], 0.1);  // the first elastic mode, of the order of √(E / ρ) / L
}

}  // namespace
}  // namespace squeal
