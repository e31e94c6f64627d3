#pragma once
/// Free vibration of the ideal associated system [4.17]: (K0 − ω² M0) d = 0, symmetric: the basis
/// of the reduced problem.
#include <vector>

#include "modes/associated.hpp"
#include "petsc/owned.hpp"

namespace squeal::modes {

struct Modes {
  std::vector<double> lambda;            ///< ω², ascending, rad²/s²
  std::vector<double> angularFrequency;  ///< ω, rad/s
  std::vector<double> relativeResidual;  ///< ‖K d − ω² M d‖ / (ω² ‖M d‖)
  OwnedBV vectors;                       ///< n × count, M0-orthonormal
  int iterations = 0;                    ///< restarts of the eigensolver
  /// The number below the highest mode agrees with the inertia of K − σ M (Sturm)
  bool countConfirmed = false;
  int inertiaCount = 0;     ///< eigenvalues of (K0, M0) below σ
  double inertiaShift = 0;  ///< σ, rad²/s²
  /// Largest relative error that rounding of the entries of K0 may make in a λ
  double rounding = 0;
};

/// `-modes_count`.
int wantedCount();

/// Collective. The lowest `count` modes by block Lanczos or SLEPc EPS (-modes_solver, -modes_eps_*,
/// -modes_st_*), or by LAPACK where most of the modes of a small problem are wanted. Error: more
/// modes wanted than there are unknowns; not converged; an eigenvalue that is not positive, or that
/// rounding could have made.
Modes compute(const AssociatedSystem& system, int count = wantedCount());

}  // namespace squeal::modes
