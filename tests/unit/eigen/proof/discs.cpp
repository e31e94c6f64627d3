// SPDX-License-Identifier: BSD-2-Clause
// Discs that hold one eigenvalue each, and lists with faults that they find.
#include <gtest/gtest.h>

#include "eigen/proof/count.hpp"
#include "eigen/proof/enclosure.hpp"
#include "support/eigen/split_brake.hpp"

namespace {

using namespace squeal;
using proof::Agreement;
using proof::Isolation;

struct Solved {
  test::RandomBrake brake;
  proof::Region region;
  std::vector<Complex> exact;  // of all unknowns, Im s ≥ 0
  std::vector<proof::Enclosure> discs;
  bool proved = false;
};

Solved solve(test::Damping damping, PetscInt modes, std::mt19937& generator) {
  Solved solved{test::randomBrake(60, damping, generator), {}, {}, {}};
  const auto& brake = solved.brake;
  for (const auto& pair : linalg::solveQuadratic(test::fullProblem(brake)))
    solved.exact.push_back(pair.s);
  const double wanted = 0.5 * brake.omega[modes];
  const auto split = test::split(brake, test::firstModes(modes), true, false, wanted);
  const proof::DiagonalForm form(split.problem, wanted);
  solved.region.top = proof::placedTop(form.eigenvalues(), wanted);
  if (damping != test::Damping::none) solved.region.left = 0.05 * solved.region.top;
  const auto count = proof::proveCount(form, split.leftOut, solved.region);
  solved.proved = count.verdict == proof::Verdict::proved;
  solved.discs = proof::enclose(form, split.leftOut, solved.region, count);
  return solved;
}

/// Returns the number of eigenvalues, with their conjugates, at most `radius` from s.
int within(const std::vector<Complex>& exact, Complex s, double radius) {
  int count = 0;
  for (const auto value : exact) {
    count += std::abs(value - s) <= radius;
    count += value.imag() > 0 && std::abs(std::conj(value) - s) <= radius;
  }
  return count;
}

TEST(Discs, HoldOneEigenvalueEach) {
  std::mt19937 generator(3);
  int single = 0, all = 0, neutral = 0;
  for (int i = 0; i < 60; ++i) {
    const auto solved = solve(i % 4 == 0 ? test::Damping::all : test::Damping::none, 14, generator);
    for (const auto& disc : solved.discs) {
      ++all;
      if (disc.isolation != Isolation::single) continue;
      ++single;
      EXPECT_EQ(within(solved.exact, disc.s, disc.inner * (1 + 1e-9) + 1e-9), 1) << i;
      EXPECT_EQ(within(solved.exact, disc.s, disc.outer * (1 - 1e-9)), 1) << i;
      if (!disc.neutral) continue;
      ++neutral;
      const Complex image(0, std::abs(disc.s.imag()));
      for (const auto value : solved.exact)
        EXPECT_TRUE(std::abs(value - image) > disc.outer * (1 - 1e-9) ||
                    std::abs(value.real()) < 1e-9);
    }
  }
  EXPECT_GT(single, all / 2);
  EXPECT_GT(neutral, single / 4);
}

/// An enclosure that holds one eigenvalue.
proof::Enclosure discAbout(double frequency, double outer) {
  return {{0, frequency}, Isolation::single, 1e-12, outer};
}

/// Returns the agreements of entries on the imaginary axis, and the number of missing ones.
std::pair<std::vector<Agreement>, std::size_t> agreements(
    const std::vector<double>& frequencies, const std::vector<proof::Enclosure>& discs) {
  std::vector<Complex> list;
  for (const double frequency : frequencies) list.emplace_back(0, frequency);
  const auto judged = proof::judge(list, discs, {.top = 3}, 3e-4);  // 1e-4 of the top
  std::vector<Agreement> found;
  for (const auto& entry : judged.entries) found.push_back(entry.agreement);
  return {found, judged.missing.size()};
}

// Eigenvalues closer to each other than the errors of the list take one entry each, whichever entry
// is nearer to which. A second entry of one eigenvalue remains one too many.
TEST(Discs, CloserThanTheToleranceTakeOneEntryEach) {
  constexpr auto right = Agreement::right, repeated = Agreement::repeated;
  const std::vector twins{discAbout(1, 5e-9), discAbout(1 + 2e-8, 5e-9), discAbout(2, 0.5)};
  using Agreements = std::vector<Agreement>;
  EXPECT_EQ(agreements({1, 1, 2}, twins), std::pair(Agreements(3, right), 0ul));
  EXPECT_EQ(agreements({1, 2}, twins), std::pair(Agreements(2, right), 1ul));
  EXPECT_EQ(agreements({1, 2, 1, 1}, twins),
            std::pair(Agreements{right, right, right, repeated}, 0ul));
  // Both entries are nearest to the second disc, and only one of them is near the first.
  const std::vector pair{discAbout(1, 2e-5), discAbout(1 + 6e-5, 2e-5)};
  for (const auto& list : {std::vector{1 + 5e-5, 1 + 1.5e-4}, {1 + 1.5e-4, 1 + 5e-5}})
    EXPECT_EQ(agreements(list, pair), std::pair(Agreements(2, right), 0ul));
  // At low frequencies the errors are relative to the frequency.
  const std::vector low{discAbout(1e-3, 2e-4), discAbout(1.2e-3, 2e-4)};
  EXPECT_EQ(agreements({1e-3, 1e-3}, low), std::pair(Agreements{right, repeated}, 1ul));
}

// One eigenvalue is left out, moved or listed twice; the list is complete and exact otherwise.
TEST(Discs, FindOneFaultInAList) {
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  int lists = 0;
  while (lists < 1000) {
    const auto solved =
        solve(lists % 2 == 0 ? test::Damping::none : test::Damping::all, 30, generator);
    if (!solved.proved || !std::ranges::all_of(solved.discs, [](const auto& disc) {
          return disc.isolation == Isolation::single;
        }))
      continue;
    std::vector<Complex> list;
    for (const auto s : solved.exact)
      if (std::abs(s) < solved.region.top && s.real() > -solved.region.left) list.push_back(s);
    const double tolerance = 1e-9 * solved.region.top;
    const auto whole = proof::judge(list, solved.discs, solved.region, tolerance);
    EXPECT_TRUE(whole.missing.empty());
    for (const auto& entry : whole.entries) EXPECT_EQ(entry.agreement, Agreement::right);
    double widest = 0;
    for (const auto& disc : solved.discs) widest = std::max(widest, disc.inner);
    for (int i = 0; i < 51; ++i, ++lists) {
      const auto at =
          static_cast<std::size_t>(uniform(generator) * static_cast<double>(list.size()));
      auto faulty = list;
      const Complex removed = list[at];
      const auto findsTheGap = [&](const proof::JudgedList& judged) {
        return judged.missing.size() == 1 &&
               std::abs(judged.missing[0].s - removed) <= judged.missing[0].inner + tolerance;
      };
      if (i % 3 == 0) {
        faulty.erase(faulty.begin() + static_cast<std::ptrdiff_t>(at));
        const auto judged = proof::judge(faulty, solved.discs, solved.region, tolerance);
        EXPECT_TRUE(findsTheGap(judged));
        for (const auto& entry : judged.entries) EXPECT_EQ(entry.agreement, Agreement::right);
      } else if (i % 3 == 1) {
        faulty.push_back(removed);
        const auto judged = proof::judge(faulty, solved.discs, solved.region, tolerance);
        EXPECT_TRUE(judged.missing.empty());
        EXPECT_EQ(
            std::ranges::count(judged.entries, Agreement::repeated, &proof::JudgedEntry::agreement),
            1);
      } else {
        // By more than the diameter of its disc, up to a tenth of the top.
        const double least = 2 * widest + 3 * tolerance,
                     size = least * std::pow(0.1 * solved.region.top / least, uniform(generator));
        faulty[at] += std::polar(size, 2 * M_PI * uniform(generator));
        const auto judged = proof::judge(faulty, solved.discs, solved.region, tolerance);
        EXPECT_NE(judged.entries[at].agreement, Agreement::right);
        EXPECT_TRUE(judged.entries[at].agreement == Agreement::inexact || findsTheGap(judged));
        for (std::size_t j = 0; j < faulty.size(); ++j)
          EXPECT_TRUE(j == at || judged.entries[j].agreement == Agreement::right);
      }
    }
  }
}

}  // namespace
