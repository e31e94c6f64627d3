// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/completeness/kept_span.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/linalg/symmetric.hpp"
#include "eigen/proof/norm_bound.hpp"

namespace squeal::completeness {
namespace {

using linalg::DenseMatrix;

/// Removes from X its part in the span of the orthonormal columns Q.
void removePart(const DenseMatrix& q, DenseMatrix& x) {
  if (q.columns() > 0) linalg::multiplyAdd(q, linalg::transposedProduct(q, x), x, -1);
}

/// Extends the orthonormal columns of Q until their span contains the columns of X, which have
/// length 1 or less, within `accuracy`.
void extendSpan(DenseMatrix& q, DenseMatrix x, double accuracy) {
  // The eigenvalues of XᵀX have half the digits: the second pass finds what the first one lost.
  for (const double small : {std::max(accuracy, 1e-6), accuracy}) {
    removePart(q, x);
    DenseMatrix vectors = linalg::transposedProduct(x, x);
    if (vectors.empty()) return;
    const auto squares = linalg::symmetricEigen(vectors);
    DenseMatrix large(vectors.rows());
    for (PetscInt k = 0; k < vectors.columns(); ++k) {
      if (!(squares[k] > small * small)) continue;
      for (double& entry : vectors.column(k)) entry /= std::sqrt(squares[k]);
      large.append(vectors.column(k));
    }
    if (large.columns() == 0) continue;
    DenseMatrix more = linalg::product(x, large);
    for (int pass = 0; pass < 2; ++pass) {
      removePart(q, more);
      more = linalg::product(
          more,
          linalg::inverseTransposed(linalg::choleskyFactor(linalg::transposedProduct(more, more))));
    }
    q.append(more);
  }
}

/// Divides the columns by their lengths.
void normalise(DenseMatrix& columns) {
  for (PetscInt j = 0; j < columns.columns(); ++j) {
    const double length = std::sqrt(linalg::squaredLength(columns.column(j)));
    for (double& entry : columns.column(j)) entry = length > 0 ? entry / length : 0;
  }
}

}  // namespace

DenseMatrix leftOf(DenseMatrix flexibility, const DenseMatrix& onKept, PetscInt boundary) {
  const DenseMatrix inner(onKept.columnRange(boundary, onKept.columns()));
  linalg::addScaled(flexibility, -1, linalg::product(inner, linalg::transposed(inner)));
  return linalg::symmetricPart(flexibility);
}

KeptSpan::KeptSpan(const KnownModes& modes, const DenseMatrix& energy, const DenseMatrix& rows)
    : fixed_(modes.first + modes.count),
      factor_(linalg::choleskyFactor(energy)),
      turn_(linalg::inverseTransposed(factor_)),
      responses_(energy.rows() - fixed_) {
  constexpr double roundOff = 1e-11;
  if (rows.empty()) return;
  DenseMatrix responses = linalg::transposedProduct(turn_, linalg::transposed(rows)),
              left = linalg::rowRange(responses, fixed_, responses.rows());
  normalise(responses);
  extendSpan(responses_, linalg::rowRange(responses, fixed_, responses.rows()), roundOff);
  removePart(responses_, left);
  forcesLeft_ = proof::quickBound(linalg::DenseView(left));
}

/// Returns the modes and these vectors of the other coordinates.
DenseMatrix KeptSpan::withModes(const DenseMatrix& others) const {
  DenseMatrix whole(turn_.rows(), fixed_ + others.columns());
  for (PetscInt j = 0; j < fixed_; ++j) whole(j, j) = 1;
  for (PetscInt j = 0; j < others.columns(); ++j)
    std::ranges::copy(others.column(j), whole.column(fixed_ + j).begin() + fixed_);
  return whole;
}

/// Returns W for more vectors in the coordinates in which V is orthonormal.
DenseMatrix KeptSpan::extended(DenseMatrix orthonormal) const {
  constexpr double accurate = 1e-7;
  DenseMatrix others = responses_;
  if (orthonormal.columns() > 0) {
    normalise(orthonormal);
    extendSpan(others, linalg::rowRange(orthonormal, fixed_, orthonormal.rows()), accurate);
  }
  return withModes(others);
}

DenseMatrix KeptSpan::vectorsWith(const DenseMatrix& more, const DenseMatrix& forces) const {
  DenseMatrix all(turn_.rows());
  if (more.columns() > 0) all.append(linalg::transposedProduct(factor_, more));
  if (forces.columns() > 0) all.append(linalg::transposedProduct(turn_, forces));
  return extended(std::move(all));
}

}  // namespace squeal::completeness
