// SPDX-License-Identifier: BSD-2-Clause
// Slabs that slide on each other with meshes that do not match, with friction damping and
// convective terms: convergence to the exact waves on hexahedra of second order.
#include <gtest/gtest.h>

#include "support/run/nonmatching_layers.hpp"

namespace squeal::test {
namespace {

TEST(NonMatchingSlabs, FourthOrderWithHex27) { expectFourthOrderOnSlabs("pad", true, "shape=1"); }

TEST(NonMatchingSlabs, FourthOrderWithHex20) {
  expectFourthOrderOnSlabs("disc", true, "serendipity=1");
}

}  // namespace
}  // namespace squeal::test
