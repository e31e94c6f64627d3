#include "regime/regime/follow.hpp"

#include <algorithm>
#include <optional>

#include "base/petsc/check.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"
#include "regime/regime/cycle.hpp"

namespace squeal::regime {
namespace {

/// Not collective. Throws Interrupted, on this rank alone, once asked() is true.
Followed follow(const ReducedModel& model, const Settings& settings, const Task& task,
                const StopAsked& asked, Stage& stage) {
  const auto start = march::startOn(task.mode, settings.march.startFactor);
  const auto scheme = settings.march.massless ? march::masslessScheme(model, start, task.step)
                                              : march::moreauScheme(model, start, task.step);
  scheme->setStop(asked);
  Recorder recorder(model, task.mode.s, task.step, largestKinetic(task.mode));
  sound::Latest latest(model, settings.sound, 2 * M_PI / task.mode.s.imag(), task.step);
  std::optional<SectionRecord> section;
  if (settings.cycles.wanted) section.emplace(model, task.mode);
  while (scheme->state().time < task.time) {
    if (asked()) throw Interrupted();
    scheme->step();
    recorder.look(*scheme);
    latest.look(*scheme);
    if (section) section->look(*scheme);
    if (!recorder.windowEnded()) continue;
    if (section) section->endWindow();
    stage.progress(formatted("start on mode %s: %.1f of at most %.1f ms", task.start.c_str(),
                             1e3 * scheme->state().time, 1e3 * task.time));
    if (settings.march.time == 0 && recorder.settled()) break;
  }
  Followed followed{recorder.result(*scheme, asked), {}, {}};
  if (!followed.regime.measured()) return followed;
  followed.trace = {recorder.velocities(), recorder.sampleTime(), latest.samples()};
  if (section) followed.passes = section->last(recorder.windowsUsed());
  return followed;
}

/// Collective. Sends a text from the rank `root` to all ranks.
void share(MPI_Comm comm, int root, std::string& text) {
  int length = text.size();
  check(MPI_Bcast(&length, 1, MPI_INT, root, comm));
  text.resize(length);
  check(MPI_Bcast(text.data(), length, MPI_CHAR, root, comm));
}

}  // namespace

int rankOf(MPI_Comm comm, std::size_t task) {
  int size = 1;
  check(MPI_Comm_size(comm, &size));
  return int(task % size);
}

std::vector<Followed> followAll(MPI_Comm comm, const ReducedModel& model, const Settings& settings,
                                std::vector<Task>& tasks, Stage& stage) {
  int rank = 0;
  check(MPI_Comm_rank(comm, &rank));
  std::vector<Followed> all(tasks.size());
  workApart(comm, [&](const StopAsked& asked) {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      Task& task = tasks[i];
      if (rankOf(comm, i) != rank || !task.failure.empty()) continue;
      try {
        all[i] = follow(model, settings, task, asked, stage);
        if (!all[i].regime.measured())
          task.failure =
              formatted("the march of %g s ended before its first window", all[i].regime.duration);
      } catch (const Error& error) {  // of this start: the others go on
        task.failure = formatted("-regime_step %g s: %s", task.step, error.what());
      }
    }
  });
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    share(comm, rankOf(comm, i), tasks[i].failure);
    if (!tasks[i].failure.empty()) continue;
    share(comm, rankOf(comm, i), all[i].regime);
    share(comm, rankOf(comm, i), all[i].passes);
  }
  return all;
}

}  // namespace squeal::regime
