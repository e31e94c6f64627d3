// SPDX-License-Identifier: BSD-2-Clause
#include "base/system/child_work.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <stdexcept>

#include "base/system/process_memory.hpp"
#include "base/system/text.hpp"

namespace squeal {
namespace {

constexpr unsigned patience = 30;  // s, until a line reports that the child is still running
constexpr const char* version = "job of squeal " SQUEAL_VERSION;

void limit(decltype(RLIMIT_AS) resource, double value) {
  rlimit now{};
  if (getrlimit(resource, &now) != 0) return;
  const rlim_t wanted = value;
  now.rlim_cur = std::min(now.rlim_cur, wanted);
  setrlimit(resource, &now);
}

void writeAll(int file, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = write(file, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;  // the parent has died, or will notice the missing bytes
    bytes += written, count -= written;
  }
}

std::vector<char> readAll(int file) {
  std::vector<char> bytes;
  for (char piece[4096];;) {
    const ssize_t got = read(file, piece, sizeof piece);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return bytes;
    bytes.insert(bytes.end(), piece, piece + got);
  }
}

char runningText[512];  // a signal handler can only write a text that exists already
int errorOutput = 2;

void reportStillRunning(int) {
  [[maybe_unused]] const auto written = write(errorOutput, runningText, std::strlen(runningText));
}

}  // namespace

void fields(Stream& stream, ChildLimits& limits) {
  auto& [subject, processorSeconds, memoryBytes, noMemory, program] = limits;
  stream(subject, processorSeconds, memoryBytes, noMemory, program);
}

void answer(int pipe, Outcome outcome, const char* bytes, std::size_t count) {
  writeAll(pipe, reinterpret_cast<const char*>(&outcome), 1);
  writeAll(pipe, reinterpret_cast<const char*>(&count), sizeof count);
  writeAll(pipe, bytes, count);
}

void resetSignals() {
  for (int number = 1; number < NSIG; ++number)
    signal(number, number == SIGTERM || number == SIGUSR1 ? SIG_IGN : SIG_DFL);
}

void closeOutputs() {
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  errorOutput = fcntl(2, F_DUPFD_CLOEXEC, 3);
  for (int file : {0, 1, 2}) dup2(nowhere, file);
}

void workAndExit(int pipe, const ChildLimits& limits,
                 const std::function<std::vector<char>(const Warn&)>& work) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_AS, addressSpace() + limits.memoryBytes);
  if (limits.processorSeconds) limit(RLIMIT_CPU, std::ceil(*limits.processorSeconds));
  std::snprintf(runningText, sizeof runningText, "squeal: %s: %s has been running for %u s\n",
                limits.subject.c_str(), limits.program.c_str(), patience);
  signal(SIGALRM, reportStillRunning);
  alarm(patience);
  try {
    const std::vector<char> result = work([&](const std::string& text) {
      dprintf(errorOutput, "squeal: warning: %s\n", escaped(text).c_str());
    });
    answer(pipe, Outcome::result, result.data(), result.size());
  } catch (const std::bad_alloc&) {
    answer(pipe, Outcome::noMemory, "", 0);
  } catch (const std::length_error&) {  // a vector longer than the address space
    answer(pipe, Outcome::noMemory, "", 0);
  } catch (const std::exception& error) {
    const std::string text = error.what();
    answer(pipe, Outcome::failure, text.data(), text.size());
  }
  _exit(0);
}

std::vector<char> Assignment::bytes(ChildLimits limits, std::vector<char> job) {
  std::string begin = version;
  Stream stream;
  stream(begin, limits, job);
  return std::move(stream).bytes();
}

Assignment::Assignment() {
  resetSignals();
  if (isatty(0)) {
    std::fputs("squeal: error: this is an internal program: start squeal\n", stderr);
    std::exit(1);
  }
  try {
    Stream stream(readAll(0));
    std::string begin;
    stream(begin);
    if (begin != version) throw Error("it comes from another version of squeal");
    stream(limits_, job_);
  } catch (const std::exception& error) {
    const std::string text = std::string("an internal program of squeal cannot read its job (") +
                             error.what() + "): install all programs of squeal together";
    answer(1, Outcome::failure, text.data(), text.size());
    std::exit(1);
  }
  pipe_ = fcntl(1, F_DUPFD_CLOEXEC, 3);
  closeOutputs();
}

void Assignment::perform(const Work& work) {
  workAndExit(pipe_, limits_, [&](const Warn& warn) { return work(std::move(job_), warn); });
}

}  // namespace squeal
