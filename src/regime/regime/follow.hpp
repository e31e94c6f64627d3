#pragma once
/// Marches are done, each by one rank, and recorded [M.72–M.74].
#include <mpi.h>

#include <vector>

#include "base/session/stages.hpp"
#include "regime/cycles/section.hpp"
#include "regime/regime/record.hpp"
#include "regime/regime/settings.hpp"
#include "regime/regime/task.hpp"
#include "regime/sound/latest.hpp"

namespace squeal::regime {

/// A march leaves these behind.
struct Followed {
  Regime regime;
  cycles::Passes passes;  ///< where periodic motions are wanted
  sound::Trace trace;     ///< on the rank that marched
};

/// Returns the rank that marches the task of this number.
int rankOf(MPI_Comm comm, std::size_t task);

/// Collective. Does the marches of the tasks that have no failure. Returns on all ranks what they
/// leave behind, [task], nothing for those that fail; traces are on the rank that marched. Sets the
/// failures of marches that come to no end or measure nothing.
std::vector<Followed> followAll(MPI_Comm comm, const ReducedModel& model, const Settings& settings,
                                std::vector<Task>& tasks, Stage& stage);

}  // namespace squeal::regime
