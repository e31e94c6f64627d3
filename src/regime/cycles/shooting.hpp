#pragma once
/// Shooting finds periodic motions of the reduced model, stable or not, and Floquet multipliers
/// tell which of them a brake can keep [M.77].
#include <functional>
#include <memory>
#include <vector>

#include "algebra/linalg/complex.hpp"
#include "regime/cycles/passage.hpp"

namespace squeal::cycles {

/// A direction in the unknowns (q, v, period, friction), each in √J: q by its frequency, period and
/// friction relative to their values and by the norm of the motion.
using Direction = std::vector<double>;

/// Floquet multipliers: a disturbance of a periodic motion is multiplied by them in each period.
struct Multipliers {
  std::vector<Complex> values;  ///< by descending modulus
  /// The place of the one that belongs to a shift in time, by its vector: it is 1, up to the error
  /// of the step.
  std::size_t trivial = 0;
};

/// The equations of a periodic motion, linearised about one:
///   (M − 1) δx + ∂x(T)/∂T δT + ∂x(T)/∂f δf = −(x(T) − x),   ẋᵀ δx = 0,   and δf = 0 or tᵀδ = 0,
/// in entries x of q, v and of slips that stick, with the scales of Direction.
class Linearisation {
 public:
  /// Collective.
  Linearisation(Period& period, const Orbit& at);
  const Monodromy& monodromy() const { return monodromy_; }

  /// A change of the unknowns and, of all z, of what it makes of the end of a period.
  struct Step {
    Direction direction;
    std::vector<double> stuck;  ///< changes of the slips that stick at the start, m
    std::vector<double> z;      ///< m
  };
  /// Not collective. Returns the step that makes the end of a period its start, to first order;
  /// with a tangent across it, without one at the same friction.
  Step step(const Handed& start, const Handed& end, const Direction& tangent) const;
  /// Not collective. Returns the direction of the branch over the friction, along `near`, 2-norm 1.
  Direction tangent(const Direction& near) const;
  /// Returns by how much the friction changes along a direction of length 1, √J.
  double frictionAlong(const Direction& direction) const {
    return direction.back() / frictionScale_;
  }
  /// Not collective. Returns the eigenvalues of the monodromy.
  Multipliers multipliers() const;
  /// Returns the orbit changed by a factor of the direction alone.
  Orbit along(const Orbit& orbit, const Direction& direction, double factor) const;
  /// Returns the orbit changed by a factor of the step, where the given end is that of a period.
  Orbit changed(const Orbit& orbit, const Handed& end, const Step& step, double factor) const;

 private:
  std::vector<double> solve(std::vector<double> right, const Direction& last) const;
  PetscInt modes() const { return std::ssize(frequency_); }

  Monodromy monodromy_;
  std::vector<double> frequency_;                // √Λ, [mode]
  std::vector<double> scale_;                    // [entry of x] from its own unit to √J
  double periodScale_, frictionScale_;           // the same of period and friction
  std::vector<double> byPeriod_, byFriction_;    // scaled derivatives of the end, [entry of x]
  std::vector<double> zByPeriod_, zByFriction_;  // of all z
  std::vector<double> phase_;                    // ẋ, scaled, [entry of x]
};

/// The result of Newton's method.
struct Found {
  Orbit orbit;
  bool converged = false;
  int derivatives = 0;  ///< linearisations made for it
  double change = 0;    ///< over a period, that is left
  Measures measures;
  std::shared_ptr<const Linearisation> linearisation;  ///< about the orbit, where it has converged
};

/// An Iteration tells what Newton's method has come to.
struct Iteration {
  double change = 0;    ///< over a period
  int derivatives = 0;  ///< linearisations made
};
using Told = std::function<void(const Iteration&)>;

/// Collective. Finds a periodic motion from one that nearly repeats itself, to a `tolerance` of
/// change(). With a `tangent` the friction is an unknown, and the orbit is sought across it.
/// A linearisation about an orbit nearby saves one. `told` is called, on all ranks, before each
/// linearisation and after each step.
Found shoot(Period& period, const Orbit& guess, double tolerance, const Told& told = {},
            const Direction& tangent = {},
            std::shared_ptr<const Linearisation> linearisation = nullptr);

}  // namespace squeal::cycles
