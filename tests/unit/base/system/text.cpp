// SPDX-License-Identifier: BSD-2-Clause
// Printed bounds.
#include "base/system/text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace squeal {
namespace {

// The text is on the right side of the value and less than one unit of its last digit away.
TEST(Text, RoundedNumbersRemainBounds) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> exponent(-12, 12);
  std::vector<double> values{140.62207, 9.9996, 0.99999, 1e-7, 1, 123456, 1e22, 5e-324};
  for (int i = 0; i < 2000; ++i) values.push_back(std::pow(10, exponent(generator)));
  for (const double value : values)
    for (int digits = 1; digits <= 7; ++digits) {
      const double unit = std::pow(10, std::floor(std::log10(value)) - digits + 1),
                   above = std::stold(roundedUp(value, digits)),
                   below = std::stold(roundedDown(value, digits));
      EXPECT_GE(above, value);
      EXPECT_LE(below, value);
      if (value < 1e-300) continue;  // of numbers with fewer digits
      EXPECT_LE(above - value, unit * (1 + 1e-9)) << value << " with " << digits;
      EXPECT_LE(value - below, unit * (1 + 1e-9)) << value << " with " << digits;
    }
}

TEST(Text, RoundedNumbers) {
  EXPECT_EQ(roundedUp(140.62207, 4), "140.7");
  EXPECT_EQ(roundedDown(140.62207, 4), "140.6");
  EXPECT_EQ(roundedUp(1.46e2, 2), "1.5e+02");
  EXPECT_EQ(roundedUp(0, 3), "0");
  EXPECT_EQ(roundedDown(0.5, 3), "0.5");
}

}  // namespace
}  // namespace squeal
