// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/missing.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/petsc/log_events.hpp"
#include "eigen/reduction/companion.hpp"

namespace squeal::reduction {

using linalg::DensePair;
using linalg::DenseProblem;

namespace {

/// Removes the components along known eigenvectors and their conjugates from vectors of the
/// companion form.
class Deflation {
 public:
  Deflation(const Companion& companion, const std::vector<const DensePair*>& pairs)
      : right_(companion.right(pairs)), left_(companion.left(pairs)) {
    for (std::size_t j = 0; j < pairs.size(); ++j) {
      if (pairs[j]->s.imag() == 0) continue;
      for (auto* vectors : {&right_, &left_}) {
        std::vector<Complex> conjugate(vectors->column(j).begin(), vectors->column(j).end());
        for (auto& entry : conjugate) entry = std::conj(entry);
        vectors->append(std::span<const Complex>(conjugate));
      }
    }
    gram_.emplace(linalg::adjointProduct(left_, right_));
  }
  void apply(ComplexMatrix& z) const {
    ComplexMatrix coefficients = linalg::adjointProduct(left_, z);
    gram_->solve(coefficients);
    addScaled(z, -1, linalg::product(right_, coefficients));
  }

 private:
  ComplexMatrix right_, left_;
  std::optional<linalg::Lu<Complex>> gram_;
};

/// Returns the eigenvalues s = σ + 1/t for the Ritz values t of (A − σB)⁻¹B that the Arnoldi method
/// finds with known vectors deflated.
std::vector<Complex> arnoldi(const Companion& companion, const Deflation& deflation,
                             Complex shift) {
  constexpr PetscInt mostSteps = 16;
  constexpr double converged = 0.1;  // of a Ritz value: enough to locate it
  const PetscInt rows = 2 * companion.order(), steps = std::min(mostSteps, rows);
  const ShiftInvert inverse(companion, shift);
  ComplexMatrix basis(rows), z(rows, 1), hessenberg(steps + 1, steps);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (auto& entry : z.entries()) entry = {uniform(random), uniform(random)};
  PetscInt size = 0;
  for (;; ++size) {
    deflation.apply(z);
    for (int pass = 0; pass < 2 && size > 0; ++pass) {
      const ComplexMatrix h = linalg::adjointProduct(basis, z);
      for (PetscInt i = 0; i < size; ++i) hessenberg(i, size - 1) += h(i, 0);
      addScaled(z, -1, linalg::product(basis, h));
    }
    const double rest = length(z.column(0));
    if (size > 0) hessenberg(size, size - 1) = rest;
    if (size == steps || !(rest > 0) || !std::isfinite(rest)) break;
    for (auto& entry : z.entries()) entry /= rest;
    basis.append(std::span<const Complex>(z.column(0)));
    z = inverse.apply(z);
  }
  ComplexMatrix square(size, size);
  for (PetscInt j = 0; j < size; ++j)
    for (PetscInt i = 0; i < size; ++i) square(i, j) = hessenberg(i, j);
  const linalg::ComplexEigen solved = linalg::eigen(std::move(square));
  std::vector<Complex> found;
  for (PetscInt k = 0; k < size; ++k) {
    const double residual =
        std::abs(hessenberg(size, size - 1)) * std::abs(solved.right(size - 1, k));
    if (solved.value[k] != 0.0 && residual <= converged * std::abs(solved.value[k]))
      found.push_back(shift + 1.0 / solved.value[k]);
  }
  return found;
}

}  // namespace

std::optional<Complex> findMissing(const DenseProblem& problem, const std::vector<DensePair>& pairs,
                                   Complex shift, const linalg::EigenvalueFilter& wanted) {
  const LoggedWork logged(Work::denseEigenvalues);
  const Companion companion(problem, largestSize(pairs));
  std::vector<const DensePair*> list;
  for (const auto& pair : pairs) list.push_back(&pair);
  const Deflation deflation(companion, list);
  for (const Complex s : arnoldi(companion, deflation, shift))
    if (s.imag() >= 0 && wanted(s)) return s;
  return {};
}

}  // namespace squeal::reduction
