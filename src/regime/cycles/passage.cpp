#include "regime/cycles/passage.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/petsc/check.hpp"
#include "base/system/concatenation.hpp"
#include "regime/march/products.hpp"

namespace squeal::cycles {
namespace {

/// Contact forces hold to this part of the mean steady force: an error in them is one of the end.
constexpr double forceAccuracy = 1e-10;

/// Adds up what a march does, step by step.
class Meter {
 public:
  explicit Meter(const ReducedModel& model)
      : model_(model), opened_(model.nodes.size()), rested_(model.nodes.size()) {}

  void look(const march::Massless& scheme) {
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
      if (open == at.pressed() || (!open && at.rubs() && rests != at.sticks()))
        measures_.linear = false;
      normal_ += state.force[row];
      if (!at.sticks()) along_ -= state.force[row + 1];
    }
    measures_.largestKinetic = std::max(measures_.largestKinetic, state.kinetic);
    if (++steps_ == 1 || sticking < fewest_) fewest_ = sticking, quietest_ = steps_;
  }

  Passage result(const march::Massless& scheme, double time) const {
    Passage passage{scheme.handed(), measures_, quietest_};
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

double norm(const ReducedModel& model, const Handed& x) {
  std::vector<double> force(model.rows());
  march::addProduct(model.boundaryStiffness, x.z, force);
  double sum = march::dot(x.z, force) + march::dot(x.v, x.v);
  for (PetscInt i = 0; i < model.modes(); ++i) sum += model.stiffness[i] * x.q[i] * x.q[i];
  return std::sqrt(std::max(0.0, sum));
}

double change(const ReducedModel& model, const Handed& start, const Handed& end) {
  Handed difference = end;
  const auto subtract = [](std::vector<double>& from, const std::vector<double>& what) {
    for (std::size_t i = 0; i < from.size(); ++i) from[i] -= what[i];
  };
  subtract(difference.q, start.q), subtract(difference.v, start.v);
  subtract(difference.z, start.z);
  return norm(model, difference) / norm(model, start);
}

Period::Period(MPI_Comm comm, ReducedModel model, double friction, int steps)
    : comm_(comm), model_(std::move(model)), modelFriction_(friction), steps_(steps) {
  for (const auto& node : model_.nodes) nodeFriction_.push_back(node.friction);
}

march::Massless Period::schemeOf(const Orbit& orbit, const StopAsked& asked) {
  for (std::size_t i = 0; i < nodeFriction_.size(); ++i) {
    auto& node = model_.nodes[i];
    const double change = orbit.friction - modelFriction_;
    node.friction = nodeFriction_[i];
    if (change != 0) node.friction += node.sweptFriction * change;
  }
  march::Massless scheme(model_, orbit.start, orbit.period / steps_);
  scheme.setAccuracy(forceAccuracy);
  scheme.setStop(asked);
  return scheme;
}

Passage Period::pass(const Orbit& orbit, int steps) {
  Passage passage;
  workApart(comm_, [&](const StopAsked& asked) {
    march::Massless scheme = schemeOf(orbit, asked);
    Meter meter(model_);
    for (int i = 0; i < steps; ++i) scheme.step(), meter.look(scheme);
    passage = meter.result(scheme, steps * orbit.period / steps_);
  });
  // Rounding may differ between ranks; all go on from the same end.
  for (auto* part : {&passage.end.q, &passage.end.v, &passage.end.z})
    check(MPI_Bcast(part->data(), part->size(), MPI_DOUBLE, 0, comm_));
  check(MPI_Bcast(&passage.quietest, 1, MPI_INT, 0, comm_));
  return passage;
}

Monodromy Period::derivative(const Orbit& orbit) {
  const PetscInt k = model_.modes(), rows = model_.rows();
  Monodromy result;
  // Which slips stick at the start follows from the last step before it: a periodic motion ends as
  // it starts.
  workApart(comm_, [&](const StopAsked& asked) {
    march::Massless before = schemeOf(orbit, asked);
    for (int i = 0; i < steps_; ++i) before.step();
    const auto stuck = before.stuck();
    for (PetscInt row = 0; row < rows; ++row)
      if (stuck[row]) result.stuck.push_back(row);
  });
  // Rounding may differ between ranks; all go on with the same slips.
  PetscMPIInt count = std::ssize(result.stuck);
  check(MPI_Bcast(&count, 1, MPI_INT, 0, comm_));
  result.stuck.resize(count);
  check(MPI_Bcast(result.stuck.data(), count, MPIU_INT, 0, comm_));
  const PetscInt order = 2 * k + count;
  int rank = 0, size = 1;
  check(MPI_Comm_rank(comm_, &rank));
  check(MPI_Comm_size(comm_, &size));
  const PetscInt first = order * rank / size, last = order * (rank + 1) / size, own = last - first;
  march::Variations x{DenseMatrix(k, own), DenseMatrix(k, own), DenseMatrix(rows, own)};
  for (PetscInt j = 0; j < own; ++j) {
    const PetscInt entry = first + j;
    if (entry < k)
      x.q(entry, j) = 1;
    else if (entry < 2 * k)
      x.v(entry - k, j) = 1;
    else
      x.z(result.stuck[entry - 2 * k], j) = 1;
  }
  workApart(comm_, [&](const StopAsked& asked) {
    march::Massless scheme = schemeOf(orbit, asked);
    for (int i = 0; i < steps_; ++i) scheme.step(), scheme.propagate(x);
  });
  DenseMatrix part(2 * k + rows, own);
  for (PetscInt j = 0; j < own; ++j) {
    std::ranges::copy(x.q.column(j), part.column(j).begin());
    std::ranges::copy(x.v.column(j), part.column(j).begin() + k);
    std::ranges::copy(x.z.column(j), part.column(j).begin() + 2 * k);
  }
  DenseMatrix all(2 * k + rows, order);
  Concatenation(comm_, part.size()).gather<double>(part.entries(), all.entries());
  check(MPI_Bcast(all.data(), all.size(), MPI_DOUBLE, 0, comm_));
  result.z = linalg::rowRange(all, 2 * k, 2 * k + rows);
  result.end = DenseMatrix(order, order);
  for (PetscInt j = 0; j < order; ++j)
    for (PetscInt i = 0; i < order; ++i)
      result.end(i, j) = i < 2 * k ? all(i, j) : all(2 * k + result.stuck[i - 2 * k], j);
  return result;
}

}  // namespace squeal::cycles
