// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// These functions apply MUMPS to symmetric matrices, for solves with one LDLᵀ factorisation and
/// for the inertia.
#include <memory>
#include <string>

#include "algebra/factor/mumps.hpp"
#include "base/options/options.hpp"
#include "base/petsc/owned.hpp"

namespace squeal::factor {

/// Collective. Returns a solver that applies the LDLᵀ factorisation of MUMPS once (KSPPREONLY),
/// unless the options with this prefix say otherwise. The matrix is shared with the solver and not
/// yet factorised.
OwnedKSP directSolver(Mat matrix, const SolverPrefix& prefix);
/// Collective. Calls KSPSetUp. Returns the reason if the factorisation fails, otherwise nothing.
/// Throws Error if its analysis foresees more memory than there is, or if PETSc refuses an option
/// of the solver.
std::string factorise(KSP solver);
/// Returns the factor, borrowed from the solver, factorised or not; null if the options ask for
/// another preconditioner.
MumpsFactor* mumpsFactor(KSP solver);

/// A SymmetricSolver is the direct solver of a symmetric positive definite matrix (prefix
/// -modes_st_). It factorises the matrix on first use.
class SymmetricSolver {
 public:
  /// Borrows the matrix during the life of the object; `name` stands for it in messages.
  SymmetricSolver(Mat matrix, std::string name) : matrix_(matrix), name_(std::move(name)) {}
  /// Collective. Returns the solver, factorised, borrowed from this object. An EPS that has used
  /// the solver leaves it with other operators; call get() again after it. Throws Error if the
  /// factorisation fails.
  KSP get() const;

 private:
  void factorise() const;
  Mat matrix_;
  std::string name_;
  mutable OwnedKSP solver_;
};

/// Collective. Returns the memory in bytes, summed over all ranks, that MUMPS foresees for the LDLᵀ
/// factorisation of a symmetric matrix. Only the pattern is analysed; nothing is factorised.
double factorMemory(Mat matrix);

/// Collective. Throws Error for unused -modes_st_* options: once a solver has been configured,
/// these are typing errors.
void rejectUnusedSolverOptions();

/// Collective. Factorises K − σ M of symmetric matrices, so that its inertia, the number of
/// eigenvalues of (K, M) below σ, is known, by the options of SymmetricSolver. K − σ M itself is
/// kept no longer than its entries take to be handed over. `like` is a factorised solver of a
/// matrix of the same distribution, whose order of elimination is taken, or null. Throws Error if
/// it fails.
std::unique_ptr<MumpsFactor> shiftedFactor(Mat k, Mat m, double sigma, KSP like = nullptr);

/// Collective. Returns the inertia of a symmetric matrix from the signs of the pivots of an LDLᵀ
/// factorisation (Sylvester's law of inertia, [M.25]), by the options of SymmetricSolver. Pivots
/// below `zero` times the norm of the scaled matrix count as zero; with 0, MUMPS decides (about
/// 1e-21). Throws Error if the factorisation fails, or if MUMPS foresees more than twice the memory
/// that is free.
Inertia inertia(Mat matrix, double zero = 0);

}  // namespace squeal::factor
