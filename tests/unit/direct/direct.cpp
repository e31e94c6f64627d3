// The direct solve on all unknowns, with and without damping, of chains whose eigenvalues are known
// in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "direct/direct.hpp"
#include "pencil/complex_modes.hpp"
#include "pencil/pencil.hpp"
#include "support/case.hpp"
#include "support/model.hpp"
#include "support/spectrum.hpp"

namespace squeal {
namespace {

using test::Complex;

/// `copies` equal chains of `length` masses m between walls, springs k, dampers proportional: Z = α
/// M + β K. With
///   κ_j = 4 k/m sin²(jπ / (2 (length + 1))):  s² + (α + β κ_j) s + κ_j = 0, `copies` times.
struct Chains {
  PetscInt length, copies;
  double mass, spring, alpha, beta;

  PetscInt size() const { return length * copies; }
  OwnedMat tridiagonal(double diagonal, double beside) const {
    OwnedMat matrix;
    check(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, size(), size(), 3, nullptr, 2,
                       nullptr, matrix.out()));
    PetscInt first = 0, end = 0;
    check(MatGetOwnershipRange(matrix, &first, &end));
    for (PetscInt i = first; i < end; ++i)
      for (const PetscInt j : {i - 1, i, i + 1})
        if (j >= 0 && j < size() && j / length == i / length)
          check(MatSetValue(matrix, i, j, i == j ? diagonal : beside, INSERT_VALUES));
    check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
    return matrix;
  }
  pencil::Pencil pencil() const {
    std::vector<pencil::Term> terms;
    terms.push_back({tridiagonal(2 * spring, -spring), 0, 0, 1});
    terms.push_back({tridiagonal(mass, 0), 2, 0, 1});
    if (alpha > 0) terms.push_back({tridiagonal(mass, 0), 1, 0, alpha});
    if (beta > 0) terms.push_back({tridiagonal(2 * spring, -spring), 1, 0, beta});
    return pencil::Pencil(std::move(terms));
  }
  /// Im s ≥ 0, by ascending |s|.
  std::vector<Complex> exact() const {
    std::vector<Complex> list;
    for (PetscInt j = 1; j <= length; ++j)
      for (PetscInt copy = 0; copy < copies; ++copy) {
        const double sine = std::sin(static_cast<double>(j) * M_PI /
                                     (2.0 * (static_cast<double>(length) + 1))),
                     kappa = 4 * spring / mass * sine * sine, half = (alpha + beta * kappa) / 2;
        const Complex root = std::sqrt(Complex(half * half - kappa));
        list.push_back(-half + root);
        if (root.imag() == 0) list.push_back(-half - root);
      }
    std::sort(list.begin(), list.end(),
              [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
    return list;
  }
};

/// Undamped; all under-damped; the lowest modes overdamped, with two real eigenvalues each.
Chains chains(PetscInt length, PetscInt copies, double alpha) {
  return {length, copies, 0.01, 4e5, alpha, alpha > 0 ? 1e-6 : 0.0};
}
constexpr double alphas[] = {0, 20, 3e3};

pencil::ComplexModes solve(const Chains& problem, const std::string& options) {
  test::setOptions(options);
  return direct::solveDirect(problem.pencil(), {0.0, 1.0}, problem.tridiagonal(1, 0));
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
  EXPECT_TRUE(
      test::contains(test::errorOf([] { direct::rejectIdleSolverOptions(); }), "-flutter_pep_ncv"));
}

}  // namespace
}  // namespace squeal
