/// Block Lanczos with full orthogonalisation and thick restart (Golub and Underwood 1977; Wu and
/// Simon 2000) on the operator S = K⁻¹ M, which is self-adjoint in the inner product of M. A direct
/// solver answers a block of right-hand sides many times faster than as many single ones, because
/// the factor is read from memory once a block; SLEPc's Krylov-Schur asks for them one at a time.
#include "modes/blocklanczos.hpp"

#include <slepcsys.h>  // first: the next header needs it

#include <slepcblaslapack.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "linalg/columns.hpp"
#include "linalg/symmetric.hpp"

namespace squeal::modes {
namespace {

using Small = std::vector<PetscScalar>;  // column-major
using Index = std::ptrdiff_t;            // so that products of sizes do not overflow

/// The growing M-orthonormal basis V of size n × k, kept by columns, and T = Vᵀ M S V.
class Lanczos {
 public:
  Lanczos(Mat k, Mat m, KSP solver, int blockSize, Index limit)
      : m_(m), b_(blockSize), limit_(limit), t_(limit * limit, 0.0) {
    PC pc = nullptr;
    check(KSPGetPC(solver, &pc));
    check(PCFactorGetMatrix(pc, &factor_));
    comm_ = PetscObjectComm(reinterpret_cast<PetscObject>(k));
    PetscInt local = 0, n = 0;
    check(MatGetLocalSize(k, &local, nullptr));
    check(MatGetSize(k, &n, nullptr));
    rows_ = local;
    check(MatCreateDense(comm_, rows_, PETSC_DECIDE, n, b_, nullptr, w_.out()));
    check(MatZeroEntries(w_));
    check(MatMatMult(m_, w_, MAT_INITIAL_MATRIX, PETSC_DEFAULT, mw_.out()));
    v_.resize(rows_ * limit);
    // Each rank draws its own part; the seed is fixed, so that a run can be repeated.
    int rank = 0;
    check(MPI_Comm_rank(comm_, &rank));
    random_.seed(rank + 1);
  }

  Index size() const { return k_; }
  bool full() const { return k_ + b_ > limit_; }

  /// The first block: S applied to a random one, which damps what belongs to high frequencies.
  void start() {
    PetscScalar* w = nullptr;
    check(MatDenseGetArray(w_, &w));
    for (Index i = 0; i < b_ * rows_; ++i) w[i] = uniform_(random_);
    check(MatDenseRestoreArray(w_, &w));
    apply();
    r_.assign(b_ * b_, 0.0);
    orthonormalise(0);
    append();
  }

  /// W = S (last block), orthogonal to V; T gets its columns. The new block stays in W until
  /// append().
  void expand() {
    PetscScalar* w = nullptr;
    check(MatDenseGetArrayWrite(w_, &w));
    std::copy_n(column(k_ - b_), b_ * rows_, w);
    check(MatDenseRestoreArrayWrite(w_, &w));
    apply();
    const Small h = orthogonalise(!restarted_);
    restarted_ = false;
    double size = 0;  // of W before V was taken out of it, squared
    for (Index j = 0; j < b_; ++j) {
      double sum = 0;
      for (Index i = 0; i < k_; ++i) sum += std::pow(h[j * k_ + i], 2);
      size = std::max(size, sum);
    }
    for (Index j = 0; j < b_; ++j)
      for (Index i = 0; i < k_; ++i) t(i, k_ - b_ + j) = t(k_ - b_ + j, i) = h[j * k_ + i];
    orthonormalise(size);
  }

  void append() {
    const PetscScalar* w = nullptr;
    check(MatDenseGetArrayRead(w_, &w));
    std::copy_n(w, b_ * rows_, column(k_));
    check(MatDenseRestoreArrayRead(w_, &w));
    k_ += b_;
  }

  /// Ritz values θ descending, vectors Y (columns), and residual norms ‖R Y_last‖ of S V y − θ V y
  /// in the norm of M.
  struct Ritz {
    std::vector<PetscReal> value, residual;
    Small vector;
  };
  Ritz ritz() const {
    Ritz ritz;
    Small a(k_ * k_);
    for (Index j = 0; j < k_; ++j) std::copy_n(t_.begin() + j * limit_, k_, a.begin() + j * k_);
    const auto ascending = linalg::symmetricEigen(a, k_);
    for (Index from = k_ - 1; from >= 0; --from) {
      const auto y = a.begin() + from * k_;
      ritz.value.push_back(ascending[from]);
      ritz.vector.insert(ritz.vector.end(), y, y + k_);
      PetscReal sum = 0;
      for (Index i = 0; i < b_; ++i) {
        PetscReal entry = 0;
        for (Index l = 0; l < b_; ++l) entry += r_[l * b_ + i] * y[k_ - b_ + l];
        sum += entry * entry;
      }
      ritz.residual.push_back(std::sqrt(sum));
    }
    return ritz;
  }

  /// V ← V Y, the first `kept` columns; T diagonal.
  void contract(const Ritz& ritz, Index kept) {
    const Index chunk = 256;  // rows at a time: no second copy of V
    std::vector<PetscScalar> rowsOfV(chunk * kept);
    for (Index begin = 0; begin < rows_; begin += chunk) {
      PetscBLASInt rows = std::min(chunk, rows_ - begin), columns = kept, inner = k_,
                   leading = rows_;
      const PetscScalar one = 1, zero = 0;
      BLASgemm_("N", "N", &rows, &columns, &inner, &one, column(0) + begin, &leading,
                ritz.vector.data(), &inner, &zero, rowsOfV.data(), &rows);
      for (Index j = 0; j < kept; ++j)
        std::copy_n(rowsOfV.data() + j * rows, rows, column(j) + begin);
    }
    k_ = kept;
    restarted_ = true;
    std::fill(t_.begin(), t_.end(), 0.0);
    for (Index j = 0; j < kept; ++j) t(j, j) = ritz.value[j];
  }

  /// Room for `limit` vectors, at a restart: T is diagonal then.
  void enlarge(Index limit) {
    Small larger(limit * limit, 0.0);
    for (Index j = 0; j < k_; ++j) larger[j * limit + j] = t(j, j);
    t_ = std::move(larger);
    limit_ = limit;
    v_.resize(rows_ * limit);
  }

  /// The k columns of V as a BV for vectors like those of `like`.
  OwnedBV vectors(Mat like) { return linalg::copiedColumns(like, column(0), k_); }

 private:
  PetscScalar& t(Index i, Index j) { return t_[j * limit_ + i]; }

  PetscScalar* column(Index j) { return v_.data() + j * rows_; }

  void massTimesW() {
    Mat product = mw_;
    check(MatMatMult(m_, w_, MAT_REUSE_MATRIX, PETSC_DEFAULT, &product));
  }

  /// W ← K⁻¹ M W.
  void apply() {
    massTimesW();
    check(MatMatSolve(factor_, mw_, w_));
  }

  /// Xᵀ (M W) over all ranks for the columns X = first `count` of `x`.
  Small products(const PetscScalar* x, Index count) {
    const PetscScalar* mw = nullptr;
    Small result(count * b_, 0.0);
    check(MatDenseGetArrayRead(mw_, &mw));
    PetscBLASInt rows = rows_, leading = std::max<PetscBLASInt>(rows, 1), columns = b_, m = count;
    const PetscScalar one = 1, zero = 0;
    if (rows > 0 && m > 0)
      BLASgemm_("T", "N", &m, &columns, &rows, &one, x, &leading, mw, &leading, &zero,
                result.data(), &m);
    check(MatDenseRestoreArrayRead(mw_, &mw));
    check(MPI_Allreduce(MPI_IN_PLACE, result.data(), result.size(), MPIU_SCALAR, MPI_SUM, comm_));
    return result;
  }

  /// W ← W − X (Xᵀ M W) for the columns X of V from `first` on; adds the coefficients to rows
  /// `first`… of `sum` (k × b).
  void subtract(Index first, Small& sum) {
    massTimesW();
    const Index count = k_ - first;
    const Small h = products(column(first), count);
    PetscScalar* w = nullptr;
    check(MatDenseGetArray(w_, &w));
    PetscBLASInt rows = rows_, leading = std::max<PetscBLASInt>(rows, 1), columns = b_,
                 inner = count;
    const PetscScalar minus = -1, one = 1;
    if (rows > 0 && count > 0)
      BLASgemm_("N", "N", &rows, &columns, &inner, &minus, column(first), &leading, h.data(),
                &inner, &one, w, &leading);
    check(MatDenseRestoreArray(w_, &w));
    for (Index j = 0; j < b_; ++j)
      for (Index i = 0; i < count; ++i) sum[j * k_ + first + i] += h[j * count + i];
  }

  /// W made M-orthogonal to V; the summed coefficients (k × b). In exact arithmetic only the last
  /// two blocks have a part in S V_last (three-term recurrence), so one pass over these and one
  /// over all of V does; after a restart, and for random columns, all of V has: two full passes.
  Small orthogonalise(bool recurrence) {
    Small sum(k_ * b_, 0.0);
    subtract(recurrence ? std::max<Index>(0, k_ - 2 * b_) : 0, sum);
    subtract(0, sum);
    return sum;
  }

  /// W = Q R with Qᵀ M Q = I by the eigenvectors of WᵀMW (Stathopoulos and Wu 2002), twice; Q
  /// replaces W. Directions that have vanished beside `size`, the square of what W was before V was
  /// taken out of it (an invariant subspace is complete), are replaced by random ones orthogonal to
  /// V, with zero rows in R.
  void orthonormalise(double size) {
    const std::size_t b = b_;
    r_.assign(b * b, 0.0);
    for (std::size_t i = 0; i < b; ++i) r_[i * b + i] = 1;
    int refills = 0;
    for (int pass = 0; pass < 3; ++pass) {
      massTimesW();
      const PetscScalar* read = nullptr;
      check(MatDenseGetArrayRead(w_, &read));
      Small gram = products(read, b_);
      check(MatDenseRestoreArrayRead(w_, &read));
      const auto d = linalg::symmetricEigen(gram, b);
      const double largest =
          std::max(d.back(), refills == 0 && pass == 0 ? size : 0);  // later W is scaled
      std::vector<bool> lost(b);
      bool any = false;
      for (std::size_t j = 0; j < b; ++j) any |= lost[j] = !(d[j] > 1e-28 * largest);
      // W ← W U D^(−1/2), R ← D^(1/2) Uᵀ R
      Small transform(b * b), product(b * b, 0.0);
      for (std::size_t j = 0; j < b; ++j)
        for (std::size_t i = 0; i < b; ++i)
          transform[j * b + i] = lost[j] ? 0.0 : gram[j * b + i] / std::sqrt(d[j]);
      for (std::size_t j = 0; j < b; ++j)
        for (std::size_t i = 0; i < b; ++i)
          for (std::size_t l = 0; l < b && !lost[i]; ++l)
            product[j * b + i] += std::sqrt(d[i]) * gram[i * b + l] * r_[j * b + l];
      r_ = product;
      multiply(transform);
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

  /// W ← W X for a b × b matrix.
  void multiply(const Small& x) {
    PetscScalar* w = nullptr;
    check(MatDenseGetArray(w_, &w));
    old_.assign(w, w + b_ * rows_);
    PetscBLASInt rows = rows_, leading = std::max<PetscBLASInt>(rows, 1), columns = b_;
    const PetscScalar one = 1, zero = 0;
    if (rows > 0)
      BLASgemm_("N", "N", &rows, &columns, &columns, &one, old_.data(), &leading, x.data(),
                &columns, &zero, w, &leading);
    check(MatDenseRestoreArray(w_, &w));
  }

  void refill(const std::vector<bool>& lost) {
    PetscScalar* w = nullptr;
    check(MatDenseGetArray(w_, &w));
    for (Index j = 0; j < b_; ++j)
      if (lost[j])
        for (Index i = 0; i < rows_; ++i) w[j * rows_ + i] = uniform_(random_);
    check(MatDenseRestoreArray(w_, &w));
    orthogonalise(false);
  }

  Mat m_ = nullptr, factor_ = nullptr;
  Index b_, limit_, k_ = 0, rows_ = 0;
  MPI_Comm comm_ = MPI_COMM_NULL;
  bool restarted_ = false;
  OwnedMat w_, mw_;
  std::vector<PetscScalar> v_;
  Small t_, r_, old_;
  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

/// Where a basis of the usual size converges at all, it does within this many restarts.
constexpr int restartsBeforeGrowth = 4;

}  // namespace

LanczosResult blockLanczos(Mat k, Mat m, KSP solver, int count, int blockSize, double tolerance,
                           int maxRestarts, const std::function<void(int, int)>& progress) {
  Index limit = lanczosVectors(count, blockSize);
  PetscInt size = 0;
  check(MatGetSize(k, &size, nullptr));
  Lanczos lanczos(k, m, solver, blockSize, limit);
  LanczosResult result;
  lanczos.start();
  result.solves = blockSize;
  const int firstCheck = count + count / 2, every = std::max(2 * blockSize, count / 8);
  for (Index next = firstCheck;;) {
    lanczos.expand();
    result.solves += blockSize;
    if (lanczos.size() < next && !lanczos.full()) {
      lanczos.append();
      continue;
    }
    const auto ritz = lanczos.ritz();
    int converged = 0;
    while (converged < std::min<Index>(count, lanczos.size()) &&
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
