// SPDX-License-Identifier: BSD-2-Clause
// The direct solve on all unknowns, with and without damping, of chains whose eigenvalues are known
// in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "eigen/direct/direct.hpp"
#include "eigen/direct/nearest.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "support/eigen/mass_chains.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using test::alphas;
using test::Chains;
using test::chains;
using test::Complex;

pencil::ComplexModes solve(const Chains& problem, const std::string& options) {
  test::setOptions(options);
  return direct::solveDirect(problem.pencil(), {0.0, 1.0}, problem.tridiagonal(1, 0),
                             direct::Settings::given(pencil::Settings::given()));
}

/// The found eigenvalues are the wanted ones, as often.
void expectSpectrum(const pencil::ComplexModes& point, const std::vector<Complex>& wanted) {
  EXPECT_EQ(point.eigenvalues.size(), wanted.size());
  // The solver's tolerance is 1e-12; in proportional damping no eigenvalue is more sensitive than
  // ten times that.
  EXPECT_LT(test::worst(test::errors(wanted, test::eigenvaluesOf(point)).relative), 1e-11);
  EXPECT_LT(point.worstBackwardError(), 1e-12);
  for (std::size_t i = 1; i < point.eigenvalues.size(); ++i)
    EXPECT_GE(point.eigenvalues[i].s.imag(), point.eigenvalues[i - 1].s.imag());
}

std::vector<Complex> nearest(std::vector<Complex> exact, std::size_t count) {
  const double last = (1 + 1e-9) * std::abs(exact.at(count - 1));
  std::erase_if(exact, [&](Complex s) { return std::abs(s) > last; });
  return exact;
}

// Single, double and triple eigenvalues, complex and real ones; those as near as the twentieth are
// listed with it.
TEST(Direct, FindsMultipleEigenvalues) {
  for (const PetscInt copies : {1, 2, 3})
    for (const double alpha : alphas) {
      const auto problem = chains(100, copies, alpha);
      const auto point = solve(problem, "-flutter_direct_count 20");
      expectSpectrum(point, nearest(problem.exact(), 20));
      EXPECT_EQ(point.coveredTo, 0);
      EXPECT_EQ(point.unstableCount(), 0);
    }
}

// Problems too small for a Krylov space, on a rank or two without a row.
TEST(Direct, FindsAllOfATinyProblem) {
  for (const PetscInt length : {1, 2, 3, 10})
    for (const double alpha : alphas) {
      const auto problem = chains(length, 1, alpha);
      expectSpectrum(solve(problem, "-flutter_direct_count 100"), problem.exact());
      expectSpectrum(solve(problem, "-flutter_direct_count 1"), nearest(problem.exact(), 1));
    }
}

std::vector<Complex> inBand(std::vector<Complex> exact, double low, double high, double coveredTo) {
  std::erase_if(exact, [&](Complex s) {
    return s.imag() < low || s.imag() > high || std::abs(s) > std::min(high, coveredTo);
  });
  return exact;
}

// The band holds more than the five first asked for. Overdamped eigenvalues larger than its top do
// not belong to it.
TEST(Direct, CoversABand) {
  for (const double alpha : alphas) {
    constexpr double high = 2 * M_PI * 400;
    const double low = alpha == 20 ? 2 * M_PI * 150 : 0;
    const auto problem = chains(80, 2, alpha);
    const auto point = solve(problem, std::string("-flutter_direct_count 5 -flutter_direct_band ") +
                                          (low > 0 ? "150" : "0") + ",400");
    const auto wanted = inBand(problem.exact(), low, high, INFINITY);
    EXPECT_GT(wanted.size(), 10u);
    expectSpectrum(point, wanted);
    EXPECT_EQ(point.coveredTo, high);
  }
}

TEST(Direct, CoversABandThatHoldsAll) {
  const auto problem = chains(12, 1, 20);
  const auto point = solve(problem, "-flutter_direct_count 3 -flutter_direct_band 0,1e6");
  expectSpectrum(point, problem.exact());
  EXPECT_EQ(point.coveredTo, 2 * M_PI * 1e6);
}

// Where the limit ends the search, what is listed is complete up to `coveredTo`.
TEST(Direct, TellsHowFarTheLimitReaches) {
  for (const double alpha : alphas) {
    const auto problem = chains(120, 1, alpha);
    const auto point = solve(
        problem, "-flutter_direct_count 4 -flutter_direct_limit 9 -flutter_direct_band 50,700");
    EXPECT_GT(point.coveredTo, 2 * M_PI * 50);
    EXPECT_LT(point.coveredTo, 2 * M_PI * 700);
    std::vector<Complex> found;
    for (const Complex s : test::eigenvaluesOf(point))
      if (std::abs(s) < (1 - 1e-9) * point.coveredTo)
        found.push_back(s);  // the last one itself is on the edge
    const auto wanted =
        inBand(problem.exact(), 2 * M_PI * 50, 2 * M_PI * 700, (1 - 1e-9) * point.coveredTo);
    EXPECT_GT(wanted.size(), 2u);
    EXPECT_EQ(found.size(), wanted.size());
    EXPECT_LT(test::worst(test::errors(wanted, found).relative), 1e-11);
  }
}

TEST(Direct, WrongOptionsAreErrors) {
  const auto problem = chains(60, 1, 20), undamped = chains(60, 1, 0);
  const auto error = [](const Chains& of, const std::string& options) {
    return test::errorOf([&] { solve(of, "-flutter_direct_count 5 " + options); });
  };
  for (const char* band : {"3", "5,2", "1,1", "1,2,3"})
    EXPECT_TRUE(test::contains(error(problem, std::string("-flutter_direct_band ") + band),
                               "-flutter_direct_band"))
        << band;
  EXPECT_TRUE(test::contains(error(problem, "-flutter_pep_foo 1"), "-flutter_pep_foo"));
  EXPECT_TRUE(test::contains(error(problem, "-flutter_st_foo 1"), "-flutter_st_foo"));
  EXPECT_TRUE(test::contains(error(undamped, "-flutter_eps_foo 1"), "-flutter_eps_foo"));
  EXPECT_TRUE(test::contains(error(problem, "-flutter_pep_max_it 1 -flutter_pep_ncv 11 "),
                             "raise -flutter_pep_max_it"));
  test::setOptions("-flutter_pep_ncv 30");
  EXPECT_TRUE(test::contains(
      test::errorOf([] { direct::rejectIdleSolverOptions(pencil::Settings::given().method); }),
      "-flutter_pep_ncv"));
}

}  // namespace
}  // namespace squeal
