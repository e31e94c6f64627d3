// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/undamped_correction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra/linalg/lu.hpp"
#include "algebra/linalg/qr.hpp"
#include "algebra/linalg/unsymmetric.hpp"

namespace squeal::reduction {

using linalg::DenseMatrix;
using linalg::DensePair;
using linalg::DenseProblem;

namespace {

/// A Ritz pair with a larger residual, relative to its vector, is none: K is near the identity.
constexpr double largestResidual = 0.1;
/// K is nearly singular, or the vectors of the two sides are nearly orthogonal, if the pivots of LU
/// differ by more.
constexpr double leastPivotRatio = 1e-8;

/// A pair with s in the closed first quadrant. With it, −s and the conjugates are eigenvalues too.
/// The real and imaginary parts of its vectors are columns of real matrices.
struct Leading {
  Complex s;
  PetscInt column;                                       // of the real part
  double right = 0, left = 0;                            // lengths of its residuals
  double wantedRight = INFINITY, wantedLeft = INFINITY;  // open above these
  bool isReal() const { return s.real() == 0 || s.imag() == 0; }
  bool isOpen() const { return right > wantedRight || left > wantedLeft; }
};

/// Vectors of one side and their products with K and M, or Kᵀ and Mᵀ.
struct Side {
  DenseMatrix vectors, stiffness, mass;
};

/// Returns the length of K q + z M q for the vector q of a pair, and z = s² or its conjugate.
double residualOf(const Leading& pair, Complex z, const Side& side) {
  if (pair.isReal()) z = z.real();
  double sum = 0, size = 0;
  for (PetscInt i = 0; i < side.vectors.rows(); ++i) {
    const auto entry = [&](const DenseMatrix& x) {
      return Complex(x(i, pair.column), pair.isReal() ? 0.0 : x(i, pair.column + 1));
    };
    sum += std::norm(entry(side.stiffness) + z * entry(side.mass));
    size += std::norm(entry(side.vectors));
  }
  return std::sqrt(sum / size);
}

/// Scales the columns to unit length, and makes them orthonormal.
DenseMatrix orthonormal(DenseMatrix columns) {
  columns.resizeColumns(std::min(columns.columns(), columns.rows()));
  for (PetscInt j = 0; j < columns.columns(); ++j)
    if (const double size = std::sqrt(linalg::squaredLength(columns.column(j))); size > 0)
      for (double& entry : columns.column(j)) entry /= size;
  linalg::orthonormalise(columns);
  return columns;
}

/// Appends a vector, or without `isReal` its real and its imaginary part.
void append(const std::vector<Complex>& vector, bool isReal, DenseMatrix& columns) {
  const PetscInt first = columns.columns();
  columns.resizeColumns(first + (isReal ? 1 : 2));
  for (std::size_t i = 0; i < vector.size(); ++i) {
    columns(i, first) = vector[i].real();
    if (!isReal) columns(i, first + 1) = vector[i].imag();
  }
}

/// Returns the vector of a pair, of 2-norm 1.
std::vector<Complex> vectorOf(const Leading& pair, const Side& side) {
  std::vector<Complex> vector(side.vectors.rows());
  for (std::size_t i = 0; i < vector.size(); ++i)
    vector[i] = {side.vectors(i, pair.column),
                 pair.isReal() ? 0.0 : side.vectors(i, pair.column + 1)};
  const double size = length(vector);
  for (auto& entry : vector) entry /= size;
  return vector;
}

/// The watched pairs of a problem while they are improved.
class Correction {
 public:
  Correction(const DenseProblem& problem, const linalg::EigenvalueFilter& watched)
      : problem_(problem), watched_(watched), factors_(problem.stiffness) {}
  bool isRegular() const { return factors_.pivotRatio() > leastPivotRatio; }

  void start(const std::vector<DensePair>& pairs, const std::vector<UnconvergedPair>& open) {
    std::vector<std::size_t> place(pairs.size(), pairs.size());
    DenseMatrix right(problem_.order()), left(problem_.order());
    for (std::size_t j = 0; j < pairs.size(); ++j) {
      const DensePair& pair = pairs[j];
      if (pair.s.real() < 0) continue;
      place[j] = leading_.size();
      leading_.push_back({.s = pair.s, .column = right.columns()});
      append(pair.q, leading_.back().isReal(), right);
      append(pair.left, leading_.back().isReal(), left);
    }
    set(std::move(right), std::move(left));
    constexpr double margin = 1000;  // of residuals that may consist only of round-off
    const double stiffness = linalg::squaredLength(problem_.stiffness.entries()),
                 mass = linalg::squaredLength(problem_.mass.entries());
    for (const auto& one : open) {
      if (place[one.pair] == pairs.size()) continue;  // so is the pair −s̄
      Leading& pair = leading_[place[one.pair]];
      const double roundOff = margin * std::numeric_limits<double>::epsilon() *
                              std::sqrt(stiffness + std::pow(std::abs(pair.s), 4) * mass);
      pair.wantedRight = std::max(one.right * pair.right, roundOff);
      pair.wantedLeft = std::max(one.left * pair.left, roundOff);
    }
  }

  bool isDone() const { return std::ranges::none_of(leading_, &Leading::isOpen); }

  /// Replaces the pairs by Ritz pairs. Returns false on failure.
  bool step() {
    const DenseMatrix trial = space(right_, false), test = space(left_, true);
    DenseMatrix images = linalg::product(problem_.mass, trial);
    const linalg::Lu<double> stiffness(
        linalg::transposedProduct(test, linalg::product(problem_.stiffness, trial)));
    if (!(stiffness.pivotRatio() > leastPivotRatio)) return false;
    DenseMatrix projected = linalg::transposedProduct(test, images);
    stiffness.solve(projected);
    factors_.solve(images);
    DenseMatrix leftImages = linalg::transposedProduct(problem_.mass, test);
    factors_.solve(leftImages, true);
    const auto ritz = linalg::standard(std::move(projected), linalg::Vectors::both, [&](Complex t) {
      return t != 0.0 && t.imag() >= 0 && watched_(linalg::rootOf(1.0 / t));
    });
    std::vector<Leading> next;
    DenseMatrix right(trial.columns()), left(test.columns());
    for (const auto& [t, q, y] : ritz) {
      next.push_back({.s = linalg::rootOf(1.0 / t), .column = right.columns()});
      append(q, next.back().isReal(), right);
      append(y, next.back().isReal(), left);
    }
    stiffness.solve(left, true);
    for (auto& pair : next) {
      const auto known = std::ranges::min_element(
          leading_, {}, [&](const Leading& one) { return std::abs(one.s - pair.s); });
      pair.wantedRight = known->wantedRight;
      pair.wantedLeft = known->wantedLeft;
    }
    if (next.empty()) return false;
    leading_ = std::move(next);
    set(linalg::product(images, right), linalg::product(leftImages, left));
    std::erase_if(leading_, [](const auto& pair) { return !(pair.right < largestResidual); });
    return true;
  }

  /// Returns the watched pairs of both quadrants.
  std::vector<DensePair> result() const {
    std::vector<DensePair> pairs;
    for (const auto& one : leading_) {
      DensePair pair{one.s, vectorOf(one, right_), vectorOf(one, left_)};
      if (const Complex mirrored = -std::conj(one.s); one.s.real() > 0 && watched_(mirrored))
        pairs.push_back({mirrored, linalg::conjugated(pair.q), linalg::conjugated(pair.left)});
      pairs.push_back(std::move(pair));
    }
    return pairs;
  }

 private:
  void set(DenseMatrix right, DenseMatrix left) {
    right_.stiffness = linalg::product(problem_.stiffness, right);
    right_.mass = linalg::product(problem_.mass, right);
    right_.vectors = std::move(right);
    left_.stiffness = linalg::transposedProduct(problem_.stiffness, left);
    left_.mass = linalg::transposedProduct(problem_.mass, left);
    left_.vectors = std::move(left);
    for (auto& pair : leading_) {
      const Complex square = pair.s * pair.s;
      pair.right = residualOf(pair, square, right_);
      pair.left = residualOf(pair, std::conj(square), left_);
    }
  }

  /// Returns an orthonormal basis of the vectors of all pairs and of the inverse times those of the
  /// open pairs.
  DenseMatrix space(const Side& side, bool transposed) const {
    DenseMatrix open(problem_.order());
    for (const auto& pair : leading_)
      if (pair.isOpen())
        open.append(side.mass.columnRange(pair.column, pair.column + (pair.isReal() ? 1 : 2)));
    factors_.solve(open, transposed);
    DenseMatrix all = side.vectors;
    all.append(open);
    return orthonormal(std::move(all));
  }

  const DenseProblem& problem_;
  const linalg::EigenvalueFilter& watched_;
  linalg::Lu<double> factors_;
  std::vector<Leading> leading_;
  Side right_, left_;
};

}  // namespace

std::optional<std::vector<DensePair>> correctedUndamped(const DenseProblem& problem,
                                                        std::vector<DensePair> pairs,
                                                        const std::vector<UnconvergedPair>& open,
                                                        const linalg::EigenvalueFilter& watched) {
  constexpr int mostSteps = 4;
  for (auto& pair : pairs)
    for (auto* vector : {&pair.q, &pair.left}) vector->resize(problem.order());
  Correction correction(problem, watched);
  if (!correction.isRegular()) return {};
  correction.start(pairs, open);
  for (int step = 0; !correction.isDone(); ++step)
    if (step == mostSteps || !correction.step()) return {};
  return correction.result();
}

}  // namespace squeal::reduction
