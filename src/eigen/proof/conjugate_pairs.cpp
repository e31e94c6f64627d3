// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/proof/conjugate_pairs.hpp"

namespace squeal::proof {

using linalg::ComplexMatrix;
using linalg::DenseMatrix;

namespace {

/// Replaces X by X U.
void combineColumns(ComplexMatrix& x, const ConjugatePairs& pairs) {
  for (PetscInt j = 0; j < x.columns(); ++j)
    if (pairs[j] == Member::first)
      for (PetscInt i = 0; i < x.rows(); ++i) {
        const Complex real = x(i, j), imaginary = Complex(0, 1) * x(i, j + 1);
        x(i, j) = real + imaginary;
        x(i, j + 1) = real - imaginary;
      }
}

/// Replaces Y by U⁻¹ Y.
void separateRows(ComplexMatrix& y, const ConjugatePairs& pairs) {
  for (PetscInt j = 0; j < y.columns(); ++j)
    for (PetscInt i = 0; i < y.rows(); ++i)
      if (pairs[i] == Member::first) {
        const Complex real = 0.5 * y(i, j), imaginary = Complex(0, 0.5) * y(i + 1, j);
        y(i, j) = real - imaginary;
        y(i + 1, j) = real + imaginary;
      }
}

ComplexMatrix complexCopy(const DenseMatrix& a) {
  return {a.rows(), a.columns(), std::vector<Complex>(a.entries().begin(), a.entries().end())};
}

}  // namespace

ComplexMatrix complexColumns(const DenseMatrix& stored, const ConjugatePairs& pairs) {
  auto x = complexCopy(stored);
  combineColumns(x, pairs);
  return x;
}

ComplexMatrix complexRows(const DenseMatrix& stored, const ConjugatePairs& pairs) {
  auto y = complexCopy(stored);
  separateRows(y, pairs);
  return y;
}

ComplexMatrix complexForm(const DenseMatrix& a, const ConjugatePairs& pairs) {
  auto result = complexCopy(a);
  combineColumns(result, pairs);
  separateRows(result, pairs);
  return result;
}

ComplexMatrix storedRows(ComplexMatrix g, const ConjugatePairs& pairs) {
  for (PetscInt j = 0; j < g.columns(); ++j)
    for (PetscInt i = 0; i < g.rows(); ++i)
      if (pairs[i] == Member::first) {
        const Complex one = g(i, j), other = g(i + 1, j);
        g(i, j) = one + other;
        g(i + 1, j) = Complex(0, 1) * (one - other);
      }
  return g;
}

}  // namespace squeal::proof
