// SPDX-License-Identifier: BSD-2-Clause
// Bases that lack modes or static responses: not proved.
#include <gtest/gtest.h>

#include "eigen/proof/count.hpp"
#include "support/eigen/split_brake.hpp"

namespace {

using namespace squeal;
using proof::Verdict;

std::vector<PetscInt> modesExcept(PetscInt count, PetscInt without) {
  std::vector<PetscInt> modes;
  for (PetscInt j = 0; j < count; ++j)
    if (j != without) modes.push_back(j);
  return modes;
}

struct Draw {
  test::RandomBrake brake;
  PetscInt modes = 15;
  proof::Region region;

  explicit Draw(std::mt19937& generator)
      : brake(test::randomBrake(60, test::Damping::none, generator)) {
    region.top = 0.7 * brake.omega[modes];
  }
  proof::CountProof proof(const std::vector<PetscInt>& kept, bool responses, double theta) const {
    auto split = test::split(brake, kept, responses, false, region.top);
    split.leftOut.mass = 1 / theta;
    const proof::DiagonalForm form(split.problem, region.top);
    return proof::proveCount(form, split.leftOut, region);
  }
};

// θ follows from the Sturm count: the number of free modes below it is the number of those in V. A
// mode is left out, but the count is right: θ is at most its ω², and δ ≤ 1 − top²/ω² < 0.
TEST(PoorBasis, WithoutAMode) {
  std::mt19937 generator(5);
  int proved = 0, wrong = 0;
  for (int i = 0; i < 40; ++i) {
    const Draw draw(generator);
    const double next = draw.brake.omega[draw.modes], top = draw.region.top;
    if (draw.proof(modesExcept(draw.modes, -1), true, next * next).verdict != Verdict::proved)
      continue;
    ++proved;
    const PetscInt inside =
        std::ranges::lower_bound(draw.brake.omega, top) - draw.brake.omega.begin();
    const PetscInt out = i % inside;
    const auto kept = modesExcept(draw.modes, out);
    const double omega = draw.brake.omega[out];
    const auto poor = draw.proof(kept, true, omega * omega);
    EXPECT_EQ(poor.verdict, Verdict::indefinite);
    EXPECT_NEAR(poor.definiteness, 1 - top * top / (omega * omega), 1e-9);
    // With a wrong Sturm count the theorem does not hold: a count may be "proved" that is wrong.
    const auto mistaken = draw.proof(kept, true, next * next);
    wrong += mistaken.verdict == Verdict::proved &&
             mistaken.count != test::fullCount(draw.brake, draw.region);
  }
  EXPECT_GT(proved, 20);
  EXPECT_GT(wrong, 2);
}

// Without K0⁻¹ Sᵀ, friction remains on C and in both couplings.
TEST(PoorBasis, WithoutResponses) {
  std::mt19937 generator(6);
  int proved = 0, stillProved = 0, indefinite = 0;
  for (int i = 0; i < 40; ++i) {
    const Draw draw(generator);
    const double next = draw.brake.omega[draw.modes];
    const auto kept = modesExcept(draw.modes, -1);
    const auto with = draw.proof(kept, true, next * next),
               without = draw.proof(kept, false, next * next);
    const auto full = test::fullCount(draw.brake, draw.region);
    if (with.verdict != Verdict::proved) continue;
    ++proved;
    EXPECT_EQ(with.count, full);
    EXPECT_LT(without.definiteness, with.definiteness);
    indefinite += without.verdict == Verdict::indefinite;
    if (without.verdict != Verdict::proved) continue;
    ++stillProved;
    EXPECT_EQ(without.count, full);
  }
  EXPECT_GT(proved, 20);
  EXPECT_LT(stillProved, proved / 2);
  EXPECT_GT(indefinite, proved / 3);
}

}  // namespace
