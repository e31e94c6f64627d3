// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Roots of characteristic equations, and whether computed eigenvalues are all of them.
#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "exact/waves.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/harness/largest_error.hpp"

namespace squeal::test {

/// f(n, s): analytic in s, zero where s is an eigenvalue of wave number index n and nowhere else.
using Characteristic = std::function<Complex(int, Complex)>;

/// How far the rows of a table are from roots of their characteristic equation.
template <class Table>
double worstStep(const Table& table, const Characteristic& characteristic) {
  double worst = 0;
  for (const auto& row : table)
    worst = worse(worst, std::abs(exact::newtonStep(
                             [&](Complex s) { return characteristic(row.n, s); }, row.s())));
  return worst;
}

/// Number of roots with |s| < radius and Im s > radius/50, by the turns of f along the edge of this
/// region (argument principle).
inline int rootCount(const Characteristic& characteristic, int n, double radius) {
  const double low = radius / 50, start = std::asin(low / radius), half = radius * std::cos(start);
  const int steps = 1000;
  std::vector<Complex> edge;
  for (int i = 0; i < steps; ++i)
    edge.push_back(std::polar(radius, start + (M_PI - 2 * start) * i / steps));
  for (int i = 0; i <= steps; ++i) edge.emplace_back(-half + 2 * half * i / steps, low);
  double turned = 0;
  Complex before = characteristic(n, edge.front());
  for (std::size_t i = 1; i < edge.size(); ++i) {
    const Complex here = characteristic(n, edge[i]);
    const double step = std::arg(here / before);
    EXPECT_LT(std::abs(step), 1) << "steps along the edge are too long to follow the argument, n = "
                                 << n;
    turned += step, before = here;
  }
  return static_cast<int>(std::lround(turned / (2 * M_PI)));
}

/// The roots of all families of waves and of all wave numbers that Newton's method finds from the
/// computed eigenvalues, each once: the known ones are divided out.
inline std::vector<Complex> rootsNear(const std::vector<Complex>& found,
                                      const std::vector<Characteristic>& families, int highest) {
  std::vector<Complex> all;
  for (const auto& characteristic : families)
    for (int n = -highest; n <= highest; ++n) {
      std::vector<Complex> roots;
      const auto deflated = [&](Complex s) {
        return std::accumulate(roots.begin(), roots.end(), characteristic(n, s),
                               [&](Complex f, Complex r) { return f / (s - r); });
      };
      for (Complex start : found) {
        Complex s = start, step = 1;
        for (int i = 0; i < 12 && std::abs(step) > 1e-12; ++i)
          s -= step = exact::newtonStep(deflated, s);
        if (std::abs(step) < 1e-9 && std::abs(s - start) < 0.01 * std::abs(start))
          roots.push_back(s);
      }
      all.insert(all.end(), roots.begin(), roots.end());
    }
  return all;
}

/// Each computed eigenvalue is close to a root of its own, and they are as many as there are roots.
/// The computed ones are those nearest to zero; the last fifth is left out, as the edge of the
/// region should not pass between a root and its approximation.
inline void expectSpectrum(std::vector<Complex> found, const std::vector<Characteristic>& families,
                           double tolerance, const std::string& label) {
  SCOPED_TRACE(label);
  std::sort(found.begin(), found.end(),
            [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
  std::size_t kept = found.size() * 4 / 5;
  while (kept + 1 < found.size() &&
         std::abs(found[kept]) < (1 + 2 * tolerance) * std::abs(found[kept - 1]))
    ++kept;
  ASSERT_LT(kept + 1, found.size());
  const double radius = (std::abs(found[kept - 1]) + std::abs(found[kept])) / 2;
  found.resize(kept);

  const int highest = 9;
  int count = 0;
  for (const auto& characteristic : families) {
    for (int n = -highest; n <= highest; ++n) count += rootCount(characteristic, n, radius);
    for (int n : {-highest, highest})
      EXPECT_EQ(rootCount(characteristic, n, radius), 0) << "more wave numbers are needed";
  }
  EXPECT_EQ(static_cast<int>(found.size()), count);

  const auto roots = matched(found, rootsNear(found, families, highest));
  double modulus = 0, growth = 0, fastest = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double error = std::abs(roots[i] - found[i]) / std::abs(found[i]);
    EXPECT_LT(error, tolerance) << found[i];  // false if NaN: no root of its own
    modulus = worse(modulus, error);
    growth = worse(growth, std::abs(roots[i].real() - found[i].real()));
    fastest = worse(fastest, found[i].real());
  }
  EXPECT_LT(growth, 1e-3);
  print(
      "%s: %zu eigenvalues, %d roots with |s| < %.3f, worst: |s - s*|/|s*| %.1e, growth rate %.1e "
      "(fastest: %.3f)\n",
      label.c_str(), found.size(), count, radius, modulus, growth, fastest);
}

}  // namespace squeal::test
