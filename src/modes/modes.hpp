#pragma once
/// Free vibration of the ideal associated system [4.17]: (K0 − ω² M0) d = 0, symmetric: the basis of the reduced problem.
#include <vector>

#include "contact/coupled.hpp"

namespace squeal::modes {

struct Modes {
  std::vector<double> lambda;            ///< ω², ascending, rad²/s²
  std::vector<double> angularFrequency;  ///< ω, rad/s
  std::vector<double> relativeResidual;  ///< ‖K d − ω² M d‖ / (ω² ‖M d‖)
  OwnedBV vectors;                       ///< n × count, M0-orthonormal
  int iterations = 0;                    ///< restarts of the eigensolver
  bool countConfirmed = false;           ///< the number below the highest mode agrees with the inertia of K − σ M (Sturm)
  int inertiaCount = 0;                  ///< eigenvalues of (K0, M0) below σ
  double inertiaShift = 0;               ///< σ, rad²/s²
};

/// Collective. The lowest `-modes_count` modes by block Lanczos or SLEPc EPS (-modes_solver, -modes_eps_*, -modes_st_*). Error:
/// more modes wanted than there are unknowns; not converged.
Modes compute(const contact::AssociatedSystem& system);

}  // namespace squeal::modes
