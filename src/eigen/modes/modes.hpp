// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The free modes: undamped vibrations with closed contact and without friction, of the associated
/// system (associated_system.hpp) [4.17],
///   (K0 − ω² M0) d = 0.
/// They are the first vectors of the basis of the reduced problem.
#include <string>
#include <vector>

#include "algebra/factor/associated_system.hpp"
#include "base/petsc/owned.hpp"
#include "eigen/modes/settings.hpp"

namespace squeal::modes {

/// The lowest free modes.
struct Modes {
  std::vector<double> lambda;            ///< ω², ascending, rad²/s²
  std::vector<double> angularFrequency;  ///< ω, rad/s
  std::vector<double> relativeResidual;  ///< [mode] ‖K0 d − ω² M0 d‖ / (ω² ‖M0 d‖)
  OwnedBV vectors;                       ///< n × count, M0-orthonormal
  int iterations = 0;                    ///< restarts of the eigensolver; 0 with LAPACK
  /// True if the inertia of K0 − σ M0 [M.25] confirms the number of modes below σ; false without
  /// `-modes_sturm`.
  bool countConfirmed = false;
  int inertiaCount = 0;     ///< number of eigenvalues of (K0, M0) below σ
  double inertiaShift = 0;  ///< σ, in a gap between two modes, rad²/s²
  /// The largest relative error of a λ that round-off in the entries of K0 may cause [M.26].
  double rounding = 0;
};

/// A count of modes by the inertia.
struct TopCount {
  double shift = 0;     ///< rad²/s²
  int below = 0;        ///< number of eigenvalues of (K0, M0) below the shift
  bool agrees = false;  ///< true if `below` equals the number of known modes below the shift
};
/// Collective. Counts the modes below the widest gap among the ten highest modes, by a
/// factorisation. `modes` must not be empty.
TopCount countAtTop(const factor::AssociatedSystem& system, const Modes& modes);

/// The name of a computation of modes in the log.
struct Label {
  std::string stage = "modes";
  std::string subject = "";  ///< text at the beginning of the result in the stage's line
};

/// Collective. Returns the lowest modes by block Lanczos or SLEPc EPS (-modes_eps_*, -modes_st_*).
/// If no option selects a solver, the program chooses. It uses LAPACK if most modes of a small
/// problem are requested, and also if EPS has missed modes of a problem with at most 2000 unknowns.
/// An unconfirmed number of modes is not an error. Throws Error if more modes are requested than
/// there are unknowns with mass, if the solver does not converge, or if an eigenvalue is not
/// positive within round-off.
Modes compute(const factor::AssociatedSystem& system, const Settings& settings,
              const Label& label = {});

}  // namespace squeal::modes
