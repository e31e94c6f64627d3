#include "reduction/projected.hpp"

#include <algorithm>

namespace squeal::reduction {
namespace {

/// Returns s^power without the rounding of std::pow: the square of an imaginary number is real.
Complex powerOf(Complex s, int power) { return power == 0 ? 1.0 : power == 1 ? s : s * s; }

bool isReal(const std::vector<Complex>& vector) {
  return std::all_of(vector.begin(), vector.end(),
                     [](const auto& entry) { return entry.imag() == 0; });
}

/// Returns the columns [old, size) of a symmetric matrix of order `size`. product(e, b, e) gives
/// the columns [b, e) as far as their first e rows; what lies below is known from the columns that
/// follow.
template <class Product>
linalg::DenseMatrix upperColumns(PetscInt old, PetscInt size, const Product& product) {
  constexpr PetscInt atOnce = 64;  // enough for matrix products to be fast
  linalg::DenseMatrix columns(size, size - old);
  for (PetscInt begin = old, end = old; begin < size; begin = end) {
    end = std::min(begin + atOnce, size);
    const linalg::DenseMatrix some = product(end, begin, end);
    for (PetscInt j = begin; j < end; ++j)
      std::ranges::copy(some.column(j - begin), columns.column(j - old).begin());
  }
  for (PetscInt j = old; j < size; ++j)
    for (PetscInt i = j + 1; i < size; ++i) columns(i, j - old) = columns(j, i - old);
  return columns;
}

bool isSymmetric(Mat matrix) {
  PetscBool known = PETSC_FALSE, symmetric = PETSC_FALSE;
  check(MatIsSymmetricKnown(matrix, &known, &symmetric));
  return known && symmetric;
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

ProjectedTerms::ProjectedTerms(const Basis& basis, const pencil::Pencil& pencil, std::size_t first,
                               std::size_t last)
    : basis_(basis) {
  for (std::size_t t = first; t < last; ++t) parts_.push_back(partOf(pencil.terms()[t].share()));
  extend();
}

ProjectedTerms::Part ProjectedTerms::partOf(pencil::Term term) const {
  const linalg::RowSet rows(term.matrix);
  Part part{std::move(term), rows, rows, {}, {}, {}, {}, {}, {}, {}};
  const Mat whole = part.term.matrix;
  part.matrix = rows.of(whole);
  part.timesV = part.rowsOfV = linalg::Block(rows.size());
  part.timesV.reserve(3 * basis_.size());
  if (isSymmetric(whole)) return part;
  OwnedMat transposed;
  check(MatTranspose(whole, MAT_INITIAL_MATRIX, transposed.out()));
  part.leftRows = linalg::RowSet(transposed);
  part.adjoint = part.leftRows.of(transposed);
  return part;
}

void ProjectedTerms::extend() {
  for (auto& part : parts_) extend(part);
}

void ProjectedTerms::extend(Part& part) const {
  const PetscInt old = part.timesV.columns(), size = basis_.size();
  if (old == size) return;
  if (knownFrom(part, old))
    part.timesV.append(basis_.forces());
  else
    basis_.appendProducts(part.matrix, old, size, part.timesV);
  part.sketch.append(basis_.sketch().of(part.rows, part.timesV.columnRange(old, size)));
  if (part.adjoint) {
    linalg::Block timesV(part.leftRows.size());
    basis_.appendProducts(part.adjoint, old, size, timesV);
    part.leftSketch.append(basis_.sketch().of(part.leftRows, timesV));
  }
  project(part, old);
}

/// Returns true if the basis knows K0 times the columns from `old` on, and A is K0.
bool ProjectedTerms::knownFrom(const Part& part, PetscInt old) const {
  return part.term.matrix == basis_.stiffness() && basis_.forces().columns() == basis_.size() - old;
}

/// Extends VᵀAV by the columns of V from `old` on.
void ProjectedTerms::project(Part& part, PetscInt old) const {
  const PetscInt size = basis_.size();
  if (!part.rows.all()) part.rowsOfV.append(part.rows.of(basis_.columns().columnRange(old, size)));
  const linalg::Block& v = part.rows.all() ? basis_.columns() : part.rowsOfV;
  const auto product = [&](PetscInt firstOfV, PetscInt lastOfV, PetscInt first, PetscInt last) {
    return linalg::transposedProduct(basis_.comm(), v.columnRange(firstOfV, lastOfV),
                                     part.timesV.columnRange(first, last));
  };
  linalg::DenseMatrix right, below;
  if (knownFrom(part, old)) {
    right = basis_.energies();
  } else if (part.adjoint) {
    right = product(0, size, old, size);
    below = product(old, size, 0, old);
  } else {
    right = upperColumns(old, size, [&](PetscInt lastOfV, PetscInt first, PetscInt last) {
      return product(0, lastOfV, first, last);
    });
  }
  part.projection = linalg::bordered(part.projection, right, below);
}

void ProjectedTerms::combine(const linalg::DenseMatrix& combinations) {
  for (auto& part : parts_) {
    part.timesV = linalg::product(part.timesV, combinations);
    if (!part.rows.all()) part.rowsOfV = linalg::product(part.rowsOfV, combinations);
    part.sketch = linalg::product(part.sketch, combinations);
    if (part.adjoint) part.leftSketch = linalg::product(part.leftSketch, combinations);
    part.projection = linalg::congruent(part.projection, combinations);
  }
}

void ProjectedTerms::addTo(const Weights& weights, linalg::DenseProblem& sum) const {
  for (const auto& part : parts_)
    if (!weights.associated || part.term.isAssociated())
      linalg::addScaled(part.term.power == 0   ? sum.stiffness
                        : part.term.power == 1 ? sum.damping
                                               : sum.mass,
                        weights.of(part.term), part.projection);
}

void ProjectedTerms::addTo(const std::vector<const PointPairs*>& points,
                           const linalg::DenseMatrix& combinations, linalg::Block& result) const {
  for (const auto& part : parts_) {
    linalg::DenseMatrix coefficients(part.timesV.columns(), result.columns());
    PetscInt first = 0;
    for (const auto* point : points) {
      const PetscInt last = first + point->pairs.columns;
      linalg::multiplyAdd(
          point->pairs.times(pencil::Side::right, part.term.power, point->weights.of(part.term)),
          linalg::rowRange(combinations, first, last), coefficients);
      first = last;
    }
    linalg::multiplyAdd(part.rows, part.timesV, coefficients, result);
  }
}

void ProjectedTerms::addTo(const PointPairs& point, pencil::Side side,
                           linalg::DenseMatrix& sketch) const {
  for (const auto& part : parts_) {
    const double c = point.weights.of(part.term);
    const auto& known = side == pencil::Side::left && part.adjoint ? part.leftSketch : part.sketch;
    if (c != 0) linalg::multiplyAdd(known, point.pairs.times(side, part.term.power, c), sketch);
  }
}

}  // namespace squeal::reduction
