// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/linalg/rayleigh_ritz.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "algebra/linalg/complexdense.hpp"
#include "algebra/linalg/lu.hpp"

namespace squeal::linalg {
namespace {

using Entries = std::vector<Complex>;

/// Returns A x, or Aᵀ x if `transposed` is "T"; zero for an empty A.
Entries product(const char* transposed, const DenseMatrix& a, const Entries& x) {
  const std::size_t m = x.size();
  if (a.empty()) return Entries(m);
  const PetscBLASInt n = m, two = 2;
  const PetscScalar one = 1, zero = 0;
  Entries y(m);
  for (std::ptrdiff_t part : {0, 1})  // real and imaginary entries alternate
    BLASgemv_(transposed, &n, &n, &one, a.data(), &n,
              reinterpret_cast<const double*>(x.data()) + part, &two, &zero,
              reinterpret_cast<double*>(y.data()) + part, &two);
  return y;
}

Entries times(const DenseMatrix& a, const Entries& x) { return product("N", a, x); }
Entries timesTransposed(const DenseMatrix& a, const Entries& x) { return product("T", a, x); }

Complex dot(const Entries& x, const Entries& y) { return innerProduct(x, y); }

Entries combined(Complex a, const Entries& x, Complex b, const Entries& y) {
  Entries z(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) z[i] = a * x[i] + b * y[i];
  return z;
}

/// The LU factors of P(σ). Without damping, P(σ) is real for an imaginary σ; its factors are then
/// real too, at a quarter of the cost.
class Factors {
 public:
  Factors(const DenseProblem& problem, Complex shift) {
    const auto &mass = problem.mass, &damping = problem.damping, &stiffness = problem.stiffness;
    const PetscInt m = problem.order();
    const Complex square = shift * shift;
    if (damping.empty() && shift.real() == 0) {
      DenseMatrix sum = stiffness;
      addScaled(sum, square.real(), mass);
      real_.emplace(std::move(sum));
    } else {
      ComplexMatrix sum(m, m);
      for (PetscInt j = 0; j < m; ++j)
        for (PetscInt i = 0; i < m; ++i)
          sum(i, j) =
              square * mass(i, j) + (damping.empty() ? 0 : shift * damping(i, j)) + stiffness(i, j);
      complex_.emplace(std::move(sum));
    }
  }
  bool regular() const { return (real_ ? real_->pivotRatio() : complex_->pivotRatio()) > 0; }
  /// Returns P(σ)⁻¹ b, or P(σ)⁻ᴴ b if `adjoint`.
  Entries solve(Entries b, bool adjoint = false) const {
    if (!real_) {
      complex_->solve(std::span(b), adjoint);
      return b;
    }
    DenseMatrix parts(b.size(), 2);
    for (std::size_t i = 0; i < b.size(); ++i) parts(i, 0) = b[i].real(), parts(i, 1) = b[i].imag();
    real_->solve(parts, adjoint);
    for (std::size_t i = 0; i < b.size(); ++i) b[i] = {parts(i, 0), parts(i, 1)};
    return b;
  }

 private:
  std::optional<Lu<double>> real_;
  std::optional<Lu<Complex>> complex_;
};

/// A vector of the companion form
///   [0 I; −K −Z] z = s [I 0; 0 M] z.
/// A right vector is (x, s x), and a left vector is ((s M + Z)ᴴ y, y).
struct CompanionVector {
  Entries top, bottom;
};

CompanionVector combined(Complex a, const CompanionVector& x, Complex b, const CompanionVector& y) {
  return {combined(a, x.top, b, y.top), combined(a, x.bottom, b, y.bottom)};
}

/// Orthonormalises one or two columns. `weight` multiplies the bottom halves in the inner product,
/// which gives both halves the same weight.
void orthonormalise(std::vector<CompanionVector>& z, double weight) {
  const auto product = [&](const CompanionVector& x, const CompanionVector& y) {
    return dot(x.top, y.top) + weight * weight * dot(x.bottom, y.bottom);
  };
  for (std::size_t j = 0; j < z.size(); ++j) {
    for (int pass = 0; pass < 2 && j > 0; ++pass)
      z[j] = combined(1, z[j], -product(z[0], z[j]), z[0]);
    const double size = std::sqrt(product(z[j], z[j]).real());
    z[j] = combined(1 / size, z[j], 0, z[j]);
  }
}

class TwoSidedIteration {
 public:
  TwoSidedIteration(const DenseProblem& problem, const std::vector<DensePair>& start)
      : problem_(problem) {
    ensure(start.size() == 1 || start.size() == 2, "a cluster has one or two eigenvalues");
    for (auto [s, x, y] : start) {
      x.resize(problem.order());
      y.resize(problem.order());
      right_.push_back({x, combined(s, x, 0, x)});
      left_.push_back({combined(std::conj(s), timesTransposed(problem.mass, y), 1,
                                timesTransposed(problem.damping, y)),
                       y});
    }
  }

  /// Takes a step of two-sided inverse iteration,
  ///   Z ← (A − σB)⁻¹ B Z,   U ← (A − σB)⁻ᴴ Bᴴ U,
  /// and projects A − σB on U and Z.
  void step(const Factors& factors, Complex shift) {
    const double size = std::abs(shift);
    orthonormalise(right_, 1 / size);
    orthonormalise(left_, size);
    std::vector<CompanionVector> bz;  // the columns of B Z
    for (auto& z : right_) {
      bz.push_back({z.top, times(problem_.mass, z.bottom)});
      //   P(σ) x = −(M v' + (Z + σM) x'),   v = x' + σ x,   (x', v') the column before the step
      const Entries old = z.top;
      Entries rhs = combined(-1, bz.back().bottom, -shift, times(problem_.mass, old));
      rhs = combined(1, rhs, -1, times(problem_.damping, old));
      z.top = factors.solve(std::move(rhs));
      z.bottom = combined(1, old, shift, z.top);
    }
    for (auto& u : left_) {
      //   wᴴ (A − σB) = uᴴ B:   w2ᴴ P(σ) = −(u1ᴴ + σ u2ᴴ M),   w1ᴴ = u2ᴴ M + w2ᴴ (Z + σM)
      const Entries carried = timesTransposed(problem_.mass, u.bottom);
      u.bottom = factors.solve(combined(-1, u.top, -std::conj(shift), carried), true);
      u.top = combined(1, carried, std::conj(shift), timesTransposed(problem_.mass, u.bottom));
      u.top = combined(1, u.top, 1, timesTransposed(problem_.damping, u.bottom));
    }
    std::array<Complex, 4> gram{}, projected{};
    const std::size_t k = right_.size();
    for (std::size_t j = 0; j < k; ++j) {
      const Entries moved = times(problem_.mass, right_[j].bottom);
      for (std::size_t i = 0; i < k; ++i) {
        gram[2 * j + i] = dot(left_[i].top, right_[j].top) + dot(left_[i].bottom, moved);
        projected[2 * j + i] = dot(left_[i].top, bz[j].top) + dot(left_[i].bottom, bz[j].bottom);
      }
    }
    if (k == 1)
      gram[3] = 1;  // the second row and column of the unit matrix: an eigenvalue of its own
    gram_ = gram;
    const Complex det = gram[0] * gram[3] - gram[1] * gram[2];
    small_ = {(gram[3] * projected[0] - gram[2] * projected[1]) / det,
              (gram[0] * projected[1] - gram[1] * projected[0]) / det,
              (gram[3] * projected[2] - gram[2] * projected[3]) / det,
              (gram[0] * projected[3] - gram[1] * projected[2]) / det};
  }

  Complex mean() const { return right_.size() == 1 ? small_[0] : 0.5 * (small_[0] + small_[3]); }
  /// Returns ((s1 − s2)/2)², or zero for one eigenvalue.
  Complex square() const {
    return right_.size() == 1
               ? Complex(0)
               : 0.25 * (small_[0] - small_[3]) * (small_[0] - small_[3]) + small_[1] * small_[2];
  }
  /// Returns the size of the numbers that cancel in square().
  double entries() const {
    return std::abs(small_[0] - small_[3]) + std::abs(small_[1]) + std::abs(small_[2]);
  }

  std::vector<DensePair> pairs(Complex shift) const {
    if (right_.size() == 1) return {pair(shift + small_[0], right_[0], left_[0])};
    std::vector<DensePair> result;
    const Complex root = std::sqrt(square());
    for (const Complex value : {mean() + root, mean() - root}) {
      const auto& [s11, s21, s12, s22] = small_;
      const bool first = std::abs(value - s11) > std::abs(value - s22);
      const Complex a = first ? s12 : value - s22,
                    b = first ? value - s11 : s21;  // right vector of the 2×2 matrix
      const Complex c = first ? s21 : value - s22, d = first ? value - s11 : s12;  // left, as a row
      // The row times the inverse of the Gram matrix gives the coefficients of Uᴴ.
      const Complex e = c * gram_[3] - d * gram_[1], g = d * gram_[0] - c * gram_[2];
      const bool still = a == 0.0 && b == 0.0;  // a multiple of the unit matrix: any vector
      result.push_back(pair(
          shift + value, still ? right_[result.size()] : combined(a, right_[0], b, right_[1]),
          still ? left_[result.size()] : combined(std::conj(e), left_[0], std::conj(g), left_[1])));
    }
    return result;
  }

 private:
  static DensePair pair(Complex s, const CompanionVector& right, const CompanionVector& left) {
    DensePair result{s, right.top, left.bottom};
    for (auto* vector : {&result.q, &result.left}) {
      const double size = std::sqrt(dot(*vector, *vector).real());
      for (auto& entry : *vector) entry /= size;
    }
    return result;
  }

  const DenseProblem& problem_;
  std::vector<CompanionVector> right_, left_;
  std::array<Complex, 4> gram_{}, small_{};  // column-major
};

}  // namespace

Cluster clusterNear(const DenseProblem& problem, const std::vector<DensePair>& start, Complex guess,
                    double isolation) {
  // The shift stays away from the mean by a fraction of the distance to the next eigenvalue: with a
  // shift at the mean, the two vectors would become parallel.
  constexpr double aside = 0.05, rounding = 4e-15;
  constexpr int factorisations = 3, solves = 25;
  TwoSidedIteration iteration(problem, start);
  Cluster cluster;
  cluster.mean = guess;
  Complex square = 0;
  for (int attempt = 0; attempt < factorisations && !cluster.converged; ++attempt) {
    Complex shift = cluster.mean + aside * isolation;
    // Without damping, neutral eigenvalues and split pairs have means on the imaginary axis, within
    // round-off.
    if (problem.damping.empty() && std::abs(cluster.mean.real()) < 1e-6 * std::abs(cluster.mean))
      shift = Complex(0, cluster.mean.imag() + aside * isolation);
    const Factors factors(problem, shift);
    if (!factors.regular()) return cluster;
    double before = INFINITY;
    for (int k = 0; k < solves; ++k) {
      iteration.step(factors, shift);
      const Complex mean = shift + iteration.mean();
      const double inMean = std::abs(mean - cluster.mean) / std::abs(mean),
                   inSquare = start.size() == 1
                                  ? 0
                                  : std::abs(iteration.square() - square) /
                                        (std::abs(mean) *
                                         std::max(iteration.entries(), 1e-10 * std::abs(mean)));
      // std::max would drop a NaN that is its second argument.
      const double change = std::isnan(inSquare) ? inSquare : std::max(inMean, inSquare);
      cluster.mean = mean;
      square = iteration.square();
      // For ill-conditioned eigenvalues, round-off ends the convergence above the bound.
      cluster.converged = k > 0 && (change < rounding || (change < 1e-10 && change > 0.3 * before));
      if (cluster.converged || !std::isfinite(change) || (k > 4 && change > 0.5 * before)) break;
      before = change;
    }
    cluster.pairs = iteration.pairs(shift);
  }
  return cluster;
}

Spectrum::Spectrum(const DenseProblem& problem, std::vector<DensePair> pairs)
    : pairs_(std::move(pairs)), linear_(problem.damping.empty()) {
  const ComplexMatrix mass = transposedTimesLeft(problem.mass, pairs_),
                      damping = transposedTimesLeft(problem.damping, pairs_);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const auto column = mass.column(i);
    Entries row(column.begin(), column.end());
    if (!linear_) {
      const auto z = damping.column(i);
      const Entries lifted = combined(std::conj(pairs_[i].s), row, 1, Entries(z.begin(), z.end()));
      row.insert(row.end(), lifted.begin(), lifted.end());
    }
    rows_.push_back(std::move(row));
    own_.push_back(product(i, pairs_[i]));
  }
}

/// Returns the biorthogonal product [M.42] of left vector i and the right vector of `pair`,
///   yᴴ ((s_i + s) M + Z) x,   or in a problem in s²   yᴴ M x.
Complex Spectrum::product(std::size_t i, const DensePair& pair) const {
  const std::span<const Complex> row = rows_[i];
  const std::size_t half = linear_ ? row.size() : row.size() / 2,
                    m = std::min(pair.q.size(), half);  // the basis may have grown in between
  const Complex mass = innerProduct(row.first(m), pair.q);
  return linear_ ? mass : pair.s * mass + innerProduct(row.subspan(half, m), pair.q);
}

Complex Spectrum::overlap(std::size_t i, const Spectrum& other, std::size_t j) const {
  return product(i, other.pairs_[j]) * other.product(j, pairs_[i]) / (own_[i] * other.own_[j]);
}

/// Returns product(i, pair) for all pairs i of this problem and all of these pairs.
ComplexMatrix Spectrum::products(const std::vector<DensePair>& pairs) const {
  if (pairs_.empty() || pairs.empty()) return ComplexMatrix(pairs_.size(), pairs.size());
  const std::size_t parts = linear_ ? 1 : 2, half = rows_[0].size() / parts,
                    m = std::min(pairs[0].q.size(), half);
  ComplexMatrix vectors(m);
  for (const auto& pair : pairs) vectors.append(std::span(pair.q).first(m));
  const auto times = [&](std::size_t begin) {
    ComplexMatrix rows(m);
    for (const auto& row : rows_) rows.append(std::span(row).subspan(begin, m));
    return adjointProduct(rows, vectors);
  };
  ComplexMatrix result = times(0);
  if (linear_) return result;
  const ComplexMatrix rest = times(half);
  for (std::size_t j = 0; j < pairs.size(); ++j)
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      result(i, j) = pairs[j].s * result(i, j) + rest(i, j);
  return result;
}

ComplexMatrix Spectrum::overlaps(const Spectrum& other) const {
  ComplexMatrix result = products(other.pairs_);
  const ComplexMatrix back = other.products(pairs_);
  for (std::size_t j = 0; j < other.own_.size(); ++j)
    for (std::size_t i = 0; i < own_.size(); ++i)
      result(i, j) *= back(j, i) / (own_[i] * other.own_[j]);
  return result;
}

}  // namespace squeal::linalg
