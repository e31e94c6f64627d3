// SPDX-License-Identifier: BSD-2-Clause
#include "regime/regime/trajectory.hpp"

#include <algorithm>
#include <optional>

#include "base/petsc/check.hpp"
#include "base/system/mpi.hpp"
#include "base/system/stream.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"
#include "regime/regime/cycle.hpp"

namespace squeal::regime {
namespace {

/// Not collective. Computes one march. Throws Interrupted, only on this rank, once stopRequested()
/// is true.
Trajectory trajectoryOf(const ReducedModel& model, const Settings& settings, const Task& task,
                        const StopRequested& stopRequested, Stage& stage) {
  const auto start = march::startOn(task.mode, settings.march.startFactor);
  const auto scheme = settings.march.massless ? march::masslessScheme(model, start, task.step)
                                              : march::moreauScheme(model, start, task.step);
  scheme->setStop(stopRequested);
  Recorder recorder(model, task.mode.s, task.step, largestKinetic(task.mode));
  sound::RecentHistory history(model, settings.sound, 2 * M_PI / task.mode.s.imag(), task.step);
  std::optional<SectionRecord> section;
  if (settings.cycles.wanted) section.emplace(model, task.mode);
  while (scheme->state().time < task.time) {
    if (stopRequested()) throw Interrupted();
    scheme->step();
    recorder.inspect(*scheme);
    history.inspect(*scheme);
    if (section) section->inspect(*scheme);
    if (!recorder.windowEnded()) continue;
    if (section) section->endWindow();
    stage.progress(formatted("start on mode %s: %.1f of at most %.1f ms", task.start.c_str(),
                             1e3 * scheme->state().time, 1e3 * task.time));
    if (settings.march.time == 0 && recorder.settled()) break;
  }
  Trajectory trajectory{recorder.result(*scheme, stopRequested), {}, {}};
  if (!trajectory.regime.measured()) return trajectory;
  trajectory.trace = {recorder.velocities(), recorder.sampleTime(), history.samples()};
  if (section) trajectory.passes = section->last(recorder.windowsUsed());
  return trajectory;
}

}  // namespace

int rankOf(MPI_Comm comm, std::size_t task) { return int(task % mpi::size(comm)); }

std::vector<Trajectory> trajectories(MPI_Comm comm, const ReducedModel& model,
                                     const Settings& settings, std::vector<Task>& tasks,
                                     Stage& stage) {
  const int rank = mpi::rank(comm);
  std::vector<Trajectory> all(tasks.size());
  workIndependently(comm, [&](const StopRequested& stopRequested) {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      Task& task = tasks[i];
      if (rankOf(comm, i) != rank || !task.failure.empty()) continue;
      try {
        all[i] = trajectoryOf(model, settings, task, stopRequested, stage);
        if (!all[i].regime.measured())
          task.failure =
              formatted("the march of %g s ended before its first window", all[i].regime.duration);
      } catch (const Error& error) {  // of this start: the others continue
        task.failure = formatted("-regime_step %g s: %s", task.step, error.what());
      }
    }
  });
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const int root = rankOf(comm, i);
    mpi::broadcast(comm, tasks[i].failure, root);
    broadcast(comm, all[i].regime, root);
    if (!tasks[i].failure.empty()) continue;
    broadcast(comm, all[i].passes, root);
  }
  return all;
}

}  // namespace squeal::regime
