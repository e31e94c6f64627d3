// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/subspace/basis.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/columns.hpp"
#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/petsc/arrays.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"

namespace squeal::subspace {
namespace {

/// A direction counts as linearly independent, to within 1e-6, if its eigenvalue of the Gram matrix
/// exceeds this fraction of the largest one.
constexpr double independent = 1e-12;

/// Returns combinations that are orthonormal in the positive semi-definite matrix `gram`. The
/// columns are first scaled to unit size, and combinations with an eigenvalue of at most `small`
/// times the largest are omitted.
linalg::DenseMatrix orthonormalising(linalg::DenseMatrix gram, double small) {
  const PetscInt n = gram.rows();
  std::vector<double> scale(n);
  for (PetscInt j = 0; j < n; ++j) scale[j] = gram(j, j) > 0 ? 1 / std::sqrt(gram(j, j)) : 0;
  for (PetscInt j = 0; j < n; ++j)
    for (PetscInt i = 0; i < n; ++i) gram(i, j) *= scale[i] * scale[j];
  const auto eigenvalues = linalg::symmetricEigen(gram);
  linalg::DenseMatrix kept(n);
  for (PetscInt j = 0; j < n; ++j) {
    if (!(eigenvalues[j] > small * eigenvalues.back())) continue;
    for (PetscInt i = 0; i < n; ++i) gram(i, j) *= scale[i] / std::sqrt(eigenvalues[j]);
    kept.append(gram.column(j));
  }
  return kept;
}

/// Sets diagonal entries to zero if they are at most `small` times the total energy of their
/// column, including its `parts` along V.
void clearDependent(linalg::DenseMatrix& energy, const linalg::DenseMatrix& parts, double small) {
  for (PetscInt j = 0; j < energy.columns(); ++j)
    if (energy(j, j) <= small * linalg::squaredLength(parts.column(j))) energy(j, j) = 0;
}

/// Returns true if energy-orthonormal vectors with the components `along` V are nearly orthogonal
/// to V.
bool isNegligible(const linalg::DenseMatrix& along) {
  constexpr double little = 1e-8;  // 1e-4 of their length
  for (PetscInt j = 0; j < along.columns(); ++j)
    if (!(linalg::squaredLength(along.column(j)) < little)) return false;
  return true;
}

/// Sets the components along the constraint modes to zero: all other vectors are orthogonal to
/// these.
void clearConstraintModes(linalg::DenseMatrix& parts, PetscInt count) {
  for (PetscInt j = 0; j < parts.columns(); ++j)
    for (PetscInt i = 0; i < count; ++i) parts(i, j) = 0;
}

}  // namespace

Basis::Basis(const modes::Modes& modes, const factor::AssociatedSystem& system,
             Substructure substructure)
    : comm_(system.comm()),
      substructure_(std::move(substructure)),
      isPlain_(!stiffness()),
      solver_(system.solver()),
      columns_(0),
      forces_(0) {
  if (isPlain_) substructure_.stiffness = system.k0();
  PetscInt rows = 0;
  check(MatGetLocalSize(stiffness(), &rows, nullptr));
  columns_ = forces_ = linalg::Block(rows);
  addConstraintModes();
  const linalg::ReadColumns columns(modes.vectors);
  linalg::Block shapes = prolonged(columns.view());
  for (PetscInt j = 0; j < shapes.columns(); ++j)
    for (double& entry : shapes.column(j)) entry /= modes.angularFrequency[j];
  // Reserved memory is free until it is used, but moving V takes time.
  columns_.reserve(4 * (size() + shapes.columns()));
  columns_.append(shapes);
  if (!isPlain_) addForces(shapes);
  OwnedVec diagonal;
  check(MatCreateVecs(stiffness(), diagonal.out(), nullptr));
  check(MatGetDiagonal(stiffness(), diagonal));
  check(VecReciprocal(diagonal));
  const ReadArray values(diagonal);
  inverseDiagonal_.assign(values.begin(), values.end());
  for (const PetscInt row : substructure_.boundary) inverseDiagonal_[row] = 0;
  sketch_.emplace(comm_, inverseDiagonal_, substructure_.boundary);
  sketchColumns(0);
}

/// Collective. Appends the sketches of the columns from `first` on.
void Basis::sketchColumns(PetscInt first) {
  // A few random combinations give the order of magnitude; blocks limit the memory of the copy.
  constexpr PetscInt few = 16, atOnce = 64;
  sketched_.append(sketch_->unweighted(columns_.columnRange(first, size())));
  for (; first < size(); first += atOnce) {
    linalg::Block scaled(columns_.columnRange(first, std::min(first + atOnce, size())));
    for (PetscInt j = 0; j < scaled.columns(); ++j)
      for (PetscInt i = 0; i < scaled.rows(); ++i)
        scaled(i, j) *= inverseDiagonal_[i] > 0 ? 1 / std::sqrt(inverseDiagonal_[i]) : 0;
    rigidity_.append(sketch_->unweighted(scaled, few));
  }
}

linalg::Block Basis::prolonged(const linalg::DenseView& interior) const {
  if (isPlain_) return linalg::Block(interior);
  linalg::Block all(localRows(), interior.columns());
  for (PetscInt j = 0; j < all.columns(); ++j)
    for (PetscInt i = 0; i < interior.rows(); ++i)
      all(substructure_.interior[i], j) = interior(i, j);
  return all;
}

void Basis::clearBoundary(linalg::Block& columns) const {
  for (PetscInt j = 0; j < columns.columns(); ++j)
    for (const PetscInt row : substructure_.boundary) columns(row, j) = 0;
}

void Basis::addConstraintModes() {
  const auto& boundary = substructure_.boundary;
  const Concatenation ranks(comm_, boundary.size());
  if (ranks.size() == 0) return;
  firstBoundary_ = ranks.ownBegin();
  linalg::Block units(localRows(), ranks.size()), forces(localRows());
  for (std::size_t i = 0; i < boundary.size(); ++i) units(boundary[i], firstBoundary_ + i) = 1;
  linalg::appendProduct(stiffness(), units, forces);
  columns_ = responses(forces);
  linalg::addScaled(units, -1, columns_);
  columns_ = std::move(units);
  linalg::appendProduct(stiffness(), columns_, forces_);
  boundaryStiffness_ = linalg::transposedProduct(comm_, columns_, forces_);
}

/// Completes K V and VᵀK V, of which the columns of the constraint modes are known, by those of the
/// free modes.
void Basis::addForces(const linalg::Block& shapes) {
  linalg::appendProduct(stiffness(), shapes, forces_);
  const PetscInt boundary = boundarySize();
  const auto right =
      linalg::transposedProduct(comm_, columns_, forces_.columnRange(boundary, size()));
  energies_ = linalg::bordered(boundaryStiffness_, right, linalg::DenseMatrix());
}

/// Sets the rows of the boundary to K z with z = K0⁻¹ r, which is −Yᵀr [M.60]; `answers` is Yᵀr.
void Basis::setBoundaryReactions(const linalg::DenseMatrix& answers,
                                 linalg::Block& residuals) const {
  const auto& boundary = substructure_.boundary;
  for (PetscInt j = 0; j < residuals.columns(); ++j)
    for (std::size_t i = 0; i < boundary.size(); ++i)
      residuals(boundary[i], j) = -answers(firstBoundary_ + i, j);
}

void Basis::releaseForces() {
  forces_ = linalg::Block(localRows());
  energies_ = {};
}

void Basis::appendProducts(Mat matrix, PetscInt first, PetscInt last, linalg::Block& result) const {
  linalg::appendProduct(matrix, columns_.columnRange(first, last), result);
}

linalg::Block Basis::responses(const linalg::Block& forces) {
  solves_ += forces.columns();
  if (isPlain_) return linalg::solved(solver_, forces);
  constexpr PetscInt atOnce = 256;  // limits the memory of the copies
  const auto& interior = substructure_.interior;
  linalg::Block all(localRows(), forces.columns());
  for (PetscInt first = 0; first < forces.columns(); first += atOnce) {
    const PetscInt count = std::min(atOnce, forces.columns() - first);
    linalg::Block some(std::ssize(interior), count);
    for (PetscInt j = 0; j < count; ++j)
      for (PetscInt i = 0; i < some.rows(); ++i) some(i, j) = forces(interior[i], first + j);
    const linalg::Block solutions = linalg::solved(solver_, some);
    for (PetscInt j = 0; j < count; ++j)
      for (PetscInt i = 0; i < some.rows(); ++i) all(interior[i], first + j) = solutions(i, j);
  }
  return all;
}

linalg::DenseMatrix Basis::flexibility(const linalg::Block& forces) {
  constexpr PetscInt panel = 256;  // wide enough for fast products
  const PetscInt size = forces.columns();
  linalg::DenseMatrix result(size, size);
  for (PetscInt first = 0; first < size; first += panel) {
    const PetscInt last = std::min(first + panel, size);
    const linalg::Block solved = responses(linalg::Block(forces.columnRange(first, last)));
    const linalg::DenseMatrix part =
        linalg::transposedProductWithSparse(comm_, solved, forces.columnRange(0, last));
    for (PetscInt j = first; j < last; ++j)
      for (PetscInt i = 0; i <= j; ++i) result(i, j) = result(j, i) = part(j - first, i);
  }
  return result;
}

PetscInt Basis::add(linalg::Block residuals) {
  const PetscInt before = size();
  addResponses(std::move(residuals));
  return size() - before;
}

linalg::DenseMatrix Basis::addResponses(linalg::Block residuals,
                                        const linalg::DenseMatrix& energies) {
  releaseForces();
  if (residuals.columns() == 0) return {};
  clearBoundary(residuals);
  linalg::Block z = responses(residuals);
  linalg::DenseMatrix energy = linalg::transposedProductWithSparse(comm_, z, residuals);
  if (energies.empty()) ratio_ = ratio(residuals, energy);
  // VᵀK z
  linalg::DenseMatrix parts = linalg::transposedProductWithSparse(comm_, columns_, residuals);
  setBoundaryReactions(linalg::rowRange(parts, 0, boundarySize()), residuals);
  clearConstraintModes(parts, boundarySize());
  const PetscInt before = size();
  if (!addOrthogonal(z, residuals, energy, parts))
    addOrthogonalised(z, parts, energies.empty() ? parts : alongBasis(energies, parts));
  sketchColumns(before);
  return energy;
}

void Basis::restore(const linalg::DenseView& columns, double lastEnergyRatio, long solves) {
  releaseForces();
  const PetscInt before = size();
  columns_.append(columns);
  sketchColumns(before);
  ratio_ = lastEnergyRatio;
  solves_ = solves;
}

/// Collective. Adds z = K0⁻¹ R if it is nearly orthogonal to V: K0 z, VᵀK0z and zᵀK0z are then R,
/// VᵀR and zᵀR. Returns false, without adding anything, if z is not nearly orthogonal or K0⁻¹ is
/// not accurate enough; otherwise it has used z and R.
bool Basis::addOrthogonal(linalg::Block& z, linalg::Block& residuals,
                          const linalg::DenseMatrix& energy, const linalg::DenseMatrix& parts) {
  const linalg::DenseMatrix combinations = orthonormalising(energy, independent),
                            along = linalg::product(parts, combinations);
  if (combinations.empty() || !isNegligible(along) || !(solutionError(z, residuals) <= 1e-12))
    return false;
  linalg::combineColumns(z, combinations);
  linalg::combineColumns(residuals, combinations);
  append(z, std::move(residuals), along);
  return true;
}

/// Collective. Appends columns z; `forces` is K0 z, and `along` is VᵀK0z.
void Basis::append(const linalg::Block& z, linalg::Block forces, const linalg::DenseMatrix& along) {
  forces_ = std::move(forces);
  const linalg::DenseMatrix own = linalg::transposedProduct(comm_, z, forces_);
  const PetscInt old = size(), added = z.columns();
  energies_ = linalg::DenseMatrix(old + added, added);
  for (PetscInt j = 0; j < added; ++j) {
    std::ranges::copy(along.column(j), energies_.column(j).begin());
    std::ranges::copy(own.column(j), energies_.column(j).begin() + old);
  }
  columns_.append(z);
}

/// Returns (VᵀK0V)⁻¹ VᵀK0z from both products; VᵀK0z, which V orthonormal would give, if the first
/// one is not positive definite. Constraint modes take no part.
linalg::DenseMatrix Basis::alongBasis(const linalg::DenseMatrix& energies,
                                      const linalg::DenseMatrix& parts) const {
  const PetscInt boundary = boundarySize(), end = size();
  const linalg::DenseMatrix own =
      linalg::rowRange(energies.columnRange(boundary, end), boundary, end);
  linalg::DenseMatrix turn;
  try {
    turn = linalg::inverseTransposed(linalg::choleskyFactor(linalg::symmetricPart(own)));
  } catch (const Error&) {  // on all ranks
    return parts;
  }
  const linalg::DenseMatrix along = linalg::product(
      turn, linalg::transposedProduct(turn, linalg::rowRange(parts, boundary, end)));
  linalg::DenseMatrix result(end, parts.columns());
  for (PetscInt j = 0; j < parts.columns(); ++j)
    std::ranges::copy(along.column(j), result.column(j).begin() + boundary);
  return result;
}

/// Collective. Adds the component of z orthogonal to V; `parts` is VᵀK0z, and `along` are the
/// coefficients of V to subtract first. If V is orthonormal within δ, each further pass leaves a
/// fraction δ of the components along V, so passes repeat until these are small compared with the
/// remainder. Columns that depend on others or on V are dropped, since they would only add noise.
void Basis::addOrthogonalised(linalg::Block& z, const linalg::DenseMatrix& parts,
                              linalg::DenseMatrix along) {
  // A remainder of 1e-6 of a column with an error of 1e-4 takes four passes if δ is a thousandth.
  constexpr int mostPasses = 6;
  for (int pass = 0; pass < mostPasses; ++pass) {
    linalg::multiplyAdd(columns_, along, z, -1);
    linalg::Block forces(z.rows());
    linalg::appendProduct(stiffness(), z, forces);
    along = linalg::transposedProduct(comm_, columns_, forces);
    clearConstraintModes(along, boundarySize());
    linalg::DenseMatrix energy = linalg::transposedProduct(comm_, z, forces);
    clearDependent(energy, parts, independent);
    const linalg::DenseMatrix combinations = orthonormalising(energy, independent),
                              remaining = linalg::product(along, combinations);
    if (combinations.empty()) return;
    if (!isNegligible(remaining)) continue;
    linalg::combineColumns(z, combinations);
    linalg::combineColumns(forces, combinations);
    append(z, std::move(forces), remaining);
    return;
  }
}

/// Collective. Returns
///   ‖K0 z w − R w‖ / ‖R w‖
/// for a vector w of signs, in the norm of diag(K0)⁻¹.
double Basis::solutionError(const linalg::Block& z, const linalg::Block& residuals) const {
  linalg::DenseMatrix signs(z.columns(), 1);
  for (PetscInt j = 0; j < z.columns(); ++j) signs(j, 0) = j % 3 == 1 ? -1 : 1;
  linalg::Block force(z.rows());
  const linalg::Block wanted = linalg::product(residuals, signs);
  linalg::appendProduct(stiffness(), linalg::product(z, signs), force);
  std::array squares{0.0, 0.0};
  for (PetscInt i = 0; i < z.rows(); ++i) {
    squares[0] += inverseDiagonal_[i] * std::pow(force(i, 0) - wanted(i, 0), 2);
    squares[1] += inverseDiagonal_[i] * std::pow(wanted(i, 0), 2);
  }
  mpi::sumAlike(comm_, squares);
  return std::sqrt(squares[0] / squares[1]);
}

void Basis::combine(const linalg::DenseMatrix& combinations) {
  linalg::combineColumns(columns_, combinations);
  forces_ = {};
  sketched_ = linalg::product(sketched_, combinations);
  rigidity_ = linalg::product(rigidity_, combinations);
  energies_ = {};
}

/// Returns the largest ratio of the energy norm to that of the diagonal among all combinations of
/// the columns, where `energy` is RᵀK0⁻¹R.
double Basis::ratio(const linalg::Block& residuals, const linalg::DenseMatrix& energy) const {
  constexpr PetscInt atOnce = 128;  // limits the memory of the copy
  linalg::DenseMatrix gram(residuals.columns());
  for (PetscInt first = 0; first < residuals.columns(); first += atOnce) {
    linalg::Block scaled(
        residuals.columnRange(first, std::min(first + atOnce, residuals.columns())));
    for (PetscInt j = 0; j < scaled.columns(); ++j)
      for (PetscInt i = 0; i < scaled.rows(); ++i) scaled(i, j) *= inverseDiagonal_[i];
    gram.append(linalg::transposedProductWithSparse(comm_, residuals, scaled));
  }
  const linalg::DenseMatrix combinations = orthonormalising(std::move(gram), 1e-8);
  if (combinations.empty()) return 0;
  return std::sqrt(linalg::symmetricEigenvalues(linalg::congruent(energy, combinations)).back());
}

std::vector<double> Basis::energyRatios(const std::vector<linalg::Block>& blocks) {
  linalg::Block all(localRows());
  for (const auto& block : blocks) all.append(block);
  if (all.columns() == 0) return std::vector<double>(blocks.size(), 0.0);
  const linalg::Block solved = responses(all);
  std::vector<double> ratios;
  PetscInt first = 0;
  for (const auto& block : blocks) {
    const linalg::DenseView solutions = solved.columnRange(first, first + block.columns());
    first += block.columns();
    ratios.push_back(ratio(block, linalg::transposedProduct(comm_, solutions, block)));
  }
  return ratios;
}

std::vector<linalg::ComplexVector> Basis::expand(
    const std::vector<std::vector<Complex>>& list) const {
  const PetscInt count = list.size();
  linalg::DenseMatrix coordinates(size(), 2 * count);  // real parts, then imaginary parts
  for (PetscInt j = 0; j < count; ++j)
    for (std::size_t i = 0; i < list[j].size(); ++i) {
      coordinates(i, j) = list[j][i].real();
      coordinates(i, count + j) = list[j][i].imag();
    }
  const linalg::Block parts = linalg::product(columns_, coordinates);
  std::vector<linalg::ComplexVector> vectors(list.size());
  const auto copy = [&](PetscInt column, Vec to) {
    std::ranges::copy(parts.column(column), WriteArray(to).begin());
  };
  for (PetscInt j = 0; j < count; ++j) {
    check(MatCreateVecs(stiffness(), vectors[j].real.out(), vectors[j].imaginary.out()));
    copy(j, vectors[j].real);
    copy(count + j, vectors[j].imaginary);
  }
  return vectors;
}

}  // namespace squeal::subspace
