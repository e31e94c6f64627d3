// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/completeness/damped_subspace.hpp"

#include <algorithm>
#include <cmath>

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

Subspace subspace(const DampedSet& set, const DenseMatrix& jumps, const DampedPoint& point) {
  constexpr double roundOffOfJumps = 1e-11, accurate = 1e-7;
  const DenseMatrix factor = linalg::choleskyFactor(set.energy),
                    turn = linalg::inverseTransposed(factor);
  const PetscInt size = turn.rows(), fixed = set.modes.first + set.modes.count;
  DenseMatrix responses = linalg::transposedProduct(turn, linalg::transposed(jumps)),
              more(size - fixed);
  DenseMatrix left = linalg::rowRange(responses, fixed, size);
  normalise(responses);
  extendSpan(more, linalg::rowRange(responses, fixed, size), roundOffOfJumps);
  removePart(more, left);
  DenseMatrix vectors(size);
  if (point.vectors.columns() > 0) vectors = linalg::transposedProduct(factor, point.vectors);
  if (point.forces.columns() > 0) vectors.append(linalg::transposedProduct(turn, point.forces));
  if (vectors.columns() > 0) {
    normalise(vectors);
    extendSpan(more, linalg::rowRange(vectors, fixed, size), accurate);
  }
  Subspace result{DenseMatrix(turn.columnRange(0, fixed)),
                  proof::quickBound(linalg::DenseView(left))};
  if (more.columns() > 0)
    result.vectors.append(linalg::product(turn.columnRange(fixed, size), more));
  return result;
}

}  // namespace squeal::completeness
