// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Periodic motions of the reduced model by shooting, and their Floquet multipliers [M.77]. In a
/// real brake, only stable motions persist.
#include <functional>
#include <memory>
#include <vector>

#include "algebra/linalg/complex.hpp"
#include "regime/cycles/passage.hpp"

namespace squeal::cycles {

/// A direction in the unknowns (q, v, period, friction), each multiplied by a scale that gives it
/// the unit √J. The scale of q is the angular frequency; v needs no scale, since its unit is √J.
/// The scale of the period is the norm of the motion divided by the period; that of the friction is
/// the norm divided by max(friction, 0.001).
using Direction = std::vector<double>;

/// Floquet multipliers: the factors by which disturbances of a periodic motion grow in a period.
struct Multipliers {
  std::vector<Complex> values;  ///< by descending modulus
  /// Index of the multiplier that belongs to a shift in time, identified by its eigenvector. This
  /// multiplier is 1 except for the error of the time integration.
  std::size_t trivial = 0;
};

/// The equations of a periodic motion, linearised about an orbit:
///   (M − 1) δx + ∂x(T)/∂T δT + ∂x(T)/∂f δf = −(x(T) − x),   ẋᵀ δx = 0,   and δf = 0 or tᵀδ = 0.
/// The last equation is tᵀδ = 0 if a tangent t of the branch is given, where δ is the Direction of
/// the changes. x consists of q and v, scaled as in Direction, and of the slip displacements of the
/// nodes that stick at the start of the period. These are entries of z, the boundary of the reduced
/// model (march::ReducedModel). M is the monodromy matrix.
class Linearisation {
 public:
  /// Collective.
  Linearisation(const Period& period, const Orbit& at);
  const Monodromy& monodromy() const { return monodromy_; }

  /// A change of the unknowns, and the resulting change of z at the end of a period.
  struct Step {
    Direction direction;
    std::vector<double> stuck;  ///< changes of the slips of nodes that stick at the start, m
    std::vector<double> z;      ///< m
  };
  /// Not collective. Returns the step that makes the end of a period equal to its start, to first
  /// order. The step is orthogonal to the tangent; if `tangent` is empty, the step leaves the
  /// friction unchanged.
  Step step(const InitialState& start, const InitialState& end, const Direction& tangent) const;
  /// Not collective. Returns the tangent of the branch, with unit 2-norm, oriented along `near`.
  Direction tangent(const Direction& near) const;
  /// Returns the change of the friction per unit step along a direction; the length of a step has
  /// the unit √J.
  double frictionAlong(const Direction& direction) const {
    return direction.back() / frictionScale_;
  }
  /// Not collective. Returns the eigenvalues of the monodromy matrix.
  Multipliers multipliers() const;
  /// Returns the orbit plus a factor times the direction.
  Orbit along(const Orbit& orbit, const Direction& direction, double factor) const;
  /// Returns the orbit plus a factor times the step; `end` is the end of a period.
  Orbit changed(const Orbit& orbit, const InitialState& end, const Step& step, double factor) const;

 private:
  /// The derivative of the end of a period with respect to the period or the friction.
  struct EndDerivative {
    std::vector<double> x;  // scaled, [entry of x]
    std::vector<double> z;  // of all z
  };
  EndDerivative derivative(const Period& period, const Orbit& at, double Orbit::*parameter,
                           double scale) const;
  std::vector<double> phase(const Period& period, const Orbit& at) const;
  std::vector<double> solve(std::vector<double> right, const Direction& last) const;
  PetscInt modes() const { return std::ssize(frequency_); }

  Monodromy monodromy_;
  std::vector<double> frequency_;       // √Λ, [mode]
  std::vector<double> scale_;           // [entry of x] factor from its own unit to √J
  double periodScale_, frictionScale_;  // factors from period and friction to √J
  EndDerivative byPeriod_, byFriction_;
  std::vector<double> phase_;  // ẋ, scaled, [entry of x]
};

/// The result of Newton's method.
struct ShootingResult {
  Orbit orbit;
  bool converged = false;
  int derivatives = 0;  ///< number of linearisations
  double change = 0;    ///< relative difference of end and start, change() of passage.hpp
  Measures measures;
  std::shared_ptr<const Linearisation> linearisation;  ///< about the orbit; null unless converged
};

/// The state of Newton's method.
struct Iteration {
  double change = 0;    ///< relative difference of end and start, change() of passage.hpp
  int derivatives = 0;  ///< number of linearisations so far
};
/// Called on all ranks before each linearisation and after each step.
using Progress = std::function<void(const Iteration&)>;

struct ShootingRequest {
  double tolerance = 0;    ///< largest change() of a periodic motion
  Progress progress = {};  ///< empty: none
  /// If given, the friction is an unknown too, and the steps are orthogonal to this tangent.
  Direction tangent = {};
  /// A linearisation about a nearby orbit, for reuse; null: none.
  std::shared_ptr<const Linearisation> linearisation = nullptr;
};

/// Collective. Computes a periodic motion by Newton's method from the nearly periodic motion
/// `guess`.
ShootingResult shoot(const Period& period, const Orbit& guess, const ShootingRequest& request);

}  // namespace squeal::cycles
