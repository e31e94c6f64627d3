// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Comparison of computed eigenvalues with exact ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <tuple>
#include <vector>

#include "eigen/modes/modes.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "support/harness/largest_error.hpp"
#include "support/harness/ranks.hpp"

namespace squeal::test {

using Complex = std::complex<double>;

inline std::vector<Complex> eigenvaluesOf(const pencil::ComplexModes& point) {
  std::vector<Complex> list;
  for (const auto& eigenvalue : point.eigenvalues) list.push_back(eigenvalue.s);
  return list;
}

/// Free vibrations as eigenvalues iω.
inline std::vector<Complex> eigenvaluesOf(const modes::Modes& modes) {
  std::vector<Complex> list;
  for (double frequency : modes.angularFrequency) list.emplace_back(0, frequency);
  return list;
}

/// The first `count` rows of an exact table.
template <class Table>
std::vector<Complex> exactValues(const Table& table, std::size_t count) {
  std::vector<Complex> list;
  for (std::size_t i = 0; i < count; ++i) list.push_back(table.at(i).s());
  return list;
}

/// For each wanted value the found one that belongs to it. The closest pair of all is matched
/// first, then the closest of the rest: no found value is used twice, so a double eigenvalue found
/// once shows as an error.
inline std::vector<Complex> matched(const std::vector<Complex>& wanted,
                                    const std::vector<Complex>& found) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    for (std::size_t j = 0; j < found.size(); ++j)
      if (const double distance = std::abs(wanted[i] - found[j]); !std::isnan(distance))
        pairs.emplace_back(distance, i, j);  // NaN has no place in an order, and is nobody's match
  std::sort(pairs.begin(), pairs.end());
  std::vector<Complex> result(wanted.size(),
                              Complex(NAN, NAN));  // too few found: every comparison fails
  std::vector<bool> done(wanted.size()), used(found.size());
  for (const auto& [distance, i, j] : pairs) {
    if (done[i] || used[j]) continue;
    done[i] = used[j] = true;
    result[i] = found[j];
  }
  return result;
}

/// How far a list is from the wanted one, value by value.
struct Errors {
  std::vector<double> modulus;    ///< | |s| − |s*| | / |s*|
  std::vector<double> growth;     ///< |Re s − Re s*|, 1/s
  std::vector<double> frequency;  ///< |Im s − Im s*| / |s*|
  std::vector<double> relative;   ///< |s − s*| / |s*|
};

inline Errors errors(const std::vector<Complex>& wanted, const std::vector<Complex>& found) {
  const auto match = matched(wanted, found);
  Errors result;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const double size = std::abs(wanted[i]);
    result.modulus.push_back(std::abs(std::abs(match[i]) - size) / size);
    result.growth.push_back(std::abs(match[i].real() - wanted[i].real()));
    result.frequency.push_back(std::abs(match[i].imag() - wanted[i].imag()) / size);
    result.relative.push_back(std::abs(match[i] - wanted[i]) / size);
  }
  return result;
}

/// The largest of the first `count` errors, or NaN if one of them is; NaN as well where there is
/// none, since an empty list shows nothing.
inline double worst(const std::vector<double>& values, std::size_t count) {
  if (count == 0) return NAN;
  double result = 0;
  for (std::size_t i = 0; i < count; ++i) result = worse(result, values.at(i));
  return result;
}

/// Checks that each wanted value is found within `tolerance` of its size, and none beside them.
inline void expectSpectrum(const std::vector<Complex>& found, const std::vector<Complex>& wanted,
                           double tolerance) {
  EXPECT_EQ(found.size(), wanted.size());
  EXPECT_LT(worst(errors(wanted, found).relative), tolerance);
}

inline double rootMeanSquare(const std::vector<double>& values) {
  double sum = 0;
  for (double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Prints and checks the order of convergence of each error between two meshes, the second of cells
/// half as large.
inline void expectOrder(double expected, double tolerance, const std::vector<double>& coarse,
                        const std::vector<double>& fine, const char* what) {
  ASSERT_FALSE(coarse.empty()) << what;
  ASSERT_EQ(coarse.size(), fine.size()) << what;
  double low = INFINITY, high = -INFINITY;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const double order = std::log2(coarse[i] / fine[i]);
    low = std::min(low, order), high = std::max(high, order);
    EXPECT_NEAR(order, expected, tolerance)
        << what << ", number " << i + 1 << ": errors " << coarse[i] << " and " << fine[i];
  }
  print("orders of %s: %.3f to %.3f\n", what, low, high);
}

}  // namespace squeal::test
