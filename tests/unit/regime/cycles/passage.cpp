// SPDX-License-Identifier: BSD-2-Clause
// Passages of one model at several frictions.
#include "regime/cycles/passage.hpp"

#include <gtest/gtest.h>

#include "support/regime/reduced_models.hpp"

namespace squeal {
namespace {

// A passage depends on its orbit only, not on the frictions of passages before it.
TEST(Passage, ForgetsEarlierFrictions) {
  cycles::Period period(PETSC_COMM_SELF, test::massOnBelt(1), 0.9, 256);
  cycles::Orbit orbit{{{0.5, 0.1}, {0.2, 0}, {0, 0}}, 4.5, 0.9}, other = orbit;
  other.friction = 0.8;
  const auto first = period.pass(orbit).end, elsewhere = period.pass(other).end,
             again = period.pass(orbit).end;
  EXPECT_NE(first.q, elsewhere.q);
  EXPECT_EQ(first.q, again.q);
  EXPECT_EQ(first.v, again.v);
  EXPECT_EQ(first.z, again.z);
}

}  // namespace
}  // namespace squeal
