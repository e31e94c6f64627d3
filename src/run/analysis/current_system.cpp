// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/current_system.hpp"

#include "base/session/stages.hpp"
#include "base/system/text.hpp"

namespace squeal::analysis {

std::unique_ptr<contact::CoupledSystem> CurrentSystem::make(const contact::ActiveSet& active) {
  if (++made_ == 1 && !open_)
    return std::make_unique<contact::CoupledSystem>(model_.bodies, model_.contact, active);
  return std::make_unique<contact::CoupledSystem>(open(), model_.contact, active);
}

const contact::OpenProjections& CurrentSystem::open() {
  if (!open_) open_.emplace(model_.bodies, model_.contact);
  return *open_;
}

void CurrentSystem::dropOpen() {
  open_.reset();
  made_ = 0;
}

const contact::CoupledSystem& CurrentSystem::of(const contact::ActiveSet& active) {
  const MPI_Comm comm = model_.mesh->comm;
  if (system_ && contact::sameOnAllRanks(comm, system_->activeSet(), active)) return *system_;
  system_.reset();  // frees the old factorisation before the new one is made
  Stage stage(comm, "contact");
  system_ = make(active);
  const PetscInt nodes = model_.contact.interfaces.totalNodes;
  stage.finish(formatted("%" PetscInt_FMT " unknowns with %" PetscInt_FMT " of %" PetscInt_FMT
                         " contact nodes closed",
                         system_->size(), nodes - system_->openNodes(), nodes));
  return *system_;
}

}  // namespace squeal::analysis
