// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Time integration of the reduced model. The conditions of contact are satisfied at the end of
/// each step.
#include <memory>
#include <utility>
#include <vector>

#include "regime/march/contact_forces.hpp"
#include "regime/march/model.hpp"

namespace squeal::march {

/// The motion at one instant.
struct State {
  double time = 0;           ///< s
  std::vector<double> q, v;  ///< modal coordinates and velocities
  std::vector<double> jump;  ///< y, [row]
  /// [row] m/s. In the row of a gap: its rate. In the row of a slip: the slip velocity w, which
  /// includes that of steady sliding.
  std::vector<double> rate;
  std::vector<double> force;  ///< R, [row], N
  double kinetic = 0;         ///< kinetic energy, J
};

/// Mechanical work since the start, J.
struct MechanicalWork {
  double contact = 0;   ///< work of R* on the jump
  double friction = 0;  ///< heat of friction, −Σ R_T·w
  double damping = 0;   ///< dissipated in materials and dashpots
  double moved = 0;     ///< sum of |R*·dy|, a scale for the other members
};

/// A time integration scheme.
class Scheme {
 public:
  virtual ~Scheme() = default;
  /// Computes one step. Throws Error if the contact forces do not converge or the motion is not
  /// finite. Throws Interrupted, only on this rank, once the function given to setStop() returns
  /// true.
  virtual void step() = 0;
  /// Sets the function that returns true if a stop is requested during a step.
  void setStop(StopRequested stopRequested) { stopRequested_ = std::move(stopRequested); }
  const State& state() const { return state_; }
  const MechanicalWork& work() const { return work_; }
  int sweeps() const { return sweeps_; }  ///< Gauss–Seidel sweeps of the last step
  /// Returns the kinetic and elastic energy of the motion about steady sliding, J.
  virtual double energy() const = 0;
  /// Returns the increments of the jump in the last step (d of StepSolver), [row], m.
  const std::vector<double>& increments() const { return increments_; }
  /// Returns the coefficients of friction in the last step, [node].
  const std::vector<double>& friction() const { return friction_; }
  /// Returns the defect of the last step, N.
  double lastDefect() const;

 protected:
  /// The accuracy of the contact forces of a step, relative to the mean normal force of steady
  /// sliding.
  static constexpr double accuracy = 1e-6;
  /// The swept coefficient of friction is that of the model plus `sweptChange`.
  explicit Scheme(const ReducedModel& model, double sweptChange = 0);
  void updateFriction();
  bool isNormal(PetscInt row) const { return row % model_.dimension == 0; }
  const ReducedModel& model_;
  double sweptChange_;
  State state_;
  MechanicalWork work_;
  int sweeps_ = 0;
  double tolerance_;                                              // tolerance of the forces, N
  std::vector<double> friction_;                                  // [node] coefficients in the step
  std::vector<double> steadyForce_, steadyVelocity_, steadyGap_;  // [row], zero if undefined
  std::vector<double> increments_;                                // d of the last step
  std::vector<double> stiffness_;  // [node] turns an error of a gap into one of a force, N/m
  StopRequested stopRequested_;    // empty: never
};

/// The start of a time integration: q, z and their rates at one instant, and the accelerations of q
/// (empty: zero).
struct Start {
  std::vector<double> q, v, z, zRate, acceleration = {};
};
/// Returns the motion of a linear mode at phase 0, multiplied by `factor`.
Start startOn(const LinearMode& mode, double factor);

/// Returns the scheme of the massless boundary (Massless). It borrows the model; h is the time
/// step, s.
std::unique_ptr<Scheme> masslessScheme(const ReducedModel& model, const Start& start, double h);
/// Returns the scheme of Moreau and Jean with θ = 1/2 and with the mass of the boundary [M.73]. Its
/// contact conditions apply to velocities, without restitution, except in rows without mass, where
/// they apply to positions.
std::unique_ptr<Scheme> moreauScheme(const ReducedModel& model, const Start& start, double h);

}  // namespace squeal::march
