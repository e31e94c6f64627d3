// SPDX-License-Identifier: BSD-2-Clause
// Solids against beam and ring theory: cantilever (Timoshenko 1921, Huang 1961), free circular ring
// (Hoppe 1871, Love).
#include <gtest/gtest.h>

#include <cmath>

#include "base/system/text.hpp"
#include "eigen/modes/modes.hpp"
#include "exact/beam.hpp"
#include "model/contact/coupled.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using exact::beam::axial;
using exact::beam::bending;
using exact::beam::density;
using exact::beam::Section;
using exact::beam::shear;
using exact::beam::torsion;
using exact::beam::young;

constexpr Section upright{1, 0.04, 0.02}, flat{1, 0.02, 0.04};

TEST(Beam, TheoryIsThatOfTheTextbooks) {
  // A thin beam: Euler's (β L)² = 3.51602, 22.0345, 61.6972; Saint-Venant's J = 0.2287 a b³ at a =
  // 2b.
  const auto thin = bending({1, 1e-4, 1e-4}, 0.3, 3);
  const double unit = std::sqrt(young / 12 / density) * 1e-4;
  EXPECT_NEAR(thin[0] / unit, 3.51602, 1e-4);
  EXPECT_NEAR(thin[1] / unit, 22.0345, 1e-3);
  EXPECT_NEAR(thin[2] / unit, 61.6972, 3e-3);
  const double j = 0.2287 * 0.04 * 8e-6, polar = 0.04 * 0.02 * (16e-4 + 4e-4) / 12;
  EXPECT_NEAR(torsion(upright, 0.3) / (M_PI / 2 * std::sqrt(shear(0.3) * j / (density * polar))), 1,
              1e-4);
}

std::string steel(const std::string& body, double poisson) {
  return test::material(body, "2.1e11", formatted("%g", poisson), "7850");
}

struct Families {
  std::vector<double> vertical, sideways, axial, torsion;  // angular frequencies, ascending
};

/// Modes of the clamped beam, each in the family of the rigid motion of a cross section that holds
/// most of its mass-weighted motion.
Families families(const std::string& set, double poisson, const std::string& incompatible) {
  test::setOptions(
      "-mesh_file meshes/beam.geo -mesh_set " + set + steel("beam", poisson) +
      "-constraint_clamped_clamped xyz -modes_count 16 -elasticity_incompatible_modes " +
      incompatible);
  const auto model = test::buildModel();
  const contact::CoupledSystem system(model.bodies, model.contact, {});
  const auto modes = modes::compute(system, modes::Settings::given());
  const auto& mesh = *model.mesh;
  Families families;
  for (std::size_t i = 0; i < modes.angularFrequency.size(); ++i) {
    OwnedVec u = elasticity::nodalVector(mesh);
    Vec d = nullptr;
    check(BVGetColumn(modes.vectors, static_cast<PetscInt>(i), &d));
    check(MatMult(system.transformation().trial, d, u));
    check(BVRestoreColumn(modes.vectors, static_cast<PetscInt>(i), &d));
    const PetscScalar* values = nullptr;
    double part[4] = {0, 0, 0,
                      0};  // Σ u_x², Σ u_y², Σ u_z², all rotation: Σ (y u_z − z u_y)² / (y² + z²)
    check(VecGetArrayRead(u, &values));
    for (PetscInt node = 0; node < mesh.ownedNodes; ++node) {
      const auto& x = mesh.coordinates[node];
      for (int c = 0; c < 3; ++c) part[c] += values[3 * node + c] * values[3 * node + c];
      const double radius2 = x[1] * x[1] + x[2] * x[2];
      if (radius2 > 1e-12)
        part[3] += std::pow(x[1] * values[3 * node + 2] - x[2] * values[3 * node + 1], 2) / radius2;
    }
    check(VecRestoreArrayRead(u, &values));
    for (auto& sum : part) sum = test::total(sum);
    const double all = part[0] + part[1] + part[2];
    auto& family = part[3] > 0.95 * all  ? families.torsion
                   : part[0] > 0.8 * all ? families.axial
                   : part[2] > part[1]   ? families.vertical
                                         : families.sideways;
    family.push_back(modes.angularFrequency[i]);
  }
  return families;
}

/// Deviations from theory in per cent: bending 1 to 3 over the height, over the width, axial,
/// torsion.
std::vector<double> deviations(const char* name, double poisson, const Families& found) {
  std::vector<double> percent;
  const auto add = [&](const std::vector<double>& list, std::size_t i, double theory) {
    percent.push_back(list.size() > i ? 100 * (list[i] / theory - 1) : NAN);
  };
  const auto low = bending(upright, poisson, 3), high = bending(flat, poisson, 3);
  for (std::size_t i = 0; i < 3; ++i) add(found.vertical, i, low[i]);
  for (std::size_t i = 0; i < 3; ++i) add(found.sideways, i, high[i]);
  add(found.axial, 0, axial(1));
  add(found.torsion, 0, torsion(upright, poisson));
  std::string text;
  for (double value : percent) text += formatted(" %6.2f", value);
  test::print("beam, %s, nu = %g: deviation from theory in %%%s\n", name, poisson, text.c_str());
  return percent;
}

// ν = 0: a clamped section need not contract, and Timoshenko's beam is nearly exact; what remains
// is the mesh. Torsion is stiffer by the warping that the clamp suppresses over d = √(E C / G J), C
// = a³ b³ / 144: d = 1 cm of 1 m, 1 %.
TEST(Beam, Hex27) {
  const char* const set = "order=2,nx=20,ny=4,nz=2";
  const auto percent = deviations("hex27, 20 x 4 x 2", 0, families(set, 0, "none"));
  EXPECT_NEAR(percent[0], 0, 0.05);
  EXPECT_NEAR(percent[3], 0, 0.05);
  EXPECT_NEAR(percent[6], 0, 0.01);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(percent[i], 0, 0.4) << i;
  EXPECT_NEAR(percent[7], 1, 0.5);
  // ν = 0.3: the clamped end cannot contract either, which stiffens it over about one thickness;
  // seen as 0.2 to 0.7 %.
  const auto contracting = deviations("hex27, 20 x 4 x 2", 0.3, families(set, 0.3, "none"));
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(contracting[i], 0.4, 0.4) << i;
}

// Two cells through the thickness bend as they should. In torsion they warp as y z only: J is that
// of the warping function y z, 4 I_y I_z / (I_y + I_z), 17 % too high, hence 8 %, and 0.7 % more
// from the clamp.
TEST(Beam, Hex8WithIncompatibleModes) {
  for (const double poisson : {0.0, 0.3}) {
    const auto percent = deviations("hex8 with incompatible modes, 40 x 2 x 2", poisson,
                                    families("nx=40,ny=2,nz=2", poisson, "hex8"));
    for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(percent[i], 0, 1) << i;
    EXPECT_NEAR(percent[7], 8.5, 0.5);
  }
}

// Without them a cell of length l cannot curve: a parasitic shear κ x, |x| ≤ l/2, adds G A l²/12 to
// the bending stiffness E A H²/12, however many cells share the height H. With ν = 0 nothing else
// is wrong: frequencies are too high by √(1 + G l² / (E H²)), a third here.
TEST(Beam, Hex8WithoutIncompatibleModesIsTooStiff) {
  const auto percent =
      deviations("hex8 without, 40 x 2 x 2", 0, families("nx=40,ny=2,nz=2", 0, "none"));
  const double ratio = 0.5 * std::pow(1.0 / 40, 2);  // G l² / E
  EXPECT_NEAR(percent[0], 100 * (std::sqrt(1 + ratio / 0.0004) - 1), 0.5);
  EXPECT_NEAR(percent[3], 100 * (std::sqrt(1 + ratio / 0.0016) - 1), 0.5);
  EXPECT_GT(percent[0], 33);
}

// Ring of radius R, thickness t (radial) and width w, t, w ≪ R. In-plane bending without extension,
// n waves around (Love, art. 293):
//   ω² = E I n² (n² − 1)² / (ρ A R⁴ (n² + 1)),  I / A = t² / 12,
// each twice, turned by a quarter wave. Out of the plane: ω² = E I' n² (n² − 1)² / (ρ A R⁴ (n² + E
// I'/(G J))): distinguished by u_z. Shear and rotatory inertia lower ω by about ½ (n t/R)²/12 · (1
// + E/κG) = 0.17 % at n = 5. Quadratic cells on a thin arc lock against extension until they are
// short: 2.7 % on 48 cells, 0.18 % on 96, then nothing to be seen.
TEST(Ring, FlexuralModesComeInPairs) {
  constexpr double radius = 0.1, thickness = 0.002;
  struct Mesh {
    const char *name, *set;
    double percent;
  };
  for (const auto& [name, set, tolerance] :
       {Mesh{"hex27, 192 cells", "order=2,n_theta=192", 0.2},
        Mesh{"hex8 with incompatible modes, 96 cells", "order=1", 1.5}}) {
    test::setOptions(std::string("-mesh_file meshes/ring.geo -mesh_set ") + set +
                     steel("ring", 0.3));
    const auto mesh = test::readMesh();
    const auto bodies = test::assembleBodies(mesh);
    // Free: six rigid motions at zero. A shift below zero keeps K − σ M positive definite.
    const double second =
        young * thickness * thickness / 12 * 4 * 9 / (density * std::pow(radius, 4) * 5);
    Owned<EPS, EPSDestroy> eps;
    ST st = nullptr;
    KSP ksp = nullptr;
    PC pc = nullptr;
    check(EPSCreate(mesh.comm, eps.out()));
    check(EPSSetOperators(eps, bodies.stiffness, bodies.mass));
    check(EPSSetProblemType(eps, EPS_GHEP));
    check(EPSSetDimensions(eps, 30, 90, PETSC_DEFAULT));
    check(EPSSetTarget(eps, -second / 4));
    check(EPSSetWhichEigenpairs(eps, EPS_TARGET_MAGNITUDE));
    check(EPSSetTolerances(eps, 1e-13, 200));
    check(EPSGetST(eps, &st));
    check(STSetType(st, STSINVERT));
    check(STGetKSP(st, &ksp));
    check(KSPSetType(ksp, KSPPREONLY));
    check(KSPGetPC(ksp, &pc));
    check(PCSetType(pc, PCCHOLESKY));
    check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
    check(EPSSolve(eps));
    PetscInt converged = 0;
    check(EPSGetConverged(eps, &converged));
    ASSERT_GE(converged, 30);
    std::vector<double> inPlane;
    int rigid = 0;
    OwnedVec u = elasticity::nodalVector(mesh);
    for (PetscInt i = 0; i < 30; ++i) {
      PetscScalar lambda = 0;
      check(EPSGetEigenpair(eps, i, &lambda, nullptr, u, nullptr));
      if (std::abs(lambda) < 1e-7 * second) {
        ++rigid;
        continue;
      }
      ASSERT_GT(lambda, 0);
      PetscReal all = 0, across = 0;
      check(VecNorm(u, NORM_2, &all));
      check(VecStrideNorm(u, 2, NORM_2, &across));
      if (across < 0.3 * all) inPlane.push_back(std::sqrt(lambda));
    }
    std::sort(inPlane.begin(), inPlane.end());
    EXPECT_EQ(rigid, 6);
    ASSERT_GE(inPlane.size(), 8u);
    for (int n = 2; n <= 5; ++n) {
      const double theory = n * (n * n - 1) * thickness / (radius * radius) *
                            std::sqrt(young / (12 * density * (n * n + 1)));
      const double first = inPlane[2 * (n - 2)], twin = inPlane[2 * (n - 2) + 1];
      test::print("ring, %s, n = %d: deviation from theory %.2f %%, pair apart by %.1e\n", name, n,
                  100 * (first / theory - 1), twin / first - 1);
      EXPECT_NEAR(100 * (first / theory - 1), 0, tolerance);
      EXPECT_NEAR(twin / first, 1,
                  1e-8);  // the mesh turns into itself: exactly double within gmsh's 11 digits
    }
  }
}

}  // namespace
}  // namespace squeal
