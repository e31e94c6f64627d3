#pragma once
/// The friction-perturbed eigenproblem (paper, section 4): which modes flutter, at which friction, how fast they grow.
#include <complex>
#include <functional>
#include <optional>
#include <vector>

#include "contact/coupled.hpp"
#include "flutter/basis.hpp"
#include "flutter/dense.hpp"
#include "flutter/family.hpp"
#include "flutter/images.hpp"
#include "flutter/pencil.hpp"
#include "flutter/terms.hpp"
#include "modes/modes.hpp"

namespace squeal::flutter {

struct Eigenvalue {
  std::complex<double> s;    ///< growth rate + i angular frequency, 1/s
  double backwardError = 0;  ///< of the full-order problem
  bool unstable = false;     ///< Re s > -flutter_unstable_tolerance · |s|
  bool inBand = true;        ///< corrected; false: above the band, of the plain modal projection
};

/// A complex mode d = real + i imaginary in nodal displacements, N entries, largest entry 1.
struct Shape {
  std::size_t index;  ///< into Point::eigenvalues
  OwnedVec real, imaginary;
};

/// Everything found at one point of the sweep.
struct FrictionPoint {
  Parameters at;
  std::vector<Eigenvalue> eigenvalues;  ///< Im s ≥ 0, by ascending frequency
  std::vector<Shape> shapes;            ///< of the fastest growing ones
  double bandTop = 0;                   ///< rad/s: eigenvalues with |s| up to here are corrected to `accuracy`; 0: none are
  double accuracy = 0;                  ///< backward error asked for in the band
  double askedTo = 0;                   ///< rad/s: upper end of `-flutter_direct_band`; 0: no such band
  double coveredTo = 0;       ///< rad/s: all eigenvalues of `-flutter_direct_band` with |s| below are listed; 0: no such band
  int unstableCount() const;  ///< in the band
  int unstableAbove() const;  ///< above it
  int bandCount() const;
  double worstBackwardError() const;  ///< in the band
};

/// The sweep is the grid of `-flutter_friction` × `-flutter_speed` × `-flutter_pressure` × `-flutter_damping`. Damping leaves steady
/// sliding as it is, so that a steady state belongs to all its damping factors.
struct Sweep {
  std::vector<double> frictions, speeds, pressures, dampings;  ///< ascending
  /// Steady states, damping 1: for each speed, each pressure, all frictions.
  std::vector<Parameters> steadyPoints() const;
  /// All points: for each damping, all steady states.
  std::vector<Parameters> points() const;
  /// Index of a steady state that differs in one parameter by one step, and comes earlier; none for the first.
  std::optional<std::size_t> earlierNeighbour(std::size_t steadyPoint) const;
};

/// Error: an empty list, a value out of range or given twice.
Sweep readSweep();
/// `-flutter_method`: true for the direct solve on all unknowns.
bool directWanted();

/// Collective. Error for -flutter_eps_*, -flutter_pep_* and -flutter_st_* options where the direct method, which alone uses them, is
/// not asked for, and for modal damping where it is.
void rejectIdleSolverOptions();

/// Rayleigh–Ritz [4.19] on the free modes and, unless `-reduction_basis modal`, on corrections of its own residuals. The modes
/// alone miss unstable eigenvalues and invent others; K0⁻¹ r for the residuals r of all pairs of the band, solved for together
/// with the real symmetric factorisation that the modes used, brings the full-order backward error of the whole band below
/// `-flutter_accuracy`, about a decade a round. The basis is kept over a sweep. As many eigenvalues as there are modes are
/// reported.
class ReducedProblem {
 public:
  /// Collective. Borrows pencil, mass M0 and the solver of K0 for its life; `modes` are M0-orthonormal with ascending frequencies.
  ReducedProblem(const Pencil& pencil, Mat mass, KSP solver, const modes::Modes& modes);
  /// Collective. The point whose terms the pencil holds. Shapes are mapped to nodal displacements by `trial` (T).
  FrictionPoint solve(const Parameters& at, Mat trial);
  PetscInt basisSize() const { return basis_.size(); }
  WatchedBand band() const;  ///< top 0: none
  /// Collective. Enters the terms that the pencil holds for a point.
  void enter();
  /// Collective. The problem at a point whose terms are entered, in the whole basis.
  DenseProblem projected(const Parameters& at) const;
  /// Collective. Adds corrections of the residuals of these pairs, of any points, all solved for together; `enterTerms(at)` sets and
  /// enters the terms of a point.
  Improvement improve(const std::vector<std::pair<Parameters, std::vector<DensePair>>>& located,
                      const std::function<void(const Parameters&)>& enterTerms);

 private:
  struct Residuals;
  struct ProjectedTerm {
    Image image;             // A V
    DenseMatrix projection;  // Vᵀ A V, column-major
    PetscInt columns = 0;    // of V held so far
  };
  void extend();
  void project(Mat matrix, ProjectedTerm& term) const;
  Residuals residuals(const Parameters& at, const std::vector<DensePair>& pairs) const;
  double length(const std::vector<std::complex<double>>& q) const;
  void expand(const DensePair& pair, Vec real, Vec imaginary) const;
  bool inBand(std::complex<double> s) const;
  DenseMatrix directions(const Residuals& residuals, const std::vector<std::size_t>& bad) const;
  void correct(const Residuals& residuals, const std::vector<std::size_t>& bad);
  std::vector<double> projected(int power, const Parameters& at, PetscInt columns) const;
  std::vector<DensePair> dense(const Parameters& at, PetscInt columns) const;

  const Pencil& pencil_;
  KSP solver_;
  PetscInt unknowns_ = 0;
  Basis basis_;
  std::vector<ProjectedTerm> images_;  // [term]
  DenseMatrix gram_;                   // VᵀV
  PetscInt gramSize_ = 0;
  std::size_t modeCount_ = 0;
  double bandTop_ = 0;
};

/// Collective. Eigenvalues of the problem on all unknowns, without reduction, by SLEPc with shift-and-invert at zero: the
/// `-flutter_direct_count` nearest to zero, or all of `-flutter_direct_band` (low ≤ Im s ≤ high, |s| ≤ high), as far as
/// `-flutter_direct_limit` of them reach. Error: a band that is none; not converged.
FrictionPoint solveDirect(const Pencil& pencil, const Parameters& at, Mat trial);

}  // namespace squeal::flutter
