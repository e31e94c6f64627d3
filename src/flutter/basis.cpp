#include "flutter/basis.hpp"

#include <algorithm>
#include <cmath>

#include "petsc/symmetric.hpp"

namespace squeal::flutter {
namespace {

/// X · combinations (x.columns × count).
Block combined(const Block& x, const DenseMatrix& combinations, PetscInt count) {
  Block result(x.rows, count);
  multiplyAdd(x.values.data(), x.rows, x.columns, combinations, result.values);
  return result;
}

/// Combinations orthonormal in the positive semi-definite matrix `gram` (n×n), without those whose eigenvalue is `small` times the
/// largest or less, each column of the matrix taken as of unit size.
DenseMatrix orthonormalising(DenseMatrix gram, PetscInt size, double small) {
  const auto n = static_cast<std::size_t>(size);
  std::vector<double> scale(n);
  for (std::size_t j = 0; j < n; ++j) scale[j] = gram[j * n + j] > 0 ? 1 / std::sqrt(gram[j * n + j]) : 0;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) gram[j * n + i] *= scale[i] * scale[j];
  const auto eigenvalues = symmetricEigen(gram, static_cast<int>(n));
  DenseMatrix kept;
  for (std::size_t j = 0; j < n; ++j)
    if (eigenvalues[j] > small * eigenvalues.back())
      for (std::size_t i = 0; i < n; ++i) kept.push_back(gram[j * n + i] * scale[i] / std::sqrt(eigenvalues[j]));
  return kept;
}

/// Sets the diagonal entries to zero (n×n) that are `small` times the whole energy of the column, with its parts along V, or less.
void clearWhatVHolds(DenseMatrix& energy, const DenseMatrix& parts, PetscInt columns, double small) {
  const auto n = static_cast<std::size_t>(columns), rows = parts.size() / n;
  for (std::size_t j = 0; j < n; ++j) {
    double held = 0;
    for (std::size_t i = 0; i < rows; ++i) held += parts[j * rows + i] * parts[j * rows + i];
    if (energy[j * n + j] <= small * held) energy[j * n + j] = 0;
  }
}

}  // namespace

OwnedBV columnsLike(BV like, PetscInt columns) {
  OwnedBV bv;
  PetscInt local = 0, global = 0;
  check(BVGetSizes(like, &local, &global, nullptr));
  check(BVCreate(PetscObjectComm(reinterpret_cast<PetscObject>(like)), bv.out()));
  check(BVSetSizes(bv, local, global, columns));
  check(BVSetType(bv, BVSVEC));
  return bv;
}

Basis::Basis(const modes::Modes& modes, Mat stiffness, KSP solver) : solver_(solver) {
  check(BVGetSizes(modes.vectors, nullptr, nullptr, &size_));
  columns_ = columnsLike(modes.vectors, size_);
  check(BVCopy(modes.vectors, columns_));
  for (PetscInt i = 0; i < size_; ++i) check(BVScaleColumn(columns_, i, 1 / modes.angularFrequency[static_cast<std::size_t>(i)]));
  OwnedVec diagonal;
  check(MatCreateVecs(stiffness, diagonal.out(), nullptr));
  check(MatGetDiagonal(stiffness, diagonal));
  check(VecReciprocal(diagonal));
  const PetscScalar* values = nullptr;
  check(VecGetArrayRead(diagonal, &values));
  inverseDiagonal_.assign(values, values + localRows());
  check(VecRestoreArrayRead(diagonal, &values));
  sketch_.emplace(columns_, inverseDiagonal_);
  sketched_ = sketch_->of(ReadColumns(columns_).values(), size_);
}

PetscInt Basis::localRows() const {
  PetscInt rows = 0;
  check(BVGetSizes(columns_, &rows, nullptr, nullptr));
  return rows;
}

OwnedBV Basis::times(Mat matrix, PetscInt first, PetscInt last) const {
  const OwnedBV some = columnsLike(columns_, last - first);
  OwnedBV product = columnsLike(columns_, last - first);
  check(BVSetActiveColumns(columns_, first, last));
  check(BVCopy(columns_, some));
  check(BVSetActiveColumns(columns_, 0, size_));
  check(BVMatMult(some, matrix, product));
  return product;
}

MPI_Comm Basis::comm() const { return PetscObjectComm(reinterpret_cast<PetscObject>(columns_.get())); }

/// K0⁻¹ of all columns at once.
Block Basis::solve(const Block& right) {
  PetscInt global = 0;
  check(BVGetSizes(columns_, nullptr, &global, nullptr));
  Block solved(right.rows, right.columns);
  std::vector<double> given = right.values;
  OwnedMat from, to;
  check(MatCreateDense(comm(), right.rows, PETSC_DECIDE, global, right.columns, given.data(), from.out()));
  check(MatCreateDense(comm(), right.rows, PETSC_DECIDE, global, right.columns, solved.values.data(), to.out()));
  check(KSPMatSolve(solver_, from, to));
  solves_ += right.columns;
  return solved;
}

PetscInt Basis::add(const Block& residuals) {
  if (residuals.columns == 0) return 0;
  Block z = solve(residuals);
  ratio_ = ratio(residuals, z);
  DenseMatrix parts;
  {
    const ReadColumns v(columns_);
    parts = transposedProduct(comm(), v.values(), v.rows(), size_, residuals.values.data(), residuals.columns);
    multiplyAdd(v.values(), v.rows(), size_, parts, z.values, -1);
  }
  // zᵀ K0 z = zᵀ r now that z is orthogonal to V. What depends on others or on V to within 1e-6 would only add noise.
  constexpr double small = 1e-12;
  DenseMatrix energy = transposedProduct(comm(), z, residuals);
  clearWhatVHolds(energy, parts, z.columns, small);
  const DenseMatrix combinations = orthonormalising(energy, z.columns, small);
  const auto added = static_cast<PetscInt>(combinations.size()) / z.columns;
  if (added == 0) return 0;
  const Block fresh = combined(z, combinations, added);
  check(BVResize(columns_, size_ + added, PETSC_TRUE));
  PetscScalar* values = nullptr;
  check(BVGetArray(columns_, &values));
  std::copy(fresh.values.begin(), fresh.values.end(), values + size_ * fresh.rows);
  check(BVRestoreArray(columns_, &values));
  size_ += added;
  const DenseMatrix sketch = sketch_->of(fresh.values.data(), added);
  sketched_.insert(sketched_.end(), sketch.begin(), sketch.end());
  check(BVSetActiveColumns(columns_, 0, size_));
  return added;
}

void Basis::combine(const DenseMatrix& combinations, PetscInt count) {
  Block combinedColumns(localRows(), count);
  {
    const ReadColumns v(columns_);
    multiplyAdd(v.values(), v.rows(), size_, combinations, combinedColumns.values);
  }
  sketched_ = sketch_->of(combinedColumns.values.data(), count);
  check(BVResize(columns_, count, PETSC_FALSE));
  PetscScalar* values = nullptr;
  check(BVGetArray(columns_, &values));
  std::copy(combinedColumns.values.begin(), combinedColumns.values.end(), values);
  check(BVRestoreArray(columns_, &values));
  size_ = count;
  check(BVSetActiveColumns(columns_, 0, size_));
}

/// diag(K0)⁻¹ times the columns.
Block Basis::scaled(const Block& residuals) const {
  Block result = residuals;
  for (PetscInt j = 0; j < result.columns; ++j)
    for (PetscInt i = 0; i < result.rows; ++i) result.column(j)[i] *= inverseDiagonal_[static_cast<std::size_t>(i)];
  return result;
}

/// The largest ratio of the energy norm to that of the diagonal among all combinations of the columns.
double Basis::ratio(const Block& residuals, const Block& solutions) const {
  const PetscInt n = residuals.columns;
  if (n == 0) return 0;
  const DenseMatrix combinations = orthonormalising(transposedProduct(comm(), residuals, scaled(residuals)), n, 1e-8);
  const auto kept = static_cast<PetscInt>(combinations.size()) / n;
  if (kept == 0) return 0;
  DenseMatrix energy = transposedProduct(comm(), combined(residuals, combinations, kept), combined(solutions, combinations, kept));
  return std::sqrt(symmetricEigen(energy, static_cast<int>(kept)).back());
}

std::vector<double> Basis::energyRatios(const std::vector<Block>& blocks) {
  Block all(localRows());
  for (const auto& block : blocks) append(all, block);
  const Block solved = solve(all);
  std::vector<double> ratios;
  PetscInt first = 0;
  for (const auto& block : blocks) {
    Block solutions(block.rows);
    for (PetscInt j = 0; j < block.columns; ++j) solutions.append(solved.column(first++));
    ratios.push_back(ratio(block, solutions));
  }
  return ratios;
}

void Basis::expand(const std::vector<std::complex<double>>& q, Vec real, Vec imaginary) const {
  const ReadColumns v(columns_);
  std::vector<double> coordinates(2 * static_cast<std::size_t>(v.columns()), 0.0),
      shape(2 * static_cast<std::size_t>(v.rows()), 0.0);
  for (std::size_t i = 0; i < q.size(); ++i) {
    coordinates[i] = q[i].real();
    coordinates[static_cast<std::size_t>(v.columns()) + i] = q[i].imag();
  }
  multiplyAdd(v.values(), v.rows(), v.columns(), coordinates, shape);
  for (Vec part : {real, imaginary}) {
    PetscScalar* entries = nullptr;
    check(VecGetArray(part, &entries));
    std::copy_n(shape.begin() + (part == imaginary ? v.rows() : 0), v.rows(), entries);
    check(VecRestoreArray(part, &entries));
  }
}

}  // namespace squeal::flutter
