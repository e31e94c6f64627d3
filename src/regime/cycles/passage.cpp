// SPDX-License-Identifier: BSD-2-Clause
#include "regime/cycles/passage.hpp"

#include <algorithm>
#include <cmath>

#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "regime/march/products.hpp"

namespace squeal::cycles {
namespace {

/// The accuracy of contact forces, relative to the mean steady force. Their error contributes to
/// the error at the end of a passage.
constexpr double forceAccuracy = 1e-10;

/// Accumulates the measures of a march, step by step.
class Meter {
 public:
  explicit Meter(const ReducedModel& model)
      : model_(model), opened_(model.nodes.size()), rested_(model.nodes.size()) {}

  void inspect(const march::Massless& scheme) {
    const auto& state = scheme.state();
    const auto stuck = scheme.stuck();
    int sticking = 0;
    for (std::size_t node = 0; node < model_.nodes.size(); ++node) {
      const auto& at = model_.nodes[node];
      const PetscInt row = node * model_.dimension;
      const bool open = state.force[row] == 0, rests = stuck[row + 1];
      sticking += rests;
      if (open) opened_[node] = 1;
      if (rests) rested_[node] = 1;
      if (open == at.pressed() || (!open && at.hasFriction() && rests != at.sticks()))
        measures_.linear = false;
      if (at.slides()) normal_ += state.force[row], along_ -= state.force[row + 1];
    }
    measures_.largestKinetic = std::max(measures_.largestKinetic, state.kinetic);
    if (++steps_ == 1 || sticking < fewest_) fewest_ = sticking, quietest_ = steps_;
  }

  Passage result(const march::Massless& scheme, double time) const {
    Passage passage{scheme.next(), measures_, quietest_};
    auto& measures = passage.measures;
    measures.opening = std::ranges::count(opened_, 1);
    measures.sticking = std::ranges::count(rested_, 1);
    measures.frictionPower = scheme.work().friction / time;
    measures.frictionCoefficient = normal_ > 0 ? along_ / normal_ : 0;
    return passage;
  }

 private:
  const ReducedModel& model_;
  std::vector<unsigned char> opened_, rested_;
  Measures measures_;
  double normal_ = 0, along_ = 0;
  int steps_ = 0, fewest_ = 0, quietest_ = 0;
};

}  // namespace

double norm(const ReducedModel& model, const InitialState& x) {
  std::vector<double> force(model.rows());
  march::addProduct(model.boundaryStiffness, x.z, force);
  double sum = march::dot(x.z, force) + march::dot(x.v, x.v);
  for (PetscInt i = 0; i < model.modes(); ++i) sum += model.stiffness[i] * x.q[i] * x.q[i];
  return std::sqrt(std::max(0.0, sum));
}

double change(const ReducedModel& model, const InitialState& start, const InitialState& end) {
  InitialState difference = end;
  const auto subtract = [](std::vector<double>& from, const std::vector<double>& x) {
    for (std::size_t i = 0; i < from.size(); ++i) from[i] -= x[i];
  };
  subtract(difference.q, start.q), subtract(difference.v, start.v);
  subtract(difference.z, start.z);
  return norm(model, difference) / norm(model, start);
}

Period::Period(MPI_Comm comm, ReducedModel model, double friction, int steps)
    : comm_(comm), model_(std::move(model)), modelFriction_(friction), steps_(steps) {}

march::Massless Period::schemeOf(const Orbit& orbit, const StopRequested& stopRequested) const {
  march::Massless scheme(model_, orbit.start, orbit.period / steps_,
                         orbit.friction - modelFriction_);
  scheme.setAccuracy(forceAccuracy);
  scheme.setStop(stopRequested);
  return scheme;
}

Passage Period::pass(const Orbit& orbit, int steps) const {
  Passage passage;
  workIndependently(comm_, [&](const StopRequested& stopRequested) {
    march::Massless scheme = schemeOf(orbit, stopRequested);
    Meter meter(model_);
    for (int i = 0; i < steps; ++i) scheme.step(), meter.inspect(scheme);
    passage = meter.result(scheme, steps * orbit.period / steps_);
  });
  // Round-off may differ between ranks; all continue from the same end.
  for (auto* part : {&passage.end.q, &passage.end.v, &passage.end.z}) mpi::broadcast(comm_, *part);
  mpi::broadcast(comm_, passage.quietest);
  return passage;
}

/// Collective. Returns the slips that stick at the start. They follow from the step before the
/// start, which is the last one of a period if the motion is periodic.
std::vector<PetscInt> Period::stuckAtStart(const Orbit& orbit) const {
  std::vector<PetscInt> rows;
  workIndependently(comm_, [&](const StopRequested& stopRequested) {
    march::Massless before = schemeOf(orbit, stopRequested);
    for (int i = 0; i < steps_; ++i) before.step();
    const auto stuck = before.stuck();
    for (PetscInt row = 0; row < model_.rows(); ++row)
      if (stuck[row]) rows.push_back(row);
  });
  mpi::broadcast(comm_, rows);  // round-off may differ between ranks
  return rows;
}

/// Collective. Returns the variations of q, v and all z at the end for unit variations of the
/// entries q, v and stuck z at the start, distributed over the ranks.
DenseMatrix Period::variationsAtEnd(const Orbit& orbit, const std::vector<PetscInt>& stuck) const {
  const PetscInt k = model_.modes(), rows = model_.rows(), order = 2 * k + std::ssize(stuck);
  const int rank = mpi::rank(comm_), size = mpi::size(comm_);
  const PetscInt first = order * rank / size, own = order * (rank + 1) / size - first;
  march::Variations x{DenseMatrix(k, own), DenseMatrix(k, own), DenseMatrix(rows, own)};
  for (PetscInt j = 0; j < own; ++j) {
    const PetscInt entry = first + j;
    if (entry < k)
      x.q(entry, j) = 1;
    else if (entry < 2 * k)
      x.v(entry - k, j) = 1;
    else
      x.z(stuck[entry - 2 * k], j) = 1;
  }
  workIndependently(comm_, [&](const StopRequested& stopRequested) {
    march::Massless scheme = schemeOf(orbit, stopRequested);
    for (int i = 0; i < steps_; ++i) scheme.step(), scheme.propagate(x);
  });
  DenseMatrix part(2 * k + rows, own), all(2 * k + rows, order);
  for (PetscInt j = 0; j < own; ++j) {
    std::ranges::copy(x.q.column(j), part.column(j).begin());
    std::ranges::copy(x.v.column(j), part.column(j).begin() + k);
    std::ranges::copy(x.z.column(j), part.column(j).begin() + 2 * k);
  }
  Concatenation(comm_, part.size()).gather<double>(part.entries(), all.entries());
  mpi::broadcastBytes(comm_, all.data(), all.size() * sizeof(double), 0);
  return all;
}

Monodromy Period::derivative(const Orbit& orbit) const {
  const PetscInt k = model_.modes();
  Monodromy result;
  result.stuck = stuckAtStart(orbit);
  const DenseMatrix all = variationsAtEnd(orbit, result.stuck);
  const PetscInt order = all.columns();
  result.z = linalg::rowRange(all, 2 * k, 2 * k + model_.rows());
  result.end = DenseMatrix(order, order);
  for (PetscInt j = 0; j < order; ++j)
    for (PetscInt i = 0; i < order; ++i)
      result.end(i, j) = i < 2 * k ? all(i, j) : all(2 * k + result.stuck[i - 2 * k], j);
  return result;
}

}  // namespace squeal::cycles
