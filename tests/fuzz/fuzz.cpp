// SPDX-License-Identifier: BSD-2-Clause
/// main() of the programs of this folder. A child process reads the inputs one after the other; its
/// parent sees it crash or hang, keeps the input, and starts another child behind it.
#include "fuzz/fuzz.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <sstream>

#include "base/petsc/check.hpp"
#include "base/session/session.hpp"
#include "fuzz/mutator.hpp"

#if defined(__SANITIZE_ADDRESS__)
// An allocation of more than this is by a header's word alone: no input is longer than some
// kilobytes.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
  // Into files, since readers that work in a process of their own close its standard error output.
  return "detect_leaks=0:allocator_may_return_null=1:max_allocation_size_mb=256:log_exe_name=1:log_"
         "path=" SQUEAL_OUTPUT_DIR "/sanitizer";
}
extern "C" const char* __ubsan_default_options();
extern "C" const char* __ubsan_default_options() { return "print_stacktrace=1"; }
constexpr bool sanitized = true;
/// Has programs that a reader starts report in the same way.
static void passSanitizerOptions() {
  setenv("ASAN_OPTIONS", __asan_default_options(), 1);
  setenv("UBSAN_OPTIONS", __ubsan_default_options(), 1);
}
#else
constexpr bool sanitized = false;
static void passSanitizerOptions() {}
#endif

namespace squeal::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double longestSeconds = 10;
constexpr int mostFailures = 10;
constexpr rlim_t memory = 1 << 28;  // bytes that a reader may ask for

/// Shared by parent and child.
struct Progress {
  std::atomic<std::uint64_t> current, accepted, refused, slowest;
  std::atomic<double> slowestSeconds;
  std::atomic<bool> reading;
  char name[64], suffix[16], failure[2048];
};

std::string contentOf(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void writeBytes(const fs::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

fs::path folder() {
  const fs::path path = fs::path(SQUEAL_OUTPUT_DIR) / "fuzz";
  fs::create_directories(path);
  return path;
}

/// By the child's number: several programs may run at once.
fs::path pathOf(pid_t child, const std::string& end) {
  return folder() / (std::to_string(child) + end);
}

void limitMemory() {
  if (sanitized) return;  // the sanitizer needs terabytes of addresses and has a limit of its own
  std::ifstream file("/proc/self/statm");
  rlim_t pages = 0;
  if (!(file >> pages)) return;
  const rlim_t limit = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + memory;
  const rlimit both{limit, limit};
  setrlimit(RLIMIT_AS, &both);
}

/// A refusal is one line in our words. onFirstRank makes an Error of every exception: what the
/// standard library says shows through.
std::string faultOf(const std::string& message) {
  for (const char* foreign : {"std::", "vector::", "basic_string", "stoi", "stod",
                              "not enough memory", ": it requires more memory than is free", "\n"})
    if (message.find(foreign) != std::string::npos) return "the message is: " + message;
  return message.empty() ? "an empty message" : "";
}

/// Reads one input; why it is a failure, or nothing.
std::string judge(const Target& target, const fs::path& input, bool isSeed, Progress& progress) {
  try {
    target.read(input.string());
    ++progress.accepted;
    return "";
  } catch (const Error& error) {
    ++progress.refused;
    return isSeed ? std::string("a sound file is refused: ") + error.what() : faultOf(error.what());
  } catch (const std::exception& error) {
    return std::string("an exception escapes: ") + error.what();
  } catch (...) {
    return "an exception of unknown type escapes";
  }
}

/// Warnings of the program are no fault.
std::string said(const fs::path& path) {
  std::istringstream lines(contentOf(path));
  std::string text;
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("squeal: warning: ", 0) != 0) text += line + "\n";
  return text.empty() ? "" : "the reader prints:\n" + text.substr(0, 1500);
}

/// A library that is known to err on damaged files, and is called in a process of its own, is at
/// fault; the first lines of a report tell.
bool isOfLibrary(const std::string& report) {
  std::istringstream lines(report);
  std::string line;
  for (int frames = 0; frames < 4 && std::getline(lines, line);) {
    frames += line.find("    #") == 0;
    for (const char* library : {"libhdf5", "libgmsh", "failed to allocate"})
      if (line.find(library) != std::string::npos) return true;
  }
  return false;
}

/// Returns the reports of the sanitizers on the process `reader` and of those that it has started.
/// The reports are removed.
std::string reported(pid_t reader) {
  if (!sanitized) return "";
  const std::string name =
      "sanitizer." + fs::read_symlink("/proc/self/exe").filename().string() + ".";
  std::string text;
  for (const auto& entry : fs::directory_iterator(SQUEAL_OUTPUT_DIR)) {
    const std::string found = entry.path().filename();
    if (!found.starts_with(name) && !found.starts_with("sanitizer.squeal_gmsh.")) continue;
    const std::string report = contentOf(entry.path());
    if (found == name + std::to_string(reader) || !isOfLibrary(report)) text += report;
    fs::remove(entry.path());
  }
  return text.empty() ? "" : "a sanitizer reports:\n" + text.substr(0, 1500);
}

/// The child. What it prints goes into a file.
int readAll(std::uint64_t first, std::uint64_t count, Progress& progress) {
  const fs::path printed = pathOf(getpid(), ".printed");
  const int file = open(printed.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_APPEND, 0600);
  if (file < 0 || dup2(file, 1) < 0 || dup2(file, 2) < 0) return 2;
  passSanitizerOptions();
  char program[] = "fuzz", *arguments[] = {program, nullptr};
  Session session(1, arguments);
  const Target target = fuzz::target();
  const fs::path input = pathOf(getpid(), target.suffix);
  std::snprintf(progress.name, sizeof progress.name, "%s", target.name.c_str());
  std::snprintf(progress.suffix, sizeof progress.suffix, "%s", target.suffix.c_str());
  limitMemory();
  for (std::uint64_t number = first; number < first + count; ++number) {
    writeBytes(input, inputOf(target.seeds, number));
    progress.current = number;
    progress.reading = true;
    const auto start = Clock::now();
    std::string failure = judge(target, input, number < target.seeds.size(), progress);
    std::fflush(nullptr);
    progress.reading = false;
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (seconds > progress.slowestSeconds)
      progress.slowestSeconds = seconds, progress.slowest = number;
    if (failure.empty()) failure = said(printed);
    if (failure.empty()) failure = reported(getpid());
    if (failure.empty()) continue;
    std::snprintf(progress.failure, sizeof progress.failure, "%s", failure.c_str());
    _exit(1);
  }
  fs::remove(input);
  return 0;
}

/// Waits for the child; how it ended badly, or nothing. It is ended if it reads one input for too
/// long.
std::string watch(pid_t child, const Progress& progress) {
  std::uint64_t current = 0;
  bool reading = false;
  for (auto since = Clock::now();; usleep(20000)) {
    int status = 0;
    if (waitpid(child, &status, WNOHANG) == child) {
      if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
      if (progress.failure[0]) return progress.failure;
      const std::string end = WIFSIGNALED(status)
                                  ? std::string("ends by signal ") + strsignal(WTERMSIG(status))
                                  : "ends with exit code " + std::to_string(WEXITSTATUS(status));
      return "the reader " + end + "\n" + said(pathOf(child, ".printed")) + reported(child);
    }
    if (!progress.reading || progress.current != current || !reading)
      since = Clock::now(), current = progress.current, reading = progress.reading;
    if (std::chrono::duration<double>(Clock::now() - since).count() < longestSeconds) continue;
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
    return "the reader takes longer than " + std::to_string(static_cast<int>(longestSeconds)) +
           " s";
  }
}

Progress& shared() {
  void* place =
      mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (place == MAP_FAILED) throw std::bad_alloc();
  return *new (place) Progress{};
}

int run(std::uint64_t begin, std::uint64_t count) {
  Progress& progress = shared();
  const std::uint64_t end = begin + count;
  std::uint64_t first = begin;
  int failures = 0;
  while (first < end && failures < mostFailures) {
    progress.failure[0] = '\0';
    progress.current = first;
    const pid_t child = fork();
    if (child == 0) std::exit(readAll(first, end - first, progress));
    const std::string failure = watch(child, progress);
    if (!failure.empty()) {
      const fs::path kept = folder() / (std::string(progress.name) + "_" +
                                        std::to_string(progress.current) + progress.suffix);
      std::error_code ignored;  // the session itself may have failed, before any input
      fs::rename(pathOf(child, progress.suffix), kept, ignored);
      std::printf("FAILED: input %llu, kept as %s\n%s\n",
                  static_cast<unsigned long long>(progress.current), kept.c_str(), failure.c_str());
      ++failures;
      first = progress.current + 1;
    } else {
      first = end;
    }
    fs::remove(pathOf(child, ".printed"));
  }
  const auto number = [](const auto& value) { return static_cast<unsigned long long>(value); };
  std::printf(
      "%s: %llu inputs, %llu accepted, %llu refused, %d failures; slowest %.3f s (input %llu)\n",
      progress.name, number(first - begin), number(progress.accepted), number(progress.refused),
      failures, progress.slowestSeconds.load(), number(progress.slowest));
  return failures == 0 ? 0 : 1;
}

/// One file, with all that the reader prints.
int replay(const char* path) {
  char program[] = "fuzz", *arguments[] = {program, nullptr};
  Session session(1, arguments);
  try {
    target().read(path);
    std::printf("accepted\n");
  } catch (const Error& error) {
    std::printf("refused: %s\n", error.what());
  }
  return 0;
}

bool isNumber(const char* word) {
  return *word && std::strspn(word, "0123456789") == std::strlen(word);
}

}  // namespace

std::string bytesWritten(const std::function<void(const std::string& path)>& write) {
  const fs::path path = pathOf(getpid(), ".seed");
  write(path.string());
  const std::string bytes = contentOf(path);
  fs::remove(path);
  return bytes;
}

}  // namespace squeal::fuzz

int main(int argc, char** argv) {
  using namespace squeal::fuzz;
  if (argc == 2 && !isNumber(argv[1])) return replay(argv[1]);
  if (argc > 3 || (argc > 1 && !isNumber(argv[1])) || (argc > 2 && !isNumber(argv[2]))) {
    std::fprintf(
        stderr,
        "usage: %s [COUNT [FIRST]] (inputs, by their numbers) or %s FILE (one input, again)\n",
        argv[0], argv[0]);
    return 2;
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  return run(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0,
             argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 10000);
}
