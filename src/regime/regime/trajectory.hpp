// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Marches of a reduced model, each by one rank, and their records [M.72–M.74].
#include <mpi.h>

#include <vector>

#include "base/session/stages.hpp"
#include "regime/cycles/section.hpp"
#include "regime/regime/record.hpp"
#include "regime/regime/settings.hpp"
#include "regime/regime/task.hpp"
#include "regime/sound/recent_history.hpp"

namespace squeal::regime {

/// The result of a march.
struct Trajectory {
  Regime regime;
  cycles::Passes passes;  ///< if periodic motions are computed
  sound::Trace trace;     ///< on the rank that marched
};

/// Returns the rank that marches the task of this index.
int rankOf(MPI_Comm comm, std::size_t task);

/// Collective. Computes the marches of the tasks without a failure. Returns the results on all
/// ranks, [task], empty for failed tasks; a trace is on the rank that marched. Sets the failures of
/// marches that end with an Error or without a measurement.
std::vector<Trajectory> trajectories(MPI_Comm comm, const ReducedModel& model,
                                     const Settings& settings, std::vector<Task>& tasks,
                                     Stage& stage);

}  // namespace squeal::regime
