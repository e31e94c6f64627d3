// SPDX-License-Identifier: BSD-2-Clause
// Derivatives of eigenvalues against closed forms and by their sums, of matrices from files, and in
// tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "eigen/sensitivity/sensitivity.hpp"
#include "run/report/sensitivities.hpp"
#include "support/eigen/sensitivity_checks.hpp"

namespace squeal {
namespace {

using test::Complex;
using test::sensitivities::Configuration;
using test::sensitivities::expectBalance;
using test::sensitivities::expectDifferences;
using test::sensitivities::run;

// Mass on a belt: s² = −2 ± √(1 − 4f/3), so that 2 s ds/df = ∓ (2/3) / √(…). Beyond the merger at
// 3/4 one of both grows, and is kept.
TEST(Sensitivity, OfTheBeltInClosedForm) {
  for (const double f : {0.8, 1.0, 2.0}) {
    const analysis::Analysis analysis = run({"external", "", f, {}}, "", 1);
    const auto& point = analysis.flutter.segments.at(0).points.at(0);
    EXPECT_EQ(point.sensitivities.size(), 1u);
    for (std::size_t i = 0; i < point.sensitivities.size(); ++i) {
      const auto& [condition, separation, error, derivatives] = point.sensitivities[i];
      const Complex root(0, std::sqrt(4 * f / 3 - 1)), s = std::sqrt(root - 2.0),
                                                       wanted = -(2. / 3) / root / (2.0 * s);
      EXPECT_EQ(derivatives.size(), 3u);
      for (const auto& [name, found, second] : derivatives) {
        test::print("belt at friction %g, condition %.2f, %s: %.12g%+.12gi\n", f, condition,
                    name.c_str(), found.real(), found.imag());
        // Rounding of s and of the vectors, times the square of the condition number at most.
        EXPECT_LT(std::abs(found - (name == "friction" ? wanted : 0)),
                  1e-14 * condition * condition)
            << name;
      }
    }
  }
}

// The damped chain beyond its critical friction, which here counts as much less at higher speed.
TEST(Sensitivity, OfMatricesFromFiles) {
  const Configuration model{"external_chain", "-matrices_friction_speed_exponent 1", 1.2, {}};
  expectDifferences(model, run(model, "", 1));
}

// All moduli by a factor and all densities by another multiply all eigenvalues of undamped bodies
// under approximation A by the root of their quotient: Σ ds/d ln E = s/2, Σ ds/d ln ρ = −s/2. Any
// left vector would say so: this is a test of the matrices of the bodies.
TEST(Sensitivity, OfAllBodiesTogether) {
  const analysis::Analysis analysis =
      run({"two_layers", "-mesh_set nx=12,ny_disc=4,ny_pad=3 -modes_count 60"}, "", 1);
  const auto& point = analysis.flutter.segments.at(0).points.at(0);
  EXPECT_EQ(point.sensitivities.size(), 3u);
  expectBalance(analysis, point);
  for (std::size_t i = 0; i < point.sensitivities.size(); ++i) {
    const Complex s = point.eigenvalues[point.shapes[i].index].s;
    Complex moduli = 0, densities = 0;
    for (const auto& [name, value, second] : point.sensitivities[i].derivatives) {
      if (name.starts_with("young_")) moduli += value;
      if (name.starts_with("density_")) densities += value;
    }
    test::print("reduced: left backward error %.0e, errors of the sums %.0e and %.0e\n",
                point.sensitivities[i].leftBackwardError, std::abs(moduli - 0.5 * s) / std::abs(s),
                std::abs(densities + 0.5 * s) / std::abs(s));
    EXPECT_LT(std::abs(moduli - 0.5 * s), 1e-7 * std::abs(s));
    EXPECT_LT(std::abs(densities + 0.5 * s), 1e-7 * std::abs(s));
  }
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> list;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) list.push_back(line);
  return list;
}

// A row for each mode and parameter, and one without numbers for a mode without derivatives.
TEST(Sensitivity, InTables) {
  analysis::Analysis analysis =
      run({"two_layers", "-mesh_set nx=12,ny_disc=4,ny_pad=3 -modes_count 60"}, "", 1);
  auto& point = analysis.flutter.segments.at(0).points.at(0);
  EXPECT_EQ(point.sensitivities.size(), 3u);
  auto& first = point.sensitivities.at(0);
  const auto full = lines(report::sensitivityTable(analysis)),
             work = lines(report::frictionWorkTable(analysis));
  EXPECT_EQ(full.size(), 1 + 3 * first.derivatives.size());
  EXPECT_EQ(work.size(), 1 + 3 * analysis.model.contact.interfaces.names.size());
  for (const auto* table : {&full, &work})
    for (const auto& line : *table)
      EXPECT_EQ(std::count(line.begin(), line.end(), ','),
                std::count(table->front().begin(), table->front().end(), ','))
          << line;
  EXPECT_TRUE(first.regular());
  first.condition = 1e6;
  EXPECT_FALSE(first.regular());
  const auto count = first.derivatives.size();
  first.derivatives.clear();
  const auto rest = lines(report::sensitivityTable(analysis));
  EXPECT_EQ(rest.size(), full.size() - count + 1);
  EXPECT_TRUE(rest.at(1).ends_with(",none,,,"));
}

}  // namespace
}  // namespace squeal
