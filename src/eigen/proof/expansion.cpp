// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/proof/expansion.hpp"

#include <cmath>
#include <limits>

#include "eigen/proof/lengths.hpp"
#include "eigen/proof/norm_bound.hpp"

namespace squeal::proof {

using linalg::ComplexMatrix;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Returns the Taylor coefficients about z0 of a polynomial.
std::vector<ComplexMatrix> shifted(const std::vector<ComplexMatrix>& polynomial, Complex z0) {
  auto result = polynomial;
  for (std::size_t first = 0; first + 1 < result.size(); ++first)  // Horner's scheme
    for (std::size_t i = result.size() - 1; i-- > first;) {
      const auto& higher = result[i + 1];
      if (higher.empty()) continue;
      auto& lower = result[i];
      if (lower.empty()) lower = ComplexMatrix(higher.rows(), higher.columns());
      for (std::size_t k = 0; k < lower.size(); ++k) lower.data()[k] += z0 * higher.data()[k];
    }
  return result;
}

/// Returns bounds of the lengths of the Taylor coefficients at a distance from 0, from those of the
/// coefficients: both [coefficient][index].
std::vector<std::vector<double>> shifted(std::vector<std::vector<double>> lengths,
                                         double distance) {
  for (std::size_t first = 0; first + 1 < lengths.size(); ++first)  // Horner's scheme
    for (std::size_t i = lengths.size() - 1; i-- > first;)
      for (std::size_t k = 0; k < lengths[i].size(); ++k)
        lengths[i][k] += distance * lengths[i + 1][k];
  return lengths;
}

/// Returns the sum of the norms of the blocks that the parts form. What is known of a part is a
/// majorant of its own, so that the norm of the whole matrix is not a bound.
double blockNorm(const ComplexMatrix& t, std::span<const PetscInt> rowEnds,
                 std::span<const PetscInt> columnEnds) {
  if (rowEnds.size() == 1 && columnEnds.size() == 1) return normBound(t);
  double sum = 0;
  PetscInt firstColumn = 0;
  for (const PetscInt lastColumn : columnEnds) {
    PetscInt firstRow = 0;
    for (const PetscInt lastRow : rowEnds) {
      ComplexMatrix block(lastRow - firstRow, lastColumn - firstColumn);
      for (PetscInt j = 0; j < block.columns(); ++j)
        for (PetscInt i = 0; i < block.rows(); ++i) block(i, j) = t(firstRow + i, firstColumn + j);
      sum += normBound(block);
      firstRow = lastRow;
    }
    firstColumn = lastColumn;
  }
  return sum;
}

}  // namespace

Expansion::Expansion(const DiagonalForm& form, Complex centre, int order, PetscInt omitted)
    : form_(form), centre_(centre), order_(order), omitted_(omitted) {
  const PetscInt size = form.size();
  const auto nu = form.nu();
  aSizes_ = shifted(form.aLengths(), std::abs(centre));
  std::vector<Complex> inverse(size);
  for (PetscInt k = 0; k < size; ++k) {
    const Complex denominator = 1.0 + (centre - 1.0) * nu[k];
    denominators_.push_back(std::abs(denominator));
    inverse[k] = k == omitted ? 0.0 : 1.0 / denominator;
  }
  const auto& a = form.a();
  const auto b = shifted(form.b(), centre);
  std::vector<ComplexMatrix> columns;
  for (const auto& matrix : a) columns.push_back(complexColumns(matrix, form.pairs()));
  for (const auto& matrix : shifted(columns, centre))
    aLengths_.push_back(columnLengths(matrix, form.rowEnds()));
  for (const auto& matrix : b)
    bLengths_.push_back(matrix.empty() ? std::vector<double>(size)
                                       : rowLengths(matrix, form.columnEnds()));
  lastLengths_.assign(size, 0);
  if (a.empty()) return;
  // (D + h diag(ν)) Σ hʲ G_j = Σ hʲ b_j:   G_j = D⁻¹ (b_j − diag(ν) G_(j−1)),
  // T_j = a_0 G_j + a_1 (z0 G_j + G_(j−1))   with a_0 and a_1 of z, not of h
  ComplexMatrix last;
  for (int j = 0; j <= order; ++j) {
    ComplexMatrix next(size, form.columnEnds().back());
    for (PetscInt column = 0; column < next.columns(); ++column)
      for (PetscInt k = 0; k < size; ++k) {
        Complex value = j < std::ssize(b) && !b[j].empty() ? b[j](k, column) : 0.0;
        if (j > 0) value -= nu[k] * last(k, column);
        next(k, column) = inverse[k] * value;
      }
    auto t = linalg::product(a[0], storedRows(next, form.pairs()));
    if (a.size() > 1) {
      if (last.empty()) last = ComplexMatrix(next.rows(), next.columns());
      for (std::size_t i = 0; i < last.size(); ++i) last.data()[i] += centre * next.data()[i];
      const auto more = linalg::product(a[1], storedRows(std::move(last), form.pairs()));
      for (std::size_t i = 0; i < t.size(); ++i) t.data()[i] += more.data()[i];
    }
    norms_.push_back(blockNorm(t, form.rowEnds(), form.columnEnds()));
    last = std::move(next);
  }
  lastLengths_ = rowLengths(last, form.columnEnds());
}

Expansion::Expansion(const DiagonalForm& form, Complex centre, const FarPart& far, PetscInt omitted)
    : form_(form),
      centre_(centre),
      order_(-1),
      omitted_(omitted),
      far_(&far),
      norms_{far.bound},
      aLengths_(shifted(form.aLengths(), std::abs(centre))),
      bLengths_(shifted(form.bLengths(), std::abs(centre))),
      aSizes_(aLengths_),
      lastLengths_(form.size()) {
  for (const auto nu : form.nu()) denominators_.push_back(std::abs(1.0 + (centre - 1.0) * nu));
}

double Expansion::bound(double radius, std::span<const double> distances) const {
  std::vector<double> inverses(form_.size());
  for (PetscInt k = 0; k < form_.size(); ++k) {
    // |D_k + h ν_k| = |ν_k| |λ_k − z|
    const double slope = std::abs(form_.nu()[k]);
    double smallest = denominators_[k] - radius * slope;
    if (!distances.empty()) smallest = std::max(smallest, slope * distances[k]);
    inverses[k] = smallest > 0 ? 1 / smallest : infinite;
  }
  return sum(radius, std::move(inverses));
}

double Expansion::boundOnCircle(double radius) const {
  std::vector<double> inverses(form_.size());
  for (PetscInt k = 0; k < form_.size(); ++k) {
    const double slope = std::abs(form_.nu()[k]),
                 smallest = k == omitted_ ? radius * slope : denominators_[k] - radius * slope;
    inverses[k] = smallest > 0 ? 1 / smallest : infinite;
  }
  return sum(radius, std::move(inverses));
}

/// Adds the bounds, with 1 / |D_k + h ν_k| ≤ inverses[k].
double Expansion::sum(double radius, std::vector<double> inverses) const {
  if (std::abs(centre_) + radius > form_.reach()) return infinite;
  const auto at = [&](const std::vector<std::vector<double>>& lengths, PetscInt k) {
    double value = 0, power = 1;
    for (const auto& list : lengths) {
      value += power * list[k];
      power *= radius;
    }
    return value;
  };
  double total = 0, power = 1;
  for (const double norm : norms_) {
    total += power * norm;
    power *= radius;
  }
  if (far_) power = 1;  // the bound does not grow with the radius
  double aSquares = 0, sizeSquares = 0, bSquares = 0, largest = 0, rest = 0;
  for (PetscInt k = 0; k < form_.size(); ++k) {
    const double a = at(aLengths_, k), b = at(bLengths_, k), inverse = inverses[k];
    if (!std::isfinite(inverse)) return infinite;
    largest = std::max(largest, inverse);
    aSquares += a * a * inverse * inverse;
    sizeSquares += std::pow(at(aSizes_, k) * inverse, 2);
    bSquares += b * b * inverse * inverse;
    if (far_ && far_->poles[k]) continue;
    if (k == omitted_) {
      total += a * b * inverse;
      continue;
    }
    // h^(order + 1) [a_1 G + (a_0 + h a_1) (Σ b_i h^(i − order − 1) (i > order) − ν G) / (D + h
    // ν)], G = G_order
    double later = std::abs(form_.nu()[k]) * lastLengths_[k], step = 1;
    for (std::size_t i = order_ + 1; i < bLengths_.size(); ++i) {
      later += step * bLengths_[i][k];
      step *= radius;
    }
    rest += a * later * inverse;
    if (aLengths_.size() > 1) rest += aLengths_[1][k] * lastLengths_[k];
  }
  total += power * rest;
  // (D + Δ)⁻¹ instead of D⁻¹, the remainders of the couplings, and the round-off of T_j:
  //   ‖a (D + Δ)⁻¹ b‖ ≤ ‖a D⁻¹ b‖ + ‖a D⁻¹‖ ‖Δ‖ ‖D⁻¹ b‖ / (1 − ‖Δ‖ ‖D⁻¹‖)
  const double reach = std::abs(centre_) + radius, deviation = form_.deviation(reach),
               series = 1 - deviation * largest,
               roundOff = 4 * form_.size() * std::numeric_limits<double>::epsilon(),
               aNorm = std::sqrt(aSquares), bNorm = std::sqrt(bSquares),
               to = form_.errorTo(reach) * form_.normOfX(),
               from = form_.errorFrom(reach) * form_.normOfY();
  if (!(series > 0.5)) return infinite;
  return total + (deviation * aNorm * bNorm + roundOff * std::sqrt(sizeSquares) * bNorm +
                  to * bNorm + from * aNorm + to * from * largest) /
                     series;
}

}  // namespace squeal::proof
