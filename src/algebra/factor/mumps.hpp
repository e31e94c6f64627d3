// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// LDLᵀ factorisation of distributed symmetric matrices by MUMPS. It replaces PETSc's own interface
/// to MUMPS, which cannot reuse an elimination order. PETSc's interface also sets up the scatter of
/// the solution at each call, which takes a fifth of the time of a solve with many columns.
#include <dmumps_c.h>
#include <petscsf.h>

#include <string>
#include <vector>

#include "algebra/linalg/block.hpp"
#include "base/petsc/owned.hpp"

namespace squeal::factor {

/// Numbers of negative and of zero eigenvalues of a symmetric matrix.
struct Inertia {
  PetscInt negative = 0, zero = 0;
};

/// The factorisation
///   A = L D Lᵀ
/// of a symmetric matrix, which need not be definite. Like PETSc's own interface, it reads the
/// options -<prefix>mat_mumps_icntl_<i>, …cntl_<i> and …ooc_tmpdir.
class MumpsFactor {
 public:
  /// Collective. `prefix` is the prefix of the options; it may be empty.
  MumpsFactor(MPI_Comm comm, const std::string& prefix);
  ~MumpsFactor();
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;

  /// Makes MUMPS report the signs of all pivots, for inertia(). Pivots smaller than `zero` times
  /// the norm of the scaled matrix are treated as zero; if `zero` is 0, MUMPS chooses the factor
  /// (about 1e-21).
  void enableInertia(double zero = 0);
  /// Makes the next analyse() and factorise() eliminate all rows except `rows`, which are 0-based
  /// and given on rank 0; all ranks must call it. schurComplement() then returns the Schur
  /// complement of `rows` on rank 0, and solve() must not be called.
  void keep(const std::vector<PetscInt>& rows);
  /// Not collective. Returns, on rank 0, the Schur complement of the rows given to keep(), in the
  /// same order. The entry (i, j) with j ≤ i is at [i · size + j]; all other entries are undefined.
  const std::vector<double>& schurComplement() const { return schur_; }
  /// Collective. Analyses the pattern. If `like` is given, reuses the elimination order of `like`,
  /// which must be the factor of a matrix with the same pattern and distribution. Throws Error if
  /// the analysis fails.
  void analyse(Mat matrix, const MumpsFactor* like = nullptr);
  /// Not collective. Returns the memory estimate of analyse() in bytes, summed over all ranks.
  double memory() const { return 1e6 * id_.infog[16]; }
  /// Collective. Factorises the matrix or, without an argument, the matrix of the preceding
  /// analyse(). If memory is short, stores the factor on disk; if pivoting or messages need more
  /// workspace, enlarges it. Throws Error if MUMPS estimates more than twice the free memory even
  /// with the factor on disk. Returns the reason for any other failure, or an empty text on
  /// success.
  std::string factorise(Mat matrix = nullptr);
  /// Collective. Computes X = A⁻¹ B. `b` and `x` contain this rank's rows, column by column. Throws
  /// Error if MUMPS fails.
  void solve(const double* b, double* x, PetscInt columns);
  /// Returns the inertia, after enableInertia() and factorise().
  Inertia inertia() const { return {id_.infog[11], id_.infog[27]}; }
  /// Returns INFOG(i), in the notation of MUMPS's manual.
  PetscInt infog(int i) const { return id_.infog[i - 1]; }
  /// Returns RINFOG(i), in the notation of MUMPS's manual.
  double rinfog(int i) const { return id_.rinfog[i - 1]; }

 private:
  MUMPS_INT& icntl(int i) { return id_.icntl[i - 1]; }
  void call(int job);
  void setEntries(Mat matrix);
  void fitIntoMemory();
  void scatterSolution(double* x, PetscInt columns);
  std::string failure() const;

  MPI_Comm comm_ = MPI_COMM_NULL;
  int ranks_ = 1;
  DMUMPS_STRUC_C id_{};
  PetscInt localRows_ = 0;
  bool hasEntries_ = false;  // analyse() has set the entries for factorise()
  std::vector<MUMPS_INT> rows_, columns_, ownRows_, solutionRows_, order_;
  std::vector<MUMPS_INT> kept_;  // 1-based rows of the Schur complement, on rank 0
  std::vector<double> entries_, solution_, byRows_, schur_;
  PetscSF toOwners_ = nullptr;  // from the rows of the solution that MUMPS stores on this rank
};

/// Collective. Computes X = A⁻¹ B for dense PETSc matrices.
void solve(MumpsFactor& factor, Mat b, Mat x);

}  // namespace squeal::factor
