#pragma once
/// Small dense quadratic eigenproblems (s² M + s Z + K) q = 0, real unsymmetric matrices, by LAPACK.
#include <mpi.h>

#include <complex>
#include <vector>

namespace squeal::flutter {

/// Column-major m×m.
using DenseMatrix = std::vector<double>;

/// s² mass + s damping + stiffness, m×m; damping may be empty.
struct DenseProblem {
  DenseMatrix mass, damping, stiffness;
  int m = 0;
};

struct DensePair {
  std::complex<double> s;
  std::vector<std::complex<double>> q;          ///< [m], 2-norm 1
  std::vector<std::complex<double>> left = {};  ///< y with yᴴ P(s) = 0, 2-norm 1; empty unless asked for
};

/// What a solve gives beside the eigenvalues.
enum class Vectors { right, both };

/// Not collective. All eigenvalues with Im s ≥ 0, by ascending Im s, then Re s. An empty Z: the problem is linear in s², solved at size m;
/// otherwise its companion form of size 2m is scaled and solved. QR on M⁻¹ K, M⁻¹ Z finds them where M is well conditioned, QZ
/// elsewhere, in ten times as long. Error: LAPACK fails, or M is singular (an eigenvalue is infinite).
std::vector<DensePair> solveQuadratic(const DenseMatrix& mass, const DenseMatrix& damping, const DenseMatrix& stiffness, int m,
                                      Vectors vectors = Vectors::right);

/// Collective. The same on all ranks: solved on rank 0 alone, which alone needs the matrices, so that rounding cannot make the ranks
/// disagree on the order or number of eigenvalues.
std::vector<DensePair> solveTogether(MPI_Comm comm, const DenseMatrix& mass, const DenseMatrix& damping,
                                     const DenseMatrix& stiffness, int m, Vectors vectors = Vectors::right);

/// Collective. The pairs of rank 0, vectors of m entries, to all; one message.
void shareFromRankZero(MPI_Comm comm, std::vector<DensePair>& pairs, int m, Vectors vectors);

}  // namespace squeal::flutter
