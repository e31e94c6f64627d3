// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The time integrations of a reduced model and their records [M.72–M.74]. Each is computed by one
/// rank.
#include <mpi.h>

#include <vector>

#include "base/session/stages.hpp"
#include "regime/cycles/section.hpp"
#include "regime/regime/record.hpp"
#include "regime/regime/settings.hpp"
#include "regime/regime/task.hpp"
#include "regime/sound/recent_history.hpp"

namespace squeal::regime {

/// The result of a time integration.
struct Trajectory {
  Regime regime;
  cycles::Passes passes;  ///< set if periodic motions are computed
  sound::Trace trace;     ///< only on the rank that computed it
};

/// Returns the rank that computes the task with this index.
int rankOf(MPI_Comm comm, std::size_t task);

/// Collective. Computes the time integrations of the tasks without a failure. Returns the results
/// on all ranks, [task], unmeasured for failed tasks; only Trajectory::trace stays on the rank that
/// computed it. Sets Task::failure if a time integration ends with an Error or before the end of
/// its first window.
std::vector<Trajectory> trajectories(MPI_Comm comm, const ReducedModel& model,
                                     const Settings& settings, std::vector<Task>& tasks,
                                     Stage& stage);

}  // namespace squeal::regime
