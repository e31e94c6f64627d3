// SPDX-License-Identifier: BSD-2-Clause
// Random small brakes, whose whole spectrum LAPACK finds: no count is proved that is wrong.
#include <gtest/gtest.h>

#include <numeric>

#include "eigen/proof/count.hpp"
#include "support/eigen/split_brake.hpp"

namespace {

using namespace squeal;

struct Tally {
  int proved = 0, wrongAndProved = 0, wrongAndRefused = 0;
  PetscInt discs = 0, evaluations = 0;
  int verdicts[6] = {};
};

std::vector<PetscInt> firstModes(PetscInt count) {
  std::vector<PetscInt> modes(count);
  std::iota(modes.begin(), modes.end(), 0);
  return modes;
}

Tally draws(int number, test::Damping damping, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  Tally tally;
  for (int i = 0; i < number; ++i) {
    const auto brake = test::randomBrake(60, damping, generator);
    const PetscInt modes = 8 + static_cast<PetscInt>(12 * uniform(generator));
    const double wanted = (0.4 + 0.5 * uniform(generator)) * brake.omega[modes];
    const auto split = test::split(brake, firstModes(modes), true, i % 2 == 1, wanted);
    const proof::DiagonalForm form(split.problem, wanted);
    proof::Region region{proof::placedTop(form.eigenvalues(), wanted)};
    if (damping != test::Damping::none && i % 4 != 0)
      region.left = (0.01 + 0.05 * uniform(generator)) * region.top;
    const auto proof = proof::proveCount(form, split.leftOut, region);
    const bool right = proof.count == test::fullCount(brake, region);
    const bool proved = proof.verdict == proof::Verdict::proved;
    tally.proved += proved;
    tally.wrongAndProved += proved && !right;
    tally.wrongAndRefused += !proved && !right;
    ++tally.verdicts[static_cast<int>(proof.verdict)];
    if (!proved) continue;
    tally.discs += proof.discs;
    tally.evaluations += proof.evaluations;
  }
  return tally;
}

void print(const Tally& tally) {
  std::printf("proved %d, wrong and proved %d, wrong and refused %d, discs %.2f, evaluations %.2f\n",
              tally.proved, tally.wrongAndProved, tally.wrongAndRefused,
              double(tally.discs) / tally.proved, double(tally.evaluations) / tally.proved);
  for (int i = 0; i < 6; ++i) std::printf(" %d", tally.verdicts[i]);
  std::printf("\n");
}

TEST(Random, Undamped) {
  const auto tally = draws(5500, test::Damping::none, 1);
  print(tally);
  EXPECT_EQ(tally.wrongAndProved, 0);
}

TEST(Random, Damped) {
  const auto tally = draws(1500, test::Damping::all, 2);
  print(tally);
  EXPECT_EQ(tally.wrongAndProved, 0);
}

}  // namespace
