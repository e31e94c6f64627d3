#pragma once
/// Marches are done, each by one rank, and recorded [M.72–M.74].
#include <mpi.h>

#include <vector>

#include "periodic/section.hpp"
#include "regime/record.hpp"
#include "regime/task.hpp"
#include "session/stages.hpp"
#include "sound/latest.hpp"

namespace squeal::regime {

/// A march leaves these behind.
struct Followed {
  Regime regime;
  periodic::Passes passes;  ///< where periodic motions are wanted
  sound::Trace trace;       ///< on the rank that marched
};

/// Returns the rank that marches the task of this number.
int rankOf(MPI_Comm comm, std::size_t task);

/// Collective. Does the marches of the tasks that have no failure. Returns on all ranks what they
/// leave behind, [task], nothing for those that fail; traces are on the rank that marched. Sets the
/// failures of marches that come to no end or measure nothing.
std::vector<Followed> followAll(MPI_Comm comm, const ReducedModel& model, std::vector<Task>& tasks,
                                Stage& stage);

}  // namespace squeal::regime
