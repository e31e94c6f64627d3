// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/state_log.hpp"

#include "steady/steady/serialization.hpp"

namespace squeal::analysis {

StateLog::StateLog(MPI_Comm comm, checkpoint::Checkpoint& checkpoint, SteadyStates& states)
    : comm_(comm), checkpoint_(checkpoint), states_(states), begin_(MPI_Wtime()) {
  while (auto entry = checkpoint_.next("steady")) serialise(*entry);
}

void StateLog::write() {
  if (checkpoint_.due()) writeEntry();
}

void StateLog::finish() {
  const bool isLeft = logged_ < states_.solutions.size();
  if ((isLeft && checkpoint_.isWorth(MPI_Wtime() - begin_)) || checkpoint_.due()) writeEntry();
}

void StateLog::writeEntry() {
  checkpoint::Archive archive(comm_);
  serialise(archive);
  checkpoint_.write("steady", archive);
}

void StateLog::serialise(checkpoint::Archive& archive) {
  std::size_t count = states_.solutions.size();
  archive.common(count, states_.events);
  states_.solutions.resize(count);
  for (; logged_ < count; ++logged_) steady::serialise(archive, states_.solutions[logged_]);
  archive.own(states_.path);  // the whole path, which is short
}

}  // namespace squeal::analysis
