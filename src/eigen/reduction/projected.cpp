// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/projected.hpp"

#include <algorithm>
#include <functional>

#include "base/petsc/matrix.hpp"

namespace squeal::reduction {
namespace {

/// Returns s^power without the rounding of std::pow: the square of an imaginary number is real.
Complex powerOf(Complex s, int power) { return power == 0 ? 1.0 : power == 1 ? s : s * s; }

/// Columns of the basis per product: enough for fast products, and few enough for the memory.
constexpr PetscInt atOnce = 64;

bool isReal(const std::vector<Complex>& vector) {
  return std::all_of(vector.begin(), vector.end(),
                     [](const auto& entry) { return entry.imag() == 0; });
}

}  // namespace

Coordinates::Coordinates(std::vector<const linalg::DensePair*> list, bool damped,
                         const PointSpace& space)
    : pairs(std::move(list)) {
  if (!space.isWhole())
    for (const auto* pair : pairs) {
      right_.push_back(space.lifted(pair->q));
      left_.push_back(space.lifted(pair->left));
    }
  for (const auto* pair : pairs) {
    firstColumn.push_back(columns);
    columns += !damped && pair->s.real() == 0 && reduction::isReal(pair->q) &&
                       reduction::isReal(pair->left)
                   ? 1
                   : 2;
  }
  firstColumn.push_back(columns);
}

bool Coordinates::isReal(std::size_t pair) const {
  return firstColumn[pair + 1] - firstColumn[pair] == 1;
}

std::vector<double> Coordinates::perPair(const std::vector<double>& ofColumns) const {
  std::vector<double> sums(pairs.size(), 0.0);
  for (std::size_t j = 0; j < sums.size(); ++j)
    for (auto c = firstColumn[j]; c < firstColumn[j + 1]; ++c) sums[j] += ofColumns[c];
  return sums;
}

const std::vector<Complex>& Coordinates::vectorOf(std::size_t pair, pencil::Side side) const {
  const bool right = side == pencil::Side::right;
  if (right_.empty()) return right ? pairs[pair]->q : pairs[pair]->left;
  return right ? right_[pair] : left_[pair];
}

double Weights::of(const pencil::Term& term) const {
  return associated && !term.isAssociated() ? 0 : term.coefficient(at);
}

linalg::DenseMatrix Coordinates::times(pencil::Side side, int power, double c) const {
  linalg::DenseMatrix matrix(pairs.empty() ? 0 : vectorOf(0, side).size(), columns);
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const auto& vector = vectorOf(j, side);
    const Complex factor =
        c * powerOf(side == pencil::Side::right ? pairs[j]->s : std::conj(pairs[j]->s), power);
    const PetscInt real = firstColumn[j], imaginary = real + 1;
    for (PetscInt i = 0; i < matrix.rows(); ++i) {
      matrix(i, real) = (factor * vector[i]).real();
      if (!isReal(j)) matrix(i, imaginary) = (factor * vector[i]).imag();
    }
  }
  return matrix;
}

ProjectedTerms::ProjectedTerms(const Basis& basis, std::span<const pencil::Term> terms)
    : basis_(basis) {
  for (const auto& term : terms) parts_.push_back(partOf(term.share()));
  extend();
}

ProjectedTerms::Part ProjectedTerms::partOf(pencil::Term term) const {
  constexpr double few = 0.25;
  const linalg::RowSet rows(term.matrix, few);
  const bool symmetric = isSymmetric(term.matrix);
  Part part{std::move(term), rows, {}, symmetric, {}, {}, {}, {}, {}, {}};
  const Mat whole = part.term.matrix;
  part.matrix = rows.of(whole);
  part.timesV = part.timesSigns = linalg::Block(rows.size());
  if (symmetric) return part;
  if (rows.all())
    check(MatTranspose(whole, MAT_INITIAL_MATRIX, part.adjoint.out()));
  else
    linalg::appendProduct(part.matrix, basis_.sketch().signs(), part.timesSigns);
  return part;
}

void ProjectedTerms::extend() {
  for (auto& part : parts_) extend(part);
}

/// Extends all parts by the new columns of V, in blocks large enough for fast matrix products.
void ProjectedTerms::extend(Part& part) const {
  const PetscInt old = part.sketch.columns(), size = basis_.size();
  if (old == size) return;
  const bool known = hasProductsFrom(part, old), thin = !part.rows.all();
  const linalg::Block rowsOfV = thin ? part.rows.of(basis_.columns()) : linalg::Block();
  const linalg::DenseView v = thin ? linalg::DenseView(rowsOfV) : basis_.columns();
  linalg::DenseMatrix right(size, size - old), below(part.isSymmetric ? 0 : size - old, old);
  const auto copy = [](const linalg::DenseMatrix& from, linalg::DenseMatrix& to, PetscInt first) {
    for (PetscInt j = 0; j < from.columns(); ++j)
      std::ranges::copy(from.column(j), to.column(first + j).begin());
  };
  for (PetscInt begin = old; begin < size; begin += atOnce) {
    const PetscInt end = std::min(begin + atOnce, size);
    linalg::Block made(part.rows.size());
    if (!known) basis_.appendProducts(part.matrix, begin, end, made);
    const linalg::DenseView timesV =
        known ? basis_.forces().columnRange(begin - old, end - old) : made;
    part.sketch.append(basis_.sketch().of(part.rows, timesV));
    if (thin) part.timesV.append(timesV);
    // Below the diagonal, a symmetric projection follows from the later columns.
    const PetscInt last = part.isSymmetric ? end : size;
    copy(known ? linalg::rowRange(basis_.energies().columnRange(begin - old, end - old), 0, size)
               : linalg::transposedProduct(basis_.comm(), v.columnRange(0, last), timesV),
         right, begin - old);
    if (part.isSymmetric) continue;
    // Where A has few rows, V and A V are known in these rows, and Aᵀ is not needed.
    linalg::Block left(thin ? 0 : basis_.localRows());
    if (!thin) basis_.appendProducts(part.adjoint, begin, end, left);
    part.leftSketch.append(
        thin ? linalg::transposedProduct(basis_.comm(), part.timesSigns, v.columnRange(begin, end))
             : basis_.sketch().of(left));
    const linalg::DenseMatrix some =
        thin ? linalg::transposedProduct(basis_.comm(), part.timesV.columnRange(0, old),
                                         v.columnRange(begin, end))
             : linalg::transposedProduct(basis_.comm(), basis_.columns().columnRange(0, old), left);
    for (PetscInt j = 0; j < some.columns(); ++j)
      for (PetscInt i = 0; i < old; ++i) below(begin - old + j, i) = some(i, j);
  }
  for (PetscInt j = old; j < size && part.isSymmetric && !known; ++j)
    for (PetscInt i = j + 1; i < size; ++i) right(i, j - old) = right(j, i - old);
  part.projection = linalg::bordered(part.projection, right, below);
}

/// Returns true if A is K0 and the basis has K0 times the columns from `old` on.
bool ProjectedTerms::hasProductsFrom(const Part& part, PetscInt old) const {
  return isStiffness(part) && basis_.forces().columns() == basis_.size() - old;
}

void ProjectedTerms::combine(const linalg::DenseMatrix& combinations) {
  for (auto& part : parts_) {
    if (!part.rows.all()) part.timesV = linalg::product(part.timesV, combinations);
    part.sketch = linalg::product(part.sketch, combinations);
    if (!part.isSymmetric) part.leftSketch = linalg::product(part.leftSketch, combinations);
    part.projection = linalg::congruent(part.projection, combinations);
  }
}

void ProjectedTerms::addTo(const Weights& weights, linalg::DenseProblem& sum) const {
  for (const auto& part : parts_)
    if (!weights.associated || part.term.isAssociated())
      linalg::addScaled(sum.ofPower(part.term.power), weights.of(part.term), part.projection);
}

bool ProjectedTerms::hasStiffness() const {
  return std::ranges::any_of(parts_, [&](const Part& part) { return isStiffness(part); });
}

/// Returns C of the sum V C on which the matrix of a term acts, basis × columns.
linalg::DenseMatrix ProjectedTerms::coefficients(const Part& part,
                                                 const std::vector<const PointPairs*>& points,
                                                 const linalg::DenseMatrix& combinations) const {
  linalg::DenseMatrix result(part.sketch.columns(), combinations.columns());
  PetscInt first = 0;
  for (const auto* point : points) {
    const PetscInt last = first + point->pairs.columns;
    linalg::multiplyAdd(
        point->pairs.times(pencil::Side::right, part.term.power, point->weights.of(part.term)),
        linalg::rowRange(combinations, first, last), result);
    first = last;
  }
  return result;
}

void ProjectedTerms::addThinTo(const std::vector<const PointPairs*>& points,
                               const linalg::DenseMatrix& combinations,
                               linalg::Block& result) const {
  for (const auto& part : parts_)
    if (!part.rows.all())
      linalg::multiplyAdd(part.rows, part.timesV, coefficients(part, points, combinations), result);
}

void ProjectedTerms::addWholeTo(const std::vector<const PointPairs*>& points,
                                const linalg::DenseMatrix& combinations,
                                const linalg::DenseMatrix& less, linalg::Block& result) const {
  for (const auto& part : parts_) {
    if (!part.rows.all()) continue;
    linalg::DenseMatrix of = coefficients(part, points, combinations);
    if (isStiffness(part) && !less.empty()) {
      // (VᵀK0V)⁻¹ ≈ 2 − VᵀK0V, as V is nearly orthonormal
      linalg::addScaled(of, -2, less);
      linalg::multiplyAdd(part.projection, less, of);
    }
    const linalg::DenseView known = basis_.columns().columnRange(0, of.rows());
    for (PetscInt begin = 0; begin < result.columns(); begin += atOnce) {
      const PetscInt end = std::min(begin + atOnce, result.columns());
      linalg::Block forces(result.rows());
      linalg::appendProduct(part.matrix, linalg::product(known, of.columnRange(begin, end)),
                            forces);
      for (PetscInt j = begin; j < end; ++j)
        std::ranges::transform(result.column(j), forces.column(j - begin), result.column(j).begin(),
                               std::plus());
    }
  }
}

linalg::DenseMatrix ProjectedTerms::projectedWhole(const std::vector<const PointPairs*>& points,
                                                   const linalg::DenseMatrix& combinations) const {
  linalg::DenseMatrix sum;
  for (const auto& part : parts_)
    if (part.rows.all())
      linalg::addScaled(sum, 1,
                        linalg::product(part.projection, coefficients(part, points, combinations)));
  return sum;
}

void ProjectedTerms::addTo(const PointPairs& point, pencil::Side side,
                           linalg::DenseMatrix& sketch) const {
  for (const auto& part : parts_) {
    const double c = point.weights.of(part.term);
    const auto& known =
        side == pencil::Side::left && !part.isSymmetric ? part.leftSketch : part.sketch;
    if (c != 0) linalg::multiplyAdd(known, point.pairs.times(side, part.term.power, c), sketch);
  }
}

}  // namespace squeal::reduction
