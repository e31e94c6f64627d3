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

/// Options of the free modes.
struct Options {
  enum class Solver { automatic, blockLanczos, eps };
  int count;         ///< `-modes_count`
  bool countGiven;   ///< a count that is not the default must not exceed the number of unknowns
  Solver solver;     ///< `-modes_solver`; eps where a -modes_eps_* option is given
  int blockSize;     ///< `-modes_block_size`
  double tolerance;  ///< `-modes_tolerance`
  bool sturm;        ///< `-modes_sturm`
  /// Reads the options.
  static Options given();
};

/// Returns the option `-modes_count`.
int wantedCount();

/// Collective. Returns the lowest modes by block Lanczos or SLEPc EPS (-modes_eps_*, -modes_st_*),
/// or by LAPACK where most of the modes of a small problem are wanted. Throws Error if more modes
/// are wanted than there are unknowns, if the solver does not converge, or if an eigenvalue is not
/// positive or could have been made by rounding.
Modes compute(const AssociatedSystem& system, const Options& options = Options::given());
/// Does the same for `count` modes, with the other options as they are given.
Modes compute(const AssociatedSystem& system, int count);

}  // namespace squeal::modes
