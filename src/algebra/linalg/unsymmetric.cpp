// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/linalg/unsymmetric.hpp"

#include <slepcsys.h>  // first: the next header needs it

#include <slepcblaslapack.h>

#include <algorithm>

#include "algebra/linalg/lapack.hpp"
#include "base/petsc/check.hpp"

extern "C" void dgebal_(const char* job, const PetscBLASInt* n, double* a, const PetscBLASInt* lda,
                        PetscBLASInt* low, PetscBLASInt* high, double* scale, PetscBLASInt* info);

namespace squeal::linalg {

std::vector<Complex> conjugated(std::vector<Complex> vector) {
  for (auto& entry : vector) entry = std::conj(entry);
  return vector;
}

namespace {

/// Returns column j of LAPACK's real storage of conjugate pairs; empty for an empty matrix.
std::vector<Complex> complexColumn(const DenseMatrix& vectors, PetscInt j, bool conjugates) {
  std::vector<Complex> column(vectors.empty() ? 0 : vectors.rows());
  for (std::size_t i = 0; i < column.size(); ++i)
    column[i] = {vectors(i, j), conjugates ? vectors(i, j + 1) : 0.0};
  return column;
}

/// Returns the wanted eigenvalues from LAPACK's real storage of conjugate pairs as complex numbers.
/// Each eigenvalue of a conjugate pair is tested separately.
std::vector<EigenPair> unpacked(const std::vector<double>& real,
                                const std::vector<double>& imaginary,
                                const std::vector<double>& beta, const DenseMatrix& right,
                                const DenseMatrix& left, const EigenvalueFilter& wanted) {
  std::vector<EigenPair> pairs;
  for (std::size_t j = 0; j < real.size(); ++j) {
    if (beta[j] == 0 && real[j] == 0)
      throw Error(
          "the reduced eigenproblem is singular: mass and stiffness have a common null vector");
    if (beta[j] == 0) continue;  // infinite: a motion without mass
    const Complex value = Complex(real[j], imaginary[j]) / beta[j];
    const bool conjugates = imaginary[j] != 0, first = wanted(value),
               second = conjugates && wanted(std::conj(value));
    if (first || second) {
      EigenPair pair{value, complexColumn(right, j, conjugates),
                     complexColumn(left, j, conjugates)};
      if (second)
        pairs.push_back({std::conj(value), conjugated(pair.right), conjugated(pair.left)});
      if (first) pairs.push_back(std::move(pair));
    }
    if (conjugates) ++j;
  }
  return pairs;
}

/// Throws Error if a routine of LAPACK has failed.
void requireSuccess(const char* routine, PetscBLASInt info) {
  if (info != 0)
    throw Error(std::string("LAPACK ") + routine + " failed on the reduced eigenproblem (info " +
                std::to_string(info) + ")");
}

}  // namespace

std::vector<EigenPair> generalized(DenseMatrix a, DenseMatrix b, Vectors sides,
                                   const EigenvalueFilter& wanted) {
  PetscBLASInt n = a.rows(), info = 0;
  std::vector<double> real(n), imaginary(n), beta(n);
  DenseMatrix right(n, n), left(n, sides == Vectors::both ? n : 0);
  callWithWork([&](double* work, PetscBLASInt length) {
    LAPACKggev_(left.empty() ? "N" : "V", "V", &n, a.data(), &n, b.data(), &n, real.data(),
                imaginary.data(), beta.data(), left.data(), &n, right.data(), &n, work, &length,
                &info);
  });
  requireSuccess("dggev", info);
  return unpacked(real, imaginary, beta, right, left, wanted);
}

std::vector<EigenPair> standard(DenseMatrix a, Vectors sides, const EigenvalueFilter& wanted) {
  PetscBLASInt n = a.rows(), info = 0, sorted = 0, low = 0, high = 0;
  std::vector<double> real(n), imaginary(n), scale(n);
  DenseMatrix schur(n, n);
  dgebal_("S", &n, a.data(), &n, &low, &high, scale.data(),
          &info);  // D⁻¹ A D: matrices of mixed units
  requireSuccess("dgebal", info);
  callWithWork([&](double* work, PetscBLASInt length) {
    LAPACKgees_("V", "N", nullptr, &n, a.data(), &n, &sorted, real.data(), imaginary.data(),
                schur.data(), &n, work, &length, nullptr, &info);
  });
  requireSuccess("dgees", info);
  std::vector<PetscBLASInt> chosen(n, 0);
  std::vector<double> realParts, imaginaryParts;  // of the chosen eigenvalues
  for (PetscInt j = 0; j < n; ++j) {
    const PetscInt width = imaginary[j] != 0 ? 2 : 1;
    const Complex value(real[j], imaginary[j]);
    for (PetscInt k = j; k < j + width && (wanted(value) || wanted(std::conj(value))); ++k) {
      chosen[k] = 1;
      realParts.push_back(real[k]);
      imaginaryParts.push_back(imaginary[k]);
    }
    j += width - 1;
  }
  PetscBLASInt count = realParts.size(), found = 0;
  if (count == 0) return {};
  DenseMatrix right(n, count), left(n, sides == Vectors::both ? count : 0);
  std::vector<double> work(3 * n);
  LAPACKtrevc_(left.empty() ? "R" : "B", "S", chosen.data(), &n, a.data(), &n, left.data(), &n,
               right.data(), &n, &count, &found, work.data(), &info);
  requireSuccess("dtrevc", info);
  const auto turned = [&](const DenseMatrix& vectors, bool inverse) {
    DenseMatrix result = product(schur, vectors);
    for (PetscInt j = 0; j < result.columns(); ++j)
      for (PetscInt i = 0; i < n; ++i) result(i, j) *= inverse ? 1 / scale[i] : scale[i];
    return result;
  };
  return unpacked(realParts, imaginaryParts, std::vector<double>(count, 1.0), turned(right, false),
                  turned(left, true), wanted);
}

}  // namespace squeal::linalg
