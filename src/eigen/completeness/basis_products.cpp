// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/completeness/basis_products.hpp"

#include <algorithm>
#include <cmath>

#include "eigen/completeness/list_judgement.hpp"

namespace squeal::completeness {

using linalg::DenseMatrix;

linalg::Block columnsOf(Mat rows) {
  OwnedMat transpose;
  check(MatTranspose(rows, MAT_INITIAL_MATRIX, transpose.out()));
  PetscInt all = 0, count = 0, first = 0;
  check(MatGetSize(rows, &all, nullptr));
  check(MatGetLocalSize(transpose, &count, nullptr));
  check(MatGetOwnershipRange(transpose, &first, nullptr));
  linalg::Block columns(count, all);
  for (PetscInt i = 0; i < count; ++i) {
    PetscInt entries = 0;
    const PetscInt* places = nullptr;
    const PetscScalar* values = nullptr;
    check(MatGetRow(transpose, first + i, &entries, &places, &values));
    for (PetscInt k = 0; k < entries; ++k) columns(i, places[k]) = values[k];
    check(MatRestoreRow(transpose, first + i, &entries, &places, &values));
  }
  return columns;
}

void appendParts(const std::vector<Complex>& vector, DenseMatrix& columns) {
  std::vector<double> real(columns.rows()), imaginary(columns.rows());
  for (std::size_t i = 0; i < vector.size(); ++i)
    real[i] = vector[i].real(), imaginary[i] = vector[i].imag();
  columns.append(std::span<const double>(real));
  if (std::ranges::any_of(imaginary, [](double entry) { return entry != 0; }))
    columns.append(std::span<const double>(imaginary));
}

namespace {

/// Collective. Appends Vᵀ M K0⁻¹ M v for the vectors v of V from `first` to before `end`.
void appendMassFlexibility(reduction::ReducedProblem& reduced, Mat mass, PetscInt first,
                           PetscInt end, DenseMatrix& result) {
  constexpr PetscInt atOnce = 128;  // limits the memory
  const auto& basis = reduced.basis();
  for (; first < end; first += atOnce) {
    linalg::Block forces(basis.localRows()), inertia(basis.localRows());
    basis.appendProducts(mass, first, std::min(first + atOnce, end), forces);
    linalg::appendProduct(mass, reduced.responses(forces), inertia);
    result.append(linalg::transposedProduct(basis.comm(), basis.columns(), inertia));
  }
}

}  // namespace

DenseMatrix massFlexibility(reduction::ReducedProblem& reduced, const KnownModes& modes,
                            const std::vector<double>& lambda, Mat mass, PetscInt solved) {
  const PetscInt size = reduced.basisSize(), afterModes = modes.first + modes.count;
  DenseMatrix result(size);
  appendMassFlexibility(reduced, mass, 0, modes.first, result);
  result.resizeColumns(afterModes);
  appendMassFlexibility(reduced, mass, afterModes, solved, result);
  result.resizeColumns(size);
  const DenseMatrix onV = reduced.projectAssociated().mass;
  for (PetscInt i = 0; i < size; ++i)
    for (PetscInt j = 0; j < modes.count; ++j) {
      const PetscInt mode = modes.first + j;
      if (i >= solved) result(mode, i) = onV(mode, i) / lambda[j];
      result(i, mode) = result(mode, i);
    }
  for (PetscInt j = 0; j < modes.count; ++j)
    result(modes.first + j, modes.first + j) = 1 / (lambda[j] * lambda[j]);
  for (PetscInt i = solved; i < size; ++i)
    for (PetscInt j = 0; j < solved; ++j) result(j, i) = result(i, j);
  return result;
}

void completeMassFlexibility(reduction::ReducedProblem& reduced, Mat mass, PetscInt solved,
                             DenseMatrix& product) {
  DenseMatrix more(product.rows());
  appendMassFlexibility(reduced, mass, solved, product.columns(), more);
  for (PetscInt j = 0; j < more.columns(); ++j)
    std::ranges::copy(more.column(j), product.column(solved + j).begin());
}

DenseMatrix randomSigns(PetscInt rows, PetscInt columns) {
  DenseMatrix signs(rows, columns);
  unsigned state = 1;
  for (double& sign : signs.entries()) {
    state = 1664525 * state + 1013904223;  // Numerical Recipes, section 7.1
    sign = state >> 31 ? 1 : -1;
  }
  return signs;
}

namespace {

/// Collective. Returns an estimate of ‖M0 d − K0 d/λ‖ of all modes together in the norm of K0⁻¹,
/// from random combinations of them, twice as large as its mean.
double errorOfModes(reduction::ReducedProblem& reduced, const modes::Modes& modes,
                    const pencil::Pencil& associated) {
  constexpr PetscInt combinations = 16;
  const auto& basis = reduced.basis();
  const PetscInt count = std::ssize(modes.lambda), first = basis.boundarySize();
  const DenseMatrix signs = randomSigns(count, combinations);
  DenseMatrix scaled = signs;
  for (PetscInt j = 0; j < combinations; ++j)
    for (PetscInt i = 0; i < count; ++i) scaled(i, j) /= modes.lambda[i];
  const auto vectors = basis.columns().columnRange(first, first + count);
  const linalg::Block motions = linalg::product(vectors, signs),
                      others = linalg::product(vectors, scaled);
  linalg::Block forces(motions.rows()), stiffness(motions.rows());
  linalg::appendProduct(associated.assembled(2, {}), motions, forces);
  linalg::appendProduct(associated.assembled(0, {}), others, stiffness);
  linalg::addScaled(forces, -1, stiffness);
  const DenseMatrix energy = reduced.flexibility(forces);
  double sum = 0;
  for (PetscInt j = 0; j < combinations; ++j) sum += energy(j, j);
  return 2 * std::sqrt(sum / combinations);
}

/// Collective. Returns θ below which all modes are known, if that is confirmed.
std::optional<double> completeTo(const factor::AssociatedSystem& system, const modes::Modes& modes,
                                 double bandTop) {
  constexpr double enough = 0.3;  // of δ
  if (!modes.countConfirmed) return {};
  if (1 - std::pow((1 + above) * bandTop, 2) / modes.inertiaShift > enough)
    return modes.inertiaShift;
  const auto count = modes::countAtTop(system, modes);
  if (!count.agrees) return {};
  return std::max(count.shift, modes.inertiaShift);
}

}  // namespace

std::optional<KnownModes> knownModes(reduction::ReducedProblem& reduced,
                                     const factor::AssociatedSystem& system,
                                     const modes::Modes& modes, const pencil::Pencil& associated) {
  const auto theta = completeTo(system, modes, reduced.band().top);
  if (!theta) return {};
  return KnownModes{reduced.basis().boundarySize(), PetscInt(std::ssize(modes.lambda)), *theta,
                    errorOfModes(reduced, modes, associated)};
}

}  // namespace squeal::completeness
