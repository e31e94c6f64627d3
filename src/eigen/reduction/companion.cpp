// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/companion.hpp"

#include <algorithm>
#include <cmath>

namespace squeal::reduction {

using linalg::DensePair;
using linalg::DenseProblem;

namespace {

ComplexMatrix stacked(const ComplexMatrix& top, const ComplexMatrix& bottom) {
  ComplexMatrix result(2 * top.rows(), top.columns());
  for (PetscInt j = 0; j < top.columns(); ++j) {
    std::ranges::copy(top.column(j), result.column(j).begin());
    std::ranges::copy(bottom.column(j), result.column(j).begin() + top.rows());
  }
  return result;
}

/// Returns P(σ) of a problem.
ComplexMatrix valueAt(const DenseProblem& problem, Complex shift) {
  const auto &mass = problem.mass, &damping = problem.damping, &stiffness = problem.stiffness;
  const PetscInt m = problem.order();
  const Complex square = shift * shift;
  ComplexMatrix sum(m, m);
  for (PetscInt j = 0; j < m; ++j)
    for (PetscInt i = 0; i < m; ++i)
      sum(i, j) = {square.real() * mass(i, j) + stiffness(i, j), square.imag() * mass(i, j)};
  for (PetscInt j = 0; j < damping.columns(); ++j)
    for (PetscInt i = 0; i < m; ++i)
      sum(i, j) += Complex(shift.real() * damping(i, j), shift.imag() * damping(i, j));
  return sum;
}

}  // namespace

void normalise(ComplexMatrix& x) {
  for (PetscInt j = 0; j < x.columns(); ++j) {
    const double size = length(x.column(j));
    for (auto& entry : x.column(j)) entry /= size;
  }
}

ComplexMatrix rowsOf(const ComplexMatrix& x, PetscInt first, PetscInt last) {
  ComplexMatrix result(last - first, x.columns());
  for (PetscInt j = 0; j < x.columns(); ++j)
    for (PetscInt i = first; i < last; ++i) result(i - first, j) = x(i, j);
  return result;
}

void addScaled(ComplexMatrix& sum, Complex factor, const ComplexMatrix& x) {
  ensure(sum.rows() == x.rows() && sum.columns() == x.columns(),
         "a sum is of matrices of the same size");
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const Complex entry = x.data()[i];
    sum.data()[i] += Complex(factor.real() * entry.real() - factor.imag() * entry.imag(),
                             factor.real() * entry.imag() + factor.imag() * entry.real());
  }
}

double largestSize(const std::vector<DensePair>& pairs) {
  double size = 0;
  for (const auto& pair : pairs) size = std::max(size, std::abs(pair.s));
  return size > 0 ? size : 1;
}

ComplexMatrix Companion::right(const std::vector<const DensePair*>& pairs) const {
  ComplexMatrix x(order()), v;
  for (const auto* pair : pairs) x.append(std::span<const Complex>(pair->q));
  v = x;
  for (std::size_t j = 0; j < pairs.size(); ++j)
    for (auto& entry : v.column(j)) entry *= pairs[j]->s / unit_;
  return stacked(x, v);
}

ComplexMatrix Companion::left(const std::vector<const DensePair*>& pairs) const {
  ComplexMatrix y(order());
  for (const auto* pair : pairs) y.append(std::span<const Complex>(pair->left));
  ComplexMatrix top = linalg::product(problem_->damping, y, true),
                bottom = linalg::product(problem_->mass, y, true);
  for (std::size_t j = 0; j < pairs.size(); ++j)
    for (PetscInt i = 0; i < order(); ++i) {
      top(i, j) += std::conj(pairs[j]->s) * bottom(i, j);
      bottom(i, j) *= unit_;
    }
  ComplexMatrix result = stacked(top, bottom);
  normalise(result);
  return result;
}

ShiftInvert::ShiftInvert(const Companion& companion, Complex shift)
    : companion_(companion), shift_(shift), factors_(valueAt(companion.problem(), shift)) {}

ComplexMatrix ShiftInvert::apply(const ComplexMatrix& z) const {
  //   P(σ) x = −[M v + (Z + σM) u],   and the new v is u + σ x
  const PetscInt m = companion_.order();
  const auto& problem = companion_.problem();
  const ComplexMatrix u = rowsOf(z, 0, m);
  ComplexMatrix v = rowsOf(z, m, 2 * m);
  for (auto& entry : v.entries()) entry *= -companion_.unit();
  addScaled(v, -shift_, u);
  ComplexMatrix x = linalg::product(problem.mass, v);
  addScaled(x, -1, linalg::product(problem.damping, u));
  factors_.solve(x);
  ComplexMatrix next = u;
  addScaled(next, shift_, x);
  for (auto& entry : next.entries()) entry /= companion_.unit();
  return stacked(x, next);
}

ComplexMatrix ShiftInvert::leftVectors(const ComplexMatrix& l) const {
  const PetscInt m = companion_.order();
  ComplexMatrix t = rowsOf(l, 0, m);
  addScaled(t, std::conj(shift_) / companion_.unit(), rowsOf(l, m, 2 * m));
  factors_.solve(t, true);
  for (auto& entry : t.entries()) entry = -entry;
  return t;
}

ComplexMatrix ShiftInvert::applyAdjoint(const ComplexMatrix& l) const {
  //   top: (Z + σM)ᴴ t + l₂ / unit,   bottom: unit Mᵀ t
  const PetscInt m = companion_.order();
  const auto& problem = companion_.problem();
  const ComplexMatrix t = leftVectors(l);
  ComplexMatrix bottom = linalg::product(problem.mass, t, true),
                top = linalg::product(problem.damping, t, true);
  addScaled(top, std::conj(shift_), bottom);
  addScaled(top, 1 / companion_.unit(), rowsOf(l, m, 2 * m));
  for (auto& entry : bottom.entries()) entry *= companion_.unit();
  return stacked(top, bottom);
}

}  // namespace squeal::reduction
