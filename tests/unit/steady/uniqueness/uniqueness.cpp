// SPDX-License-Identifier: BSD-2-Clause
// Existence and uniqueness of the steady sliding state: the condensed matrix A(f) of the contact,
// and what is concluded from it.
#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <cmath>

#include <gtest/gtest.h>

#include "model/contact/coupled.hpp"
#include "model/mesh/mesh.hpp"
#include "model/mesh/read.hpp"
#include "steady/uniqueness/compliance.hpp"
#include "steady/uniqueness/uniqueness.hpp"
#include "support/algebra/dense.hpp"
#include "support/algebra/minors.hpp"
#include "support/harness/largest_error.hpp"
#include "support/harness/ranks.hpp"
#include "support/model/contact_cases.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using test::contains;
using test::errorOf;
using test::Model;
using test::square;
using test::contact_cases::layers;

// --- the condensed matrix ---

const std::string cylinders =
    "-mesh_file meshes/cylinders.geo -mesh_set n_inner=2,n_outer=2,n_theta=16,order=2 "
    "-motion_inner_speed 2" +
    test::material("inner", "1", "0.3", "1") + test::material("outer", "0.3", "0.2", "1") +
    "-contact_ring_pad outer_face -contact_ring_disc inner_face -constraint_sym_x_clamped x "
    "-constraint_sym_y_clamped y ";
/// Two slabs that slide obliquely: both tangential directions take part.
const std::string slabs =
    "-mesh_file meshes/two_slabs.geo -mesh_set nx=3,ny_disc=2,ny_pad=2,nz=2,depth=1.3 "
    "-motion_disc_velocity 1,0,-2" +
    test::material("disc", "1", "0.3", "1") + test::material("pad", "0.4", "0.25", "1") +
    "-constraint_disc_bottom_clamped xyz -constraint_pad_top_clamped xyz -contact_face_pad "
    "pad_face -contact_face_disc disc_face "
    "-constraint_disc_right_image_of disc_left -constraint_pad_right_image_of pad_left ";
/// A block clamped at its foot under a sliding plate.
std::string block(int nx, int ny) {
  return "-mesh_file meshes/layer.geo -mesh_set Lx=0.5,nx=" + std::to_string(nx) +
         ",ny=" + std::to_string(ny) + test::material("layer", "1e9", "0.3", "1000") +
         "-constraint_bottom_clamped xy -contact_plate_pad top -contact_plate_obstacle_velocity "
         "1,0,0 ";
}

uniqueness::Compliance complianceOf(const Model& model) {
  return uniqueness::OpenContact(model.contact, model.bodies.stiffness,
                                 model.contact.slip(1, nullptr))
      .dense();
}

uniqueness::Uniqueness examined(const Model& model, const std::vector<double>& frictions) {
  return uniqueness::examine(model.bodies, model.contact, 1, frictions,
                             uniqueness::Settings::given());
}

/// All gaps unknown, all nodes sliding.
struct Coupled {
  contact::Transformation transformation;
  OwnedMat k0, k1;
};

Coupled coupledOf(const Model& model) {
  const std::vector<unsigned char> all(model.contact.interfaces.nodes.size(), 1);
  Coupled coupled{model.contact.transformation(contact::ActiveSet::open(all.size())), {}, {}};
  auto stiffness = contact::project(model.contact, coupled.transformation, model.bodies.stiffness);
  coupled.k1 = stiffness.friction(
      model.contact.slipRows(coupled.transformation, model.contact.slip(1, nullptr), all, 1));
  coupled.k0 = std::move(stiffness.matrix);
  return coupled;
}

/// X of A X = B by LAPACK.
linalg::DenseMatrix solved(linalg::DenseMatrix a, linalg::DenseMatrix b) {
  PetscBLASInt n = a.rows(), columns = b.columns(), info = 0;
  std::vector<PetscBLASInt> pivots(n);
  LAPACKgesv_(&n, &columns, a.data(), &n, pivots.data(), b.data(), &n, &info);
  EXPECT_EQ(info, 0);
  return b;
}

/// The gap block of the inverse of L(f)ᵀ K T, all entries at once: no symmetry used, and none of
/// K_o, e and U.
linalg::DenseMatrix gapBlock(const Coupled& coupled, double friction) {
  const auto gaps = test::gathered(coupled.transformation.gapColumn, MPIU_INT);
  OwnedMat jacobian;
  check(MatDuplicate(coupled.k0, MAT_COPY_VALUES, jacobian.out()));
  check(MatAXPY(jacobian, friction, coupled.k1, SUBSET_NONZERO_PATTERN));
  const auto full = test::denseCopy(jacobian);
  const PetscInt count = std::ssize(gaps);
  linalg::DenseMatrix units(full.rows(), count), result(count, count);
  for (PetscInt j = 0; j < count; ++j) units(gaps[j], j) = 1;
  const auto columns = solved(full, units);
  for (PetscInt j = 0; j < count; ++j)
    for (PetscInt i = 0; i < count; ++i) result(i, j) = columns(gaps[i], j);
  return result;
}

TEST(Condensed, IsTheGapBlockOfTheInverse) {
  const auto layersCase = [] { test::setCase("two_layers", layers); };
  const auto with = [](const std::string& options) {
    return [options] { test::setOptions(options); };
  };
  const std::pair<const char*, std::function<void()>> cases[] = {
      {"layers", layersCase},
      {"cylinders", with(cylinders)},
      {"slabs", with(slabs)},
      {"block", with(block(70, 2))}};  // more than one block of columns
  for (const auto& [name, set] : cases) {
    set();
    const Model model = test::buildModel();
    const auto compliance = complianceOf(model);
    ASSERT_EQ(compliance.a0.rows(), model.contact.interfaces.totalNodes);
    ASSERT_EQ(compliance.a1.rows(), model.contact.interfaces.totalNodes);
    const auto coupled = coupledOf(model);
    double worst = 0;
    for (const double friction : {0.0, 0.3, 1.7}) {
      const auto expected = gapBlock(coupled, friction);
      worst = test::worse(worst, test::largestDifference(compliance.at(friction), expected) /
                                     test::largestEntry(expected));
    }
    // The part of friction is not nothing; both inverses lose digits with the condition of K, below
    // 1e5 here.
    const double a0 = test::largestEntry(compliance.a0), a1 = test::largestEntry(compliance.a1);
    EXPECT_GT(a1, 0.01 * a0);
    EXPECT_LT(worst, 1e-10) << name;
    test::print(
        "%s: %d contact nodes, entries of A(f) differ by %.1e of the largest, |A1| / |A0| %.2f\n",
        name, static_cast<int>(compliance.a0.rows()), worst, a1 / a0);
  }
}

// One contact node. Two unit squares of bilinear cells side by side, clamped below and at the right
// end; the plate slides on the upper side of the left one, whose two nodes are tied. Their
// displacement spreads as φ = 1 + y in the left square and (2 − x)(1 + y) in the right one: ∫φ_x² =
// 1/3, ∫φ_y² = 1 + 1/3, ∫φ_x φ_y = −1/4, so
//   K_xx = (λ+2μ)/3 + 4μ/3,  K_yy = 4(λ+2μ)/3 + μ/3,  K_xy = −(λ+μ)/4.
// n = (0, −1) and τ = −V/|V|. With a = τ_x K_ny = −τ_x K_xy, K_xx u + a g = −f R and a u + K_yy g =
// R give
//   g = A(f) R,  A(f) = (1 + f a / K_xx) / (K_yy − a² / K_xx),
// which vanishes at f* = −K_xx / a, the critical friction of Klarbring (1990), if the plate pushes
// towards the clamped end.
std::string oneNode(double velocity) {
  const auto file = test::writeFile("one_node.geo", R"(
Point(1) = {0, -1, 0}; Point(2) = {1, -1, 0}; Point(3) = {2, -1, 0};
Point(4) = {0, 0, 0}; Point(5) = {1, 0, 0}; Point(6) = {2, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 6}; Line(4) = {6, 5}; Line(5) = {5, 4};
Line(6) = {4, 1}; Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6}; Curve Loop(2) = {2, 3, 4, -7};
Plane Surface(1) = {1}; Plane Surface(2) = {2};
Transfinite Curve {1 : 7} = 2;
Transfinite Surface {1, 2};
Recombine Surface {1, 2};
Physical Point("first") = {4};
Physical Point("second") = {5};
Physical Curve("face") = {5};
Physical Curve("fixed") = {1, 2, 3};
Physical Surface("body") = {1, 2};
)");
  return "-mesh_file " + file + test::material("body", "1", "0.25", "1") +
         "-elasticity_incompatible_modes none -constraint_fixed_clamped xy "
         "-constraint_second_image_of first "
         "-contact_plate_pad face -contact_plate_obstacle_velocity " +
         std::to_string(velocity) + ",0,0 ";
}

TEST(Uniqueness, OneNodeLosesItAtTheKnownFriction) {
  const double lambda = 0.4, mu = 0.4, kxx = (lambda + 6 * mu) / 3, kyy = (4 * lambda + 9 * mu) / 3,
               kxy = -(lambda + mu) / 4;
  const double critical = kxx / -kxy;
  EXPECT_NEAR(critical, 14.0 / 3, 1e-14);
  for (const double velocity : {1.0, -1.0})
    for (const std::string limit : {"1000", "0"}) {
      test::setOptions(oneNode(velocity) + "-steady_uniqueness_dense " + limit);
      const Model model = test::buildModel();
      ASSERT_EQ(model.contact.interfaces.totalNodes, 1);
      const double a = (velocity > 0 ? 1 : -1) * kxy;
      const auto result = examined(model, {0, 0.3, 4.66, 4.67});
      for (const auto& judgement : result.judgements) {
        if (limit == "1000") {
          EXPECT_NEAR(judgement.smallest, (1 + judgement.friction * a / kxx) / (kyy - a * a / kxx),
                      1e-13);
        }
        EXPECT_EQ(judgement.verdict,
                  velocity > 0 && judgement.friction > critical ? "not decided" : "one solution");
      }
      if (velocity > 0)
        EXPECT_NEAR(result.lostAt, critical, 1e-12);
      else
        EXPECT_EQ(result.lostAt, INFINITY);
    }
}

// A strip that looks the same after a turn about z: friction to the left and to the right are one,
// so sym(A1) = 0.
TEST(Uniqueness, LayersNeverLoseIt) {
  test::setCase("two_layers", layers);
  const auto result = examined(test::buildModel(), {0, 0.5, 5});
  EXPECT_EQ(result.lostAt, INFINITY);
  for (const auto& judgement : result.judgements) {
    EXPECT_EQ(judgement.verdict, "one solution") << judgement.reason;
    EXPECT_GT(judgement.smallest, 0);
    EXPECT_NEAR(judgement.smallest / result.judgements[0].smallest, 1, 1e-9);
  }
  test::setCase("two_layers", layers + " -steady_uniqueness_dense 0");
  EXPECT_EQ(examined(test::buildModel(), {5}).lostAt, INFINITY);
}

// The verdicts follow from A(f): all its principal minors, its symmetric part on either side of the
// loss.
TEST(Uniqueness, VerdictsOfABlock) {
  test::setOptions(block(4, 8));
  const Model model = test::buildModel();
  const auto compliance = complianceOf(model);
  const double lost = examined(model, {}).lostAt;
  std::vector<double> frictions = {0, lost * (1 - 1e-6), lost * (1 + 1e-6)};
  for (int i = 1; i <= 20; ++i) frictions.push_back(0.1 * i);
  const auto result = examined(model, frictions);
  ASSERT_EQ(result.judgements.size(), frictions.size());
  EXPECT_GT(result.judgements[1].smallest, 0);
  EXPECT_LT(result.judgements[2].smallest, 0);
  double noLonger = INFINITY;
  for (const auto& judgement : result.judgements) {
    const bool unique = test::smallestMinor(compliance.at(judgement.friction)) > 0;
    EXPECT_EQ(judgement.verdict == "one solution", unique)
        << "friction " << judgement.friction << ": " << judgement.reason;
    EXPECT_EQ(judgement.smallest > 0, judgement.friction < lost);
    if (!unique) noLonger = std::min(noLonger, judgement.friction);
  }
  test::print("block: sym(A) positive definite below friction %.4f, no P-matrix at %.1f\n", lost,
              noLonger);
  EXPECT_LT(lost, noLonger);
  EXPECT_LT(noLonger, 2.1);
}

// A never formed: the same loss, and the verdicts that follow from it.
TEST(Uniqueness, MatrixFreeAgrees) {
  for (const auto& options :
       {block(40, 10), slabs + "-constraint_disc_left_clamped x -constraint_pad_left_clamped x "}) {
    std::vector<uniqueness::Uniqueness> results;
    for (const std::string limit : {"1000", "0"}) {
      test::setOptions(options + "-steady_uniqueness_pmatrix 0 -steady_uniqueness_dense " + limit);
      const Model model = test::buildModel();
      results.push_back(examined(model, {0, 0.2, 0.7, 1.5}));
    }
    test::print("formed: lost at %.10g; matrix-free: %.10g\n", results[0].lostAt,
                results[1].lostAt);
    if (std::isfinite(results[0].lostAt))
      EXPECT_NEAR(results[1].lostAt / results[0].lostAt, 1, 1e-5);
    else
      EXPECT_EQ(results[1].lostAt, INFINITY);
    for (std::size_t i = 0; i < results[0].judgements.size(); ++i) {
      const auto &formed = results[0].judgements[i], &free = results[1].judgements[i];
      EXPECT_EQ(free.verdict == "one solution", formed.verdict == "one solution");
    }
  }
}

// The same on one rank as on all: every rank examines the block on its own as well.
TEST(Uniqueness, DoesNotDependOnTheRanks) {
  test::setOptions(block(12, 6));
  const auto together = examined(test::buildModel(), {0.3, 1.2});
  mesh::Mesh mesh = test::readMesh(PETSC_COMM_SELF);
  auto ties = test::findTies(mesh);
  const auto [bodies, contact] =
      test::assembleContact(mesh, test::assembleBodies(mesh), std::move(ties));
  const auto single =
      uniqueness::examine(bodies, contact, 1, {0.3, 1.2}, uniqueness::Settings::given());
  EXPECT_NEAR(together.lostAt / single.lostAt, 1, 1e-9);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(together.judgements[i].smallest / single.judgements[i].smallest, 1, 1e-8);
    EXPECT_EQ(together.judgements[i].verdict, single.judgements[i].verdict);
  }
}

TEST(Uniqueness, IsNotDecidedWithoutTheMatrix) {
  test::setCase("two_layers",
                layers + " -constraint_pad_top_clamped x -constraint_pad_top_displacement 0,0,0");
  auto result = examined(test::buildModel(), {0, 0.5});
  ASSERT_EQ(result.judgements.size(), 2u);
  EXPECT_TRUE(std::isnan(result.lostAt));
  for (const auto& judgement : result.judgements) {
    EXPECT_TRUE(std::isnan(judgement.smallest));
    EXPECT_EQ(judgement.verdict, "not decided");
    EXPECT_EQ(
        judgement.reason,
        "body 'pad' is supported only by the contact, so the condensed matrix does not exist");
  }
}

// The gaps of tri6 faces are combined so that their forces have one sign under pressure. A0 is
// positive definite as the inverse of a stiffness is.
TEST(Uniqueness, IsDecidedOnTri6) {
  test::setOptions(
      "-mesh_file meshes/beam.geo -mesh_set Lx=1,Ly=0.4,Lz=0.4,nx=2,ny=1,nz=1,recombine=0,order=2" +
      test::material("beam", "1", "0.3", "1") +
      "-constraint_clamped_clamped xyz -contact_plate_pad tip -contact_plate_obstacle_velocity "
      "0,1,0");
  const auto result = examined(test::buildModel(), {0, 0.5});
  for (const auto& judgement : result.judgements)
    EXPECT_EQ(judgement.verdict, "one solution") << judgement.reason;
  EXPECT_GT(result.judgements.at(0).smallest, 0);
}

// Beyond a critical speed, here K − σ M with σ = 1e7: the lowest eigenvalue of the cantilever is
// about 3.5² E h² / (12 ρ L⁴) = 3e5. A0 is not an inner product that the eigenvalue solver could
// use.
TEST(Uniqueness, IndefiniteStiffnessNeedsTheMatrixFormed) {
  test::setOptions(block(4, 8) + "-steady_uniqueness_dense 0");
  const Model model = test::buildModel();
  check(MatAXPY(model.bodies.stiffness, -1e7, model.bodies.mass, SAME_NONZERO_PATTERN));
  const auto result = examined(model, {0.3});
  EXPECT_EQ(result.judgements.at(0).verdict, "not decided");
  EXPECT_TRUE(contains(result.judgements[0].reason, "stiffness")) << result.judgements[0].reason;
}

TEST(Uniqueness, UnknownSolverOptionIsNamed) {
  for (const std::string limit : {"1000", "0"}) {
    const std::string size = "-steady_uniqueness_dense " + limit;
    test::setOptions(block(4, 2) + size + " -steady_uniqueness_ksp_typo 1");
    const Model model = test::buildModel();
    EXPECT_TRUE(contains(errorOf([&] { examined(model, {0.5}); }), "-steady_uniqueness_ksp_typo"));
    test::setOptions(
        block(4, 2) + size +
        " -steady_uniqueness_eps_max_it 77 -steady_uniqueness_pc_factor_mat_ordering_type rcm");
    EXPECT_EQ(errorOf([&] { examined(model, {0.5}); }), "");
  }
}

}  // namespace
}  // namespace squeal
