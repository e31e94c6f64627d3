// SPDX-License-Identifier: BSD-2-Clause
// Random small brakes, whose whole spectrum LAPACK finds: no count is proved that is wrong.
#include <gtest/gtest.h>

#include <cstdlib>

#include "eigen/proof/count.hpp"
#include "support/eigen/split_brake.hpp"

namespace {

using namespace squeal;

struct Tally {
  int proved = 0, wrongAndProved = 0, wrongAndRefused = 0;
};

Tally draws(int number, test::Damping damping, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  Tally tally;
  for (int i = 0; i < number; ++i) {
    const auto brake = test::randomBrake(60, damping, generator);
    const PetscInt modes = 8 + static_cast<PetscInt>(12 * uniform(generator));
    const double wanted = (0.5 + 0.45 * uniform(generator)) * brake.omega[modes];
    const auto split = test::split(brake, test::firstModes(modes), true, i % 2 == 1, wanted);
    const proof::DiagonalForm form(split.problem, wanted);
    proof::Region region{proof::placedTop(form.eigenvalues(), wanted)};
    if (damping != test::Damping::none && i % 4 != 0)
      region.left = (0.01 + 0.05 * uniform(generator)) * region.top;
    const auto proof = proof::proveCount(form, split.leftOut, region);
    const bool proved = proof.verdict == proof::Verdict::proved,
               right = proof.count == test::fullCount(brake, region);
    tally.proved += proved;
    tally.wrongAndProved += proved && !right;
    tally.wrongAndRefused += !proved && !right;
  }
  return tally;
}

int number(int few, int many) { return std::getenv("SQUEAL_LONG") ? many : few; }

// The draws are hard enough that a fair part is refused, and that V lacks an eigenvalue in some.
TEST(Random, Undamped) {
  const int count = number(300, 5000);
  const auto tally = draws(count, test::Damping::none, 1);
  EXPECT_EQ(tally.wrongAndProved, 0);
  EXPECT_GT(tally.wrongAndRefused, count / 100);
  EXPECT_GT(tally.proved, count / 2);
  EXPECT_LT(tally.proved, 9 * count / 10);
}

TEST(Random, Damped) {
  const int count = number(50, 1000);
  const auto tally = draws(count, test::Damping::all, 2);
  EXPECT_EQ(tally.wrongAndProved, 0);
  EXPECT_GT(tally.wrongAndRefused, count / 100);
  EXPECT_GT(tally.proved, count / 2);
  EXPECT_LT(tally.proved, 9 * count / 10);
}

}  // namespace
