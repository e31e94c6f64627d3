// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Periodic motions of the reduced model by shooting, and their Floquet multipliers [M.77]. Only
/// stable motions persist in a brake.
#include <functional>
#include <memory>
#include <vector>

#include "algebra/linalg/complex.hpp"
#include "regime/cycles/passage.hpp"

namespace squeal::cycles {

/// A direction in the unknowns (q, v, period, friction), all scaled to √J. The scale of q is the
/// angular frequency. The scale of the period is the norm of the motion divided by the period, and
/// likewise for the friction.
using Direction = std::vector<double>;

/// Floquet multipliers: the factors of disturbances of a periodic motion per period.
struct Multipliers {
  std::vector<Complex> values;  ///< by descending modulus
  /// Index of the multiplier of a shift in time, identified by its vector. It is 1 within the error
  /// of the time step.
  std::size_t trivial = 0;
};

/// The equations of a periodic motion, linearised about an orbit:
///   (M − 1) δx + ∂x(T)/∂T δT + ∂x(T)/∂f δf = −(x(T) − x),   ẋᵀ δx = 0,   and δf = 0 or tᵀδ = 0,
/// in entries x of q, v and slips that stick, with the scales of Direction.
class Linearisation {
 public:
  /// Collective.
  Linearisation(const Period& period, const Orbit& at);
  const Monodromy& monodromy() const { return monodromy_; }

  /// A change of the unknowns, and of all z at the end of a period.
  struct Step {
    Direction direction;
    std::vector<double> stuck;  ///< changes of the slips that stick at the start, m
    std::vector<double> z;      ///< m
  };
  /// Not collective. Returns the step that makes the end of a period equal its start to first
  /// order: orthogonal to the tangent if there is one, otherwise at the same friction.
  Step step(const InitialState& start, const InitialState& end, const Direction& tangent) const;
  /// Not collective. Returns the direction of the branch over the friction, 2-norm 1, oriented
  /// along `near`.
  Direction tangent(const Direction& near) const;
  /// Returns the change of the friction along a direction of length 1, √J.
  double frictionAlong(const Direction& direction) const {
    return direction.back() / frictionScale_;
  }
  /// Not collective. Returns the eigenvalues of the monodromy.
  Multipliers multipliers() const;
  /// Returns the orbit plus a factor times the direction.
  Orbit along(const Orbit& orbit, const Direction& direction, double factor) const;
  /// Returns the orbit plus a factor times the step; `end` is the end of a period.
  Orbit changed(const Orbit& orbit, const InitialState& end, const Step& step, double factor) const;

 private:
  /// A derivative of the end of a period.
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
  std::vector<double> scale_;           // [entry of x] from its own unit to √J
  double periodScale_, frictionScale_;  // from period and friction to √J
  EndDerivative byPeriod_, byFriction_;
  std::vector<double> phase_;  // ẋ, scaled, [entry of x]
};

/// The result of Newton's method.
struct ShootingResult {
  Orbit orbit;
  bool converged = false;
  int derivatives = 0;  ///< number of linearisations
  double change = 0;    ///< over a period
  Measures measures;
  std::shared_ptr<const Linearisation> linearisation;  ///< about the orbit, if it has converged
};

/// The state of Newton's method.
struct Iteration {
  double change = 0;    ///< over a period
  int derivatives = 0;  ///< number of linearisations so far
};
/// Called on all ranks before each linearisation and after each step.
using Progress = std::function<void(const Iteration&)>;

struct ShootingRequest {
  double tolerance = 0;    ///< of change()
  Progress progress = {};  ///< empty: none
  /// With a tangent, the friction is an unknown, and the search is orthogonal to the tangent.
  Direction tangent = {};
  /// A linearisation about a nearby orbit, to reuse.
  std::shared_ptr<const Linearisation> linearisation = nullptr;
};

/// Collective. Computes a periodic motion from one that nearly repeats itself.
ShootingResult shoot(const Period& period, const Orbit& guess, const ShootingRequest& request);

}  // namespace squeal::cycles
