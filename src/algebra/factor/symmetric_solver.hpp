// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Solvers and inertia of symmetric matrices by LDLᵀ factorisations with MUMPS.
#include <memory>
#include <string>

#include "algebra/factor/mumps.hpp"
#include "base/options/options.hpp"
#include "base/petsc/owned.hpp"

namespace squeal::factor {

/// The prefix of the options of all factorisations of symmetric matrices.
inline constexpr char solverPrefix[] = "modes_st_";

/// Collective. Returns a direct solver (KSPPREONLY) with the LDLᵀ factorisation of MUMPS, unless
/// options with this prefix select another solver. The solver shares the matrix and does not
/// factorise it yet.
OwnedKSP directSolver(Mat matrix, const SolverPrefix& prefix);
/// Collective. Calls KSPSetUp, which factorises the matrix. Returns the reason if this fails, or an
/// empty text on success. Throws Error if MUMPS estimates more than twice the free memory, or if
/// PETSc rejects an option of the solver.
std::string factorise(KSP solver);
/// Returns the factor of the solver, borrowed, whether or not it is factorised yet; null if the
/// options select another preconditioner.
MumpsFactor* mumpsFactor(KSP solver);

/// The direct solver of a symmetric positive definite matrix (prefix -modes_st_). It factorises the
/// matrix on first use.
class SymmetricSolver {
 public:
  /// Borrows the matrix during the lifetime of the object. Messages refer to it by `name`.
  SymmetricSolver(Mat matrix, std::string name) : matrix_(matrix), name_(std::move(name)) {}
  /// Collective. Returns the factorised solver, borrowed. An EPS that uses the solver changes the
  /// solver's operators, so call get() again afterwards. Throws Error if the factorisation fails.
  KSP get() const;

 private:
  void factorise() const;
  Mat matrix_;
  std::string name_;
  mutable OwnedKSP solver_;
};

/// The size of an LDLᵀ factorisation by MUMPS, summed over all ranks.
struct FactorSize {
  double bytes = 0;       ///< memory of the factorisation, factor included
  double entries = 0;     ///< number of entries of the factor
  double operations = 0;  ///< floating-point operations of the factorisation
};

/// Collective. Returns MUMPS's estimates for the factorisation of a symmetric matrix. Only the
/// pattern of the matrix is analysed.
FactorSize factorSize(Mat matrix);

/// Collective. Throws Error for unused options -modes_st_*. Call it after the solver is configured:
/// an option that is still unused then is misspelled.
void rejectUnusedSolverOptions();

/// Collective. Factorises K − σ M for symmetric K and M, with the options of SymmetricSolver. The
/// inertia of the factor gives the number of eigenvalues of (K, M) below σ. The matrix K − σ M is
/// destroyed once MUMPS has its entries. `like` is null, or a factorised solver of a matrix with
/// the same distribution; its elimination order is then reused. Throws Error on failure.
std::unique_ptr<MumpsFactor> shiftedFactor(Mat k, Mat m, double sigma, KSP like = nullptr);

/// Collective. Returns the inertia of a symmetric matrix from the signs of the pivots of an LDLᵀ
/// factorisation (Sylvester's law of inertia, [M.25]), with the options of SymmetricSolver. Pivots
/// smaller than `zero` times the norm of the scaled matrix are treated as zero; if `zero` is 0,
/// MUMPS chooses the factor (about 1e-21). Throws Error if the factorisation fails, or if MUMPS
/// estimates more than twice the free memory.
Inertia inertia(Mat matrix, double zero = 0);

}  // namespace squeal::factor
