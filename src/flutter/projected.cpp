#include "flutter/projected.hpp"

#include <algorithm>

namespace squeal::flutter {
namespace {

/// A projection of `old` columns grown to `size`: the new columns, and the new rows below the old columns (empty: by symmetry).
void grow(DenseMatrix& matrix, PetscInt old, PetscInt size, const DenseMatrix& right, const DenseMatrix& below) {
  const auto n = static_cast<std::size_t>(size), o = static_cast<std::size_t>(old), added = n - o;
  DenseMatrix grown(n * n);
  for (std::size_t j = 0; j < o; ++j) {
    std::copy_n(matrix.begin() + static_cast<std::ptrdiff_t>(j * o), o, grown.begin() + static_cast<std::ptrdiff_t>(j * n));
    for (std::size_t i = 0; i < added; ++i) grown[j * n + o + i] = below.empty() ? right[i * n + j] : below[j * added + i];
  }
  std::copy(right.begin(), right.end(), grown.begin() + static_cast<std::ptrdiff_t>(o * n));
  matrix = std::move(grown);
}

/// s^power without the rounding of std::pow: the square of an imaginary number is real.
std::complex<double> powerOf(std::complex<double> s, int power) { return power == 0 ? 1.0 : power == 1 ? s : s * s; }

bool isReal(const std::vector<std::complex<double>>& vector) {
  return std::all_of(vector.begin(), vector.end(), [](const auto& entry) { return entry.imag() == 0; });
}

/// a (rows × inner) times b (inner × columns).
DenseMatrix product(const DenseMatrix& a, std::size_t inner, const DenseMatrix& b) {
  const std::size_t rows = a.size() / inner;
  DenseMatrix result(rows * b.size() / inner);
  multiplyAdd(a.data(), static_cast<PetscInt>(rows), static_cast<PetscInt>(inner), b, result);
  return result;
}

bool isSymmetric(Mat matrix) {
  PetscBool known = PETSC_FALSE, symmetric = PETSC_FALSE;
  check(MatIsSymmetricKnown(matrix, &known, &symmetric));
  return known && symmetric;
}

}  // namespace

Coordinates::Coordinates(std::vector<const DensePair*> list, bool damped) : pairs(std::move(list)) {
  for (const auto* pair : pairs) {
    firstColumn.push_back(columns);
    columns += !damped && pair->s.real() == 0 && flutter::isReal(pair->q) && flutter::isReal(pair->left) ? 1 : 2;
  }
  firstColumn.push_back(columns);
}

bool Coordinates::isReal(std::size_t pair) const { return firstColumn[pair + 1] - firstColumn[pair] == 1; }

std::vector<double> Coordinates::times(Side side, int power, double c) const {
  std::vector<double> matrix;
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const auto& vector = side == Side::right ? pairs[j]->q : pairs[j]->left;
    const std::complex<double> factor = c * powerOf(side == Side::right ? pairs[j]->s : std::conj(pairs[j]->s), power);
    for (const auto& entry : vector) matrix.push_back((factor * entry).real());
    if (isReal(j)) continue;
    for (const auto& entry : vector) matrix.push_back((factor * entry).imag());
  }
  return matrix;
}

ProjectedTerms::ProjectedTerms(const Basis& basis, const Pencil& pencil, std::size_t first, std::size_t last) : basis_(basis) {
  for (std::size_t t = first; t < last; ++t) {
    Term term = pencil.terms()[t].share();
    OwnedMat transposed;
    if (!isSymmetric(term.matrix)) check(MatTranspose(term.matrix, MAT_INITIAL_MATRIX, transposed.out()));
    const RowSet rows(term.matrix), leftRows = transposed ? RowSet(transposed) : rows;
    parts_.push_back({std::move(term), std::move(transposed), rows, leftRows, Image(rows), {}, {}, {}, 0});
  }
  extend();
}

void ProjectedTerms::extend() {
  for (auto& part : parts_) extend(part);
}

void ProjectedTerms::extend(Part& part) const {
  const PetscInt old = part.columns, size = basis_.size();
  if (old == size) return;
  const auto sketchOf = [&](BV columns, const RowSet& rows, DenseMatrix& sketch) {
    const auto fresh = basis_.sketch().of(rows, ReadColumns(columns).values(), size - old);
    sketch.insert(sketch.end(), fresh.begin(), fresh.end());
  };
  {
    const OwnedBV product = basis_.times(part.term.matrix, old, size);
    part.image.append(ReadColumns(product).values(), size - old);
    sketchOf(product, part.rows, part.sketch);
  }
  if (part.transposed) sketchOf(basis_.times(part.transposed, old, size), part.leftRows, part.leftSketch);
  const ReadColumns all(basis_.columns());
  auto right = part.image.transposedProduct(basis_.comm(), all, 0, size, old, size);  // Vᵀ (A V_new)
  auto below =
      part.transposed ? part.image.transposedProduct(basis_.comm(), all, old, size, 0, old) : DenseMatrix{};  // V_newᵀ (A V_old)
  // Sums over the ranks, whose rounding may depend on the rank; what follows from them must not.
  for (auto* block : {&right, &below})
    check(MPI_Bcast(block->data(), static_cast<int>(block->size()), MPI_DOUBLE, 0, basis_.comm()));
  grow(part.projection, old, size, right, below);
  part.columns = size;
}

void ProjectedTerms::combine(const DenseMatrix& combinations) {
  for (auto& part : parts_) {
    const auto old = static_cast<std::size_t>(part.columns), size = combinations.size() / old;
    part.image.combine(combinations, part.columns);
    part.sketch = product(part.sketch, old, combinations);
    if (part.transposed) part.leftSketch = product(part.leftSketch, old, combinations);
    DenseMatrix transposed(size * old);
    for (std::size_t j = 0; j < size; ++j)
      for (std::size_t i = 0; i < old; ++i) transposed[i * size + j] = combinations[j * old + i];
    part.projection = product(transposed, old, product(part.projection, old, combinations));
    part.columns = static_cast<PetscInt>(size);
  }
}

void ProjectedTerms::addTo(const Parameters& at, DenseProblem& sum) const {
  sum.m = static_cast<int>(basis_.size());
  for (const auto& part : parts_) {
    auto& matrix = part.term.power == 0 ? sum.stiffness : part.term.power == 1 ? sum.damping : sum.mass;
    matrix.resize(part.projection.size(), 0.0);
    const double c = part.term.coefficient(at);
    for (std::size_t i = 0; i < matrix.size(); ++i) matrix[i] += c * part.projection[i];
  }
}

void ProjectedTerms::addTo(const Parameters& at, const Coordinates& pairs, Block& result) const {
  for (const auto& part : parts_)
    if (const double c = part.term.coefficient(at); c != 0)
      part.image.multiplyAdd(pairs.times(Side::right, part.term.power, c), part.columns, result.values);
}

Block ProjectedTerms::residuals(const std::vector<PointPairs>& points) const {
  PetscInt columns = 0;
  for (const auto& point : points) columns += point.pairs.columns;
  Block result(basis_.localRows(), columns);
  for (const auto& part : parts_) {
    std::vector<double> coefficients;
    for (const auto& [at, pairs] : points) {
      const auto own = pairs.times(Side::right, part.term.power, part.term.coefficient(at));
      coefficients.insert(coefficients.end(), own.begin(), own.end());
    }
    part.image.multiplyAdd(coefficients, part.columns, result.values);
  }
  return result;
}

void ProjectedTerms::addTo(const Parameters& at, const Coordinates& pairs, Side side, DenseMatrix& sketch) const {
  for (const auto& part : parts_) {
    const double c = part.term.coefficient(at);
    const auto& known = side == Side::left && part.transposed ? part.leftSketch : part.sketch;
    if (c != 0) multiplyAdd(known.data(), 2 * Sketch::size, part.columns, pairs.times(side, part.term.power, c), sketch);
  }
}

}  // namespace squeal::flutter
