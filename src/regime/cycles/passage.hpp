// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A passage: a time integration over a single period, from the initial state of its first step to
/// the initial state of the step after its last one [M.77].
#include <mpi.h>

#include <vector>

#include "regime/march/massless.hpp"
#include "regime/march/model.hpp"

namespace squeal::cycles {

using linalg::DenseMatrix;
using march::InitialState;
using march::ReducedModel;

/// A motion over one period, periodic or not.
struct Orbit {
  InitialState start;   ///< initial state of its first step
  double period = 0;    ///< s
  double friction = 0;  ///< swept coefficient of friction
};

/// Measures of a motion over one period.
struct Measures {
  double largestKinetic = 0;       ///< J
  double frictionPower = 0;        ///< mean power that friction dissipates, W
  double frictionCoefficient = 0;  ///< −Σ R_T·τ / Σ R_N of the nodes with Node::slides()
  int opening = 0, sticking = 0;   ///< numbers of nodes that are open or stick at some time
  bool linear = true;  ///< each node stays open, sticking or sliding as in steady sliding
};

/// The end of a period.
struct Passage {
  InitialState end;
  Measures measures;
  int quietest = 0;  ///< number of steps after which the fewest nodes stick
};

/// The derivative of the end of a passage with respect to its start. The variables are q, v, and,
/// of z, the slips of nodes that stick at the start; the effect of other entries of z decays within
/// a few steps.
struct Monodromy {
  std::vector<PetscInt> stuck;  ///< rows of z
  DenseMatrix end;              ///< derivative of q, v and the stuck z, square
  DenseMatrix z;                ///< derivative of all z, rows of z × columns of `end`
};

/// Returns √(qᵀΛq + vᵀv + zᵀK_z z), √J.
double norm(const ReducedModel& model, const InitialState& x);
/// Returns norm(end − start) / norm(start).
double change(const ReducedModel& model, const InitialState& start, const InitialState& end);

/// Computes passages of one model at any friction. The static part of the displacements is exact at
/// all frictions, because it contains the static responses to friction. The unstable modes in the
/// model are those of the friction at which it was made.
class Period {
 public:
  /// Copies the model, which was made at `friction`. A period has `steps` steps of the scheme of
  /// the massless boundary. All ranks of `comm` must have the same model; they share the work on
  /// the columns of derivatives.
  Period(MPI_Comm comm, ReducedModel model, double friction, int steps);
  MPI_Comm comm() const { return comm_; }
  const ReducedModel& model() const { return model_; }
  int steps() const { return steps_; }

  /// Collective. Returns the end of a period, or the state after its first `steps` steps. Throws
  /// Error if the contact forces of a step do not converge or the motion is not finite.
  Passage pass(const Orbit& orbit, int steps) const;
  Passage pass(const Orbit& orbit) const { return pass(orbit, steps_); }
  /// Collective. Returns the derivative of pass().
  Monodromy derivative(const Orbit& orbit) const;

 private:
  march::Massless schemeOf(const Orbit& orbit, const StopRequested& stopRequested) const;
  std::vector<PetscInt> stuckAtStart(const Orbit& orbit) const;
  DenseMatrix variationsAtEnd(const Orbit& orbit, const std::vector<PetscInt>& stuck) const;
  MPI_Comm comm_;
  ReducedModel model_;
  double modelFriction_;
  int steps_;
};

}  // namespace squeal::cycles
