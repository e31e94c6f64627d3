#include "base/session/stages.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/options/options.hpp"
#include "base/petsc/check.hpp"
#include "base/session/events.hpp"
#include "base/system/text.hpp"

namespace squeal {
namespace {

const FlagOption quiet("general", "quiet", false, "print nothing but errors");

std::vector<StageRecord>& records() {
  static std::vector<StageRecord> list;
  return list;
}

int& outputErrorSlot() {
  static int error = 0;
  return error;
}

bool speaks(MPI_Comm comm) {
  int rank = 0;
  check(MPI_Comm_rank(comm, &rank));
  return rank == 0 && !isQuiet();
}

}  // namespace

Stage::Stage(MPI_Comm comm, std::string name)
    : comm_(comm),
      name_(std::move(name)),
      begin_(MPI_Wtime()),
      lastProgress_(begin_),
      before_(trafficSoFar()),
      logged_(name_) {
  tellEvent("stage_begin", {{"stage", name_}});
  showStage(name_);
}

Stage::~Stage() {
  if (logged_)  // it has come to nothing that is told
    tellEvent("stage_end", {{"stage", name_}, {"seconds", MPI_Wtime() - begin_}});
  showStage("");
}

void Stage::progress(const std::string& text) {
  if (MPI_Wtime() - lastProgress_ >= 2) say(text);
}

void Stage::say(const std::string& text) {
  lastProgress_ = MPI_Wtime();
  tellEvent("progress", {{"stage", name_}, {"text", text}});
  if (!speaks(comm_)) return;
  print(formatted("%-10s %8.2f s … %s\n", name_.c_str(), lastProgress_ - begin_, text.c_str()));
}

void Stage::finish(const std::string& result) {
  const Traffic now = trafficSoFar();
  logged_.reset();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double memory = 1024.0 * usage.ru_maxrss;
  double seconds = MPI_Wtime() - begin_;
  check(MPI_Allreduce(MPI_IN_PLACE, &seconds, 1, MPI_DOUBLE, MPI_MAX, comm_));
  std::array sums{memory, now.messages - before_.messages, now.bytes - before_.bytes};
  double reductions = now.reductions - before_.reductions;
  check(MPI_Allreduce(MPI_IN_PLACE, sums.data(), sums.size(), MPI_DOUBLE, MPI_SUM, comm_));
  check(MPI_Allreduce(MPI_IN_PLACE, &reductions, 1, MPI_DOUBLE, MPI_MAX, comm_));
  auto known = std::find_if(records().begin(), records().end(),
                            [&](const auto& record) { return record.name == name_; });
  if (known == records().end()) known = records().insert(known, {name_, 0, 0, {}});
  known->seconds += seconds;
  known->peakMemoryBytes = sums[0];
  known->traffic.messages += sums[1];
  known->traffic.bytes += sums[2];
  known->traffic.reductions += reductions;
  tellEvent(
      "stage_end",
      {{"stage", name_}, {"seconds", seconds}, {"peak_memory_bytes", sums[0]}, {"result", result}});
  if (!speaks(comm_)) return;
  print(formatted("%-10s %8.2f s  %s\n", name_.c_str(), seconds, result.c_str()));
}

bool isQuiet() { return quiet.get(); }

void say(MPI_Comm comm, const std::string& text) {
  tellEvent("message", {{"text", text}});
  if (!speaks(comm)) return;
  print(text + "\n");
}

void print(const std::string& text) {
  const LineAway away;
  if ((std::fputs(escaped(text).c_str(), stdout) < 0 || std::fflush(stdout) != 0) &&
      outputErrorSlot() == 0)
    outputErrorSlot() = errno;
}

int outputError() { return outputErrorSlot() == EPIPE ? 0 : outputErrorSlot(); }

void complain(MPI_Comm comm, const std::string& text) {
  int rank = 0;
  check(MPI_Comm_rank(comm, &rank));
  if (rank > 0) return;
  tellEvent("warning", {{"text", text}});
  const LineAway away;
  std::fprintf(stderr, "squeal: %s\n", escaped(text).c_str());
}

const std::vector<StageRecord>& stageRecords() { return records(); }

}  // namespace squeal
