/// Block Lanczos is made with full orthogonalisation and thick restart (Golub and Underwood 1977;
/// Wu and Simon 2000) on the operator S = K⁻¹ M, which is self-adjoint in the inner product of M. A
/// direct solver answers a block of right-hand sides many times faster than as many single ones,
/// because the factor is read from memory once a block; SLEPc's Krylov-Schur asks for them one at a
/// time.
#include "modes/blocklanczos.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "linalg/block.hpp"
#include "linalg/columns.hpp"
#include "linalg/symmetric.hpp"

namespace squeal::modes {
namespace {

using linalg::DenseMatrix;

/// The growing M-orthonormal basis V of size n × k and T = Vᵀ M S V.
class Lanczos {
 public:
  Lanczos(Mat k, Mat m, KSP solver, PetscInt blockSize, PetscInt limit)
      : m_(m), b_(blockSize), limit_(limit) {
    PC pc = nullptr;
    check(KSPGetPC(solver, &pc));
    check(PCFactorGetMatrix(pc, &factor_));
    comm_ = PetscObjectComm(reinterpret_cast<PetscObject>(k));
    PetscInt rows = 0, n = 0;
    check(MatGetLocalSize(k, &rows, nullptr));
    check(MatGetSize(k, &n, nullptr));
    w_ = linalg::Block(rows, b_);
    asMat_ = linalg::borrowed(comm_, n, w_);
    check(MatMatMult(m_, asMat_, MAT_INITIAL_MATRIX, PETSC_DEFAULT, mw_.out()));
    v_ = linalg::Block(rows);
    enlarge(limit);
    // Each rank draws its own part; the seed is fixed, so that a run can be repeated.
    int rank = 0;
    check(MPI_Comm_rank(comm_, &rank));
    random_.seed(rank + 1);
  }

  PetscInt size() const { return v_.columns(); }
  bool full() const { return size() + b_ > limit_; }

  /// Makes the first block: S applied to a random one, which damps what belongs to high
  /// frequencies.
  void start() {
    for (double& entry : w_.entries()) entry = uniform_(random_);
    apply();
    orthonormalise(0);
    append();
  }

  /// Computes W = S (last block), orthogonal to V, and the columns of T for it. The new block stays
  /// in W until append().
  void expand() {
    const PetscInt k = size();
    std::ranges::copy(v_.columnRange(k - b_, k).entries(), w_.data());
    apply();
    const DenseMatrix h = orthogonalise(!restarted_);
    restarted_ = false;
    double size = 0;  // of W before V was taken out of it, squared
    for (PetscInt j = 0; j < b_; ++j) {
      double sum = 0;
      for (PetscInt i = 0; i < k; ++i) {
        t_(i, k - b_ + j) = t_(k - b_ + j, i) = h(i, j);
        sum += h(i, j) * h(i, j);
      }
      size = std::max(size, sum);
    }
    orthonormalise(size);
  }

  void append() { v_.append(w_); }

  /// Ritz values θ, descending, with the vectors Y as columns and the residual norms ‖R Y_last‖ of
  /// S V y − θ V y in the norm of M.
  struct Ritz {
    std::vector<double> value, residual;
    DenseMatrix vectors;
  };
  Ritz ritz() const {
    const PetscInt k = size();
    Ritz ritz{{}, {}, DenseMatrix(k)};
    DenseMatrix a = linalg::rowRange(t_.columnRange(0, k), 0, k);
    const auto ascending = linalg::symmetricEigen(a);
    for (PetscInt from = k - 1; from >= 0; --from) {
      ritz.value.push_back(ascending[from]);
      ritz.vectors.append(a.column(from));
    }
    const DenseMatrix last = linalg::product(r_, linalg::rowRange(ritz.vectors, k - b_, k));
    for (PetscInt j = 0; j < k; ++j)
      ritz.residual.push_back(std::sqrt(linalg::squaredLength(last.column(j))));
    return ritz;
  }

  /// Replaces V by V Y for the first `kept` Ritz vectors. T becomes diagonal.
  void contract(const Ritz& ritz, PetscInt kept) {
    constexpr PetscInt chunk = 256;  // rows at a time: no second copy of V
    const linalg::DenseView y = ritz.vectors.columnRange(0, kept);
    for (PetscInt begin = 0; begin < v_.rows(); begin += chunk) {
      const PetscInt end = std::min(begin + chunk, v_.rows());
      const DenseMatrix rows = linalg::product(linalg::rowRange(v_, begin, end), y);
      for (PetscInt j = 0; j < kept; ++j)
        std::ranges::copy(rows.column(j), v_.column(j).begin() + begin);
    }
    v_.resizeColumns(kept);
    restarted_ = true;
    t_ = DenseMatrix(limit_, limit_);
    for (PetscInt j = 0; j < kept; ++j) t_(j, j) = ritz.value[j];
  }

  /// Makes room for `limit` vectors, before the first one or at a restart, where T is diagonal.
  void enlarge(PetscInt limit) {
    DenseMatrix larger(limit, limit);
    for (PetscInt j = 0; j < size(); ++j) larger(j, j) = t_(j, j);
    t_ = std::move(larger);
    limit_ = limit;
    v_.reserve(limit);
  }

  /// Returns the k columns of V as a BV for vectors like those of `like`.
  OwnedBV vectors(Mat like) const { return linalg::copiedColumns(like, v_); }

 private:
  /// Computes M W.
  void massTimesW() {
    Mat product = mw_;
    PetscScalar* changed = nullptr;  // tells PETSc that the entries are not those of before
    check(MatDenseGetArrayWrite(asMat_, &changed));
    check(MatDenseRestoreArrayWrite(asMat_, &changed));
    check(MatMatMult(m_, asMat_, MAT_REUSE_MATRIX, PETSC_DEFAULT, &product));
  }

  /// Replaces W by K⁻¹ M W.
  void apply() {
    massTimesW();
    check(MatMatSolve(factor_, mw_, asMat_));
  }

  /// Returns Xᵀ (M W) over all ranks, after massTimesW().
  DenseMatrix timesMassTimesW(const linalg::DenseView& x) {
    const PetscScalar* mw = nullptr;
    check(MatDenseGetArrayRead(mw_, &mw));
    DenseMatrix result = linalg::transposedProduct(comm_, x, {mw, w_.rows(), b_});
    check(MatDenseRestoreArrayRead(mw_, &mw));
    return result;
  }

  /// Replaces W by W − X (Xᵀ M W) for the columns X of V from `first` on, and adds the coefficients
  /// to the rows of `sum`, k × b, from `first` on.
  void subtract(PetscInt first, DenseMatrix& sum) {
    massTimesW();
    const linalg::DenseView x = v_.columnRange(first, size());
    const DenseMatrix h = timesMassTimesW(x);
    linalg::multiplyAdd(x, h, w_, -1);
    for (PetscInt j = 0; j < b_; ++j)
      for (PetscInt i = 0; i < h.rows(); ++i) sum(first + i, j) += h(i, j);
  }

  /// Makes W M-orthogonal to V and returns the summed coefficients, k × b. In exact arithmetic only
  /// the last two blocks have a part in S V_last (three-term recurrence), so one pass over these
  /// and one over all of V does; after a restart, and for random columns, all of V has: two full
  /// passes.
  DenseMatrix orthogonalise(bool recurrence) {
    DenseMatrix sum(size(), b_);
    subtract(recurrence ? std::max<PetscInt>(0, size() - 2 * b_) : 0, sum);
    subtract(0, sum);
    return sum;
  }

  /// Splits W = Q R with Qᵀ M Q = I by the eigenvectors of WᵀMW (Stathopoulos and Wu 2002), twice;
  /// Q replaces W. Directions that have vanished beside `size`, the square of what W was before V
  /// was taken out of it (an invariant subspace is complete), are replaced by random ones
  /// orthogonal to V, with zero rows in R.
  void orthonormalise(double size) {
    r_ = DenseMatrix(b_, b_);
    for (PetscInt i = 0; i < b_; ++i) r_(i, i) = 1;
    int refills = 0;
    for (int pass = 0; pass < 3; ++pass) {
      massTimesW();
      DenseMatrix u = timesMassTimesW(w_);
      const auto d = linalg::symmetricEigen(u);
      const double largest =
          std::max(d.back(), refills == 0 && pass == 0 ? size : 0);  // later W is scaled
      std::vector<bool> lost(b_);
      bool any = false;
      for (PetscInt j = 0; j < b_; ++j) any |= lost[j] = !(d[j] > 1e-28 * largest);
      //   W ← W U D^(−1/2),   R ← D^(1/2) Uᵀ R
      DenseMatrix down = u, up = u;
      for (PetscInt j = 0; j < b_; ++j)
        for (PetscInt i = 0; i < b_; ++i) {
          down(i, j) *= lost[j] ? 0 : 1 / std::sqrt(d[j]);
          up(i, j) *= lost[j] ? 0 : std::sqrt(d[j]);
        }
      r_ = linalg::transposedProduct(up, r_);
      // W keeps its place in memory, as the matrix of PETSc borrows it.
      std::ranges::copy(linalg::product(w_, down).entries(), w_.data());
      if (!any) {
        if (pass > 0) return;
        continue;
      }
      if (++refills > 5)
        throw Error("free vibration: block Lanczos cannot extend its basis; use -modes_solver eps");
      refill(lost);
      pass = -1;
    }
  }

  void refill(const std::vector<bool>& lost) {
    for (PetscInt j = 0; j < b_; ++j)
      if (lost[j])
        for (double& entry : w_.column(j)) entry = uniform_(random_);
    orthogonalise(false);
  }

  Mat m_ = nullptr, factor_ = nullptr;
  PetscInt b_, limit_;
  MPI_Comm comm_ = MPI_COMM_NULL;
  bool restarted_ = false;
  linalg::Block v_, w_;
  OwnedMat asMat_, mw_;  // W, whose entries are borrowed, and M W
  DenseMatrix t_, r_;
  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

/// Where a basis of the usual size converges at all, it does within this many restarts.
constexpr int restartsBeforeGrowth = 4;

}  // namespace

LanczosResult blockLanczos(Mat k, Mat m, KSP solver, int count, int blockSize, double tolerance,
                           int maxRestarts, const std::function<void(int, int)>& progress) {
  PetscInt limit = lanczosVectors(count, blockSize), size = 0;
  check(MatGetSize(k, &size, nullptr));
  Lanczos lanczos(k, m, solver, blockSize, limit);
  LanczosResult result;
  lanczos.start();
  result.solves = blockSize;
  const int firstCheck = count + count / 2, every = std::max(2 * blockSize, count / 8);
  for (PetscInt next = firstCheck;;) {
    lanczos.expand();
    result.solves += blockSize;
    if (lanczos.size() < next && !lanczos.full()) {
      lanczos.append();
      continue;
    }
    const auto ritz = lanczos.ritz();
    int converged = 0;
    while (converged < std::min<PetscInt>(count, lanczos.size()) &&
           ritz.residual[converged] <= tolerance * ritz.value[converged])
      ++converged;
    progress(result.restarts, converged);
    if (converged == count || (lanczos.full() && result.restarts == maxRestarts)) {
      result.converged = converged;
      lanczos.contract(ritz, converged);
      for (int i = 0; i < converged; ++i) result.lambda.push_back(1 / ritz.value[i]);
      if (converged > 0) result.vectors = lanczos.vectors(k);  // SLEPc knows no BV without columns
      return result;
    }
    next = lanczos.size() + every;
    if (lanczos.full()) {
      lanczos.contract(ritz, count + (limit - count) / 3);
      // Eigenvalues that lie close together, as those of a thin ring held at its hub, need a larger
      // basis: more restarts do not help.
      if (++result.restarts % restartsBeforeGrowth == 0 && 4 * limit <= size)
        lanczos.enlarge(limit *= 2);
      next = lanczos.size() + every;
    }
    lanczos.append();
  }
}

}  // namespace squeal::modes
