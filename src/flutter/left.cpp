#include "flutter/left.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <array>
#include <cmath>
#include <numeric>

#include "flutter/images.hpp"
#include "petsc/columns.hpp"

namespace squeal::flutter {
namespace {

using Complex = std::complex<double>;

constexpr double wanted = 1e-10;
constexpr int mostRounds = 20;

/// H = Σ s^p H_p as the real matrix [Re −Im; Im Re], so that real LAPACK solves with it, transposed for Hᴴ.
class Factorised {
 public:
  Factorised(const std::array<DenseMatrix, 3>& h, std::size_t m, Complex s) : m_(m), a_(4 * m * m, 0.0), pivots_(2 * m) {
    for (std::size_t p = 0; p < 3; ++p) {
      const Complex c = std::pow(s, static_cast<int>(p));
      for (std::size_t k = 0; k < h[p].size(); ++k) {
        const std::size_t i = k % m, j = k / m;
        at(i, j) += c.real() * h[p][k], at(m + i, m + j) += c.real() * h[p][k];
        at(m + i, j) += c.imag() * h[p][k], at(i, m + j) -= c.imag() * h[p][k];
      }
    }
    PetscBLASInt n = static_cast<PetscBLASInt>(2 * m), info = 0;
    LAPACKgetrf_(&n, &n, a_.data(), &n, pivots_.data(), &info);
    // s may be an eigenvalue to the last digit: a pivot of zero takes the size of rounding.
    double largest = 0;
    for (std::size_t i = 0; i < 2 * m; ++i) largest = std::max(largest, std::abs(at(i, i)));
    for (std::size_t i = 0; i < 2 * m; ++i)
      if (at(i, i) == 0) at(i, i) = 1e-16 * largest;
  }
  /// x ← H⁻¹ x, or H⁻ᴴ x, of length one; x holds real parts, then imaginary ones.
  void solve(bool adjoint, std::vector<double>& x) const {
    PetscBLASInt n = static_cast<PetscBLASInt>(2 * m_), one = 1, info = 0;
    LAPACKgetrs_(adjoint ? "T" : "N", &n, &one, const_cast<double*>(a_.data()), &n, const_cast<PetscBLASInt*>(pivots_.data()),
                 x.data(), &n, &info);
    double sum = 0;
    for (double entry : x) sum += entry * entry;
    for (double& entry : x) entry /= std::sqrt(sum);
  }

 private:
  double& at(std::size_t i, std::size_t j) { return a_[j * 2 * m_ + i]; }
  std::size_t m_;
  std::vector<double> a_;
  std::vector<PetscBLASInt> pivots_;
};

/// cᴴ A q of vectors that hold real parts, then imaginary ones.
Complex form(const std::vector<double>& c, const DenseMatrix& a, const std::vector<double>& q) {
  const std::size_t m = q.size() / 2;
  Complex sum = 0;
  if (!a.empty())
    for (std::size_t j = 0; j < m; ++j) {
      Complex column = 0;
      for (std::size_t i = 0; i < m; ++i) column += Complex(c[i], -c[m + i]) * a[j * m + i];
      sum += column * Complex(q[j], q[m + j]);
    }
  return sum;
}

/// c with cᴴ H(s) = 0 by inverse iteration. s is known to some digits; where the space knows it better, the two-sided Rayleigh
/// quotient δs = −cᴴ H q / cᴴ H′ q takes its own error out.
std::vector<double> nullVector(const std::array<DenseMatrix, 3>& h, std::size_t m, Complex s) {
  std::vector<double> c(2 * m);
  for (std::size_t i = 0; i < 2 * m; ++i) c[i] = std::sin(12.9898 * static_cast<double>(i + 1));
  for (int step = 0; step < 3; ++step) {
    const Factorised factorised(h, m, s);
    auto q = c;
    for (int cycle = 0; cycle < 2; ++cycle) {
      factorised.solve(false, q);
      c = q;
      factorised.solve(true, c);
      if (cycle == 0) q = c;
    }
    const Complex value = form(c, h[0], q) + s * form(c, h[1], q) + s * s * form(c, h[2], q),
                  slope = form(c, h[1], q) + 2.0 * s * form(c, h[2], q), change = -value / slope;
    if (!(std::abs(change) > 1e-14 * std::abs(s) && std::abs(change) < 1e-6 * std::abs(s))) break;
    s += change;
  }
  return c;
}

class Search {
 public:
  Search(const Pencil& pencil, const Parameters& at, const StartSpace& start, KSP solver)
      : pencil_(pencil),
        at_(at),
        norms_{pencil.norm(0, at), pencil.norm(1, at), pencil.norm(2, at)},
        solver_(solver),
        projected_{start.projected.stiffness, start.projected.damping, start.projected.mass},
        known_(start.projected.m) {
    check(BVGetSizes(start.columns, nullptr, nullptr, &size_));
    check(BVDuplicateResize(start.columns, size_, basis_.out()));
    check(BVCopy(start.columns, basis_));
    check(BVSetMatrix(basis_, start.inner, PETSC_FALSE));
  }

  std::vector<LeftVector> vectors(const std::vector<RightPair>& pairs) {
    add(partsOf(pairs));
    std::vector<LeftVector> found(pairs.size());
    std::vector<std::size_t> open(pairs.size());
    std::iota(open.begin(), open.end(), 0);
    for (int round = 0;; ++round) {
      std::vector<Complex> values;
      for (std::size_t i : open) values.push_back(pairs[i].s);
      const auto coordinates = nullVectors(values);
      std::vector<std::size_t> bad;
      std::vector<ComplexVector> residuals;
      for (std::size_t k = 0; k < open.size(); ++k) {
        auto& left = found[open[k]];
        left.y = expand(coordinates[k]);
        ComplexVector residual = flutter::residual(pencil_, at_, values[k], left.y, Side::left);
        left.backwardError = length(residual) / (scale(values[k]) * length(left.y));
        if (left.backwardError > wanted) bad.push_back(open[k]), residuals.push_back(std::move(residual));
      }
      if (bad.empty() || round == mostRounds) return found;
      const auto solved = corrections(residuals);
      if (!add({solved.begin(), solved.end()})) return found;
      open = std::move(bad);
    }
  }

 private:
  static std::vector<Vec> partsOf(const std::vector<RightPair>& pairs) {
    std::vector<Vec> parts;
    for (const auto& pair : pairs) parts.insert(parts.end(), {pair.vector->real.get(), pair.vector->imaginary.get()});
    return parts;
  }

  double scale(Complex s) const {
    const double size = std::abs(s);
    return norms_[0] + size * norms_[1] + size * size * norms_[2];
  }

  /// K0⁻¹ of the real and imaginary parts, scaled to one.
  std::vector<OwnedVec> corrections(const std::vector<ComplexVector>& residuals) {
    const auto count = static_cast<PetscInt>(2 * residuals.size());
    PetscInt local = 0, global = 0;
    check(VecGetLocalSize(residuals[0].real, &local));
    check(VecGetSize(residuals[0].real, &global));
    OwnedMat rhs, solution;
    check(MatCreateDense(pencil_.comm(), local, PETSC_DECIDE, global, count, nullptr, rhs.out()));
    check(MatCreateDense(pencil_.comm(), local, PETSC_DECIDE, global, count, nullptr, solution.out()));
    for (PetscInt j = 0; j < count; ++j) {
      const auto& residual = residuals[static_cast<std::size_t>(j / 2)];
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

  /// True if the basis has grown; projects what is new.
  bool add(const std::vector<Vec>& vectors) {
    constexpr double dependent = 1e-6;
    const PetscInt before = size_;
    check(BVResize(basis_, size_ + static_cast<PetscInt>(vectors.size()), PETSC_TRUE));
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

  /// Vᵀ A V of each power, with the columns that V has gained.
  void extend() {
    const PetscInt old = known_, added = size_ - old;
    if (added == 0) return;
    const ReadColumns all(basis_);
    const auto size = static_cast<std::size_t>(size_), o = static_cast<std::size_t>(old);
    for (int power = 0; power <= 2; ++power) {
      if (!pencil_.hasPower(power)) continue;
      const auto image = images(power, old, false), adjoint = images(power, old, true);
      const auto right = transposedProduct(pencil_.comm(), all.values(), all.rows(), size_, image.data(), added),
                 below = transposedProduct(pencil_.comm(), adjoint.data(), all.rows(), added, all.values(), old);
      auto& matrix = projected_[static_cast<std::size_t>(power)];
      DenseMatrix grown(size * size);
      for (std::size_t j = 0; j < size; ++j)
        for (std::size_t i = 0; i < size; ++i)
          grown[j * size + i] = j >= o ? right[(j - o) * size + i] : i >= o ? below[j * (size - o) + i - o] : matrix[j * o + i];
      matrix = std::move(grown);
    }
    known_ = size_;
  }

  /// Local rows of A V or Aᵀ V for the columns of V from `first` on.
  DenseMatrix images(int power, PetscInt first, bool transposed) const {
    DenseMatrix values;
    for (PetscInt j = first; j < size_; ++j) {
      Vec column = nullptr;
      OwnedVec image;
      check(BVGetColumn(basis_, j, &column));
      check(VecDuplicate(column, image.out()));
      if (transposed)
        pencil_.applyTranspose(power, at_, column, image);
      else
        pencil_.apply(power, at_, column, image);
      check(BVRestoreColumn(basis_, j, &column));
      PetscInt rows = 0;
      const PetscScalar* entries = nullptr;
      check(VecGetLocalSize(image, &rows));
      check(VecGetArrayRead(image, &entries));
      values.insert(values.end(), entries, entries + rows);
      check(VecRestoreArrayRead(image, &entries));
    }
    return values;
  }

  /// Left null vectors in the basis, spread over the ranks; the same on all, so that rounding cannot make them disagree.
  std::vector<std::vector<double>> nullVectors(const std::vector<Complex>& values) const {
    const auto m = static_cast<std::size_t>(size_);
    int rank = 0, ranks = 1;
    check(MPI_Comm_rank(pencil_.comm(), &rank));
    check(MPI_Comm_size(pencil_.comm(), &ranks));
    std::vector<std::vector<double>> vectors(values.size(), std::vector<double>(2 * m));
    for (std::size_t i = static_cast<std::size_t>(rank); i < values.size(); i += static_cast<std::size_t>(ranks))
      vectors[i] = nullVector(projected_, m, values[i]);
    for (std::size_t i = 0; i < values.size(); ++i)
      check(MPI_Bcast(vectors[i].data(), static_cast<int>(2 * m), MPI_DOUBLE, static_cast<int>(i) % ranks, pencil_.comm()));
    return vectors;
  }

  /// V c, of length one.
  ComplexVector expand(const std::vector<double>& c) const {
    ComplexVector y;
    check(MatCreateVecs(pencil_.terms().at(0).matrix, y.real.out(), y.imaginary.out()));
    const auto columns = static_cast<std::size_t>(size_);
    check(BVMultVec(basis_, 1, 0, y.real, const_cast<double*>(c.data())));
    check(BVMultVec(basis_, 1, 0, y.imaginary, const_cast<double*>(c.data() + columns)));
    const double size = length(y);
    check(VecScale(y.real, 1 / size));
    check(VecScale(y.imaginary, 1 / size));
    return y;
  }

  const Pencil& pencil_;
  const Parameters at_;
  const std::array<double, 3> norms_;  // [power of s] of the full matrices
  KSP solver_;
  OwnedBV basis_;
  PetscInt size_ = 0;
  std::array<DenseMatrix, 3> projected_;  // [power of s] Vᵀ A V
  PetscInt known_ = 0;                    // columns of V in it
};

}  // namespace

std::vector<LeftVector> leftVectors(const Pencil& pencil, const Parameters& at, const StartSpace& start, KSP solver,
                                    const std::vector<RightPair>& pairs) {
  if (pairs.empty()) return {};
  return Search(pencil, at, start, solver).vectors(pairs);
}

}  // namespace squeal::flutter
