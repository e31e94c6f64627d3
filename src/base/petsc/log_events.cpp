// SPDX-License-Identifier: BSD-2-Clause
#include "base/petsc/log_events.hpp"

#include <petsclog.h>

#include <array>
#include <map>

#include "base/petsc/check.hpp"
#include "base/system/mpi.hpp"

namespace squeal {
namespace {

constexpr std::array names{"BlockSolve", "BlockProduct", "InnerProduct", "DenseEigen", "Sketch"};

std::array<PetscLogEvent, names.size()>& events() {
  static std::array<PetscLogEvent, names.size()> list;
  return list;
}

bool& isRegistered() {
  static bool registered = false;
  return registered;
}

}  // namespace

void registerWork() {
  if (isRegistered()) return;
  isRegistered() = true;
  PetscClassId id = 0;
  check(PetscClassIdRegister("squeal", &id));
  for (std::size_t i = 0; i < names.size(); ++i)
    check(PetscLogEventRegister(names[i], id, &events()[i]));
}

LoggedWork::LoggedWork(Work work) {
  registerWork();
  event_ = events()[static_cast<std::size_t>(work)];
  check(PetscLogEventBegin(event_, nullptr, nullptr, nullptr, nullptr));
}

LoggedWork::~LoggedWork() { PetscLogEventEnd(event_, nullptr, nullptr, nullptr, nullptr); }

LoggedStage::LoggedStage(const std::string& name) {
  static std::map<std::string, PetscLogStage> known;
  const auto [place, isNew] = known.try_emplace(name);
  if (isNew) check(PetscLogStageRegister(name.c_str(), &place->second));
  check(PetscLogStagePush(place->second));
}

LoggedStage::~LoggedStage() { PetscLogStagePop(); }

Traffic trafficSoFar() {
  return {petsc_isend_ct + petsc_send_ct, petsc_isend_len + petsc_send_len,
          petsc_allreduce_ct + mpi::reductionsSoFar()};
}

SparseWork& sparseWork() {
  static SparseWork work;
  return work;
}

}  // namespace squeal
