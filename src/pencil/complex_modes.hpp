#pragma once
/// The friction-perturbed eigenproblem (paper, section 4): which modes flutter, at which friction, how fast they grow.
#include <complex>
#include <limits>
#include <optional>
#include <vector>

#include "contact/coupled.hpp"
#include "flutter/terms.hpp"
#include "linalg/dense.hpp"
#include "linalg/images.hpp"
#include "modes/modes.hpp"
#include "pencil/pencil.hpp"
#include "reduction/basis.hpp"
#include "sensitivity/left.hpp"
#include "sensitivity/sensitivity.hpp"

namespace squeal::flutter {

struct Eigenvalue {
  std::complex<double> s;    ///< growth rate + i angular frequency, 1/s
  double backwardError = 0;  ///< of the full-order problem
  double errorEstimate = 0;  ///< of |δs|/|s|; NaN where there is none (direct method)
  bool certified = false;    ///< both are as small as asked for
  bool unstable = false;     ///< Re s > -flutter_unstable_tolerance · |s|
};

/// A complex mode d = real + i imaginary in nodal displacements, N entries, largest entry 1.
struct Shape {
  std::size_t index;  ///< into Point::eigenvalues
  OwnedVec real, imaginary;
  ComplexVector unknowns;            ///< the same d in the unknowns x
  std::vector<double> frictionWork;  ///< [owned contact node] what friction there adds to the growth rate, 1/s: frictionWork()
};

/// Everything found at one point of the sweep.
struct FrictionPoint {
  Parameters at;
  std::vector<Eigenvalue> eigenvalues;     ///< Im s ≥ 0, by ascending frequency
  std::vector<Shape> shapes;               ///< of the fastest growing ones
  std::vector<Sensitivity> sensitivities;  ///< [shape]; empty unless `-flutter_sensitivities`
  double bandTop = 0;                      ///< rad/s: eigenvalues with |s| up to here are listed, and corrected; 0: none are
  int freeModesInBand = 0;                 ///< free modes up to bandTop
  bool damped = false;                     ///< the problem has terms in s
  double accuracy = 0;                     ///< backward error asked for
  double tolerance = 0;                    ///< estimate of |δs|/|s| asked for
  double askedTo = 0;                      ///< rad/s: upper end of `-flutter_direct_band`; 0: no such band
  double coveredTo = 0;  ///< rad/s: all eigenvalues of `-flutter_direct_band` with |s| below are listed; 0: no such band
  /// Of a damped problem, the free modes of the band that no eigenvalue listed answers to: those are damped too strongly to be
  /// listed, or have been moved beyond the top.
  int modesWithoutEigenvalue() const;
  int unstableCount() const;
  int uncertifiedCount() const;
  double worstBackwardError() const;
  double worstErrorEstimate() const;
  /// Null if there are no eigenvalues.
  const Eigenvalue* fastestGrowing() const;
};

/// The sweep is the grid of `-flutter_friction` × `-flutter_speed` × `-flutter_pressure` × `-flutter_damping`. Damping leaves steady
/// sliding as it is, so that a steady state belongs to all its damping factors.
struct Sweep {
  std::vector<double> frictions, speeds, pressures, dampings;  ///< ascending
  /// Steady states, damping 1: for each speed, each pressure, all frictions.
  std::vector<Parameters> steadyPoints() const;
  /// All points: for each damping, all steady states.
  std::vector<Parameters> points() const;
  /// The number of points.
  double pointCount() const;
  /// Index of a steady state that differs in one parameter by one step, and comes earlier; none for the first.
  std::optional<std::size_t> earlierNeighbour(std::size_t steadyPoint) const;
};

/// Error: an empty list, a value out of range or given twice, more than `mostPoints` points in all.
Sweep readSweep();
inline constexpr double mostPoints = 100'000;
/// Collective. A warning where the points are so many that their eigenvalue problems take long, with an estimate.
void warnOfLongSweep(MPI_Comm comm, const Sweep& sweep, int modes);
/// Indices of points in the order in which one basis serves them best, in batches of 5, 16, 16, … points: the largest friction
/// first, then whatever lies farthest from the points before: of a sweep over friction alone the ends, the middle and the quarters. The
/// same on any number of ranks.
std::vector<std::vector<std::size_t>> batches(const std::vector<Parameters>& points);
/// `-flutter_method`: true for the direct solve on all unknowns.
bool directWanted();

/// Collective. Error for -flutter_eps_*, -flutter_pep_* and -flutter_st_* options where the direct method, which alone uses them, is
/// not asked for, and for modal damping where it is.
void rejectIdleSolverOptions();

/// Collective. Eigenvalues of the problem on all unknowns, without reduction, by SLEPc with shift-and-invert at zero: the
/// `-flutter_direct_count` nearest to zero, or all of `-flutter_direct_band` (low ≤ Im s ≤ high, |s| ≤ high), as far as
/// `-flutter_direct_limit` of them reach. Error: a band that is none; not converged.
FrictionPoint solveDirect(const Pencil& pencil, const Parameters& at, Mat trial);

}  // namespace squeal::flutter
