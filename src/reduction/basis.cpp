#include "reduction/basis.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "linalg/block.hpp"
#include "linalg/columns.hpp"
#include "linalg/quadratic.hpp"
#include "linalg/symmetric.hpp"

namespace squeal::reduction {
namespace {

/// Eigenvalue of a Gram matrix, of its largest, from which on a direction counts as independent of
/// the others: to within 1e-6.
constexpr double independent = 1e-12;

/// Combinations orthonormal in the positive semi-definite matrix `gram` (n×n), without those whose
/// eigenvalue is `small` times the largest or less, each column of the matrix taken as of unit
/// size.
linalg::DenseMatrix orthonormalising(linalg::DenseMatrix gram, PetscInt size, double small) {
  const auto n = static_cast<std::size_t>(size);
  std::vector<double> scale(n);
  for (std::size_t j = 0; j < n; ++j)
    scale[j] = gram[j * n + j] > 0 ? 1 / std::sqrt(gram[j * n + j]) : 0;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) gram[j * n + i] *= scale[i] * scale[j];
  const auto eigenvalues = linalg::symmetricEigen(gram, static_cast<int>(n));
  linalg::DenseMatrix kept;
  for (std::size_t j = 0; j < n; ++j)
    if (eigenvalues[j] > small * eigenvalues.back())
      for (std::size_t i = 0; i < n; ++i)
        kept.push_back(gram[j * n + i] * scale[i] / std::sqrt(eigenvalues[j]));
  return kept;
}

/// Sets the diagonal entries to zero (n×n) that are `small` times the whole energy of the column,
/// with its parts along V, or less.
void clearWhatVHolds(linalg::DenseMatrix& energy, const linalg::DenseMatrix& parts,
                     PetscInt columns, double small) {
  const auto n = static_cast<std::size_t>(columns), rows = parts.size() / n;
  for (std::size_t j = 0; j < n; ++j) {
    double held = 0;
    for (std::size_t i = 0; i < rows; ++i) held += parts[j * rows + i] * parts[j * rows + i];
    if (energy[j * n + j] <= small * held) energy[j * n + j] = 0;
  }
}

}  // namespace

Basis::Basis(const modes::Modes& modes, const modes::AssociatedSystem& system)
    : comm_(system.comm()),
      stiffness_(system.k0()),
      solver_(system.solver()),
      columns_(0),
      forces_(0) {
  const linalg::ReadColumns shapes(modes.vectors);
  columns_ = linalg::Block(shapes.rows());
  columns_.reserve(3 *
                   shapes.columns());  // untouched memory costs nothing, moving a grown basis does
  for (PetscInt j = 0; j < shapes.columns(); ++j)
    columns_.append(shapes.values() + j * shapes.rows(), 1 / modes.angularFrequency[j]);
  OwnedVec diagonal;
  check(MatCreateVecs(stiffness_, diagonal.out(), nullptr));
  check(MatGetDiagonal(stiffness_, diagonal));
  check(VecReciprocal(diagonal));
  const PetscScalar* values = nullptr;
  check(VecGetArrayRead(diagonal, &values));
  inverseDiagonal_.assign(values, values + localRows());
  check(VecRestoreArrayRead(diagonal, &values));
  sketch_.emplace(comm_, inverseDiagonal_);
  sketched_ = sketch_->unweighted(columns_.values.data(), size());
}

OwnedBV Basis::vectors() const {
  return linalg::copiedColumns(stiffness_, columns_.values.data(), size());
}

void Basis::appendProducts(Mat matrix, PetscInt first, PetscInt last, linalg::Block& result) const {
  linalg::appendProduct(matrix, columns_.column(first), last - first, result);
}

/// K0⁻¹ of all columns at once.
linalg::Block Basis::solve(const linalg::Block& right) {
  PetscInt global = 0;
  check(MatGetSize(stiffness_, &global, nullptr));
  linalg::Block solved(right.rows, right.columns);
  const OwnedMat from = linalg::borrowed(comm_, right.rows, global, right.columns,
                                         right.values.data()),
                 to = linalg::borrowed(comm_, right.rows, global, right.columns,
                                       solved.values.data());
  check(KSPMatSolve(solver_, from, to));
  solves_ += right.columns;
  return solved;
}

PetscInt Basis::add(const linalg::Block& residuals) {
  forces_ = linalg::Block(localRows());
  energies_.clear();
  if (residuals.columns == 0) return 0;
  linalg::Block z = solve(residuals);
  const linalg::DenseMatrix energy = linalg::transposedProduct(comm_, z, residuals);
  ratio_ = ratio(residuals, energy);
  const linalg::DenseMatrix parts =
      linalg::transposedProduct(comm_, columns_, residuals);  // VᵀK0 z
  const PetscInt before = size();
  if (!addAcross(z, residuals, energy, parts)) addOrthogonalised(z, parts);
  const PetscInt added = size() - before;
  const linalg::DenseMatrix sketch = sketch_->unweighted(columns_.column(before), added);
  sketched_.insert(sketched_.end(), sketch.begin(), sketch.end());
  return added;
}

/// Adds z = K0⁻¹ R where that is all but orthogonal to V: K0 z, VᵀK0z and zᵀK0z are then R, VᵀR and
/// zᵀR. False: it is not, or K0⁻¹ is not good enough for that.
bool Basis::addAcross(const linalg::Block& z, const linalg::Block& residuals,
                      const linalg::DenseMatrix& energy, const linalg::DenseMatrix& parts) {
  constexpr double little = 1e-6;
  const linalg::DenseMatrix combinations = orthonormalising(energy, z.columns, independent);
  const auto old = static_cast<std::size_t>(size()),
             added = combinations.size() / static_cast<std::size_t>(z.columns);
  linalg::DenseMatrix along(old * added);
  if (added > 0) linalg::multiplyAdd(parts.data(), size(), z.columns, combinations, along);
  for (std::size_t j = 0; j < added; ++j) {
    const auto begin = along.begin() + j * old, end = begin + static_cast<std::ptrdiff_t>(old);
    if (!(std::inner_product(begin, end, begin, 0.0) < little)) return false;
  }
  if (added == 0 || solutionError(z, residuals) > 1e-12) return false;
  const linalg::Block fresh = linalg::combined(z, combinations, static_cast<PetscInt>(added));
  forces_ = linalg::combined(residuals, combinations, fresh.columns);
  const linalg::DenseMatrix own = linalg::transposedProduct(comm_, fresh, forces_);
  for (std::size_t j = 0; j < added; ++j) {
    energies_.insert(energies_.end(), along.begin() + j * old, along.begin() + ((j + 1) * old));
    energies_.insert(energies_.end(), own.begin() + j * added, own.begin() + ((j + 1) * added));
  }
  append(columns_, fresh);
  return true;
}

/// Adds what z has orthogonal to V, `parts` being VᵀK0z: twice, since V is orthonormal to some
/// digits alone.
void Basis::addOrthogonalised(linalg::Block& z, const linalg::DenseMatrix& parts) {
  linalg::multiplyAdd(columns_.values.data(), columns_.rows, size(), parts, z.values, -1);
  linalg::Block images(z.rows);
  linalg::appendProduct(stiffness_, z.values.data(), z.columns, images);
  const linalg::DenseMatrix rest = linalg::transposedProduct(comm_, columns_, images);
  linalg::DenseMatrix energy = linalg::transposedProduct(comm_, z, images);
  linalg::multiplyAdd(columns_.values.data(), columns_.rows, size(), rest, z.values, -1);
  const linalg::DenseMatrix square = linalg::transposedProduct(MPI_COMM_SELF, rest.data(), size(),
                                                               z.columns, rest.data(), z.columns);
  for (std::size_t k = 0; k < energy.size(); ++k) energy[k] -= square[k];
  // Columns that depend on others or on V would only add noise.
  clearWhatVHolds(energy, parts, z.columns, independent);
  const linalg::DenseMatrix combinations = orthonormalising(energy, z.columns, independent);
  const auto added = static_cast<PetscInt>(combinations.size()) / z.columns;
  if (added > 0) append(columns_, linalg::combined(z, combinations, added));
}

/// ‖K0 z w − R w‖ / ‖R w‖ for a vector w of signs, in the norm of diag(K0)⁻¹.
double Basis::solutionError(const linalg::Block& z, const linalg::Block& residuals) const {
  linalg::DenseMatrix signs;
  for (PetscInt j = 0; j < z.columns; ++j) signs.push_back(j % 3 == 1 ? -1 : 1);
  linalg::Block image(z.rows);
  const linalg::Block solution = linalg::combined(z, signs, 1),
                      wanted = linalg::combined(residuals, signs, 1);
  linalg::appendProduct(stiffness_, solution.values.data(), 1, image);
  double squares[2] = {0, 0};
  for (PetscInt i = 0; i < z.rows; ++i) {
    const double error = image.column(0)[i] - wanted.column(0)[i], weight = inverseDiagonal_[i];
    squares[0] += weight * error * error;
    squares[1] += weight * wanted.column(0)[i] * wanted.column(0)[i];
  }
  check(MPI_Allreduce(MPI_IN_PLACE, squares, 2, MPI_DOUBLE, MPI_SUM, comm_));
  check(MPI_Bcast(squares, 2, MPI_DOUBLE, 0, comm_));
  return std::sqrt(squares[0] / squares[1]);
}

void Basis::combine(const linalg::DenseMatrix& combinations, PetscInt count) {
  columns_ = linalg::combined(columns_, combinations, count);
  forces_ = linalg::Block(0);
  sketched_ = sketch_->unweighted(columns_.values.data(), count);
  energies_.clear();
}

/// The largest ratio of the energy norm to that of the diagonal among all combinations of the
/// columns; `energy`: RᵀK0⁻¹R.
double Basis::ratio(const linalg::Block& residuals, const linalg::DenseMatrix& energy) const {
  const PetscInt n = residuals.columns;
  if (n == 0) return 0;
  linalg::Block scaled = residuals;
  for (PetscInt j = 0; j < n; ++j)
    for (PetscInt i = 0; i < scaled.rows; ++i) scaled.column(j)[i] *= inverseDiagonal_[i];
  const linalg::DenseMatrix combinations =
      orthonormalising(linalg::transposedProduct(comm_, residuals, scaled), n, 1e-8);
  const auto kept = static_cast<int>(combinations.size()) / n;
  if (kept == 0) return 0;
  linalg::DenseMatrix projected = linalg::congruent(energy, n, combinations);
  return std::sqrt(linalg::symmetricEigen(projected, kept).back());
}

std::vector<double> Basis::energyRatios(const std::vector<linalg::Block>& blocks) {
  linalg::Block all(localRows());
  for (const auto& block : blocks) append(all, block);
  const linalg::Block solved = solve(all);
  std::vector<double> ratios;
  PetscInt first = 0;
  for (const auto& block : blocks) {
    const double* solutions = solved.values.data() + first * solved.rows;
    first += block.columns;
    const linalg::DenseMatrix energy = linalg::transposedProduct(
        comm_, solutions, block.rows, block.columns, block.values.data(), block.columns);
    ratios.push_back(ratio(block, energy));
  }
  return ratios;
}

std::vector<linalg::ComplexVector> Basis::expand(
    const std::vector<const std::vector<std::complex<double>>*>& list) const {
  const auto m = static_cast<std::size_t>(size());
  std::vector<double> coordinates(2 * list.size() * m, 0.0);
  for (std::size_t j = 0; j < list.size(); ++j)
    for (std::size_t i = 0; i < list[j]->size(); ++i) {
      coordinates[2 * j * m + i] = (*list[j])[i].real();
      coordinates[(2 * j + 1) * m + i] = (*list[j])[i].imag();
    }
  const linalg::Block parts =
      linalg::combined(columns_, coordinates, static_cast<PetscInt>(2 * list.size()));
  std::vector<linalg::ComplexVector> vectors(list.size());
  for (std::size_t j = 0; j < list.size(); ++j) {
    check(MatCreateVecs(stiffness_, vectors[j].real.out(), vectors[j].imaginary.out()));
    for (const bool imaginary : {false, true}) {
      const Vec part = imaginary ? vectors[j].imaginary : vectors[j].real;
      PetscScalar* entries = nullptr;
      check(VecGetArrayWrite(part, &entries));
      std::copy_n(parts.column(static_cast<PetscInt>(2 * j) + (imaginary ? 1 : 0)), parts.rows,
                  entries);
      check(VecRestoreArrayWrite(part, &entries));
    }
  }
  return vectors;
}

}  // namespace squeal::reduction
