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
#include "algebra/linalg/symmetric.hpp"
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
    for (int power = 0; power <= 2; ++power)
      if (pencil.hasPower(power)) powers_.push_back(power);
    if (projected_.order() > 0) return;
    for (const int power : powers_)
      projected_.*matrices[power] =
          linalg::transposedProduct(comm(), start_, products(power, start_, false));
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
        auto& [vector, backwardError, rounds] = found[open[k]];
        vector = combination(pencil_, {start_, added_}, coordinates[k]);
        const auto residual = pencil::residual(pencil_, at_, values[k], vector, side_);
        const double size = length(residual);
        backwardError = size == 0 ? 0 : size / (scale(values[k]) * length(vector));
        rounds = round;
        const double before = std::exchange(previous[open[k]], backwardError);
        const bool stalls = backwardError <= settled && backwardError > before / 2;
        if (backwardError <= search.accuracy || stalls || !std::isfinite(backwardError)) continue;
        bad.push_back(open[k]);
        appendParts(residual, size, residuals);
      }
      if (bad.empty() || round == mostRounds) return found;
      if (!add(linalg::solved(solver_, residuals))) return found;
      open = std::move(bad);
    }
  }

 private:
  static constexpr std::array matrices{&linalg::DenseProblem::stiffness,
                                       &linalg::DenseProblem::damping,
                                       &linalg::DenseProblem::mass};  // [power of s]
  MPI_Comm comm() const { return pencil_.comm(); }
  PetscInt size() const { return start_.columns() + added_.columns(); }

  double scale(Complex s) const {
    const double size = std::abs(s);
    return norms_[0] + size * norms_[1] + size * size * norms_[2];
  }

  /// Adds vectors to the basis, except those that depend on it. Returns true if the basis has
  /// grown.
  bool add(linalg::Block x) {
    constexpr double dependent = 1e-6;  // of the length of a vector
    constexpr int mostPasses = 6;
    if (x.columns() == 0) return false;
    auto products = timesInner(x);
    auto directions = linalg::transposedProduct(comm(), x, products);
    for (PetscInt j = 0; j < x.columns(); ++j)
      if (const double square = directions(j, j); square > 0)
        for (auto* block : {&x, &products})
          for (double& entry : block->column(j)) entry /= std::sqrt(square);
    // V is orthonormal only within about a thousandth, so a pass leaves as much of the part along
    // V. The passes end when they remove less than counts among nearly parallel vectors.
    constexpr double negligible = 1e-10;  // square of a length
    double removed = INFINITY;
    for (int pass = 0; pass < mostPasses && removed > negligible; ++pass) {
      const auto ofStart = linalg::transposedProduct(comm(), start_, products),
                 ofAdded = linalg::transposedProduct(comm(), added_, products);
      linalg::multiplyAdd(start_, ofStart, x, -1);
      linalg::multiplyAdd(added_, ofAdded, x, -1);
      products = timesInner(x);
      removed = 0;
      for (PetscInt j = 0; j < x.columns(); ++j)
        removed = std::max(removed, linalg::squaredLength(ofStart.column(j)) +
                                        linalg::squaredLength(ofAdded.column(j)));
    }
    directions = linalg::transposedProduct(comm(), x, products);
    const auto squares = linalg::symmetricEigen(directions);  // ascending
    PetscInt first = 0;
    while (first < x.columns() && !(squares[first] > dependent * dependent)) ++first;
    if (first == x.columns()) return false;
    for (PetscInt j = first; j < x.columns(); ++j)
      for (double& entry : directions.column(j)) entry /= std::sqrt(squares[j]);
    const auto news = linalg::product(x, directions.columnRange(first, x.columns()));
    border(news);
    return true;
  }

  linalg::Block timesInner(const linalg::Block& x) const {
    linalg::Block products(x.rows());
    linalg::appendProduct(inner_, x, products);
    return products;
  }

  /// Adds columns to W, and to the projected pencil. V is read only once for all products.
  void border(const linalg::Block& columns) {
    const PetscInt known = size(), count = columns.columns();
    added_.append(columns);
    linalg::Block all(columns.rows());
    for (const bool transposed : {false, true})
      for (const int power : powers_) all.append(products(power, columns, transposed));
    auto rows = linalg::transposedProduct(comm(), all, start_);
    rows.append(linalg::transposedProduct(comm(), all, added_));
    const auto part = [&](std::size_t i) {
      return linalg::rowRange(rows, i * count, (i + 1) * count);
    };
    for (std::size_t i = 0; i < powers_.size(); ++i) {
      auto& matrix = projected_.*matrices[powers_[i]];
      matrix = linalg::bordered(matrix, linalg::transposed(part(i)),
                                part(powers_.size() + i).columnRange(0, known));
    }
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
  std::vector<int> powers_;         // of s, with terms
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
