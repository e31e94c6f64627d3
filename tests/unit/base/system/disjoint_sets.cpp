// SPDX-License-Identifier: BSD-2-Clause
// Joined sets of numbers.
#include "base/system/disjoint_sets.hpp"

#include <gtest/gtest.h>

#include <set>

namespace squeal {
namespace {

// The residues modulo 7 of the numbers below 700: seven sets, whatever the order of the joins, each
// with its residue as the smallest number.
TEST(DisjointSets, AreResidueClasses) {
  DisjointSets<int> sets(700);
  for (int k = 0; k < 700; ++k) EXPECT_EQ(sets.smallest(k), k);
  for (int k = 693 - 1; k >= 0; --k) sets.join(k + 7, k);
  std::set<int> smallest;
  for (int k = 0; k < 700; ++k) {
    EXPECT_EQ(sets.smallest(k), k % 7);
    smallest.insert(sets.smallest(k));
  }
  EXPECT_EQ(smallest.size(), 7u);
  sets.join(699, 3);  // 699 = 6 modulo 7
  EXPECT_EQ(sets.smallest(6), 3);
  sets.join(3, 699);  // already joined
  EXPECT_EQ(sets.smallest(13), 3);
}

}  // namespace
}  // namespace squeal
