// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A run of the program that a test does something to while it runs.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <thread>

#include "support/harness/folder_files.hpp"
#include "support/harness/program.hpp"

namespace squeal::test {

/// True as soon as the condition holds, false after the time limit.
inline bool waitUntil(const std::function<bool()>& condition, double seconds = 60) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

/// mpirun with the program, its results in `name`/results, where what lies there stays.
class Started {
 public:
  Started(const std::string& name, int ranks, const std::string& options) : place_(placeFor(name)) {
    fs::create_directories(place_);
    for (const auto& file : {out(), error()}) writeText(file, "");
    const std::string command = "cd '" SQUEAL_SOURCE_DIR "' && exec '" SQUEAL_MPIEXEC "' " +
                                std::to_string(ranks) + secondToEnd + " '" SQUEAL_EXECUTABLE "' " +
                                options + " -report_dir '" + folder().string() + "' >'" +
                                out().string() + "' 2>'" + error().string() + "'";
    process_ = fork();
    if (process_ == 0) {
      setsid();  // a signal for the test is none for the run; see tests/CMakeLists.txt
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
  }
  ~Started() {
    if (!ended_) kill(process_, SIGKILL);
    if (!ended_) waitpid(process_, nullptr, 0);
  }
  Started(const Started&) = delete;
  Started& operator=(const Started&) = delete;

  fs::path folder() const { return place_ / "results"; }
  pid_t mpirun() const { return process_; }
  /// The process of a rank; 0: there is none (yet).
  pid_t rank(int wanted) const {
    for (const auto& [process, rank] : processes())
      if (rank == wanted) return process;
    return 0;
  }
  /// Waits until the program has printed a line that begins so.
  bool printed(const std::string& begin) const {
    return waitUntil([&] {
             return ended() || ("\n" + contentOf(out())).find("\n" + begin) != std::string::npos;
           }) &&
           !ended();
  }
  /// The same for a stage; the last one, whose line stands at its end, is reached when the first
  /// fields are written.
  bool reached(const std::string& stage) const {
    if (stage != "report") return printed(stage);
    return waitUntil([&] { return ended() || fs::exists(folder() / ".partial" / "vtk"); }) &&
           !ended();
  }
  bool ended() const {
    int status = 0;
    if (!ended_ && waitpid(process_, &status, WNOHANG) == process_) {
      ended_ = true;
      exitCode_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    return ended_;
  }
  /// Waits for the end of mpirun and of the ranks, for which mpirun does not wait when it is ended
  /// by a signal.
  ProgramRun finished(double seconds = 60) {
    ProgramRun run;
    run.folder = folder();
    run.exitCode = waitUntil([&] { return ended(); }, seconds) ? exitCode_ : 124;
    const bool gone = waitUntil([&] { return processes().empty(); }, 20);
    EXPECT_TRUE(gone) << "a rank is left running";
    run.out = contentOf(out());
    run.error = contentOf(error());
    return run;
  }

 private:
  fs::path out() const { return place_ / "stdout.txt"; }
  fs::path error() const { return place_ / "stderr.txt"; }
  static std::string procFile(pid_t process, const char* name) {
    std::ifstream file("/proc/" + std::to_string(process) + "/" + name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  /// The processes of the program that name the folder, and their ranks.
  std::vector<std::pair<pid_t, int>> processes() const {
    std::vector<std::pair<pid_t, int>> found;
    for (const auto& entry : fs::directory_iterator("/proc")) {
      const std::string name = entry.path().filename();
      if (name.find_first_not_of("0123456789") != std::string::npos) continue;
      const auto process = static_cast<pid_t>(std::stol(name));
      const std::string words = procFile(process, "cmdline");
      if (words.rfind(SQUEAL_EXECUTABLE, 0) != 0 ||
          words.find('\0' + folder().string() + '\0') == std::string::npos)
        continue;
      const std::string environment = procFile(process, "environ"), key = "OMPI_COMM_WORLD_RANK=";
      if (const auto begin = environment.find(key); begin != std::string::npos)
        found.emplace_back(process, std::stoi(environment.substr(begin + key.size())));
    }
    return found;
  }

  fs::path place_;
  pid_t process_ = 0;
  mutable bool ended_ = false;
  mutable int exitCode_ = -1;
};

}  // namespace squeal::test
