// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// This file calls MUMPS for the LDLᵀ factorisation of distributed symmetric matrices. PETSc's own
/// interface sets up the scatter of the solution at each call, a fifth of the time of a block of
/// solves, and does not pass an ordering on.
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

/// A MumpsFactor is the factorisation
///   A = L D Lᵀ
/// of a symmetric matrix, which need not be definite. Of the options -<prefix>mat_mumps_*, it reads
/// icntl_<i>, cntl_<i> and ooc_tmpdir, as PETSc's own interface does.
class MumpsFactor {
 public:
  /// Collective. `prefix` is that of the options; an empty one stands for none.
  MumpsFactor(MPI_Comm comm, const std::string& prefix);
  ~MumpsFactor();
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;

  /// Makes the signs of all pivots known, for inertia(). Pivots below `zero` times the norm of the
  /// scaled matrix count as zero; with 0, MUMPS decides (about 1e-21).
  void wantInertia(double zero = 0);
  /// Collective. Analyses the pattern. With `like`, the factor of a matrix of the same pattern and
  /// distribution, its order of elimination is taken. Throws Error if it fails.
  void analyse(Mat matrix, const MumpsFactor* like = nullptr);
  /// Collective. Returns the memory in bytes, summed over all ranks, that the analysis foresees.
  double memory() const { return 1e6 * id_.infog[16]; }
  /// Collective. Factorises the matrix, or that of analyse() if none is given, which may follow
  /// only analyse(), with more workspace if pivoting needs it, and with the factor on disk if
  /// memory is short. Throws Error if the analysis foresees more memory than there is even
  /// so. Returns the reason of another failure, empty if there is none.
  std::string factorise(Mat matrix = nullptr);
  /// Collective. Computes X = A⁻¹ B, each by this rank's rows, column after column.
  void solve(const double* b, double* x, PetscInt columns);
  /// Returns the inertia, after wantInertia() and factorise().
  Inertia inertia() const { return {id_.infog[11], id_.infog[27]}; }
  /// Returns INFOG(i) of MUMPS's manual.
  PetscInt infog(int i) const { return id_.infog[i - 1]; }

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
  bool entriesHeld_ = false;  // since analyse()
  std::vector<MUMPS_INT> rows_, columns_, ownRows_, solutionRows_, order_;
  std::vector<double> entries_, solution_, byRows_;
  PetscSF toOwners_ = nullptr;  // from the rows of the solution that MUMPS leaves here
};

/// Collective. Computes X = A⁻¹ B of dense matrices of PETSc.
void solve(MumpsFactor& factor, Mat b, Mat x);

}  // namespace squeal::factor
