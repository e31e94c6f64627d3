// SPDX-License-Identifier: BSD-2-Clause
/// A direct solver solves a block of right-hand sides many times faster than the same number of
/// single ones, because it reads the factor from memory once per block. SLEPc's Krylov-Schur solves
/// one right-hand side at a time.
#include "eigen/modes/rational_lanczos.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/columns.hpp"
#include "algebra/linalg/qr.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/petsc/log_events.hpp"
#include "base/petsc/object.hpp"
#include "base/system/mpi.hpp"

namespace squeal::modes {

using linalg::DenseMatrix;
using linalg::DenseView;

RationalLanczos::RationalLanczos(Mat m, BV basis, PetscInt blockSize)
    : m_(m), basis_(basis), comm_(commOf(m)), width_(blockSize) {
  check(BVGetSizes(basis, &rows_, &unknowns_, &limit_));
  w_ = mw_ = linalg::Block(rows_, width_);
  a_ = b_ = DenseMatrix(limit_, limit_);
  check(BVGetArray(basis_, &columns_));
  // Each rank draws its own part. The seed is fixed, so a run is reproducible.
  random_.seed(mpi::rank(comm_) + 1);
}

DenseView RationalLanczos::columnRange(PetscInt first, PetscInt last) const {
  return DenseView(columns_, rows_, size_).columnRange(first, last);
}

void RationalLanczos::start(const Pole& pole) {
  for (double& entry : w_.entries()) entry = uniform_(random_);
  massTimesW();
  solve(pole);
  orthogonalise(false);
  orthonormalise(0);
  append();
}

void RationalLanczos::expand(const Pole& pole) {
  const PetscInt k = size_, known = k - width_;
  if (pole.distance != distance_) sinceChange_ = 0;
  distance_ = pole.distance;
  if (!massIsOfLast_) {
    std::ranges::copy(columnRange(known, k).entries(), w_.data());
    massTimesW();
  }
  massOfLast_[0] = std::move(massOfLast_[1]);
  massOfLast_[1] = mw_;
  solve(pole);
  // In exact arithmetic, W has components only along the last two blocks, except in the first two
  // steps with a pole.
  const DenseMatrix h = orthogonalise(sinceChange_ >= 2);
  ++sinceChange_;
  double size = 0;  // of W before orthogonalisation against V, squared
  for (PetscInt j = 0; j < width_; ++j) size = std::max(size, linalg::squaredLength(h.column(j)));
  orthonormalise(size);
  append();
  for (PetscInt j = 0; j < width_; ++j) {
    const auto a = a_.column(known + j), b = b_.column(known + j);
    std::ranges::copy(h.column(j), b.begin());
    std::ranges::copy(r_.column(j), b.begin() + k);
    for (PetscInt i = 0; i < size_; ++i) a[i] = pole.distance * b[i];
    a[known + j] += 1;
    foreign_.push_back(pole.distance != 0);
    const double length = std::sqrt(linalg::squaredLength(a));
    for (PetscInt i = 0; i < size_; ++i) a[i] /= length, b[i] /= length;
  }
}

RitzPairs RationalLanczos::ritz() const {
  const PetscInt k = size_, known = k - width_;
  //   A = Q [R; 0],   QᵀB R⁻¹ = [T; C],   T = Tᵀ:  S V Q₁ = V Q₁ T + V Q₂ C
  // The steps with poles other than σ0 come first. Their columns of A may be nearly parallel, and
  // must stay free of round-off from the columns of B with the largest θ.
  DenseMatrix a(k), b(k);
  for (const bool foreign : {true, false})
    for (PetscInt j = 0; j < known; ++j)
      if (foreign_[j] == foreign) {
        a.append(std::span<const double>(a_.column(j)).first(k));
        b.append(std::span<const double>(b_.column(j)).first(k));
      }
  const linalg::Qr qr(a);
  qr.divideByR(b);
  const DenseMatrix products = linalg::transposedProduct(qr.q(), b);
  DenseMatrix vectors = linalg::symmetricPart(linalg::rowRange(products, 0, known));
  const auto ascending = linalg::symmetricEigen(vectors);
  DenseMatrix turned(known);  // by descending value
  RitzPairs pairs;
  for (PetscInt from = known - 1; from >= 0; --from) {
    pairs.value.push_back(ascending[from]);
    turned.append(vectors.column(from));
  }
  pairs.coupling = linalg::product(linalg::rowRange(products, known, k), turned);
  pairs.vectors = linalg::product(qr.q().columnRange(0, known), turned);
  pairs.vectors.append(qr.q().columnRange(known, k));
  // The ranks must agree on convergence.
  for (auto entries : {std::span(pairs.value), pairs.coupling.entries(), pairs.vectors.entries()})
    mpi::broadcastEntries(comm_, entries);
  for (PetscInt j = 0; j < known; ++j)
    pairs.residual.push_back(std::sqrt(linalg::squaredLength(pairs.coupling.column(j))));
  return pairs;
}

void RationalLanczos::restart(const RitzPairs& ritz, PetscInt kept) {
  const PetscInt pairs = std::ssize(ritz.value);
  DenseMatrix some(ritz.vectors.columnRange(0, kept));
  some.append(ritz.vectors.columnRange(pairs, pairs + width_));
  rotate(some);
  a_ = b_ = DenseMatrix(limit_, limit_);
  for (PetscInt j = 0; j < kept; ++j) {
    a_(j, j) = 1;
    b_(j, j) = ritz.value[j];
    std::ranges::copy(ritz.coupling.column(j), b_.column(j).begin() + kept);
  }
  foreign_.assign(kept, false);
  sinceChange_ = 0;
  massIsOfLast_ = false;
}

void RationalLanczos::finish(const RitzPairs& ritz, PetscInt count) {
  rotate(DenseMatrix(ritz.vectors.columnRange(0, count)));
}

/// Replaces V by V C.
void RationalLanczos::rotate(const DenseMatrix& combinations) {
  constexpr PetscInt chunk = 256;  // rows at a time: no second copy of V
  const PetscInt count = combinations.columns();
  const DenseView v = columnRange(0, size_);
  for (PetscInt begin = 0; begin < rows_; begin += chunk) {
    const PetscInt end = std::min(begin + chunk, rows_);
    const DenseMatrix rows = linalg::product(linalg::rowRange(v, begin, end), combinations);
    for (PetscInt j = 0; j < count; ++j)
      std::ranges::copy(rows.column(j), columns_ + static_cast<std::ptrdiff_t>(j) * rows_ + begin);
  }
  size_ = count;
}

void RationalLanczos::append() {
  std::ranges::copy(w_.entries(), columns_ + static_cast<std::ptrdiff_t>(size_) * rows_);
  size_ += width_;
}

/// Computes M W.
void RationalLanczos::massTimesW() {
  mw_.resizeColumns(0);
  linalg::appendProduct(m_, w_, mw_);
}

/// Replaces W by (K − σ M)⁻¹ M W, after massTimesW().
void RationalLanczos::solve(const Pole& pole) {
  const LoggedWork work(Work::blockSolve);
  pole.solve(linalg::borrowed(comm_, unknowns_, mw_), linalg::borrowed(comm_, unknowns_, w_));
  solves_ += width_;
}

/// Returns Xᵀ (M W) over all ranks, after massTimesW().
DenseMatrix RationalLanczos::timesMassTimesW(const DenseView& x) const {
  return linalg::transposedProduct(comm_, x, mw_);
}

/// Replaces W by W − V (Vᵀ M W) and adds the coefficients to `sum`, k × b. M W is unchanged.
void RationalLanczos::subtract(DenseMatrix& sum) {
  massTimesW();
  const DenseMatrix h = timesMassTimesW(columnRange(0, size_));
  linalg::multiplyAdd(columnRange(0, size_), h, w_, -1);
  linalg::addScaled(sum, 1, h);
}

/// Does the same for the last two blocks of V only, from M times these blocks.
void RationalLanczos::subtractLastTwo(DenseMatrix& sum) {
  for (const PetscInt back : {2, 1}) {
    const PetscInt first = size_ - back * width_;
    const DenseMatrix h = linalg::transposedProduct(comm_, massOfLast_[2 - back], w_);
    linalg::multiplyAdd(columnRange(first, first + width_), h, w_, -1);
    for (PetscInt j = 0; j < width_; ++j)
      for (PetscInt i = 0; i < width_; ++i) sum(first + i, j) += h(i, j);
  }
}

/// Makes W M-orthogonal to V and returns the summed coefficients, k × b. Two passes run over all of
/// V; with `recurrence`, W has components only along the last two blocks, and the first pass is
/// limited to these.
DenseMatrix RationalLanczos::orthogonalise(bool recurrence) {
  DenseMatrix sum(size_, width_);
  recurrence ? subtractLastTwo(sum) : subtract(sum);
  subtract(sum);
  return sum;
}

/// Splits W = Q R with Qᵀ M Q = I by the eigenvectors of WᵀMW (Stathopoulos and Wu 2002), twice; Q
/// replaces W. Directions that are negligible compared with `size`, the squared norm of W before
/// orthogonalisation against V, show a complete invariant subspace: random ones orthogonal to V
/// replace them, with zero rows in R. Call it after orthogonalise(), whose last M W it reuses: W,
/// orthogonal to V, has the same products with it as with the exact M W. Finally M W is that of Q.
void RationalLanczos::orthonormalise(double size) {
  r_ = linalg::identity(width_);
  int refills = 0;
  for (int pass = 0; pass < 3; ++pass) {
    if (pass > 0) massTimesW();
    DenseMatrix u = linalg::symmetricPart(timesMassTimesW(w_));
    const auto d = linalg::symmetricEigen(u);
    const double largest =
        std::max(d.back(), refills == 0 && pass == 0 ? size : 0);  // later W is scaled
    std::vector<bool> lost(width_);
    bool any = false;
    for (PetscInt j = 0; j < width_; ++j) any |= lost[j] = !(d[j] > 1e-28 * largest);
    //   W ← W U D^(−1/2),   R ← D^(1/2) Uᵀ R
    DenseMatrix down = u, up = u;
    for (PetscInt j = 0; j < width_; ++j)
      for (PetscInt i = 0; i < width_; ++i) {
        down(i, j) *= lost[j] ? 0 : 1 / std::sqrt(d[j]);
        up(i, j) *= lost[j] ? 0 : std::sqrt(d[j]);
      }
    r_ = linalg::transposedProduct(up, r_);
    w_ = linalg::product(w_, down);
    if (any) {
      if (++refills > 5)
        throw Error("free vibration: block Lanczos cannot extend its basis; use -modes_solver eps");
      refill(lost);
      pass = -1;
    } else if (pass == 0 && d.front() < 1e-8 * largest) {
      // Scaling up the small directions has amplified the remaining components along V.
      DenseMatrix rest(size_, width_);
      subtract(rest);
    } else if (pass > 0) {
      mw_ = linalg::product(mw_, down);
      massIsOfLast_ = true;
      return;
    }
  }
}

void RationalLanczos::refill(const std::vector<bool>& lost) {
  for (PetscInt j = 0; j < width_; ++j)
    if (lost[j])
      for (double& entry : w_.column(j)) entry = uniform_(random_);
  orthogonalise(false);
}

}  // namespace squeal::modes
