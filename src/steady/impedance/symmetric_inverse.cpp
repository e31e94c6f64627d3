// SPDX-License-Identifier: BSD-2-Clause
#include "steady/impedance/symmetric_inverse.hpp"

#include <slepcblaslapack.h>

#include <algorithm>

#include "algebra/linalg/symmetric.hpp"

namespace squeal::impedance {

using linalg::DenseMatrix;

SymmetricInverse::SymmetricInverse(DenseMatrix a) : factor_(std::move(a)) {
  PetscBLASInt order = factor_.rows(), info = 0;
  if (order == 0) return;
  const DenseMatrix whole = factor_;
  LAPACKpotrf_("L", &order, factor_.data(), &order, &info);
  for (PetscInt i = 0; i < whole.rows() && info == 0; ++i)
    leastPivot_ = std::min(leastPivot_, factor_(i, i) * factor_(i, i) / whole(i, i));
  if (info == 0) return;
  leastPivot_ = 0;
  factor_ = whole;
  values_ = linalg::symmetricEigen(factor_);
}

void SymmetricInverse::apply(DenseMatrix& x) const {
  constexpr double rigid = 1e-12;
  PetscBLASInt order = factor_.rows(), columns = x.columns(), info = 0;
  if (order == 0 || columns == 0) return;
  if (values_.empty()) {
    LAPACKpotrs_("L", &order, &columns, factor_.data(), &order, x.data(), &order, &info);
    return;
  }
  DenseMatrix parts = linalg::transposedProduct(factor_, x);
  for (PetscInt j = 0; j < parts.columns(); ++j)
    for (PetscInt i = 0; i < parts.rows(); ++i)
      parts(i, j) = values_[i] > rigid * values_.back() ? parts(i, j) / values_[i] : 0;
  x = linalg::product(factor_, parts);
}

}  // namespace squeal::impedance
