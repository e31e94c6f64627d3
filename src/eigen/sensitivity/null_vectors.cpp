// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sensitivity/null_vectors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/null_vectors.hpp"
#include "algebra/linalg/spread.hpp"
#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::sensitivity {
namespace {

constexpr int mostRounds = 20;

/// Collective. Returns the vector [parts] c, scaled to the 2-norm 1. The parts contain this rank's
/// rows and lie side by side.
linalg::ComplexVector combination(const pencil::Pencil& pencil,
                                  std::initializer_list<linalg::DenseView> parts,
                                  const std::vector<Complex>& c) {
  linalg::DenseMatrix coefficients(std::ssize(c), 2);
  for (std::size_t i = 0; i < c.size(); ++i)
    coefficients(i, 0) = c[i].real(), coefficients(i, 1) = c[i].imag();
  linalg::Block sum(parts.begin()->rows(), 2);
  PetscInt first = 0;
  for (const auto& part : parts) {
    const PetscInt next = first + part.columns();
    linalg::multiplyAdd(part, linalg::rowRange(coefficients, first, next), sum);
    first = next;
  }
  auto y = linalg::ComplexVector::like(rightVector(pencil.terms().front().matrix));
  for (const auto& [vector, column] : {std::pair{y.real.get(), 0}, {y.imaginary.get(), 1}})
    std::ranges::copy(sum.column(column), WriteArray(vector).begin());
  const double size = length(y);
  check(VecScale(y.real, 1 / size));
  check(VecScale(y.imaginary, 1 / size));
  return y;
}

/// Appends the real and the imaginary part, divided by `divisor`.
void appendParts(const linalg::ComplexVector& vector, double divisor, linalg::Block& columns) {
  for (Vec part : {vector.real.get(), vector.imaginary.get()}) {
    const ReadArray entries(part);
    columns.append(linalg::DenseView(entries.data(), entries.size(), 1));
    for (double& entry : columns.column(columns.columns() - 1)) entry /= divisor;
  }
}

/// The vectors of one side, in the basis [V W]: V is the start space, and W what the search adds.
class NullIteration {
 public:
  NullIteration(const pencil::Pencil& pencil, const sweep::Parameters& at, const StartSpace& start,
                KSP solver, pencil::Side side)
      : pencil_(pencil),
        at_(at),
        side_(side),
        norms_{pencil.norm(0, at), pencil.norm(1, at), pencil.norm(2, at)},
        solver_(solver),
        inner_(start.inner),
        start_(start.columns),
        added_(start.columns.rows()),
        projected_(start.projected) {
    if (projected_.order() == 0) border(start_, 0);
  }

  /// Returns the vectors of these eigenvalues; the search also starts from `more`.
  std::vector<NullVector> vectors(const std::vector<Complex>& s, linalg::Block more,
                                  const Search& search) {
    // Round-off and the error of s limit the accuracy: below `settled`, an error that a round does
    // not halve has reached this limit.
    constexpr double settled = 1e-10;
    add(std::move(more));
    std::vector<NullVector> found(s.size());
    std::vector<double> previous(s.size(), INFINITY);
    std::vector<std::size_t> open(s.size());
    std::iota(open.begin(), open.end(), 0);
    for (int round = 0;; ++round) {
      std::vector<Complex> values;
      for (std::size_t i : open) values.push_back(s[i]);
      const auto coordinates = nullVectors(values, search.simple);
      std::vector<std::size_t> bad;
      linalg::Block residuals(start_.rows());
      for (std::size_t k = 0; k < open.size(); ++k) {
        auto& [vector, backwardError] = found[open[k]];
        vector = combination(pencil_, {start_, added_}, coordinates[k]);
        const auto residual = pencil::residual(pencil_, at_, values[k], vector, side_);
        const double size = length(residual);
        backwardError = size > 0 ? size / (scale(values[k]) * length(vector)) : 0;
        const double before = std::exchange(previous[open[k]], backwardError);
        const bool stalls = backwardError <= settled && backwardError > before / 2;
        if (backwardError <= search.accuracy || stalls) continue;
        bad.push_back(open[k]);
        appendParts(residual, size, residuals);
      }
      if (bad.empty() || round == mostRounds) return found;
      if (!add(linalg::solved(solver_, residuals))) return found;
      open = std::move(bad);
    }
  }

 private:
  MPI_Comm comm() const { return pencil_.comm(); }
  PetscInt size() const { return start_.columns() + added_.columns(); }

  double scale(Complex s) const {
    const double size = std::abs(s);
    return norms_[0] + size * norms_[1] + size * size * norms_[2];
  }

  /// Returns the norms of the columns in the inner product of the start space.
  std::vector<double> norms(const linalg::Block& x) const {
    const auto gram = linalg::transposedProduct(comm(), x, innerProducts(x));
    std::vector<double> lengths;
    for (PetscInt j = 0; j < x.columns(); ++j)
      lengths.push_back(std::sqrt(std::max(0.0, gram(j, j))));
    return lengths;
  }

  linalg::Block innerProducts(const linalg::Block& x) const {
    linalg::Block products(x.rows());
    linalg::appendProduct(inner_, x, products);
    return products;
  }

  /// Makes X orthogonal to columns that are orthonormal.
  void orthogonalise(const linalg::DenseView& columns, linalg::Block& x) const {
    if (columns.columns() == 0) return;
    for (int pass = 0; pass < 2; ++pass)
      linalg::multiplyAdd(columns, linalg::transposedProduct(comm(), columns, innerProducts(x)), x,
                          -1);
  }

  /// Adds vectors to the basis, except those that depend on it. Returns true if the basis has
  /// grown.
  bool add(linalg::Block x) {
    constexpr double dependent = 1e-6;
    if (x.columns() == 0) return false;
    const PetscInt before = size();
    const auto lengths = norms(x);
    orthogonalise(start_, x);
    for (PetscInt j = 0; j < x.columns(); ++j) {
      linalg::Block column(x.columnRange(j, j + 1));
      orthogonalise(added_, column);
      const double rest = norms(column)[0];
      if (!(rest > dependent * lengths[j])) continue;
      for (double& entry : column.entries()) entry /= rest;
      added_.append(column);
    }
    if (size() == before) return false;
    border(added_.columnRange(before - start_.columns(), added_.columns()), before);
    return true;
  }

  /// Extends the projected pencil by the last columns of the basis, which follow after `known`.
  void border(const linalg::DenseView& columns, PetscInt known) {
    constexpr std::array matrices{&linalg::DenseProblem::stiffness, &linalg::DenseProblem::damping,
                                  &linalg::DenseProblem::mass};  // [power of s]
    for (int power = 0; power <= 2; ++power) {
      if (!pencil_.hasPower(power)) continue;
      const auto right = linalg::transposed(timesBasis(products(power, columns, false))),
                 below = known == 0 ? linalg::DenseMatrix(columns.columns(), 0)
                                    : timesBasis(products(power, columns, true));
      auto& matrix = projected_.*matrices[power];
      matrix = linalg::bordered(matrix, right, below.columnRange(0, known));
    }
  }

  /// Returns Yᵀ times the basis.
  linalg::DenseMatrix timesBasis(const linalg::Block& y) const {
    auto result = linalg::transposedProduct(comm(), y, start_);
    if (added_.columns() > 0) result.append(linalg::transposedProduct(comm(), y, added_));
    return result;
  }

  /// Returns this rank's rows of A X, or of Aᵀ X.
  linalg::Block products(int power, const linalg::DenseView& x, bool transposed) const {
    const OwnedVec argument = rightVector(pencil_.terms().front().matrix),
                   product = rightVector(pencil_.terms().front().matrix);
    linalg::Block values(x.rows());
    for (PetscInt j = 0; j < x.columns(); ++j) {
      std::ranges::copy(x.column(j), WriteArray(argument).begin());
      if (transposed)
        pencil_.applyTranspose(power, at_, argument, product);
      else
        pencil_.apply(power, at_, argument, product);
      const ReadArray entries(product);
      values.append(linalg::DenseView(entries.data(), entries.size(), 1));
    }
    return values;
  }

  /// Returns the null vectors in coordinates of the basis, [value]. The work is distributed
  /// over the ranks, and all ranks get the same results, so round-off cannot make them disagree.
  std::vector<std::vector<Complex>> nullVectors(const std::vector<Complex>& values,
                                                bool simple) const {
    std::vector<std::vector<Complex>> vectors(values.size(), std::vector<Complex>(size()));
    linalg::onOwners(comm(), values.size(), [&](std::size_t i) {
      auto [right, left] = linalg::nullVectors(projected_, values[i], simple);
      vectors[i] = std::move(side_ == pencil::Side::left ? left : right);
    });
    const int ranks = mpi::size(comm());
    for (std::size_t i = 0; i < values.size(); ++i)
      mpi::broadcastEntries<Complex>(comm(), vectors[i], i % ranks);
    return vectors;
  }

  const pencil::Pencil& pencil_;
  const sweep::Parameters at_;
  const pencil::Side side_;
  const std::array<double, 3> norms_;  // [power of s] 2-norms of the full matrices
  KSP solver_;
  Mat inner_;
  const linalg::DenseView start_;   // V
  linalg::Block added_;             // W
  linalg::DenseProblem projected_;  // [V W]ᵀ P [V W]
};

}  // namespace

linalg::ComplexVector expanded(const pencil::Pencil& pencil, const linalg::DenseView& columns,
                               const std::vector<Complex>& c) {
  return combination(pencil, {columns}, c);
}

std::vector<NullVector> leftVectors(const pencil::Pencil& pencil, const sweep::Parameters& at,
                                    const StartSpace& start, KSP solver,
                                    const std::vector<RightPair>& pairs, const Search& search) {
  if (pairs.empty()) return {};
  std::vector<Complex> values;
  linalg::Block parts(start.columns.rows());
  for (const auto& [s, vector] : pairs) {
    values.push_back(s);
    appendParts(*vector, 1, parts);
  }
  return NullIteration(pencil, at, start, solver, pencil::Side::left)
      .vectors(values, std::move(parts), search);
}

NullVector rightVector(const pencil::Pencil& pencil, const sweep::Parameters& at,
                       const StartSpace& start, KSP solver, Complex s, const Search& search) {
  NullIteration iteration(pencil, at, start, solver, pencil::Side::right);
  return std::move(iteration.vectors({s}, linalg::Block(start.columns.rows()), search).front());
}

}  // namespace squeal::sensitivity
