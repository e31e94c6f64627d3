// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The eigenvalues nearest to zero of the problem in all unknowns, by SLEPc.
#include <memory>
#include <string>
#include <vector>

#include "algebra/linalg/complexvector.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/pencil/settings.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::direct {

/// An eigenvalue and its right vector, which has the 2-norm 1. The imaginary part of a real vector
/// is zero.
struct NearestPair : linalg::ComplexVector {
  Complex s;
};

/// Eigenvalues found near zero.
struct NearestPairs {
  std::vector<NearestPair> pairs;  ///< with Im s ≥ 0
  double reached = 0;  ///< |s| up to which no eigenvalue is missing, 1/s; may be infinite
};

/// A solver for the eigenvalues nearest to zero at one point of the sweep.
class NearestSolver {
 public:
  /// Collective. Assembles the matrix of each power of s at this point.
  NearestSolver(const pencil::Pencil& pencil, const sweep::Parameters& at);
  virtual ~NearestSolver() = default;
  /// Collective. Returns at least the `count` eigenvalues nearest to zero, or all if there are
  /// fewer. A conjugate pair counts once. Each call uses another start vector and the same
  /// factorisation. If the Krylov space of a small problem would be the whole space, LAPACK solves
  /// the problem instead. Throws Error if SLEPc does not converge, or if LAPACK fails inside SLEPc
  /// for several start vectors.
  NearestPairs solve(PetscInt count);

 protected:
  MPI_Comm comm() const;
  sweep::Parameters at_;
  OwnedMat terms_[3];  // [power of s]
  PetscInt size_ = 0;

 private:
  /// Collective. Sets up SLEPc's solver for `count` eigenvalues and this start vector.
  virtual void prepare(PetscInt count, Vec start) = 0;
  /// Collective. Runs SLEPc's solver and returns its error code.
  virtual PetscErrorCode run() = 0;
  /// Collective. Destroys SLEPc's solver; prepare() makes another one.
  virtual void discard() = 0;
  /// Collective. Returns the results of SLEPc's solver. Throws Error if fewer than `count`
  /// eigenvalues have converged.
  virtual NearestPairs collected(PetscInt count) = 0;
  NearestPairs krylov(PetscInt count);
  /// Collective. Runs SLEPc's solver. Returns an empty text on success. If LAPACK fails, destroys
  /// SLEPc's solver and returns its message.
  std::string lapackFailure();
  NearestPairs whole() const;
  int runs_ = 0;  // number of start vectors used so far
};

/// Collective. Returns a solver with shift-and-invert at zero: if there is no damping, an EPS in
/// μ = −s² [M.40] (-flutter_eps_*), otherwise the PEP solver TOAR (-flutter_pep_*). The options
/// -flutter_st_* configure the factorisation of both solvers.
std::unique_ptr<NearestSolver> nearestSolver(const pencil::Pencil& pencil,
                                             const sweep::Parameters& at);

/// Collective. `found` is the result of solver.solve(count). Repeats the solve from other start
/// vectors and adds the new pairs to `found`, until a solve finds no new pair. A Krylov space from
/// one vector contains only one vector of a multiple eigenvalue, except for round-off. A pair is
/// new if its vector is not in the span of known vectors with nearly the same s.
void addMissing(NearestSolver& solver, PetscInt count, NearestPairs& found);

/// Throws Error if -flutter_eps_*, -flutter_pep_* or -flutter_st_* options are given without the
/// direct method, which is the only one that uses them.
void rejectIdleSolverOptions(pencil::Method method);

}  // namespace squeal::direct
