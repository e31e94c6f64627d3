// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/referee/kept_space.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/linalg/spread.hpp"
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
                     const modes::Modes& modes, const linalg::DenseView& more)
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
  if (more.columns() > 0 && !isWhole()) {
    linalg::Block forces(basis_.localRows());
    linalg::appendProduct(shifted.system.k0(), more, forces);
    basis_.add(std::move(forces));
  }
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
  if (power == 0) total = linalg::identity(size());
  for (const auto& part : parts_) {
    if (part.power == power) linalg::addScaled(total, 1, part.onV);
    if (power == 0 && part.power == 2 && !part.skew)
      linalg::addScaled(total, -shifted_.shift, part.onV);  // K = K0 − σ M
  }
  return total;
}

std::vector<linalg::DensePair> KeptSpace::pairs(const linalg::EigenvalueFilter& wanted) const {
  // On one rank: round-off must not make the ranks disagree on the pairs.
  return std::move(
      linalg::spread(shifted_.system.comm(), 1, linalg::Vectors::both, [&](std::size_t) {
        return linalg::solveQuadratic({.mass = sum(2), .damping = sum(1), .stiffness = sum(0)},
                                      linalg::Vectors::both, wanted);
      }).front());
}

/// Collective. Appends the residuals `parts`, real and imaginary parts by turns, that are large
/// enough to matter.
void KeptSpace::appendLarge(const linalg::Block& parts, linalg::Block& residuals) const {
  constexpr double accurate = 1e-3;  // of the largest residual: the pair needs no correction
  constexpr double roundOff = 1e-6;  // of the other part: the imaginary part of a real vector
  std::vector<double> squares;
  for (PetscInt j = 0; j < parts.columns(); ++j)
    squares.push_back(linalg::squaredLength(parts.column(j)));
  mpi::sumAlike(shifted_.system.comm(), squares);
  const double largest = squares.empty() ? 0 : *std::ranges::max_element(squares);
  for (PetscInt j = 0; j < parts.columns(); ++j)
    if (squares[j] > accurate * accurate * largest &&
        squares[j] > roundOff * roundOff * squares[j ^ 1])
      residuals.append(parts.column(j));
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
    appendLarge(sides, all);
  }
  basis_.add(linalg::unitColumns(shifted_.system.comm(), all));
  measure();
}

/// Returns the Gram matrix of the coefficients of s⁰, s¹ and s² that the problem has, from that of
/// the parts: C_k = Σ ± A.
linalg::DenseMatrix ProjectedProblem::couplingGram(bool transposed) const {
  const PetscInt n = matrices[0].rows(), count = std::ssize(parts);
  // The blocks to which a part contributes, with its factors.
  const auto places = [&](const Part& part) {
    const PetscInt own = part.power == 2 && !damped ? 1 : part.power;
    std::vector<std::pair<PetscInt, double>> result{{own, transposed && part.skew ? -1 : 1}};
    if (part.power == 2 && !part.skew && shift != 0) result.emplace_back(0, -shift);
    return result;
  };
  const PetscInt size = (damped ? 3 : 2) * n;
  linalg::DenseMatrix result(size, size);
  for (PetscInt q = 0; q < count; ++q)
    for (const auto& [column, right] : places(parts[q]))
      for (PetscInt p = 0; p < count; ++p)
        for (const auto& [row, left] : places(parts[p]))
          for (PetscInt j = 0; j < n; ++j)
            for (PetscInt i = 0; i < n; ++i)
              result(row * n + i, column * n + j) += left * right * gram(p * n + i, q * n + j);
  return linalg::symmetricPart(result);
}

proof::KeptProblem ProjectedProblem::kept(double top) const {
  proof::KeptProblem kept;
  kept.matrices = matrices;
  if (gram.empty()) return kept;
  const std::vector<int> powers = damped ? std::vector{0, 1, 2} : std::vector{0, 2};
  kept.toLeftOut = {proof::couplingFromGram(couplingGram(false), powers, top)};
  kept.fromLeftOut = {proof::transposed(proof::couplingFromGram(couplingGram(true), powers, top))};
  return kept;
}

ProjectedProblem KeptSpace::problem() {
  const MPI_Comm comm = shifted_.system.comm();
  const PetscInt n = size();
  ProjectedProblem result;
  result.matrices = {sum(0), sum(1), sum(2)};
  result.shift = shifted_.shift;
  result.damped = problem_.damped();
  for (const auto& part : parts_) result.parts.push_back({part.power, part.skew});
  leak_ = 0;
  if (isWhole()) return result;
  linalg::Block outside(v_.rows());  // A V less its part in K0 V
  for (auto& part : parts_) {
    linalg::Block rest = std::exchange(part.products, linalg::Block());
    // Twice: the first time leaves the round-off of a product that is nearly in V.
    linalg::multiplyAdd(forces_, part.onV, rest, -1);
    linalg::multiplyAdd(forces_, linalg::transposedProduct(comm, v_, rest), rest, -1);
    outside.append(rest);
  }
  result.gram = basis_.flexibility(outside);
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    if (parts_[p].power != 2 || parts_[p].skew) continue;
    double sum = squaredNorm(parts_[p].onV, modes_, n, modes_);
    for (PetscInt j = 0; j < modes_; ++j) {
      const PetscInt place = static_cast<PetscInt>(p) * n + j;
      sum += std::max(result.gram(place, place), 0.0);
    }
    leak_ = std::sqrt(sum);
  }
  return result;
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
