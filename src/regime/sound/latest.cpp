#include "regime/sound/latest.hpp"

#include <algorithm>
#include <cmath>

#include "base/petsc/check.hpp"

namespace squeal::sound {
namespace {

/// Returns z = y − j q, zero in the rows without z.
std::vector<double> staticPart(const ReducedModel& model, const march::State& state) {
  std::vector<double> z(state.jump);
  for (PetscInt i = 0; i < model.rows(); ++i) {
    if (!model.moves[i]) z[i] = 0;
    for (PetscInt j = 0; model.moves[i] && j < model.modes(); ++j)
      z[i] -= model.jump(i, j) * state.q[j];
  }
  return z;
}

}  // namespace

Latest::Latest(const ReducedModel& model, const Settings& settings, double period, double step)
    : model_(model),
      frames_(settings.framesOfPeriod(period, step)),
      most_(settings.cyclesKept > 0 ? frames_ * settings.cyclesKept + 1 : 0),
      interval_(period / frames_),
      next_(interval_) {}

void Latest::look(const Scheme& scheme) {
  if (most_ == 0 || scheme.state().time < next_) return;
  next_ += interval_;
  if (std::ssize(states_) == most_) states_.pop_front();
  states_.push_back(scheme.state());
}

std::vector<Sample> Latest::samples() const {
  std::vector<Sample> result;
  const long count = states_.empty() ? 0 : (std::ssize(states_) - 1) / frames_ * frames_ + 1;
  for (auto state = states_.end() - count; state != states_.end(); ++state) {
    Sample sample{state->time, state->q, staticPart(model_, *state), {}, {}};
    for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
      const PetscInt row = i * model_.dimension;
      sample.gap.push_back(model_.nodes[i].gap + state->jump[row]);
      sample.force.push_back(state->force[row]);
    }
    result.push_back(std::move(sample));
  }
  return result;
}

void share(MPI_Comm comm, int root, std::vector<Sample>& samples) {
  std::size_t count = samples.size();
  check(MPI_Bcast(&count, sizeof count, MPI_BYTE, root, comm));
  samples.resize(count);
  for (Sample& sample : samples) {
    check(MPI_Bcast(&sample.time, 1, MPI_DOUBLE, root, comm));
    for (auto* list : {&sample.q, &sample.z, &sample.gap, &sample.force}) {
      std::size_t length = list->size();
      check(MPI_Bcast(&length, sizeof length, MPI_BYTE, root, comm));
      list->resize(length);
      check(MPI_Bcast(list->data(), length, MPI_DOUBLE, root, comm));
    }
  }
}

}  // namespace squeal::sound
