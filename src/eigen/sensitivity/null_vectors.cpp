// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sensitivity/null_vectors.hpp"

#include <array>
#include <cmath>
#include <numeric>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/columns.hpp"
#include "algebra/linalg/null_vectors.hpp"
#include "algebra/linalg/spread.hpp"
#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::sensitivity {
namespace {

constexpr int mostRounds = 20;

/// The vectors of one side.
class NullIteration {
 public:
  NullIteration(const pencil::Pencil& pencil, const sweep::Parameters& at, const StartSpace& start,
                KSP solver, pencil::Side side)
      : pencil_(pencil),
        at_(at),
        side_(side),
        norms_{pencil.norm(0, at), pencil.norm(1, at), pencil.norm(2, at)},
        solver_(solver),
        projected_(start.projected),
        known_(start.projected.order()) {
    check(BVGetSizes(start.columns, nullptr, nullptr, &size_));
    check(BVDuplicateResize(start.columns, size_, basis_.out()));
    check(BVCopy(start.columns, basis_));
    check(BVSetMatrix(basis_, start.inner, PETSC_FALSE));
  }

  /// Returns the vectors of these eigenvalues; the search also starts from `more`.
  std::vector<NullVector> vectors(const std::vector<Complex>& s, const std::vector<Vec>& more,
                                  const Search& search) {
    add(more);
    std::vector<NullVector> found(s.size());
    std::vector<std::size_t> open(s.size());
    std::iota(open.begin(), open.end(), 0);
    for (int round = 0;; ++round) {
      std::vector<Complex> values;
      for (std::size_t i : open) values.push_back(s[i]);
      const auto coordinates = nullVectors(values, search.simple);
      std::vector<std::size_t> bad;
      std::vector<linalg::ComplexVector> residuals;
      for (std::size_t k = 0; k < open.size(); ++k) {
        auto& [vector, backwardError] = found[open[k]];
        vector = expanded(basis_, coordinates[k]);
        linalg::ComplexVector residual = pencil::residual(pencil_, at_, values[k], vector, side_);
        const double size = length(residual);
        backwardError = size > 0 ? size / (scale(values[k]) * length(vector)) : 0;
        if (backwardError > search.accuracy)
          bad.push_back(open[k]), residuals.push_back(std::move(residual));
      }
      if (bad.empty() || round == mostRounds) return found;
      const auto solved = corrections(residuals);
      if (!add({solved.begin(), solved.end()})) return found;
      open = std::move(bad);
    }
  }

 private:
  double scale(Complex s) const {
    const double size = std::abs(s);
    return norms_[0] + size * norms_[1] + size * size * norms_[2];
  }

  /// Returns K0⁻¹ times the real and the imaginary parts of the residuals, which are first scaled
  /// to the 2-norm 1.
  std::vector<OwnedVec> corrections(const std::vector<linalg::ComplexVector>& residuals) {
    const PetscInt count = 2 * residuals.size();
    PetscInt local = 0, global = 0;
    check(VecGetLocalSize(residuals[0].real, &local));
    check(VecGetSize(residuals[0].real, &global));
    OwnedMat rhs, solution;
    check(MatCreateDense(pencil_.comm(), local, PETSC_DECIDE, global, count, nullptr, rhs.out()));
    check(MatCreateDense(pencil_.comm(), local, PETSC_DECIDE, global, count, nullptr,
                         solution.out()));
    for (PetscInt j = 0; j < count; ++j) {
      const auto& residual = residuals[j / 2];
      Vec column = nullptr;
      check(MatDenseGetColumnVecWrite(rhs, j, &column));
      check(VecCopy(j % 2 == 0 ? residual.real : residual.imaginary, column));
      check(VecScale(column, 1 / length(residual)));
      check(MatDenseRestoreColumnVecWrite(rhs, j, &column));
    }
    check(KSPMatSolve(solver_, rhs, solution));
    std::vector<OwnedVec> parts;
    for (PetscInt j = 0; j < count; ++j) {
      Vec column = nullptr;
      OwnedVec part;
      check(VecDuplicate(residuals[0].real, part.out()));
      check(MatDenseGetColumnVecRead(solution, j, &column));
      check(VecCopy(column, part));
      check(MatDenseRestoreColumnVecRead(solution, j, &column));
      parts.push_back(std::move(part));
    }
    return parts;
  }

  /// Adds vectors to the basis, except those that depend on it, and projects the pencil on the new
  /// columns. Returns true if the basis has grown.
  bool add(const std::vector<Vec>& vectors) {
    constexpr double dependent = 1e-6;
    const PetscInt before = size_;
    check(BVResize(basis_, size_ + std::ssize(vectors), PETSC_TRUE));
    for (Vec vector : vectors) {
      PetscReal length = 0, rest = 0;
      PetscBool lost = PETSC_FALSE;
      check(BVInsertVec(basis_, size_, vector));
      check(BVNormColumn(basis_, size_, NORM_2, &length));
      check(BVSetActiveColumns(basis_, 0, size_ + 1));
      if (length > 0) check(BVOrthonormalizeColumn(basis_, size_, PETSC_FALSE, &rest, &lost));
      if (!lost && rest > dependent * length) ++size_;
    }
    check(BVResize(basis_, size_, PETSC_TRUE));
    check(BVSetActiveColumns(basis_, 0, size_));
    extend();
    return size_ > before;
  }

  /// Extends Vᵀ A V of each power of s by the new columns of V.
  void extend() {
    const PetscInt old = known_, added = size_ - old;
    if (added == 0) return;
    constexpr std::array matrices{&linalg::DenseProblem::stiffness, &linalg::DenseProblem::damping,
                                  &linalg::DenseProblem::mass};  // [power of s]
    const linalg::ReadColumns all(basis_);
    for (int power = 0; power <= 2; ++power) {
      if (!pencil_.hasPower(power)) continue;
      const linalg::DenseView v = all.view();
      const auto right =
                     linalg::transposedProduct(pencil_.comm(), v, productsWithV(power, old, false)),
                 below = linalg::transposedProduct(pencil_.comm(), productsWithV(power, old, true),
                                                   v.columnRange(0, old));
      auto& matrix = projected_.*matrices[power];
      matrix = linalg::bordered(matrix, right, below);
    }
    known_ = size_;
  }

  /// Returns this rank's rows of A V, or of Aᵀ V, for the columns of V from `first` on.
  linalg::Block productsWithV(int power, PetscInt first, bool transposed) const {
    linalg::Block values;
    for (PetscInt j = first; j < size_; ++j) {
      Vec column = nullptr;
      OwnedVec product;
      check(BVGetColumn(basis_, j, &column));
      check(VecDuplicate(column, product.out()));
      if (transposed)
        pencil_.applyTranspose(power, at_, column, product);
      else
        pencil_.apply(power, at_, column, product);
      check(BVRestoreColumn(basis_, j, &column));
      const ReadArray entries(product);
      values.append(linalg::DenseView(entries.data(), entries.size(), 1));
    }
    return values;
  }

  /// Returns the null vectors in coordinates of the basis, [value]. The work is distributed
  /// over the ranks, and all ranks get the same results, so round-off cannot make them disagree.
  std::vector<std::vector<Complex>> nullVectors(const std::vector<Complex>& values,
                                                bool simple) const {
    std::vector<std::vector<Complex>> vectors(values.size(), std::vector<Complex>(size_));
    linalg::onOwners(pencil_.comm(), values.size(), [&](std::size_t i) {
      auto [right, left] = linalg::nullVectors(projected_, values[i], simple);
      vectors[i] = std::move(side_ == pencil::Side::left ? left : right);
    });
    const int ranks = mpi::size(pencil_.comm());
    for (std::size_t i = 0; i < values.size(); ++i)
      mpi::broadcastEntries<Complex>(pencil_.comm(), vectors[i], i % ranks);
    return vectors;
  }

  const pencil::Pencil& pencil_;
  const sweep::Parameters at_;
  const pencil::Side side_;
  const std::array<double, 3> norms_;  // [power of s] 2-norms of the full matrices
  KSP solver_;
  OwnedBV basis_;
  PetscInt size_ = 0;
  linalg::DenseProblem projected_;  // Vᵀ P V
  PetscInt known_ = 0;              // columns of V that it covers
};

}  // namespace

linalg::ComplexVector expanded(BV columns, const std::vector<Complex>& c) {
  OwnedVec like;
  Vec first = nullptr;
  check(BVGetColumn(columns, 0, &first));
  check(VecDuplicate(first, like.out()));
  check(BVRestoreColumn(columns, 0, &first));
  linalg::ComplexVector y = linalg::ComplexVector::like(like);
  std::vector<double> real, imaginary;
  for (const auto& entry : c) real.push_back(entry.real()), imaginary.push_back(entry.imag());
  check(BVMultVec(columns, 1, 0, y.real, real.data()));
  check(BVMultVec(columns, 1, 0, y.imaginary, imaginary.data()));
  const double size = length(y);
  check(VecScale(y.real, 1 / size));
  check(VecScale(y.imaginary, 1 / size));
  return y;
}

std::vector<NullVector> leftVectors(const pencil::Pencil& pencil, const sweep::Parameters& at,
                                    const StartSpace& start, KSP solver,
                                    const std::vector<RightPair>& pairs, const Search& search) {
  if (pairs.empty()) return {};
  std::vector<Complex> values;
  std::vector<Vec> parts;
  for (const auto& [s, vector] : pairs) {
    values.push_back(s);
    parts.insert(parts.end(), {vector->real.get(), vector->imaginary.get()});
  }
  return NullIteration(pencil, at, start, solver, pencil::Side::left)
      .vectors(values, parts, search);
}

NullVector rightVector(const pencil::Pencil& pencil, const sweep::Parameters& at,
                       const StartSpace& start, KSP solver, Complex s, const Search& search) {
  NullIteration iteration(pencil, at, start, solver, pencil::Side::right);
  return std::move(iteration.vectors({s}, {}, search).front());
}

}  // namespace squeal::sensitivity
