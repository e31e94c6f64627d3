// SPDX-License-Identifier: BSD-2-Clause
// The proof for a problem with infinitely many unknowns in closed form:
//   K0 = diag(j²),  M0 = 1,  S = (1, 1, …),  N = ((−1)^j),  j = 1, 2, …,
//   P(s) = K0 + s² M0 + f Sᵀ N,   det(K0 + s² M0)⁻¹ P = 1 + f (π s / sinh π s − 1) / (2 s²).
// V are the first m modes and K0⁻¹ Sᵀ. All that V leaves out are sums of powers of j.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "eigen/proof/count.hpp"
#include "eigen/proof/enclosure.hpp"
#include "eigen/proof/expansion.hpp"

namespace {

using namespace squeal;
using std::numbers::pi;

constexpr double top = 5.5;

/// Returns the sum of 1 / j^p, or of (−1)^j / j^p, over j > m.
double tail(int m, int p, bool alternating) {
  constexpr int last = 20000;
  const double end = last + 0.5;
  // Midpoint rule, and mean of two partial sums; the errors are below 1e-13 for p ≥ 2.
  double sum = alternating ? -0.5 * std::pow(end, -p) : std::pow(end, 1 - p) / (p - 1);
  for (int j = last; j > m; --j) sum += (alternating && j % 2 ? -1 : 1) * std::pow(j, -p);
  return sum;
}

enum class Bound { exact, parts, free };

struct Model {
  proof::KeptProblem problem;
  proof::LeftOut leftOut;
};

/// In energy coordinates, M = diag(1/j²), S_j = 1/j and N_j = (−1)^j / j.
Model model(int m, double f, Bound bound) {
  const double length = std::sqrt(tail(m, 2, false));  // of K0⁻¹ Sᵀ without its part on the modes
  const double massQQ = tail(m, 4, false) / (length * length), normalQ = tail(m, 2, true) / length,
               theta = (m + 1.0) * (m + 1.0);
  // Grams of M_CQ and N_C
  double mass = tail(m, 6, false) / (length * length) - massQQ * massQQ;
  const double mixed = tail(m, 4, true) / length - massQQ * normalQ,
               normal = length * length - normalQ * normalQ;
  if (bound == Bound::free) mass = massQQ / theta - massQQ * massQQ;  // from 0 ≤ M ≤ 1/θ on C
  linalg::DenseMatrix stiffness(m + 1, m + 1), massVV(m + 1, m + 1), slip(m + 1, 1);
  for (int i = 0; i <= m; ++i) {
    stiffness(i, i) = 1;
    massVV(i, i) = i < m ? 1 / std::pow(i + 1, 2) : massQQ;
    slip(i, 0) = i < m ? 1.0 / (i + 1) : length;
  }
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= m; ++i)
      stiffness(i, j) += f * slip(i, 0) * (j < m ? (j % 2 ? 1.0 : -1.0) / (j + 1) : normalQ);
  Model result;
  result.leftOut.mass = 1 / theta;
  result.problem.matrices = {stiffness, {}, massVV};
  const int rows = bound == Bound::exact ? 2 : 1;
  linalg::DenseMatrix to(rows, m + 1), from(m + 1, rows), friction(m + 1, rows);
  to(0, m) = from(m, 0) = std::sqrt(mass);
  for (int i = 0; i <= m; ++i) {
    if (bound == Bound::exact) {  // the coordinates of N_C along M_CQ and across it
      friction(i, 0) = f * slip(i, 0) * mixed / std::sqrt(mass);
      friction(i, 1) = f * slip(i, 0) * std::sqrt(normal - mixed * mixed / mass);
    } else {
      friction(i, 0) = f * slip(i, 0) * std::sqrt(normal);
    }
  }
  using proof::Coefficients, proof::Coupling;
  const linalg::DenseMatrix none;
  result.problem.toLeftOut = {Coupling{Coefficients{none, none, to}}};
  if (bound == Bound::exact)
    result.problem.fromLeftOut = {Coupling{Coefficients{friction, none, from}}};
  else
    result.problem.fromLeftOut = {Coupling{Coefficients{none, none, from}},
                                  Coupling{Coefficients{friction, none, none}}};
  return result;
}

/// Returns the largest ratio at 400 points of the boundary.
double largestRatio(const Model& model, const proof::DiagonalForm& form) {
  double largest = 0;
  for (int i = 0; i <= 400; ++i)
    largest =
        std::max(largest, proof::Expansion(form, std::polar(1.0, pi * i / 400), 0).boundAtCentre());
  return largest / proof::definiteness(model.leftOut, top, top);
}

struct Case {
  int modes;
  double friction, exact, parts, free;
};

// The ratios were computed with 30 digits from the same formulas, on 4,000 points.
constexpr Case cases[] = {{6, 4, 0.43204, 0.53457, 0.85793},
                          {10, 4, 0.04374, 0.05149, 0.08314},
                          {6, 8, 0.76541, 0.88325, 1.35893},
                          {7, 8, 0.33048, 0.38428, 0.58975}};

TEST(ClosedForm, RatiosAndCounts) {
  for (const auto& item : cases)
    for (const auto& [bound, expected] :
         {std::pair(Bound::exact, item.exact), std::pair(Bound::parts, item.parts),
          std::pair(Bound::free, item.free)}) {
      const auto given = model(item.modes, item.friction, bound);
      const proof::DiagonalForm form(given.problem, top);
      // 400 points miss the maximum by less than 1e-4 of it, and norms are bounded within 1e-4.
      EXPECT_NEAR(largestRatio(given, form), expected, 3e-4 * expected);
      const auto proof = proof::proveCount(form, given.leftOut, {top});
      EXPECT_EQ(proof.verdict, expected < 1 ? proof::Verdict::proved : proof::Verdict::ratio);
      EXPECT_NEAR(proof.definiteness, 1 - std::pow(top / (item.modes + 1), 2), 1e-12);
      EXPECT_EQ(proof.count, 10);
    }
}

/// Returns the root of the closed form near s, by the secant method.
Complex root(double f, Complex s) {
  const auto determinant = [f](Complex z) {
    return 1.0 + f * (pi * z / std::sinh(pi * z) - 1.0) / (2.0 * z * z);
  };
  Complex before = s * (1.0 + 1e-6);
  for (int i = 0; i < 20 && std::abs(s - before) > 1e-12; ++i) {
    const Complex slope = (determinant(s) - determinant(before)) / (s - before);
    before = s;
    s -= determinant(s) / slope;
  }
  return s;
}

// Each root with nine digits; those with a real part also with the opposite one.
const std::vector<std::pair<double, std::vector<Complex>>> roots = {
    {1, {{0, 0.396214045}, {0, 2.221874757}, {0, 2.824700566}, {0, 4.120741440}, {0, 4.898285023}}},
    {2, {{0.729022722, 0}, {0.124687209, 2.530631339}, {0, 4.247189306}, {0, 4.783352474}}},
    {4, {{1.317626572, 0}, {0.399889816, 2.531435478}, {0.227636476, 4.521430743}}}};

TEST(ClosedForm, DiscsHoldTheEigenvalues) {
  for (const auto& [f, values] : roots) {
    const auto given = model(30, f, Bound::free);
    const proof::DiagonalForm form(given.problem, top);
    ASSERT_EQ(proof::proveCount(form, given.leftOut, {top}).verdict, proof::Verdict::proved);
    auto discs = proof::enclose(form, given.leftOut, {top});
    ASSERT_EQ(discs.size(), 10u);
    std::vector<Complex> list;
    int imaginary = 0;
    for (const auto value : values) {
      const auto exact = root(f, value);
      EXPECT_LT(std::abs(exact - value), 1e-9);
      list.push_back(exact);
      if (value.real() != 0) list.push_back(-std::conj(exact));
      imaginary += value.real() == 0;
    }
    const auto judged = proof::judge(list, discs, {top}, 0);
    EXPECT_TRUE(judged.missing.empty());
    for (const auto& entry : judged.entries) {
      EXPECT_EQ(entry.agreement, proof::Agreement::right) << f;  // within the radius itself
      EXPECT_GT(entry.radius, 0);
    }
    int neutral = 0;
    for (const auto& disc : discs) {
      EXPECT_EQ(disc.isolation, proof::Isolation::single);
      EXPECT_LT(disc.inner, 1e-3);
      neutral += disc.neutral;
    }
    EXPECT_EQ(neutral, 2 * imaginary);
  }
}

}  // namespace
