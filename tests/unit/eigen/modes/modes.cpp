// SPDX-License-Identifier: BSD-2-Clause
// Free modes: block Lanczos against SLEPc's EPS, its restarts, and what both promise of their
// vectors.
#include <gtest/gtest.h>

#include "eigen/modes/blocklanczos.hpp"
#include "eigen/modes/modes.hpp"
#include "model/contact/coupled.hpp"
#include "support/harness/largest_error.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

const std::string layer = "-report_fields off -flutter_friction 0 -flutter_basis modal ";

/// Largest entry of |VᵀMV − I| over the columns of V.
double departureFromOrthonormal(BV vectors, Mat mass) {
  PetscInt first = 0, count = 0;
  check(BVGetActiveColumns(vectors, &first, &count));
  OwnedMat products;
  check(BVSetMatrix(vectors, mass, PETSC_FALSE));
  check(MatCreateSeqDense(PETSC_COMM_SELF, count, count, nullptr, products.out()));
  check(BVDot(vectors, vectors, products));
  check(BVSetMatrix(vectors, nullptr, PETSC_FALSE));
  double worst = 0;
  for (PetscInt i = 0; i < count; ++i)
    for (PetscInt j = 0; j < count; ++j) {
      PetscScalar entry = 0;
      check(MatGetValue(products, i, j, &entry));
      worst = worse(worst, std::abs(entry - (i == j)));
    }
  return worst;
}

TEST(Modes, BlockLanczosAgreesWithEps) {
  // 51 modes: the list ends after a double one. Eigenvalue errors are the square of the residual
  // tolerance 1e-8 over the relative gaps (some 1e-3): far below 1e-10.
  const analysis::Analysis lanczos =
      runCase("layer", layer + "-modes_count 51 -modes_solver block_lanczos");
  const analysis::Analysis eps = runCase("layer", layer + "-modes_count 51 -modes_solver eps");
  const auto &a = lanczos.flutter.segments.at(0).modes, &b = eps.flutter.segments.at(0).modes;
  ASSERT_EQ(a.angularFrequency.size(), 51U);
  ASSERT_EQ(b.angularFrequency.size(), 51U);
  for (std::size_t i = 0; i < 51; ++i)
    EXPECT_NEAR(a.angularFrequency[i], b.angularFrequency[i], 1e-10 * b.angularFrequency[i]) << i;
  EXPECT_TRUE(a.countConfirmed);
  EXPECT_TRUE(b.countConfirmed);
}

class Layer : public testing::Test {
 protected:
  void SetUp() override {
    clearOptions();
    insertFile(PETSC_COMM_WORLD, "options/layer.yaml");
    insert(settingsOfText("-quiet"));
    model_ = buildModel();
    system_ = std::make_unique<contact::CoupledSystem>(
        model_.bodies, model_.contact,
        contact::ActiveSet::bonded(model_.contact.interfaces.nodes.size()));
  }
  Model model_;
  std::unique_ptr<contact::CoupledSystem> system_;
};

/// Collective. Solves for the lowest `count` modes by the EPS type of this program.
OwnedEPS blockLanczos(const contact::CoupledSystem& system, PetscInt count, PetscInt blockSize,
                      PetscInt vectors, bool secondPole) {
  OwnedEPS eps;
  modes::registerBlockLanczos();
  check(EPSCreate(PETSC_COMM_WORLD, eps.out()));
  check(EPSSetOperators(eps, system.k0(), system.m0()));
  check(EPSSetProblemType(eps, EPS_GHEP));
  check(EPSSetType(eps, modes::blockLanczosType));
  modes::setBlockLanczos(eps, blockSize, secondPole);
  check(EPSSetTarget(eps, 0));
  check(EPSSetWhichEigenpairs(eps, EPS_TARGET_MAGNITUDE));
  check(EPSSetDimensions(eps, count, vectors, PETSC_DEFAULT));
  check(EPSSetTolerances(eps, 1e-12, 60));
  ST st = nullptr;
  check(EPSGetST(eps, &st));
  check(STSetType(st, STSINVERT));
  check(STSetKSP(st, system.solver()));
  return eps;
}

std::vector<double> eigenvalues(EPS eps) {
  PetscInt converged = 0;
  check(EPSGetConverged(eps, &converged));
  std::vector<double> values(converged);
  for (PetscInt i = 0; i < converged; ++i) check(EPSGetEigenvalue(eps, i, &values[i], nullptr));
  return values;
}

BV basisOf(EPS eps) {
  BV basis = nullptr;
  PetscInt converged = 0;
  check(EPSGetConverged(eps, &converged));
  check(EPSGetBV(eps, &basis));
  check(BVSetActiveColumns(basis, 0, converged));
  return basis;
}

/// Returns the largest ‖K⁻¹M x − x/λ‖_M λ over all pairs, by a solve for each.
double worstResidual(const contact::CoupledSystem& system, EPS eps) {
  const OwnedVec x = rightVector(system.k0()), y = rightVector(system.k0()),
                 z = rightVector(system.k0());
  const auto values = eigenvalues(eps);
  double largest = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    check(EPSGetEigenvector(eps, i, x, nullptr));
    check(MatMult(system.m0(), x, y));
    check(KSPSolve(system.solver(), y, z));
    check(VecAXPY(z, -1 / values[i], x));
    check(MatMult(system.m0(), z, y));
    PetscScalar square = 0;
    check(VecDot(y, z, &square));
    largest = worse(largest, std::sqrt(square) * values[i]);
  }
  return largest;
}

TEST_F(Layer, RestartsFindTheSameModes) {
  // Room for 20 vectors is too little for four modes to 1e-12 at once, and blocks of one cannot see
  // both of a double mode but through rounding and restarts: the hard way. Blocks of four have room
  // for 44.
  const OwnedEPS hard = blockLanczos(*system_, 4, 1, 20, false),
                 easy = blockLanczos(*system_, 4, 4, 44, false);
  const auto hardFacts = modes::solveBlockLanczos(hard);
  modes::solveBlockLanczos(easy);
  const auto a = eigenvalues(hard), b = eigenvalues(easy);
  ASSERT_GE(a.size(), 4U);
  ASSERT_GE(b.size(), 4U);
  EXPECT_GT(hardFacts.restarts, 0);
  // The exact frequencies of the continuous layer (one, a double one, one), a coarse check that
  // none is skipped: the mesh errs by 0.3 %.
  const double exact[4] = {0.9741665274383, 2.391686885819, 2.391686885819, 2.922499582374};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(std::sqrt(b[i]), exact[i], 3e-3 * exact[i]);
    EXPECT_NEAR(a[i], b[i], 1e-10 * b[i]) << i;
  }
  EXPECT_LT(departureFromOrthonormal(basisOf(easy), system_->m0()), 1e-12);
  EXPECT_LT(departureFromOrthonormal(basisOf(hard), system_->m0()), 1e-12);
}

// With a second pole fewer solves find the same modes, and the inertia at the pole counts those
// below it.
TEST_F(Layer, ASecondPoleFindsTheSameModes) {
  const OwnedEPS one = blockLanczos(*system_, 60, 4, 300, false),
                 two = blockLanczos(*system_, 60, 4, 300, true);
  const auto facts = modes::solveBlockLanczos(one), fewer = modes::solveBlockLanczos(two);
  const auto a = eigenvalues(one), b = eigenvalues(two);
  ASSERT_GE(a.size(), 60U);
  ASSERT_GE(b.size(), 60U);
  for (std::size_t i = 0; i < 60; ++i) EXPECT_NEAR(b[i], a[i], 1e-12 * a[i]) << i;
  EXPECT_EQ(fewer.below, std::ranges::count_if(a, [&](double x) { return x < fewer.countedTo; }));
  EXPECT_GT(fewer.below, 30);
  EXPECT_LT(fewer.solves, facts.solves);
  EXPECT_LT(departureFromOrthonormal(basisOf(two), system_->m0()), 1e-12);
  // The residuals that the small matrices give are those of the pairs themselves, except for
  // round-off of the solves, some 1e-13, which grows by λ/|λ − σ| next to the second pole.
  EXPECT_LT(worstResidual(*system_, one), 3e-12);
  EXPECT_LT(worstResidual(*system_, two), 1e-10);
  print("60 modes: %d solves with one pole, %d with two, of which the second has %d modes below\n",
        facts.solves, fewer.solves, fewer.below);
}

TEST_F(Layer, SturmCountSeesAMissingMode) {
  // The inertia of K − σ M counts 51 modes below a shift just above mode 51: the confirmation is a
  // number, not a formality.
  insert(settingsOfText("-modes_count 60"));
  const auto modes = modes::compute(*system_, modes::Settings::given());
  ASSERT_TRUE(modes.countConfirmed);
  const auto below = std::count_if(modes.lambda.begin(), modes.lambda.end(),
                                   [&](double lambda) { return lambda < modes.inertiaShift; });
  EXPECT_EQ(modes.inertiaCount, static_cast<int>(below));
  EXPECT_GT(modes.inertiaCount, 45);
}

/// A ring of one cell held at its inner side: double modes, and clusters of them where the ring is
/// thin.
Model heldRing(const std::string& shape) {
  setOptions("-mesh_file meshes/ring.geo -mesh_set " + shape +
             material("ring", "2.1e11", "0.3", "7850") +
             "-constraint_inner_clamped xyz -flutter_friction 0");
  return buildModel();
}

modes::Modes modesOf(const Model& model, const std::string& options, int count) {
  insert(settingsOfText(options));
  const contact::CoupledSystem system(model.bodies, model.contact, {});
  return modes::compute(system, modes::Settings::given().withCount(count));
}

// Krylov vectors of one start vector meet one vector of each eigenspace: blocks of one miss half of
// the modes of a ring. The inertia shows it, and larger blocks find them; LAPACK gives the
// frequencies.
TEST(HeldRing, DoubleModesAreCounted) {
  const Model model = heldRing("n_theta=64,n_r=2,thickness=0.04,width=0.01");
  const auto wanted = modesOf(model, "-modes_solver auto", 300),
             found = modesOf(model, "-modes_solver block_lanczos -modes_block_size 1", 4);
  EXPECT_TRUE(found.countConfirmed);
  for (std::size_t i = 0; i < found.lambda.size(); ++i)
    EXPECT_NEAR(found.lambda[i] / wanted.lambda[i], 1, 1e-8) << i;
  EXPECT_NEAR(found.lambda[2] / found.lambda[1], 1, 1e-8);
}

// The lowest frequencies of a thin ring, shear of its width, differ by parts of a thousand: few
// vectors and many restarts do not part them, more vectors do.
TEST(HeldRing, ClustersOfModesConverge) {
  const auto found = modesOf(heldRing("n_theta=192"), "-modes_solver block_lanczos", 3);
  EXPECT_TRUE(found.countConfirmed);
  EXPECT_LT(worst(found.relativeResidual), 1e-6);
}

// Three eigenvalues of multiplicity 100: the first three blocks are an invariant subspace, beyond
// which the residual is rounding.
TEST(Modes, EigenvaluesOfHighMultiplicity) {
  setOptions("");
  OwnedMat k, m;
  for (auto [matrix, isMass] : {std::pair{&k, false}, {&m, true}}) {
    check(MatCreateConstantDiagonal(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, 300, 300, 1,
                                    matrix->out()));
    OwnedMat sparse;
    check(MatConvert(*matrix, MATAIJ, MAT_INITIAL_MATRIX, sparse.out()));
    PetscInt first = 0, end = 0;
    check(MatGetOwnershipRange(sparse, &first, &end));
    for (PetscInt i = first; i < end; ++i)
      check(MatSetValue(sparse, i, i, isMass ? 1 : 1 + i / 100, INSERT_VALUES));
    check(MatAssemblyBegin(sparse, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(sparse, MAT_FINAL_ASSEMBLY));
    check(MatSetOption(sparse, MAT_SYMMETRIC, PETSC_TRUE));
    *matrix = std::move(sparse);
  }
  const factor::AssociatedSystem system(k.share(), m.share(), "stiffness");
  const auto modes = modes::compute(system, modes::Settings::given().withCount(40));
  for (double lambda : modes.lambda) EXPECT_NEAR(lambda, 1, 1e-12);
  EXPECT_LT(departureFromOrthonormal(modes.vectors, m), 1e-12);
}

TEST(Modes, TooManyForTheUnknowns) {
  const std::string message = errorOf([] { runCase("layer", "-modes_count 829"); });
  EXPECT_NE(message.find("-modes_count 829"), std::string::npos) << message;
  EXPECT_NE(message.find("828 unknowns"), std::string::npos) << message;
}

}  // namespace
}  // namespace squeal::test
