#include "reduction/projected.hpp"

#include <algorithm>

namespace squeal::reduction {
namespace {

/// A projection of `old` columns grown to `size`: the new columns, and the new rows below the old
/// columns (empty: by symmetry).
void grow(linalg::DenseMatrix& matrix, PetscInt old, PetscInt size,
          const linalg::DenseMatrix& right, const linalg::DenseMatrix& below) {
  const auto n = static_cast<std::size_t>(size), o = static_cast<std::size_t>(old), added = n - o;
  linalg::DenseMatrix grown(n * n);
  for (std::size_t j = 0; j < o; ++j) {
    std::copy_n(matrix.begin() + j * o, o, grown.begin() + j * n);
    for (std::size_t i = 0; i < added; ++i)
      grown[j * n + o + i] = below.empty() ? right[i * n + j] : below[j * added + i];
  }
  std::copy(right.begin(), right.end(), grown.begin() + o * n);
  matrix = std::move(grown);
}

/// s^power without the rounding of std::pow: the square of an imaginary number is real.
std::complex<double> powerOf(std::complex<double> s, int power) {
  return power == 0 ? 1.0 : power == 1 ? s : s * s;
}

bool isReal(const std::vector<std::complex<double>>& vector) {
  return std::all_of(vector.begin(), vector.end(),
                     [](const auto& entry) { return entry.imag() == 0; });
}

/// a (rows × inner) times b (inner × columns).
linalg::DenseMatrix product(const linalg::DenseMatrix& a, PetscInt inner,
                            const linalg::DenseMatrix& b) {
  const auto n = static_cast<std::size_t>(inner), rows = a.size() / n;
  linalg::DenseMatrix result(rows * b.size() / n);
  linalg::multiplyAdd(a.data(), static_cast<PetscInt>(rows), inner, b, result);
  return result;
}

/// Columns [old, size) of a symmetric matrix of order `size`, of which product(0, e, b, e) gives
/// columns [b, e) as far as their first e rows: what lies below is known from the columns that
/// follow.
template <class Product>
linalg::DenseMatrix upperColumns(PetscInt old, PetscInt size, const Product& product) {
  constexpr PetscInt atOnce = 64;  // enough for matrix products to be fast
  const auto n = static_cast<std::ptrdiff_t>(size);
  linalg::DenseMatrix columns(n * (size - old));
  for (PetscInt begin = old, end = old; begin < size; begin = end) {
    end = std::min(begin + atOnce, size);
    const linalg::DenseMatrix some = product(0, end, begin, end);
    for (PetscInt j = begin; j < end; ++j)
      std::copy_n(some.begin() + static_cast<std::ptrdiff_t>(j - begin) * end, end,
                  columns.begin() + (j - old) * n);
  }
  for (PetscInt j = old; j < size; ++j)
    for (PetscInt i = j + 1; i < size; ++i) columns[(j - old) * n + i] = columns[(i - old) * n + j];
  return columns;
}

bool isSymmetric(Mat matrix) {
  PetscBool known = PETSC_FALSE, symmetric = PETSC_FALSE;
  check(MatIsSymmetricKnown(matrix, &known, &symmetric));
  return known && symmetric;
}

}  // namespace

Coordinates::Coordinates(std::vector<const linalg::DensePair*> list, bool damped)
    : pairs(std::move(list)) {
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

std::vector<double> Coordinates::times(pencil::Side side, int power, double c) const {
  std::vector<double> matrix;
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const auto& vector = side == pencil::Side::right ? pairs[j]->q : pairs[j]->left;
    const std::complex<double> factor =
        c * powerOf(side == pencil::Side::right ? pairs[j]->s : std::conj(pairs[j]->s), power);
    for (const auto& entry : vector) matrix.push_back((factor * entry).real());
    if (isReal(j)) continue;
    for (const auto& entry : vector) matrix.push_back((factor * entry).imag());
  }
  return matrix;
}

ProjectedTerms::ProjectedTerms(const Basis& basis, const pencil::Pencil& pencil, std::size_t first,
                               std::size_t last)
    : basis_(basis) {
  for (std::size_t t = first; t < last; ++t) parts_.push_back(newState(pencil.terms()[t].share()));
  extend();
}

ProjectedTerms::Part ProjectedTerms::newState(pencil::Term term) const {
  const linalg::RowSet rows(term.matrix);
  OwnedMat matrix = rows.of(term.matrix);
  linalg::Block image(rows.size());
  image.reserve(3 * basis_.size());
  if (isSymmetric(term.matrix))
    return {std::move(term),
            rows,
            rows,
            std::move(matrix),
            {},
            std::move(image),
            linalg::Block(rows.size()),
            {},
            {},
            {}};
  OwnedMat transposed;
  check(MatTranspose(term.matrix, MAT_INITIAL_MATRIX, transposed.out()));
  const linalg::RowSet leftRows(transposed);
  OwnedMat adjoint = leftRows.of(transposed);
  return {std::move(term),
          rows,
          leftRows,
          std::move(matrix),
          std::move(adjoint),
          std::move(image),
          linalg::Block(rows.size()),
          {},
          {},
          {}};
}

void ProjectedTerms::extend() {
  for (auto& part : parts_) extend(part);
}

void ProjectedTerms::extend(Part& part) const {
  const PetscInt old = part.image.columns, size = basis_.size();
  if (old == size) return;
  const auto sketch = [&](const double* columns, const linalg::RowSet& rows,
                          linalg::DenseMatrix& sketches) {
    const auto fresh = basis_.sketch().of(rows, columns, size - old);
    sketches.insert(sketches.end(), fresh.begin(), fresh.end());
  };
  if (knownFrom(part, old))
    append(part.image, basis_.forces());
  else
    basis_.appendProducts(part.matrix, old, size, part.image);
  sketch(part.image.column(old), part.rows, part.sketch);
  if (part.adjoint) {
    linalg::Block images(part.leftRows.size());
    basis_.appendProducts(part.adjoint, old, size, images);
    sketch(images.values.data(), part.leftRows, part.leftSketch);
  }
  project(part, old);
}

/// The basis knows K0 times the columns from `old` on.
bool ProjectedTerms::knownFrom(const Part& part, PetscInt old) const {
  return part.term.matrix == basis_.stiffness() && basis_.forces().columns == basis_.size() - old;
}

/// VᵀAV with the columns of V from `old` on.
void ProjectedTerms::project(Part& part, PetscInt old) const {
  const PetscInt size = basis_.size();
  if (!part.rows.all()) append(part.rowsOfV, part.rows.of(basis_.columns(), old, size));
  const auto product = [&](PetscInt xBegin, PetscInt xEnd, PetscInt begin,
                           PetscInt end) {  // X of V, transposed, times some of A V
    const double* x = (part.rows.all() ? basis_.columns() : part.rowsOfV).column(xBegin);
    return linalg::transposedProduct(basis_.comm(), x, part.rows.size(), xEnd - xBegin,
                                     part.image.column(begin), end - begin);
  };
  linalg::DenseMatrix right, below;
  if (knownFrom(part, old)) {
    right = basis_.energies();
  } else if (part.adjoint) {
    right = product(0, size, old, size);
    below = product(old, size, 0, old);
  } else {
    right = upperColumns(old, size, product);
  }
  grow(part.projection, old, size, right, below);
}

void ProjectedTerms::combine(const linalg::DenseMatrix& combinations) {
  for (auto& part : parts_) {
    const PetscInt old = part.image.columns,
                   size = static_cast<PetscInt>(combinations.size()) / old;
    part.image = linalg::combined(part.image, combinations, size);
    if (!part.rows.all()) part.rowsOfV = linalg::combined(part.rowsOfV, combinations, size);
    part.sketch = product(part.sketch, old, combinations);
    if (part.adjoint) part.leftSketch = product(part.leftSketch, old, combinations);
    part.projection = linalg::congruent(part.projection, old, combinations);
  }
}

void ProjectedTerms::addTo(const sweep::Parameters& at, linalg::DenseProblem& sum) const {
  sum.m = static_cast<int>(basis_.size());
  for (const auto& part : parts_) {
    auto& matrix = part.term.power == 0   ? sum.stiffness
                   : part.term.power == 1 ? sum.damping
                                          : sum.mass;
    matrix.resize(part.projection.size(), 0.0);
    const double c = part.term.coefficient(at);
    for (std::size_t i = 0; i < matrix.size(); ++i) matrix[i] += c * part.projection[i];
  }
}

void ProjectedTerms::addTo(const std::vector<const PointPairs*>& points,
                           const linalg::DenseMatrix& combinations, linalg::Block& result) const {
  const auto count = static_cast<std::size_t>(result.columns), all = combinations.size() / count;
  for (const auto& part : parts_) {
    linalg::DenseMatrix coefficients(static_cast<std::size_t>(part.image.columns) * count);
    std::size_t first = 0;
    for (const auto* point : points) {
      const auto columns = static_cast<std::size_t>(point->pairs.columns);
      const linalg::DenseMatrix own = linalg::rowsOf(combinations, all, first, columns);
      first += columns;
      const auto vectors = point->pairs.times(pencil::Side::right, part.term.power,
                                              part.term.coefficient(point->at));
      if (columns > 0)
        linalg::multiplyAdd(vectors.data(), part.image.columns, point->pairs.columns, own,
                            coefficients);
    }
    linalg::multiplyAdd(part.rows, part.image, coefficients, result.values);
  }
}

void ProjectedTerms::addTo(const PointPairs& point, pencil::Side side,
                           linalg::DenseMatrix& sketch) const {
  for (const auto& part : parts_) {
    const double c = part.term.coefficient(point.at);
    const auto& known = side == pencil::Side::left && part.adjoint ? part.leftSketch : part.sketch;
    if (c != 0)
      linalg::multiplyAdd(known.data(), 2 * linalg::Sketch::size, part.image.columns,
                          point.pairs.times(side, part.term.power, c), sketch);
  }
}

}  // namespace squeal::reduction
