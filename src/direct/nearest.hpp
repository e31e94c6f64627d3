#pragma once
/// The eigenvalues nearest to zero of the problem on all unknowns, by SLEPc.
#include <complex>
#include <memory>
#include <vector>

#include "linalg/complexvector.hpp"
#include "pencil/pencil.hpp"
#include "sweep/parameters.hpp"

namespace squeal::direct {

/// The vector has 2-norm 1; its imaginary part is zero for a real one.
struct NearestPair : linalg::ComplexVector {
  std::complex<double> s;
};

struct NearestPairs {
  std::vector<NearestPair> pairs;  ///< Im s ≥ 0
  double reached = 0;  ///< all eigenvalues with |s| below are among them; infinite: all there are
};

class NearestSolver {
 public:
  /// Collective. Assembles the terms.
  NearestSolver(const pencil::Pencil& pencil, const sweep::Parameters& at);
  virtual ~NearestSolver() = default;
  /// Collective. At least the `count` eigenvalues nearest to zero, conjugate pairs counted once.
  /// Each call begins with another vector and keeps the factorisation. Where the Krylov space would
  /// be the whole space, LAPACK is called instead. Error: not converged.
  NearestPairs solve(PetscInt count);

 protected:
  virtual NearestPairs krylov(PetscInt count) = 0;
  sweep::Parameters at_;
  OwnedMat terms_[3];  // [power of s]
  PetscInt size_ = 0;
  int runs_ = 0;

 private:
  NearestPairs whole() const;
};

/// Collective. Shift-and-invert at zero: EPS in −s² if there is no damping (-flutter_eps_*),
/// otherwise TOAR, a PEP solver
/// (-flutter_pep_*); the factorisation is configured by -flutter_st_* in both.
std::unique_ptr<NearestSolver> nearestSolver(const pencil::Pencil& pencil,
                                             const sweep::Parameters& at);

/// Collective. A Krylov space begun with one vector holds one vector of a multiple eigenvalue; the
/// others come from rounding, or do not. `found`, the result of solver.solve(count), is joined by
/// what is new in further solves from other starts, until one brings nothing new. New is a vector
/// that is not in the span of those already known with nearly the same s.
void addMissed(NearestSolver& solver, PetscInt count, NearestPairs& found);

}  // namespace squeal::direct
