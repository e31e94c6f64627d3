// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/factored_friction.hpp"

#include "algebra/linalg/rows.hpp"
#include "base/system/concatenation.hpp"

namespace squeal::reduction {

using linalg::DenseMatrix;

DenseMatrix productWithBasis(const subspace::Basis& basis, Mat rows, PetscInt first) {
  PetscInt own = 0;
  check(MatGetLocalSize(rows, &own, nullptr));
  linalg::Block product(own);
  basis.appendProducts(rows, first, basis.size(), product);
  return linalg::gatheredRows(Concatenation(basis.comm(), own), product);
}

FactoredFriction::FactoredFriction(const subspace::Basis& basis, pencil::FrictionFactors factors)
    : basis_(basis) {
  for (auto& term : factors.slip) slip_.push_back({std::move(term), {}});
  for (auto& term : factors.normal) normal_.push_back({std::move(term), {}});
  extend();
}

void FactoredFriction::extend() {
  for (auto* list : {&slip_, &normal_})
    for (auto& [term, timesV] : *list)
      if (timesV.columns() < basis_.size()) {
        timesV.append(productWithBasis(basis_, term.matrix, timesV.columns()));
        last_.clear();
      }
}

void FactoredFriction::combine(const DenseMatrix& combinations) {
  for (auto* list : {&slip_, &normal_})
    for (auto& factor : *list) factor.timesV = linalg::product(factor.timesV, combinations);
  last_.clear();
}

const std::vector<FactoredFriction::Product>& FactoredFriction::products(
    const std::vector<PetscInt>& rows) const {
  if (!last_.empty() && rows == lastRows_) return last_;
  last_.clear();
  for (const auto& slip : slip_) {
    const DenseMatrix left = linalg::rowsOf(rows, slip.timesV);
    for (const auto& normal : normal_)
      last_.push_back({&slip.term, &normal.term,
                       linalg::transposedProduct(left, linalg::rowsOf(rows, normal.timesV))});
  }
  lastRows_ = rows;
  return last_;
}

void FactoredFriction::addTo(const sweep::Parameters& at, const std::vector<PetscInt>& rows,
                             linalg::DenseProblem& sum) const {
  if (rows.empty()) return;
  for (const auto& [slip, normal, matrix] : products(rows)) {
    const double c = slip->coefficient(at) * normal->coefficient(at);
    // Without damping of the bodies, the terms of friction have none either.
    if (c == 0 || (normal->power == 1 && sum.damping.empty())) continue;
    linalg::addScaled(sum.ofPower(normal->power), c, matrix);
  }
}

}  // namespace squeal::reduction
