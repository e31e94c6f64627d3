// SPDX-License-Identifier: BSD-2-Clause
#include "base/session/stages.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/petsc/check.hpp"
#include "base/session/events.hpp"
#include "base/system/process_memory.hpp"
#include "base/system/text.hpp"

namespace squeal {
namespace {

std::vector<StageRecord>& records() {
  static std::vector<StageRecord> list;
  return list;
}

bool& quietSlot() {
  static bool quiet = false;
  return quiet;
}

int& outputErrorSlot() {
  static int error = 0;
  return error;
}

/// Returns true if this rank prints the log.
bool prints(MPI_Comm comm) { return mpi::rank(comm) == 0 && !isQuiet(); }

}  // namespace

Stage::Stage(MPI_Comm comm, std::string name)
    : comm_(comm),
      name_(std::move(name)),
      begin_(MPI_Wtime()),
      lastProgress_(begin_),
      before_(trafficSoFar()),
      workBefore_(sparseWork()),
      logged_(name_) {
  logEvent("stage_begin", {{"stage", name_}});
  showStage(name_);
}

Stage::~Stage() {
  if (logged_)  // it has ended without a result
    logEvent("stage_end", {{"stage", name_}, {"seconds", MPI_Wtime() - begin_}});
  showStage("");
}

void Stage::progress(const std::string& text) {
  if (MPI_Wtime() - lastProgress_ >= 2) printLine(text);
}

void Stage::printLine(const std::string& text) {
  lastProgress_ = MPI_Wtime();
  logEvent("progress", {{"stage", name_}, {"text", text}});
  if (!prints(comm_)) return;
  print(formatted("%-10s %8.2f s … %s\n", name_.c_str(), lastProgress_ - begin_, text.c_str()));
}

void Stage::finish(const std::string& result) {
  const Traffic now = trafficSoFar();
  logged_.reset();
  releaseFreedMemory();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double memory = 1024.0 * usage.ru_maxrss;
  const double seconds = mpi::max(comm_, MPI_Wtime() - begin_);
  std::array sums{memory, now.messages - before_.messages, now.bytes - before_.bytes};
  mpi::reduce<double>(comm_, sums, MPI_SUM);
  const double reductions = mpi::max(comm_, now.reductions - before_.reductions);
  auto known = std::find_if(records().begin(), records().end(),
                            [&](const auto& record) { return record.name == name_; });
  if (known == records().end()) known = records().insert(known, {name_, 0, 0, {}, {}});
  known->seconds += seconds;
  known->peakMemoryBytes = sums[0];
  known->traffic.messages += sums[1];
  known->traffic.bytes += sums[2];
  known->traffic.reductions += reductions;
  const SparseWork& work = sparseWork();
  known->work.factorisations += work.factorisations - workBefore_.factorisations;
  known->work.rightHandSides += work.rightHandSides - workBefore_.rightHandSides;
  known->work.projections += work.projections - workBefore_.projections;
  logEvent(
      "stage_end",
      {{"stage", name_}, {"seconds", seconds}, {"peak_memory_bytes", sums[0]}, {"result", result}});
  if (!prints(comm_)) return;
  print(formatted("%-10s %8.2f s  %s\n", name_.c_str(), seconds, result.c_str()));
}

void setQuiet(bool quiet) { quietSlot() = quiet; }

bool isQuiet() { return quietSlot(); }

void printLine(MPI_Comm comm, const std::string& text) {
  logEvent("message", {{"text", text}});
  if (!prints(comm)) return;
  print(text + "\n");
}

void print(const std::string& text) {
  const ClearedLine away;
  if ((std::fputs(escaped(text).c_str(), stdout) < 0 || std::fflush(stdout) != 0) &&
      outputErrorSlot() == 0)
    outputErrorSlot() = errno;
}

int outputError() { return outputErrorSlot() == EPIPE ? 0 : outputErrorSlot(); }

void printWarning(MPI_Comm comm, const std::string& text) {
  if (mpi::rank(comm) > 0) return;
  logEvent("warning", {{"text", text}});
  const ClearedLine away;
  std::fprintf(stderr, "squeal: %s\n", escaped(text).c_str());
}

const std::vector<StageRecord>& stageRecords() { return records(); }

}  // namespace squeal
