// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Solves and inertia of symmetric matrices from one LDLᵀ factorisation by MUMPS.
#include <memory>
#include <string>

#include "algebra/factor/mumps.hpp"
#include "base/options/options.hpp"
#include "base/petsc/owned.hpp"

namespace squeal::factor {

/// The prefix of the options of all factorisations of symmetric matrices.
inline constexpr char solverPrefix[] = "modes_st_";

/// Collective. Returns a solver that applies the LDLᵀ factorisation of MUMPS once (KSPPREONLY),
/// unless options with this prefix select another solver. The solver shares the matrix, which is
/// not yet factorised.
OwnedKSP directSolver(Mat matrix, const SolverPrefix& prefix);
/// Collective. Calls KSPSetUp. Returns the reason if the factorisation fails; empty on success.
/// Throws Error if the analysis estimates more memory than is free, or if PETSc rejects an option
/// of the solver.
std::string factorise(KSP solver);
/// Returns the factor, borrowed from the solver, factorised or not; null if the options select
/// another preconditioner.
MumpsFactor* mumpsFactor(KSP solver);

/// The direct solver of a symmetric positive definite matrix (prefix -modes_st_). It factorises the
/// matrix on first use.
class SymmetricSolver {
 public:
  /// Borrows the matrix during the lifetime of the object; messages call it `name`.
  SymmetricSolver(Mat matrix, std::string name) : matrix_(matrix), name_(std::move(name)) {}
  /// Collective. Returns the solver, factorised, borrowed from this object. An EPS that uses the
  /// solver changes its operators, so call get() again afterwards. Throws Error if the
  /// factorisation fails.
  KSP get() const;

 private:
  void factorise() const;
  Mat matrix_;
  std::string name_;
  mutable OwnedKSP solver_;
};

/// Collective. Returns the memory in bytes, summed over all ranks, that MUMPS estimates for the
/// LDLᵀ factorisation of a symmetric matrix. It analyses only the pattern.
double factorMemory(Mat matrix);

/// Collective. Throws Error for unused -modes_st_* options: after the solver is configured, these
/// are typing errors.
void rejectUnusedSolverOptions();

/// Collective. Factorises K − σ M of symmetric matrices with the options of SymmetricSolver. Its
/// inertia gives the number of eigenvalues of (K, M) below σ. K − σ M is destroyed once MUMPS has
/// its entries. `like` is null, or a factorised solver of a matrix of the same distribution, whose
/// elimination order is reused. Throws Error on failure.
std::unique_ptr<MumpsFactor> shiftedFactor(Mat k, Mat m, double sigma, KSP like = nullptr);

/// Collective. Returns the inertia of a symmetric matrix from the signs of the pivots of an LDLᵀ
/// factorisation (Sylvester's law of inertia, [M.25]), with the options of SymmetricSolver. Pivots
/// below `zero` times the norm of the scaled matrix count as zero; with 0, MUMPS decides (about
/// 1e-21). Throws Error if the factorisation fails, or if MUMPS estimates more than twice the free
/// memory.
Inertia inertia(Mat matrix, double zero = 0);

}  // namespace squeal::factor
