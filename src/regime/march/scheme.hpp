#pragma once
/// The reduced model is integrated in time with the conditions of contact at the end of each step.
#include <memory>
#include <utility>
#include <vector>

#include "regime/march/contact_forces.hpp"
#include "regime/march/model.hpp"

namespace squeal::march {

/// The motion at one instant.
struct State {
  double time = 0;            ///< s
  std::vector<double> q, v;   ///< modal coordinates and velocities
  std::vector<double> jump;   ///< y, [row]
  std::vector<double> rate;   ///< relative velocity of the contact w, steady part included in the
                              ///< slips; rates of the gaps, [row]
  std::vector<double> force;  ///< R, [row], N
  double kinetic = 0;         ///< kinetic energy, J
};

/// Work since the start, J.
struct Work {
  double contact = 0;   ///< done by R* on the jump
  double friction = 0;  ///< heat of friction, −Σ R_T·w
  double damping = 0;   ///< lost in the material and in dashpots
  double moved = 0;     ///< sum of |R*·dy|, the scale of the other figures
};

/// A Scheme is a rule that takes the motion over one step.
class Scheme {
 public:
  virtual ~Scheme() = default;
  /// Takes one step. Throws Error if the contact forces do not converge or the motion is not
  /// finite, and Interrupted, on this rank alone, once setStop() says so.
  virtual void step() = 0;
  /// Lets a step end once asked() is true.
  void setStop(StopAsked asked) { stopAsked_ = std::move(asked); }
  const State& state() const { return state_; }
  const Work& work() const { return work_; }
  int sweeps() const { return sweeps_; }  ///< of the last step
  /// Returns the kinetic and elastic energy of the motion about steady sliding, J.
  virtual double energy() const = 0;
  /// Returns d of StepSolver in the last step, [row], m.
  const std::vector<double>& increments() const { return increments_; }
  /// Returns the coefficients of friction in the last step, [node].
  const std::vector<double>& friction() const { return friction_; }
  /// Returns the defect of the last step, N.
  double lastDefect() const;

 protected:
  /// Contact forces of a step hold to this part of the mean steady force. Each sweep of the solver
  /// costs as much; they are said to hold to ten times this.
  static constexpr double accuracy = 1e-6;
  explicit Scheme(const ReducedModel& model);
  void updateFriction();
  const ReducedModel& model_;
  State state_;
  Work work_;
  int sweeps_ = 0;
  double tolerance_;                                              // of the forces, N
  std::vector<double> friction_;                                  // [node] coefficients in force
  std::vector<double> steadyForce_, steadyVelocity_, steadyGap_;  // [row], zero in the other rows
  std::vector<double> increments_;                                // d of the last step
  std::vector<double> stiffness_;  // [node] that weighs gaps in a defect, N/m
  StopAsked stopAsked_;            // empty: never
};

/// The start of a march: q, z and their rates at one instant, and the accelerations of q; none: 0.
struct Start {
  std::vector<double> q, v, z, zRate, acceleration = {};
};
/// Returns the motion of a linear mode at its phase 0, with this factor.
Start startOn(const LinearMode& mode, double factor);

/// Returns the scheme of the massless boundary (Massless). The model is borrowed; h is the step, s.
std::unique_ptr<Scheme> masslessScheme(const ReducedModel& model, const Start& start, double h);
/// Returns the scheme of Moreau and Jean with θ = 1/2 and with the mass of the boundary [M.73]:
/// contact conditions on velocities, no restitution. Rows whose mass is zero keep them on
/// positions.
std::unique_ptr<Scheme> moreauScheme(const ReducedModel& model, const Start& start, double h);

}  // namespace squeal::march
