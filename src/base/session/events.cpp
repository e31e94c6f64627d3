// SPDX-License-Identifier: BSD-2-Clause
#include "base/session/events.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string_view>
#include <thread>

#include "base/petsc/check.hpp"
#include "base/session/session.hpp"
#include "base/session/stages.hpp"
#include "base/system/regular_file.hpp"
#include "base/system/text.hpp"

namespace squeal {
namespace {

/// The reported state of a run; on rank 0.
struct Run {
  std::recursive_mutex gate;
  std::FILE* file = nullptr;
  double begin = 0;  // s
  std::string stage;
  std::size_t done = 0, total = 0;  // points
  double firstPoint = 0;            // start of the first point, s
  bool hasLine = false, shown = false;
  int away = 0;
  std::condition_variable_any ends;
  std::jthread clock;  // redraws the line twice a second
};

Run& run() {
  static Run one;
  return one;
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string clockText(double seconds) {
  const long s = std::lround(seconds);
  return s < 3600 ? formatted("%02ld:%02ld", s / 60, s % 60)
                  : formatted("%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
}

std::string lineText() {
  const Run& r = run();
  std::string text = r.stage.empty() ? "squeal" : r.stage;
  if (r.total > 0) text += formatted(" · point %zu of %zu", r.done, r.total);
  text += " · " + clockText(now() - r.begin);
  if (r.done > 0 && r.done < r.total && r.firstPoint > 0)
    text += " · about " +
            clockText((now() - r.firstPoint) / double(r.done) * double(r.total - r.done)) + " left";
  return text;
}

void erase() {
  if (!run().shown) return;
  std::fputs("\r\033[K", stdout);
  run().shown = false;
}

void draw() {
  if (!run().hasLine || run().away > 0) return;
  winsize window{};
  const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0;
  std::string text = lineText();
  // A line that wraps could not be erased. The dots between words take two bytes and one column.
  if (const std::size_t most = known ? window.ws_col - 1 : 79; text.size() > most)
    text = text.substr(0, most), text.erase(text.find_last_not_of("\xc2") + 1);
  std::fputs(("\r\033[K" + text).c_str(), stdout);
  std::fflush(stdout);
  run().shown = true;
}

/// True if mpirun or srun started the run. Evaluated before MPI starts, which sets such variables
/// itself.
const bool isLaunched =
    std::ranges::any_of(std::array{"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "SLURM_PROCID"},
                        [](const char* name) { return std::getenv(name) != nullptr; });

bool wantsLine(const OutputSettings& settings) {
  if (settings.quiet) return false;
  if (settings.progress != "auto") return settings.progress == "line";
  // A terminal that cannot erase a line, as in editors, is of type "dumb".
  const char* kind = std::getenv("TERM");
  return !isLaunched && isatty(STDOUT_FILENO) == 1 && kind && std::string_view(kind) != "dumb";
}

/// Opens the file to append to it. Throws Error if the path exists and is not an event log. A link
/// to a device, such as /dev/stderr, is followed; a link to a file is not, since it may lead to
/// another user's file.
std::FILE* openLog(const std::string& path) {
  constexpr std::string_view head = R"({"event":)";
  const std::string failure = "cannot write " + path;
  std::error_code none;
  int file = -1;
  if (std::filesystem::is_character_file(std::filesystem::status(path, none)))
    file = open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  else {
    file = openRegular(path, O_RDWR | O_APPEND | O_CREAT, failure);
    std::string begin(head.size(), ' ');
    const auto count = pread(file, begin.data(), begin.size(), 0);
    if (count != 0 && begin != head) {
      close(file);
      throw Error(path + " already exists and is not an event log");
    }
  }
  std::FILE* stream = file < 0 ? nullptr : fdopen(file, "a");
  if (!stream) throw Error(failure + ": " + std::strerror(errno));
  return stream;
}

std::string timeText() {
  char text[32] = "";
  const std::time_t time = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&time, &parts);
  std::strftime(text, sizeof text, "%FT%TZ", &parts);
  return text;
}

}  // namespace

void beginEvents(MPI_Comm comm, const OutputSettings& settings) {
  const std::string& path = settings.eventLog;
  const bool line = wantsLine(settings);
  onFirstRank(comm, "option -log_json: ", [&] {
    Run& r = run();
    r.begin = now();
    if (!path.empty()) r.file = openLog(path);
    r.hasLine = line;
    if (line)
      r.clock = std::jthread([](const std::stop_token& stop) {
        Run& shared = run();
        std::unique_lock lock(shared.gate);
        for (draw(); !stop.stop_requested(); draw())
          shared.ends.wait_for(lock, stop, std::chrono::milliseconds(500), [] { return false; });
      });
  });
  logEvent("start", {{"version", version()}, {"ranks", mpi::size(comm)}});
}

void endEvents(int exitCode) {
  logEvent("end", {{"exit_code", exitCode}});
  Run& r = run();
  if (r.clock.joinable()) {
    r.clock.request_stop();
    r.clock.join();
  }
  const std::lock_guard lock(r.gate);
  erase();
  std::fflush(stdout);
  r.hasLine = false;
  if (r.file) std::fclose(r.file);
  r.file = nullptr;
}

void logEvent(const std::string& event, nlohmann::ordered_json members) {
  Run& r = run();
  const std::lock_guard lock(r.gate);
  if (!r.file) return;
  nlohmann::ordered_json all{{"event", event},
                             {"time", timeText()},
                             {"elapsed_s", std::round(1e3 * (now() - r.begin)) / 1e3}};
  all.update(members);
  // Texts of other libraries may not be UTF-8. The escapes of hidden characters are those of JSON.
  const std::string text =
      escaped(all.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) + "\n";
  if (std::fputs(text.c_str(), r.file) >= 0 && std::fflush(r.file) == 0) return;
  std::fprintf(stderr, "squeal: warning: no more events are written to -log_json: %s\n",
               std::strerror(errno));
  std::fclose(r.file);
  r.file = nullptr;
}

void expectPoints(std::size_t count) {
  const std::lock_guard lock(run().gate);
  run().total = count;
}

void pointsDone(std::size_t count) {
  Run& r = run();
  const std::lock_guard lock(r.gate);
  r.done += count;
  logEvent("points", {{"done", r.done}, {"total", r.total}});
}

void showStage(const std::string& stage) {
  Run& r = run();
  const std::lock_guard lock(r.gate);
  r.stage = stage;
  if (stage == "flutter" && r.firstPoint == 0) r.firstPoint = now();
}

ClearedLine::ClearedLine() {
  run().gate.lock();
  ++run().away;
  erase();
}

ClearedLine::~ClearedLine() {
  --run().away;
  draw();
  run().gate.unlock();
}

}  // namespace squeal
