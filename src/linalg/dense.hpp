#pragma once
/// Small dense quadratic eigenproblems (s² M + s Z + K) q = 0, real unsymmetric matrices, by
/// LAPACK.
#include <mpi.h>

#include <complex>
#include <functional>
#include <vector>

namespace squeal::linalg {

/// Column-major m×m.
using DenseMatrix = std::vector<double>;

/// s² mass + s damping + stiffness, m×m; damping may be empty.
struct DenseProblem {
  DenseMatrix mass, damping, stiffness;
  int m = 0;
};

struct DensePair {
  std::complex<double> s;
  std::vector<std::complex<double>> q;  ///< [m], 2-norm 1
  /// Y with yᴴ P(s) = 0, 2-norm 1; empty unless asked for
  std::vector<std::complex<double>> left = {};
};

/// What a solve gives beside the eigenvalues.
enum class Vectors { right, both };

/// Which eigenvalues; empty: all.
using Wanted = std::function<bool(std::complex<double>)>;

/// Not collective. All finite eigenvalues with Im s ≥ 0, by ascending Im s, then Re s. An empty Z:
/// the problem is linear in s², solved at size m; otherwise its companion form of size 2m is scaled
/// and solved. QR with the inverse of M or K, whichever is better conditioned, finds them; QZ, in
/// ten times as long, where neither is. Error: LAPACK fails, or M and K are singular. Those that
/// are not `wanted` (none given: all are) are left out.
std::vector<DensePair> solveQuadratic(const DenseProblem& problem, Vectors vectors = Vectors::right,
                                      const Wanted& wanted = {});
std::vector<DensePair> solveQuadratic(const DenseMatrix& mass, const DenseMatrix& damping,
                                      const DenseMatrix& stiffness, int m,
                                      Vectors vectors = Vectors::right);

/// Not collective. A times the right vectors, their real and imaginary parts as columns 2j and 2j +
/// 1; zero for an empty A.
std::vector<double> timesVectors(const DenseMatrix& a, int m, const std::vector<DensePair>& pairs);

/// Collective. Solves several problems, each on one rank, which alone needs its matrices: problem i
/// on rank i modulo their number. The same results on all ranks, so that rounding cannot make the
/// ranks disagree on the order or number of eigenvalues.
std::vector<std::vector<DensePair>> solveSpread(MPI_Comm comm,
                                                const std::vector<DenseProblem>& problems,
                                                Vectors vectors, const Wanted& wanted = {});

/// Collective. One problem, on rank 0.
std::vector<DensePair> solveTogether(MPI_Comm comm, const DenseMatrix& mass,
                                     const DenseMatrix& damping, const DenseMatrix& stiffness,
                                     int m, Vectors vectors = Vectors::right);

/// Collective. The pairs of rank `root`, vectors of m entries, to all; one message.
void shareFrom(int root, MPI_Comm comm, std::vector<DensePair>& pairs, int m, Vectors vectors);

}  // namespace squeal::linalg
