// Free modes: block Lanczos against SLEPc's EPS, its restarts, and what both promise of their vectors.
#include <gtest/gtest.h>

#include "modes/blocklanczos.hpp"
#include "support/case.hpp"
#include "support/model.hpp"

namespace squeal::test {
namespace {

const std::string layer = "-report_fields off -flutter_friction 0 -reduction_basis modal ";

/// Largest entry of |VᵀMV − I| over the columns of V.
double departureFromOrthonormal(BV vectors, Mat mass) {
  PetscInt local = 0, global = 0, count = 0;
  check(BVGetSizes(vectors, &local, &global, &count));
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
      worst = std::max(worst, std::abs(entry - (i == j)));
    }
  return worst;
}

TEST(Modes, BlockLanczosAgreesWithEps) {
  // 51 modes: the list ends after a double one. Eigenvalue errors are the square of the residual tolerance 1e-8 over the relative gaps
  // (some 1e-3): far below 1e-10.
  const Analysis lanczos = runCase("layer", layer + "-modes_count 51 -modes_solver block_lanczos");
  const Analysis eps = runCase("layer", layer + "-modes_count 51 -modes_solver eps");
  const auto &a = lanczos.segments.at(0).modes, &b = eps.segments.at(0).modes;
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
    check(PetscOptionsClear(nullptr));
    insertFile(PETSC_COMM_WORLD, "options/layer.yaml");
    check(PetscOptionsInsertString(nullptr, "-quiet"));
    model_ = buildModel();
    system_ = std::make_unique<contact::AssociatedSystem>(model_.bodies, model_.contact,
                                                          std::vector<unsigned char>(model_.contact.nodes.size(), 1));
  }
  Model model_;
  std::unique_ptr<contact::AssociatedSystem> system_;
};

TEST_F(Layer, RestartsFindTheSameModes) {
  const Mat k = system_->k0(), m = system_->m0();
  const auto silent = [](int, int) {};
  // Room for 3·4 + 8·1 = 20 vectors is too little for four modes to 1e-12 at once, and blocks of one cannot see both of a double mode
  // but through rounding and restarts: the hard way. Blocks of four have room for 44.
  const auto hard = modes::blockLanczos(k, m, system_->solver(), 4, 1, 1e-12, 60, silent);
  const auto easy = modes::blockLanczos(k, m, system_->solver(), 4, 4, 1e-12, 60, silent);
  ASSERT_EQ(hard.converged, 4);
  ASSERT_EQ(easy.converged, 4);
  EXPECT_GT(hard.restarts, 0);
  // The exact frequencies of the continuous layer (one, a double one, one), a coarse check that none is skipped: the mesh errs by 0.3 %.
  const double exact[4] = {0.9741665274383, 2.391686885819, 2.391686885819, 2.922499582374};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(std::sqrt(easy.lambda[i]), exact[i], 3e-3 * exact[i]);
    EXPECT_NEAR(hard.lambda[i], easy.lambda[i], 1e-10 * easy.lambda[i]) << i;
  }
  EXPECT_LT(departureFromOrthonormal(easy.vectors, m), 1e-12);
  EXPECT_LT(departureFromOrthonormal(hard.vectors, m), 1e-12);
}

TEST_F(Layer, SturmCountSeesAMissingMode) {
  // The inertia of K − σ M counts 51 modes below a shift just above mode 51: the confirmation is a number, not a formality.
  check(PetscOptionsInsertString(nullptr, "-modes_count 60"));
  const auto modes = modes::compute({system_->k0(), system_->m0(), system_->solver()});
  ASSERT_TRUE(modes.countConfirmed);
  const auto below =
      std::count_if(modes.lambda.begin(), modes.lambda.end(), [&](double lambda) { return lambda < modes.inertiaShift; });
  EXPECT_EQ(modes.inertiaCount, static_cast<int>(below));
  EXPECT_GT(modes.inertiaCount, 45);
}

TEST(Modes, TooManyForTheUnknowns) {
  const std::string message = errorOf([] { runCase("layer", "-modes_count 829"); });
  EXPECT_NE(message.find("-modes_count 829"), std::string::npos) << message;
  EXPECT_NE(message.find("828 unknowns"), std::string::npos) << message;
}

}  // namespace
}  // namespace squeal::test
