// SPDX-License-Identifier: BSD-2-Clause
// Left eigenvectors of full problems against LAPACK, and derivatives of two coupled oscillators in
// closed form.
#include "eigen/sensitivity/null_vectors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "algebra/linalg/columns.hpp"
#include "algebra/linalg/complexvector.hpp"
#include "algebra/linalg/quadratic.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/sensitivity/sensitivity.hpp"
#include "eigen/subspace/basis.hpp"
#include "eigen/sweep/parameters.hpp"
#include "model/contact/coupled.hpp"
#include "problem/terms/terms.hpp"
#include "support/eigen/full_problem.hpp"
#include "support/problem/coarse_layers.hpp"

namespace squeal {
namespace {

using Complex = std::complex<double>;

linalg::ComplexVector vectorOf(Mat layout, const std::vector<Complex>& entries) {
  linalg::ComplexVector vector;
  check(MatCreateVecs(layout, vector.real.out(), vector.imaginary.out()));
  PetscInt first = 0, end = 0;
  check(VecGetOwnershipRange(vector.real, &first, &end));
  for (PetscInt i = first; i < end; ++i) {
    check(VecSetValue(vector.real, i, entries[i].real(), INSERT_VALUES));
    check(VecSetValue(vector.imaginary, i, entries[i].imag(), INSERT_VALUES));
  }
  for (Vec part : {vector.real.get(), vector.imaginary.get()})
    check(VecAssemblyBegin(part)), check(VecAssemblyEnd(part));
  return vector;
}

// Sixty free modes of the layers' 156 unknowns; pairs of the lower two fifths, as in the band of
// the reduced problem. The left vectors of LAPACK on all unknowns span the same lines: with
// backward errors of 1e-10 and eigenvalues apart by some hundredths they turn by 1e-7 at most,
// which changes the cosine by the square.
TEST(Left, VectorsAreThoseOfAllUnknowns) {
  for (const std::string damping : {"", " -material_pad_rayleigh_stiffness 0.01"}) {
    const test::Layers layers("-modes_count 60" + damping);
    const auto& system = *layers.system;
    const auto pencil = terms::affineTerms(layers.model.contact, system);
    const auto modes = layers.modes();
    const linalg::ReadColumns start(modes.vectors);
    const sweep::Parameters at{0.4};
    const auto full = linalg::solveQuadratic(test::fullProblem(pencil, at), linalg::Vectors::both);
    EXPECT_EQ(pencil.hasPower(1), !damping.empty());
    std::vector<linalg::ComplexVector> right, left;
    std::vector<sensitivity::RightPair> pairs;
    for (std::size_t i = 0; i < 24; i += 4) {
      right.push_back(vectorOf(system.k0(), full[i].q));
      left.push_back(vectorOf(system.k0(), full[i].left));
    }
    for (std::size_t i = 0; i < right.size(); ++i) pairs.push_back({full[4 * i].s, &right[i]});
    const auto found = sensitivity::leftVectors(pencil, at, {start.view(), system.m0(), {}},
                                                system.solver(), pairs, {});
    EXPECT_EQ(found.size(), pairs.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double cosine = std::abs(linalg::dot(found[i].vector, left[i])) /
                            (linalg::length(found[i].vector) * linalg::length(left[i]));
      test::print("s = %.4f%+.4fi: backward error %.0e, cosine less 1: %.0e\n", pairs[i].s.real(),
                  pairs[i].s.imag(), found[i].backwardError, cosine - 1);
      EXPECT_LT(found[i].backwardError, 1e-10);
      EXPECT_NEAR(cosine, 1, 1e-11);
    }
  }
}

/// Returns V (1 + `change` N), where the entries of N are of the order of 1/√columns.
linalg::Block mixed(const linalg::DenseView& v, double change) {
  linalg::DenseMatrix combinations(v.columns(), v.columns());
  for (PetscInt j = 0; j < v.columns(); ++j)
    for (PetscInt i = 0; i < v.columns(); ++i)
      combinations(i, j) = (i == j) + change * std::sin(i + 7.0 * j) / std::sqrt(v.columns());
  return linalg::product(v, combinations);
}

// V as the solver makes it, orthonormal within a thousandth, and right vectors that lie in V: they
// add nothing. If what round-off leaves of them were added, the projected problem would be singular
// at every s, the more so as s is wrong by 1e-11.
TEST(Left, VectorsInAStartSpaceThatIsNearlyOrthonormal) {
  const test::Layers layers("-modes_count 60");
  const auto& system = *layers.system;
  const auto pencil = terms::affineTerms(layers.model.contact, system);
  const auto modes = layers.modes();
  const linalg::ReadColumns read(modes.vectors);
  const linalg::Block start = mixed(read.view(), 1e-3);
  const sweep::Parameters at{0.4};
  const auto full = linalg::solveQuadratic(test::fullProblem(pencil, at), linalg::Vectors::right);
  std::vector<linalg::ComplexVector> right;
  std::vector<sensitivity::RightPair> pairs;
  for (std::size_t i = 0; i < 24; i += 4) {
    std::vector<Complex> c(start.columns());
    for (std::size_t k = 0; k < c.size(); ++k) c[k] = {std::cos(k + i), std::sin(2.0 * k + i)};
    right.push_back(sensitivity::expanded(pencil, start, c));
  }
  for (std::size_t i = 0; i < right.size(); ++i)
    pairs.push_back({full[4 * i].s * (1 + 1e-11), &right[i]});
  const auto found =
      sensitivity::leftVectors(pencil, at, {start, system.m0(), {}}, system.solver(), pairs, {});
  for (const auto& one : found) {
    test::print("backward error %.0e after %d rounds\n", one.backwardError, one.rounds);
    EXPECT_LE(one.backwardError, 1e-10);
    EXPECT_LE(one.rounds, 10);
  }
}

// Round-off limits the backward error, and the corrections of what it leaves always find something
// new: an accuracy beyond that is not sought for all 20 rounds.
TEST(Left, SearchEndsWhereRoundOffLimitsIt) {
  const test::Layers layers("-modes_count 60");
  const auto& system = *layers.system;
  const auto pencil = terms::affineTerms(layers.model.contact, system);
  const auto modes = layers.modes();
  const linalg::ReadColumns start(modes.vectors);
  const sweep::Parameters at{0.4};
  const auto full = linalg::solveQuadratic(test::fullProblem(pencil, at), linalg::Vectors::right);
  const auto right = vectorOf(system.k0(), full[4].q);
  const auto found =
      sensitivity::leftVectors(pencil, at, {start.view(), system.m0(), {}}, system.solver(),
                               {{full[4].s, &right}}, {.accuracy = 0, .simple = false});
  test::print("backward error %.0e after %d rounds\n", found[0].backwardError, found[0].rounds);
  EXPECT_LT(found[0].backwardError, 1e-14);
  EXPECT_LT(found[0].rounds, 20);
}

OwnedMat matrix2(double a, double b, double c, double d) {
  OwnedMat result;
  check(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, 2, 2, 2, nullptr, 2, nullptr,
                     result.out()));
  const double entries[2][2] = {{a, b}, {c, d}};
  PetscInt first = 0, end = 0;
  check(MatGetOwnershipRange(result, &first, &end));
  for (PetscInt i = first; i < end; ++i)
    for (PetscInt j = 0; j < 2; ++j) check(MatSetValue(result, i, j, entries[i][j], INSERT_VALUES));
  check(MatAssemblyBegin(result, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(result, MAT_FINAL_ASSEMBLY));
  return result;
}

// M = I, K = diag(k1, k2) + f k3 [0 1; −1 0]: s² = −μ, μ = (k1 + k2)/2 ± √(((k1 − k2)/2)² − f²
// k3²), so that
//   2 s ds/df = ± f k3² / √(…),   and the condition number is |k1 − k2|/2 over |√(…)| below the
//   critical friction, f k3 over it beyond.
TEST(Left, DerivativesOfCoupledOscillators) {
  const double k1 = 1.0, k2 = 1.5, k3 = 0.8, critical = (k2 - k1) / (2 * k3);
  std::vector<pencil::Term> terms;
  terms.push_back({matrix2(k1, 0, 0, k2), 0, 0, 1});
  terms.push_back({matrix2(0, k3, -k3, 0), 0, 1, 1});
  terms.push_back({matrix2(1, 0, 0, 1), 2, 0, 1});
  const pencil::Pencil pencil(std::move(terms));
  const Mat stiffness = pencil.terms()[0].matrix, mass = pencil.terms()[2].matrix;
  OwnedKSP solver;
  PC pc = nullptr;
  check(KSPCreate(PETSC_COMM_WORLD, solver.out()));
  check(KSPSetOperators(solver, stiffness, stiffness));
  check(KSPSetType(solver, KSPPREONLY));
  check(KSPGetPC(solver, &pc));
  check(PCSetType(pc, PCCHOLESKY));
  check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  PetscInt first = 0, end = 0;  // this rank's rows of the whole space
  check(MatGetOwnershipRange(mass, &first, &end));
  linalg::Block whole(end - first, 2);
  for (PetscInt i = first; i < end; ++i) whole(i - first, i) = 1;
  for (const double f : {0.5 * critical, 0.99 * critical, critical, 1.01 * critical, 2 * critical})
    for (const double sign : {-1.0, 1.0}) {
      const Complex root = std::sqrt(Complex((k2 - k1) * (k2 - k1) / 4 - f * f * k3 * k3)),
                    s = std::sqrt(-((k1 + k2) / 2 + sign * root));
      const auto right = vectorOf(stiffness, {f * k3, -(k1 + s * s)});
      const sweep::Parameters at{f};
      const auto left =
          sensitivity::leftVectors(pencil, at, {whole, mass, {}}, solver, {{s, &right}}, {});
      const sensitivity::EigenTriple triple{s, right, left[0].vector};
      const Complex slope = sensitivity::slopeForm(pencil, at, triple);
      const double condition = sensitivity::condition(triple, slope, mass);
      const pencil::Sensitivity sensitivity{condition, 1, left[0].backwardError, {}};
      test::print("f = %.4f: condition %.6g, left backward error %.0e\n", f, condition,
                  left[0].backwardError);
      EXPECT_EQ(sensitivity.regular(), f != critical);
      if (f == critical) continue;
      const Complex found = -sensitivity::parameterForm(pencil, at, triple,
                                                        &sweep::Parameters::friction) /
                            slope,
                    wanted = sign * f * k3 * k3 / root / (2.0 * s);
      // Rounding of s and of the vectors, times the square of the condition number at most.
      const double tolerance = 1e-14 * condition * condition;
      EXPECT_LT(std::abs(found - wanted), tolerance * std::abs(wanted));
      EXPECT_NEAR(condition, std::max((k2 - k1) / 2, f * k3) / std::abs(root),
                  tolerance * condition);
    }
}

}  // namespace
}  // namespace squeal
