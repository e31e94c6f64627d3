// SPDX-License-Identifier: BSD-2-Clause
#include "regime/sound/recent_history.hpp"

#include <algorithm>
#include <cmath>

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

RecentHistory::RecentHistory(const ReducedModel& model, const Settings& settings, double period,
                             double step)
    : model_(model),
      frames_(settings.framesOfPeriod(period, step)),
      most_(settings.cyclesKept > 0 ? frames_ * settings.cyclesKept + 1 : 0),
      interval_(period / frames_),
      next_(interval_) {}

void RecentHistory::inspect(const Scheme& scheme) {
  if (most_ == 0 || scheme.state().time < next_) return;
  next_ += interval_;
  if (std::ssize(states_) == most_) states_.pop_front();
  states_.push_back(scheme.state());
}

std::vector<Sample> RecentHistory::samples() const {
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

void fields(Stream& stream, Sample& sample) {
  // This lists all members: a new one does not compile until it is added here.
  auto& [time, q, z, gap, force] = sample;
  stream(time, q, z, gap, force);
}

}  // namespace squeal::sound
