// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/proof/matrix_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/factor/symmetric_solver.hpp"
#include "algebra/linalg/block.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/petsc/arrays.hpp"
#include "base/system/error.hpp"

namespace squeal::proof {
namespace {

constexpr int mostTrials = 60;

/// Collective. Returns the largest |A_ij| / √(H_ii H_jj), which no bound of A in H is below.
double lowerBound(Mat matrix, Mat energy) {
  const OwnedVec scale = rightVector(energy);
  check(MatGetDiagonal(energy, scale));
  check(VecPow(scale, -0.5));
  OwnedMat scaled;
  check(MatDuplicate(matrix, MAT_COPY_VALUES, scaled.out()));
  check(MatDiagonalScale(scaled, scale, scale));
  const OwnedVec largest = rightVector(energy);
  check(MatGetRowMaxAbs(scaled, largest, nullptr));
  PetscReal bound = 0;
  check(VecMax(largest, nullptr, &bound));
  return bound;
}

/// Collective. Returns this rank's rows of a few columns that look random.
linalg::Block startColumns(Mat matrix) {
  constexpr PetscInt few = 6;
  PetscInt first = 0, end = 0;
  check(MatGetOwnershipRange(matrix, &first, &end));
  linalg::Block columns(end - first, few);
  for (PetscInt j = 0; j < few; ++j)
    for (PetscInt i = first; i < end; ++i) columns(i - first, j) = std::sin(1.7 * i * (j + 1) + j);
  return columns;
}

/// Collective. Returns the largest |xᵀ A y| / √(xᵀ H x yᵀ H y) for a symmetric or antisymmetric A
/// on a few directions found by subspace iteration, given the factor of H. It is at most the
/// largest one of all directions, and usually near it.
double estimate(Mat matrix, factor::MumpsFactor& energy) {
  constexpr int steps = 12;
  constexpr double independent = 1e-12;
  const MPI_Comm comm = commOf(matrix);
  linalg::Block columns = startColumns(matrix);
  double largest = 0;
  for (int step = 0; step < steps; ++step) {
    // The next columns are H⁻¹ A x. Their Gram matrix in H takes no product with H.
    linalg::Block forces(columns.rows());
    linalg::appendProduct(matrix, columns, forces);
    energy.solve(forces.data(), columns.data(), forces.columns());
    linalg::DenseMatrix gram =
        linalg::symmetricPart(linalg::transposedProduct(comm, columns, forces));
    const auto values = linalg::symmetricEigen(gram);
    if (!(values.back() > 0)) return largest;
    linalg::DenseMatrix kept(gram.rows());
    for (PetscInt j = 0; j < gram.columns(); ++j) {
      if (!(values[j] > independent * values.back())) continue;
      for (double& entry : gram.column(j)) entry /= std::sqrt(values[j]);
      kept.append(gram.column(j));
    }
    columns = linalg::product(columns, kept);
    linalg::Block products(columns.rows());
    linalg::appendProduct(matrix, columns, products);
    const auto onColumns = linalg::transposedProduct(comm, columns, products);
    const auto squares =
        linalg::symmetricEigenvalues(linalg::transposedProduct(onColumns, onColumns));
    largest = std::max(largest, std::sqrt(std::max(squares.back(), 0.0)));
  }
  return largest;
}

/// Collective. Returns true if g H + sign A ≥ 0.
bool isBounded(Mat matrix, Mat energy, double g, double sign) {
  OwnedMat sum;
  check(MatDuplicate(energy, MAT_COPY_VALUES, sum.out()));
  check(MatScale(sum, g));
  check(MatAXPY(sum, sign, matrix, DIFFERENT_NONZERO_PATTERN));
  check(MatSetOption(sum, MAT_SYMMETRIC, PETSC_TRUE));
  return factor::inertia(sum).negative == 0;
}

/// Collective. Returns true if |xᵀ A y| ≤ g √(xᵀ H x yᵀ H y).
bool isBoundedSkew(Mat skew, Mat energy, double g) {
  OwnedMat scaled, transposed, nested, whole;
  check(MatDuplicate(energy, MAT_COPY_VALUES, scaled.out()));
  check(MatScale(scaled, g));
  check(MatTranspose(skew, MAT_INITIAL_MATRIX, transposed.out()));
  Mat blocks[] = {scaled, skew, transposed, scaled};
  check(MatCreateNest(commOf(energy), 2, nullptr, 2, nullptr, blocks, nested.out()));
  check(MatConvert(nested, MATAIJ, MAT_INITIAL_MATRIX, whole.out()));
  check(MatSetOption(whole, MAT_SYMMETRIC, PETSC_TRUE));
  return factor::inertia(whole).negative == 0;
}

/// Returns a g ≥ start that is confirmed. Unless g · weight is negligible, it is less than 1.2
/// times the smallest one. `likely` is an estimate of the smallest one; 0 if there is none. Each
/// trial takes a factorisation.
template <class Confirmed>
double smallest(double start, double likely, double weight, const Confirmed& confirmed) {
  constexpr double negligible = 5e-3, close = 1.2;
  if (likely >= start && likely > 0) {
    const bool matters = 4 * likely * weight > negligible;
    for (const double factor : {matters ? 1.08 : 2, matters ? close : 4})
      if (confirmed(factor * likely)) return factor * likely;
    start = close * likely;
  }
  double g = start, ratio = start * weight < negligible ? 4 : 2;
  for (int i = 0; !confirmed(g); ++i, g *= ratio)
    if (i == mostTrials)
      throw Error("a damping or gyroscopic matrix has no bound in the energy of the stiffness");
  while (ratio > close && g > start && g * weight > negligible) {
    ratio = std::sqrt(ratio);
    if (confirmed(g / ratio)) g /= ratio;
  }
  return g;
}

}  // namespace

MatrixBounds::MatrixBounds(const factor::AssociatedSystem& system, double mass,
                           std::vector<Mat> matrices) {
  check(MatDuplicate(system.k0(), MAT_COPY_VALUES, energy_.out()));
  check(MatAXPY(energy_, 1 / mass, system.m0(), DIFFERENT_NONZERO_PATTERN));
  // The factor of H takes memory that the inertia of other matrices needs.
  const auto factor = factor::shiftedFactor(system.k0(), system.m0(), -1 / mass, system.solver());
  for (const Mat matrix : matrices)
    if (matrix) likely_.emplace_back(matrix, estimate(matrix, *factor));
}

double MatrixBounds::likely(Mat matrix) const {
  const auto known = std::ranges::find(likely_, matrix, &std::pair<Mat, double>::first);
  ensure(known != likely_.end(), "a bound belongs to one of the given matrices");
  return known->second;
}

double MatrixBounds::ofSkew(Mat matrix, double weight) const {
  if (!matrix) return 0;
  return 2 * smallest(lowerBound(matrix, energy_), likely(matrix), 2 * weight,
                      [&](double g) { return isBoundedSkew(matrix, energy_, g); });
}

double MatrixBounds::ofSymmetric(Mat matrix, double weight) const {
  if (!matrix) return 0;
  return 2 * smallest(lowerBound(matrix, energy_), likely(matrix), 2 * weight, [&](double g) {
           return isBounded(matrix, energy_, g, -1) && isBounded(matrix, energy_, g, 1);
         });
}

MatrixBounds::Damping MatrixBounds::ofDamping(Mat matrix, double weight, double weightBelow) const {
  if (!matrix) return {};
  const double start = lowerBound(matrix, energy_);
  const double above = 2 * smallest(start, likely(matrix), 2 * weight,
                                    [&](double g) { return isBounded(matrix, energy_, g, -1); });
  // Round-off of a semi-definite C, or a C that feeds motions: C + κ H ≥ 0.
  const double below = 2 * smallest(1e-9 * start, 0, 2 * weightBelow,
                                    [&](double g) { return isBounded(matrix, energy_, g, 1); });
  return {above + below, below};
}

}  // namespace squeal::proof
