#pragma once
/// The friction-perturbed eigenproblem (paper, section 4): which modes flutter, at which friction, how fast they grow.
#include <complex>
#include <vector>

#include "contact/coupled.hpp"
#include "flutter/basis.hpp"
#include "flutter/dense.hpp"
#include "flutter/images.hpp"
#include "flutter/pencil.hpp"
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

/// Everything found at one friction.
struct FrictionPoint {
  double friction = 0;
  std::vector<Eigenvalue> eigenvalues;  ///< Im s ≥ 0, by ascending frequency
  std::vector<Shape> shapes;            ///< of the fastest growing ones
  double bandTop = 0;                   ///< rad/s: eigenvalues up to here are corrected to `accuracy`; 0: none are
  double accuracy = 0;                  ///< backward error asked for in the band
  int unstableCount() const;            ///< in the band
  int unstableAbove() const;            ///< above it
  int bandCount() const;
  double worstBackwardError() const;  ///< in the band
};

/// Frictions asked for, ascending. Error: an empty list, a negative value, a value given twice.
std::vector<double> frictions();
/// `-flutter_method`: true for the direct solve on all unknowns.
bool directWanted();

/// Collective. Error for -flutter_eps_* and -flutter_st_* options where the direct method, which alone uses them, is not asked for.
void rejectIdleSolverOptions();

/// The terms of [4.15–4.16] under approximation A: K0 + f K1 + s² (M0 + f M1).
Pencil approximationA(const contact::AssociatedSystem& system);

/// Rayleigh–Ritz [4.19] on the free modes and, unless `-reduction_basis modal`, on corrections of its own residuals. The modes
/// alone miss unstable eigenvalues and invent others; K0⁻¹ r for the residuals r of all pairs of the band, solved for together
/// with the real symmetric factorisation that the modes used, brings the full-order backward error of the whole band below
/// `-flutter_accuracy`, about a decade a round. The basis is kept over a sweep. As many eigenvalues as there are modes are
/// reported.
class ReducedProblem {
 public:
  /// Collective. Borrows pencil and solver (of K0) for its life; `modes` are M0-orthonormal with ascending frequencies.
  ReducedProblem(const Pencil& pencil, const contact::AssociatedSystem& system, const modes::Modes& modes);
  /// Collective. Shapes are mapped to nodal displacements by `trial` (T).
  FrictionPoint solve(double friction, Mat trial);
  PetscInt basisSize() const { return basis_.size(); }
  int solves() const { return solves_; }       ///< right-hand sides solved for so far
  double bandTop() const { return bandTop_; }  ///< rad/s

 private:
  struct Residuals;
  void extend();
  Residuals residuals(double friction, const std::vector<DensePair>& pairs) const;
  double length(const std::vector<std::complex<double>>& q) const;
  void correct(const Residuals& residuals, const std::vector<std::size_t>& bad);
  std::vector<double> projected(int power, double friction, PetscInt columns) const;
  std::vector<DensePair> dense(double friction, PetscInt columns) const;

  const Pencil& pencil_;
  const contact::AssociatedSystem& system_;
  Basis basis_;
  std::vector<Image> images_;                     // [term] A_t V
  std::vector<std::vector<double>> projections_;  // [term] Vᵀ A_t V, column-major
  std::vector<double> gram_;                      // VᵀV
  PetscInt projected_ = 0;                        // columns of the basis that images and projections hold
  std::size_t modeCount_ = 0;
  double bandTop_ = 0;
  int solves_ = 0;
};

/// Collective. The lowest `-flutter_direct_count` eigenvalues of the problem on all unknowns, without reduction: SLEPc EPS in −s²,
/// shift-and-invert (-flutter_eps_*, -flutter_st_*). Error: the pencil has damping; not converged.
FrictionPoint solveDirect(const Pencil& pencil, double friction, Mat trial);

}  // namespace squeal::flutter
