#pragma once
/// Symmetric matrices by MUMPS: solutions with one LDLᵀ factorisation, and inertia.
#include <string>

#include "options/options.hpp"
#include "petsc/owned.hpp"

namespace squeal::linalg {

/// Collective. One application of MUMPS' LDLᵀ unless the options with this prefix say otherwise;
/// not yet factorised.
OwnedKSP directSolver(Mat matrix, const SolverPrefix& prefix);
/// Collective. KSPSetUp. Error: MUMPS' analysis foresees far more memory than is free.
void factorise(KSP solver);
/// The factor if it is MUMPS' LDLᵀ, set up or not; null otherwise. Borrowed from the solver.
Mat mumpsFactor(KSP solver);

/// The direct solver of a symmetric positive definite matrix (prefix -modes_st_), factorised on
/// first use.
class SymmetricSolver {
 public:
  /// Borrows the matrix for its life; `name` stands for it in messages.
  SymmetricSolver(Mat matrix, std::string name) : matrix_(matrix), name_(std::move(name)) {}
  /// Collective. The solver, factorised. (An EPS that has used it leaves it without: call again.)
  /// Error: the factorisation fails.
  KSP get() const;

 private:
  void factorise() const;
  Mat matrix_;
  std::string name_;
  mutable OwnedKSP solver_;
};

/// Collective. Memory of MUMPS for the LDLᵀ factorisation of a symmetric matrix on all ranks,
/// bytes, as its analysis of the pattern foresees it; nothing is factorised.
double factorMemory(Mat matrix);

/// Unused -modes_st_* options are typing errors once a solver has been configured.
void rejectUnusedSolverOptions();

/// Numbers of eigenvalues of a symmetric matrix by sign (Sylvester).
struct Inertia {
  PetscInt negative = 0, zero = 0;
};

/// Collective. From the pivots of an LDLᵀ factorisation. Pivots below `zero` times the norm of the
/// scaled matrix count as zero; 0: as MUMPS decides, some 1e-21. Error: the factorisation fails.
Inertia inertia(Mat matrix, double zero = 0);

}  // namespace squeal::linalg
