// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/subspace/substructure.hpp"

#include <algorithm>

#include "algebra/linalg/rows.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/system/error.hpp"

namespace squeal::subspace {

using linalg::DenseMatrix;

PointSpace::PointSpace(const DenseMatrix& boundaryStiffness, const std::vector<unsigned char>& has)
    : all_(boundaryStiffness.rows()) {
  for (std::size_t i = 0; i < has.size(); ++i)
    if (has[i]) boundary_.push_back(i);
  try {
    turn_ = linalg::inverseTransposed(
        linalg::choleskyFactor(linalg::principalPart(boundary_, boundaryStiffness)));
  } catch (const Error&) {
    throw Error(
        "a body is under-constrained: with the present open contact nodes the stiffness matrix is "
        "not positive definite");
  }
}

std::vector<Complex> PointSpace::lifted(const std::vector<Complex>& q) const {
  if (isWhole() || q.empty()) return q;
  std::vector<Complex> result(all_), part(own());
  for (PetscInt j = 0; j < own(); ++j) {
    const auto column = turn_.column(j);
    for (PetscInt i = 0; i <= j; ++i) part[i] += column[i] * q[j];
  }
  for (PetscInt i = 0; i < own(); ++i) result[boundary_[i]] = part[i];
  result.insert(result.end(), q.begin() + own(), q.end());
  return result;
}

DenseMatrix PointSpace::restrictedColumns(const DenseMatrix& a) const {
  if (isWhole()) return a;
  // A C, with C = (L⁻ᵀ on the unknowns of the point; the identity)
  DenseMatrix some(a.rows(), own());
  for (PetscInt j = 0; j < own(); ++j)
    std::ranges::copy(a.column(boundary_[j]), some.column(j).begin());
  DenseMatrix result = own() > 0 ? linalg::product(some, turn_) : std::move(some);
  result.append(a.columnRange(all_, a.columns()));
  return result;
}

DenseMatrix PointSpace::restricted(const DenseMatrix& a) const {
  if (a.empty()) return a;
  const PetscInt k = own(), n = size(a.rows());
  const DenseMatrix right = restrictedColumns(a);
  DenseMatrix top(k, n), result(n, n);
  for (PetscInt j = 0; j < n; ++j) {
    for (PetscInt i = 0; i < k; ++i) top(i, j) = right(boundary_[i], j);
    for (PetscInt i = k; i < n; ++i) result(i, j) = right(all_ - k + i, j);
  }
  if (k == 0) return result;
  top = linalg::transposedProduct(turn_, top);
  for (PetscInt j = 0; j < n; ++j) std::ranges::copy(top.column(j), result.column(j).begin());
  return result;
}

linalg::DenseProblem PointSpace::restricted(linalg::DenseProblem problem) const {
  if (isWhole()) return problem;
  for (const auto matrix : {&linalg::DenseProblem::mass, &linalg::DenseProblem::damping,
                            &linalg::DenseProblem::stiffness})
    problem.*matrix = restricted(problem.*matrix);
  return problem;
}

}  // namespace squeal::subspace
