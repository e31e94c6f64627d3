// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/referee/kept_space.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/symmetric.hpp"
#include "base/system/error.hpp"
#include "eigen/reduction/responses.hpp"

namespace squeal::referee {
namespace {

double squaredNorm(const linalg::DenseMatrix& a, PetscInt firstRow, PetscInt lastRow,
                   PetscInt columns) {
  double sum = 0;
  for (PetscInt j = 0; j < columns; ++j)
    for (PetscInt i = firstRow; i < lastRow; ++i) sum += a(i, j) * a(i, j);
  return sum;
}

}  // namespace

KeptSpace::KeptSpace(const SplitProblem& problem, const ShiftedSystem& shifted,
                     const modes::Modes& modes)
    : problem_(problem),
      shifted_(shifted),
      basis_(modes, shifted.system),
      modes_(std::ssize(modes.lambda)) {
  for (const int power : {0, 1, 2})
    for (const bool skew : {false, true})
      if (const Mat matrix = skew ? problem.skew(power) : problem.symmetric(power);
          matrix && (power > 0 || skew))
        parts_.push_back({matrix, power, skew, linalg::Block(), {}});
  constexpr double resolution = 1e-3;
  const pencil::Pencil others(problem.perturbations());
  std::vector<double> frequencies;
  for (const double lambda : modes.lambda)
    frequencies.push_back(std::sqrt(std::abs(lambda - shifted.shift)));
  if (!others.terms().empty() && !isWhole())
    basis_.add(reduction::forcesOnModes(basis_, others, {}, frequencies, resolution));
  measure();
}

/// Makes V orthonormal in energy and projects all matrices.
void KeptSpace::measure() {
  const MPI_Comm comm = shifted_.system.comm();
  v_ = linalg::Block(basis_.columns());
  // Two passes: the first leaves the round-off of the deviation from the identity.
  for (int pass = 0; pass < 2; ++pass) {
    linalg::Block forces(v_.rows());
    linalg::appendProduct(shifted_.system.k0(), v_, forces);
    // Upper triangular combinations: the first vectors stay in the span of the first.
    v_ = linalg::product(v_, linalg::inverseTransposed(linalg::choleskyFactor(
                                 linalg::transposedProduct(comm, v_, forces))));
  }
  forces_ = linalg::Block(v_.rows());
  linalg::appendProduct(shifted_.system.k0(), v_, forces_);
  for (auto& part : parts_) {
    part.products = linalg::Block(v_.rows());
    linalg::appendProduct(part.matrix, v_, part.products);
    part.onV = linalg::transposedProduct(comm, v_, part.products);
  }
}

linalg::DenseMatrix KeptSpace::sum(int power) const {
  linalg::DenseMatrix total;
  if (power == 0) {
    total = linalg::DenseMatrix(size(), size());
    for (PetscInt i = 0; i < size(); ++i) total(i, i) = 1;
  }
  for (const auto& part : parts_) {
    if (part.power == power) linalg::addScaled(total, 1, part.onV);
    if (power == 0 && part.power == 2 && !part.skew)
      linalg::addScaled(total, -shifted_.shift, part.onV);  // K = K0 − σ M
  }
  return total;
}

std::vector<linalg::DensePair> KeptSpace::pairs(const linalg::EigenvalueFilter& wanted) const {
  return linalg::solveQuadratic({.mass = sum(2), .damping = sum(1), .stiffness = sum(0)},
                                linalg::Vectors::both, wanted);
}

void KeptSpace::correct(const std::vector<linalg::DensePair>& pairs) {
  const PetscInt count = std::ssize(pairs);
  linalg::Block all(v_.rows());
  for (const bool left : {false, true}) {
    linalg::Block sides(v_.rows(), 2 * count);  // real and imaginary parts
    const auto addProducts = [&](const linalg::Block& products, int power, double factor) {
      linalg::DenseMatrix coefficients(products.columns(), 2 * count);
      for (PetscInt j = 0; j < count; ++j) {
        const auto& vector = left ? pairs[j].left : pairs[j].q;
        const Complex weight = factor * std::pow(left ? std::conj(pairs[j].s) : pairs[j].s, power);
        for (PetscInt i = 0; i < products.columns(); ++i) {
          coefficients(i, 2 * j) = (weight * vector[i]).real();
          coefficients(i, 2 * j + 1) = (weight * vector[i]).imag();
        }
      }
      linalg::multiplyAdd(products, coefficients, sides);
    };
    addProducts(forces_, 0, 1);
    for (const auto& part : parts_) {
      addProducts(part.products, part.power, part.skew && left ? -1 : 1);
      if (part.power == 2 && !part.skew) addProducts(part.products, 0, -shifted_.shift);
    }
    // Residuals are orthogonal to V except for round-off, which the imaginary parts of real vectors
    // consist of.
    const MPI_Comm comm = shifted_.system.comm();
    for (PetscInt j = 0; j < count; ++j) {
      const double real = linalg::length(comm, sides.column(2 * j)),
                   imaginary = linalg::length(comm, sides.column(2 * j + 1));
      if (real > 1e-6 * imaginary) all.append(sides.column(2 * j));
      if (imaginary > 1e-6 * real) all.append(sides.column(2 * j + 1));
    }
  }
  basis_.add(linalg::unitColumns(shifted_.system.comm(), all));
  measure();
}

/// Returns the Gram matrix of the coefficients of s⁰, s¹ and s² that the problem has, from that of
/// the parts: C_k = Σ ± A.
linalg::DenseMatrix KeptSpace::couplingGram(const linalg::DenseMatrix& gram,
                                            bool transposed) const {
  const PetscInt n = size(), count = std::ssize(parts_);
  const bool damped = problem_.damped();
  linalg::DenseMatrix combination(count * n, (damped ? 3 : 2) * n);
  for (PetscInt p = 0; p < count; ++p) {
    const auto& part = parts_[p];
    const PetscInt place = part.power == 2 && !damped ? 1 : part.power;
    const double sign = transposed && part.skew ? -1 : 1;
    for (PetscInt i = 0; i < n; ++i) {
      combination(p * n + i, place * n + i) += sign;
      if (part.power == 2 && !part.skew) combination(p * n + i, i) -= shifted_.shift;
    }
  }
  return linalg::symmetricPart(linalg::congruent(gram, combination));
}

proof::KeptProblem KeptSpace::problem(double top) {
  const MPI_Comm comm = shifted_.system.comm();
  const PetscInt n = size();
  proof::KeptProblem kept;
  kept.matrices = {sum(0), sum(1), sum(2)};
  leak_ = 0;
  if (isWhole()) return kept;
  linalg::Block outside(v_.rows());  // A V less its part in K0 V
  for (const auto& part : parts_) {
    linalg::Block rest = part.products;
    // Twice: the first time leaves the round-off of a product that is nearly in V.
    linalg::multiplyAdd(forces_, part.onV, rest, -1);
    linalg::multiplyAdd(forces_, linalg::transposedProduct(comm, v_, rest), rest, -1);
    outside.append(rest);
  }
  const linalg::Block responses = basis_.responses(outside);
  const linalg::DenseMatrix gram =
      linalg::symmetricPart(linalg::transposedProduct(comm, responses, outside));
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    if (parts_[p].power != 2 || parts_[p].skew) continue;
    double sum = squaredNorm(parts_[p].onV, modes_, n, modes_);
    for (PetscInt j = 0; j < modes_; ++j) {
      const PetscInt place = static_cast<PetscInt>(p) * n + j;
      sum += std::max(gram(place, place), 0.0);
    }
    leak_ = std::sqrt(sum);
  }
  const std::vector<int> powers = problem_.damped() ? std::vector{0, 1, 2} : std::vector{0, 2};
  kept.toLeftOut = {proof::couplingFromGram(couplingGram(gram, false), powers, top)};
  kept.fromLeftOut = {
      proof::transposed(proof::couplingFromGram(couplingGram(gram, true), powers, top))};
  return kept;
}

proof::LeftOut KeptSpace::leftOut(PetscInt count, double last, double below) const {
  proof::LeftOut bounds;
  bounds.shift = shifted_.shift;
  if (isWhole()) return bounds;
  ensure(count <= modes_, "the modes below a bound belong to V");
  bounds.mass = 1 / below + leak_;  // Weyl
  // As many Ritz values of the modes must lie above this bound as M has eigenvalues above 1/θ.
  if (count > 0 && !(1 / last > bounds.mass)) bounds.mass = 1;
  return bounds;
}

}  // namespace squeal::referee
