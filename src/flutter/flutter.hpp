#pragma once
/// The friction-perturbed eigenproblem (paper, section 4): which modes flutter, at which friction, how fast they grow.
#include <complex>
#include <vector>

#include "contact/coupled.hpp"
#include "flutter/pencil.hpp"
#include "modes/modes.hpp"

namespace squeal::flutter {

struct Eigenvalue {
  std::complex<double> s;    ///< growth rate + i angular frequency, 1/s
  double backwardError = 0;  ///< of the full-order problem
  bool unstable = false;     ///< Re s > -flutter_unstable_tolerance · |s|
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
  int unstableCount() const;
  double worstBackwardError() const;
};

/// Frictions asked for, in the order given. Error: an empty list, a negative value.
std::vector<double> frictions();
/// `-flutter_method`: true for the direct solve on all unknowns.
bool directWanted();

/// The terms of [4.15–4.16] under approximation A: K0 + f K1 + s² (M0 + f M1).
Pencil approximationA(const contact::AssociatedSystem& system);

/// Rayleigh–Ritz on a basis [4.19]: the projections of all terms are made once, then each friction is a dense problem.
class ReducedProblem {
 public:
  /// Collective. Borrows pencil and basis for its life.
  ReducedProblem(const Pencil& pencil, BV basis);
  /// Collective. Shapes are mapped to nodal displacements by `trial` (T).
  FrictionPoint solve(double friction, Mat trial) const;

 private:
  std::vector<double> projected(int power, double friction) const;
  const Pencil& pencil_;
  BV basis_;
  std::vector<OwnedBV> images_;                     // [term] A_t V
  std::vector<std::vector<double>> projections_;    // [term] Vᵀ A_t V, column-major
};

/// Collective. The lowest `-flutter_direct_count` eigenvalues of the problem on all unknowns, without reduction: SLEPc EPS in −s², shift-and-invert
/// (-flutter_eps_*, -flutter_st_*). Error: the pencil has damping; not converged.
FrictionPoint solveDirect(const Pencil& pencil, double friction, Mat trial);

}  // namespace squeal::flutter
