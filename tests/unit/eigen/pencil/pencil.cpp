// SPDX-License-Identifier: BSD-2-Clause
// Norms of the terms of a pencil, and backward errors of eigenpairs.
#include "eigen/pencil/pencil.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>  // before the next header, which needs it

#include <petscblaslapack.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "algebra/linalg/complexvector.hpp"
#include "algebra/linalg/lapack.hpp"
#include "algebra/linalg/quadratic.hpp"
#include "base/petsc/matrix.hpp"
#include "problem/terms/terms.hpp"
#include "support/algebra/sparse.hpp"
#include "support/eigen/full_problem.hpp"
#include "support/harness/largest_error.hpp"
#include "support/problem/coarse_layers.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using test::Layers;

double largestSingularValue(linalg::DenseMatrix a) {
  PetscBLASInt n = a.rows(), one = 1, info = 0;
  std::vector<double> values(n);
  linalg::callWithWork([&](double* work, PetscBLASInt length) {
    LAPACKgesvd_("N", "N", &n, &n, a.data(), &n, values.data(), nullptr, &one, nullptr, &one, work,
                 &length, &info);
  });
  EXPECT_EQ(info, 0);
  return values.at(0);
}

// From below, so that no backward error is flattered, and not far below.
TEST(Norm, IsJustBelowTheLargestSingularValue) {
  const Layers layers;
  const auto pencil = terms::affineTerms(layers.model.contact, *layers.system);
  EXPECT_EQ(pencil.norm(1, {0.3}), 0);  // no damping
  for (const int power : {0, 2})
    for (const double f : {0.0, 0.3, 0.5, 2.0}) {
      const double exact = largestSingularValue(test::fullMatrix(pencil, power, {f})),
                   estimate = pencil.norm(power, {f});
      test::print("norm of the terms in s^%d at f = %g: estimate / exact = %.4f\n", power, f,
                  estimate / exact);
      EXPECT_LE(estimate, (1 + 1e-12) * exact);
      EXPECT_GE(estimate, 0.95 * exact);
    }
}

// K0 and M0 have no friction. Their power iteration is the start of that at a point.
TEST(Norm, ContinuesThatOfTheAssociatedMatrices) {
  const Layers layers;
  const auto pencil = terms::affineTerms(layers.model.contact, *layers.system);
  const auto associated = pencil.associated();
  ASSERT_LT(associated.terms().size(), pencil.terms().size());
  for (const auto& term : associated.terms()) EXPECT_TRUE(term.isAssociated());
  for (const int power : {0, 2})
    for (const auto* one : {&associated, &pencil}) {
      const double exact = largestSingularValue(test::fullMatrix(*one, power, {0.5})),
                   estimate = one->norm(power, {0.5});
      EXPECT_LE(estimate, (1 + 1e-12) * exact);
      EXPECT_GE(estimate, 0.95 * exact);
    }
  // One more step comes closer; a pencil that starts again would reach the same estimate.
  const auto other = terms::affineTerms(layers.model.contact, *layers.system);
  const double first = other.associated().norm(0, {});
  EXPECT_GT(other.norm(0, {0}), first);
}

// A term that is zero at the first friction of a sweep, as friction-induced damping is at f = 0,
// has a norm at the next.
TEST(Norm, RecoversFromAVanishingTerm) {
  std::vector<pencil::Term> terms;
  terms.push_back({test::matrixOf(2, {{0, 0, 3}, {1, 1, -5}}), 1, 1, 1});
  const pencil::Pencil pencil(std::move(terms));
  EXPECT_EQ(pencil.norm(1, {0}), 0);
  EXPECT_NEAR(pencil.norm(1, {0.5}), 2.5, 0.05 * 2.5);
}

// Exact eigenpairs of the layers, from LAPACK on all their unknowns, and the same pairs with s
// moved by a known step:
//   P(s + δ) d = (2 s δ + δ²) M̄ d.
TEST(BackwardError, OfExactAndOfPerturbedPairs) {
  constexpr double friction = 0.4;
  const Layers layers;
  const auto pencil = terms::affineTerms(layers.model.contact, *layers.system);
  const auto problem = test::fullProblem(pencil, {friction});
  const double stiffnessNorm = largestSingularValue(problem.stiffness),
               massNorm = largestSingularValue(problem.mass);
  const auto pairs = linalg::solveQuadratic(problem);
  const auto forces = linalg::timesVectors(problem.mass, pairs);  // M̄ d
  EXPECT_TRUE(std::any_of(pairs.begin(), pairs.end(), [](const auto& pair) {
    return pair.s.real() > 1e-3;
  }));  // complex ones among them
  linalg::ComplexVector d;
  check(MatCreateVecs(layers.system->k0(), d.real.out(), d.imaginary.out()));
  double worst = 0;
  for (std::size_t k = 0; k < pairs.size(); k += 7) {
    const auto& s = pairs[k].s;
    const auto& q = pairs[k].q;
    for (std::size_t i = 0; i < q.size(); ++i) {
      check(VecSetValue(d.real, i, q[i].real(), INSERT_VALUES));
      check(VecSetValue(d.imaginary, i, q[i].imag(), INSERT_VALUES));
    }
    double length = 0;
    for (const Complex force : forces.column(k)) length += std::norm(force);
    for (Vec part : {d.real.get(), d.imaginary.get()})
      check(VecAssemblyBegin(part)), check(VecAssemblyEnd(part));
    worst = test::worse(worst, pencil::backwardError(pencil, {friction}, s, d));
    for (const Complex step : {Complex(1e-3, 0), Complex(0, -1e-6), Complex(2e-9, 1e-9)}) {
      const Complex delta = step * std::abs(s), there = s + delta;
      const double size = std::abs(there);
      const double exact = std::abs(2.0 * s * delta + delta * delta) * std::sqrt(length) /
                           (size * size * massNorm + stiffnessNorm);
      EXPECT_NEAR(pencil::backwardError(pencil, {friction}, there, d), exact,
                  0.05 * exact);  // norms are estimates
    }
  }
  test::print("backward error of LAPACK's pairs, %d unknowns: %.1e\n",
              static_cast<int>(problem.order()), worst);
  // Rounding of a backward stable method: a few units times a power of the size.
  EXPECT_LT(worst, 1e-14);
}

// s = 0 is an eigenvalue like any other.
TEST(BackwardError, OfARealVectorAndOfZero) {
  std::vector<pencil::Term> terms;
  terms.push_back({test::matrixOf(2, {{0, 0, 4}}), 0, 0, 1});
  terms.push_back({test::matrixOf(2, {{0, 0, 1}, {1, 1, 1}}), 2, 0, 1});
  const pencil::Pencil pencil(std::move(terms));
  linalg::ComplexVector d;
  check(MatCreateVecs(pencil.terms()[0].matrix, d.real.out(), d.imaginary.out()));
  check(VecZeroEntries(d.imaginary));
  const auto set = [&](double a, double b) {
    check(VecSetValue(d.real, 0, a, INSERT_VALUES));
    check(VecSetValue(d.real, 1, b, INSERT_VALUES));
    check(VecAssemblyBegin(d.real));
    check(VecAssemblyEnd(d.real));
  };
  set(3, 0);
  EXPECT_LT(pencil::backwardError(pencil, {}, {0, 2}, d), 1e-15);
  EXPECT_NEAR(pencil::backwardError(pencil, {}, {0, 1}, d), (4 - 1) / (1.0 * 1 + 4), 1e-6);
  set(0, 5);
  EXPECT_LT(pencil::backwardError(pencil, {}, 0, d), 1e-15);
}

// The terms of one point with the same power of s are added, with their coefficients at that point:
// 2 f A and 3 v B. Terms of K0 and M0 are added to each other only, and a single term keeps its
// matrix.
TEST(PointSums, AreTheSumsOfTheTermsOfThePoint) {
  const auto entry = [](PetscInt row, PetscInt column, double value) {
    return test::matrixOf(2, {{row, column, value}});
  };
  std::vector<pencil::Term> affine, own;
  affine.push_back({entry(0, 0, 7)});
  own.push_back({.matrix = entry(0, 0, 5), .frictionExponent = 1, .factor = 2});
  check(MatSetOption(own[0].matrix, MAT_SYMMETRIC, PETSC_TRUE));
  own.push_back({.matrix = entry(1, 1, 11)});  // of K0
  own.push_back({.matrix = entry(1, 0, 13), .power = 1, .ofFriction = true});
  own.push_back({.matrix = entry(1, 0, 17), .factor = 3, .speedExponent = 1, .ofFriction = true});
  const pencil::Pencil pencil = pencil::Pencil(std::move(affine)).with(std::move(own));
  const auto sums = pencil.pointSums({.friction = 0.5, .speed = 4});
  ASSERT_EQ(sums.size(), 3u);
  EXPECT_TRUE(sums[1].isAssociated());
  EXPECT_EQ(sums[1].matrix.get(), pencil.terms()[2].matrix.get());
  EXPECT_EQ(sums[2].power, 1);
  EXPECT_EQ(sums[2].matrix.get(), pencil.terms()[3].matrix.get());
  EXPECT_EQ(sums[0].power, 0);
  EXPECT_FALSE(sums[0].isAssociated());
  EXPECT_EQ(sums[0].coefficient({.friction = 0.1, .speed = 9}), 1);
  const linalg::DenseMatrix sum = test::denseCopy(sums[0].matrix);
  EXPECT_EQ(sum(0, 0), 2 * 0.5 * 5);
  EXPECT_EQ(sum(1, 0), 3 * 4 * 17);
  EXPECT_EQ(sum(0, 1), 0);
  EXPECT_EQ(sum(1, 1), 0);
  // The terms of the pencil are as before.
  EXPECT_EQ(test::denseCopy(pencil.terms()[1].matrix)(0, 0), 5);
  EXPECT_TRUE(isSymmetric(pencil.terms()[1].matrix));
  EXPECT_FALSE(isSymmetric(sums[0].matrix));
}

}  // namespace
}  // namespace squeal
