// SPDX-License-Identifier: BSD-2-Clause
/// main() of the program that solves random models. A separate process, which is restarted if it
/// crashes or hangs, solves a batch of them; every fourth model is also solved on two ranks.
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/petsc/check.hpp"
#include "base/session/session.hpp"
#include "base/system/text.hpp"
#include "fuzz/models/compare.hpp"
#include "fuzz/models/paths.hpp"

namespace squeal::fuzz {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr double longestSeconds = 60;     // for a model with all its ways
constexpr std::uint64_t batchSize = 100;  // models of a process
constexpr std::uint64_t rankStride = 4;   // of the models that are solved on two ranks too
constexpr int mostFailures = 20;

fs::path folder() {
  const fs::path path =
      fs::path(SQUEAL_OUTPUT_DIR) / "fuzz" / ("models_" + std::to_string(getpid()));
  fs::create_directories(path);
  return path;
}

void writeText(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

std::string contentOf(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void writeForm(const Model& model, const Form& form, const fs::path& place) {
  fs::create_directories(place);
  const Written files = written(model, form);
  std::string features;
  for (const auto& feature : model.features) features += " " + feature + ",";
  writeText(place / "model.msh", files.mesh);
  writeText(place / "case.yaml",
            caseText(files, "model.msh", "model " + std::to_string(model.seed) + ":" + features));
}

/// Writes the mesh file and the options file of a model, and those of its other forms in folders
/// beside them.
void writeModel(const Model& model, const fs::path& place) {
  writeForm(model, {}, place);
  writeForm(model, {true, 0, {}}, place / "shuffled");
  for (int turn = 1; turn <= 2 && model.mesh.dimension == 3; ++turn)
    writeForm(model, {false, turn, {}}, place / ("turned_" + std::to_string(turn)));
  for (int i = 0; i < bondForms && model.glue; ++i) {
    std::string name = text(Bond(i));
    std::ranges::replace(name, ' ', '_');
    writeForm(model, {false, 0, Bond(i)}, place / name);
  }
}

// --- the process that solves ---

/// Appends a line for the parent to `results`, on rank 0.
void tell(std::FILE* results, const json& line) {
  if (!results) return;
  std::fprintf(results, "%s\n", line.dump().c_str());
  std::fflush(results);
}

json judgedAlone(const Model& model, bool allPaths, const fs::path& place) {
  const Judgement judgement = judge(model, allPaths, place);
  json line{{"seed", model.seed},
            {"failure", judgement.failure},
            {"refusal", judgement.base.refusal},
            {"paths", judgement.paths}};
  if (model.seed % rankStride == 0) line["base"] = toJson(judgement.base);
  return line;
}

/// Collective. Solves the models, on one rank with their other ways.
int work(const fs::path& results, const fs::path& place, std::uint64_t first, std::uint64_t count,
         bool allPaths) {
  char program[] = "fuzz", *arguments[] = {program, nullptr};
  const Session session(1, arguments);
  std::FILE* file = session.rank() == 0 ? std::fopen(results.c_str(), "w") : nullptr;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    if (session.size() > 1 && seed % rankStride != 0) continue;
    tell(file, {{"begin", seed}});
    const Model model = modelOf(seed);
    const auto start = Clock::now();
    json line;
    try {
      if (session.size() == 1)
        line = judgedAlone(model, allPaths, place);
      else
        line = {{"seed", seed}, {"base", toJson(run(model, {}, {}, place))}};
    } catch (const std::exception& error) {
      line = {{"seed", seed}, {"failure", std::string("an exception escapes: ") + error.what()}};
    }
    line["seconds"] = std::chrono::duration<double>(Clock::now() - start).count();
    tell(file, line);
  }
  if (file) std::fclose(file);
  return 0;
}

// --- the parent ---

/// What was found at a batch of models, by their seeds.
struct Batch {
  std::map<std::uint64_t, json> lines;
  std::optional<std::uint64_t> stopped;  ///< the model that the process has ended at
  std::string end;
};

class Driver {
 public:
  Driver(std::string program, bool allPaths)
      : program_(std::move(program)), allPaths_(allPaths), place_(folder()) {}
  ~Driver() {
    std::error_code ignored;
    fs::remove_all(place_, ignored);
  }

  int run(std::uint64_t first, std::uint64_t count) {
    for (std::uint64_t begin = first; begin < first + count && failures_ < mostFailures;
         begin += batchSize)
      runBatch(begin, std::min(batchSize, first + count - begin));
    print(count);
    return failures_ == 0 ? 0 : 1;
  }

 private:
  void runBatch(std::uint64_t begin, std::uint64_t count) {
    const auto onOne = solved(begin, count, 1);
    for (const auto& [seed, line] : onOne) take(seed, line);
    for (const auto& [seed, line] : solved(begin, count, 2)) {
      const auto other = onOne.find(seed);
      if (line.contains("failure")) fail(seed, "2 ranks: " + line["failure"].get<std::string>());
      if (!line.contains("base") || other == onOne.end() || !other->second.contains("base"))
        continue;
      const Outcome onTwo = fromJson(line["base"]);
      if (onTwo.refusal.starts_with("the mesh has ")) continue;  // fewer cells than ranks
      ++onTwoRanks_;
      const auto found = difference(fromJson(other->second["base"]), onTwo, Extent{});
      if (!found.empty()) fail(seed, "2 ranks: " + found);
    }
  }

  /// Solves models, with a new process behind each that crashes or hangs.
  std::map<std::uint64_t, json> solved(std::uint64_t begin, std::uint64_t count, int ranks) {
    std::map<std::uint64_t, json> all;
    const std::uint64_t end = begin + count;
    while (begin < end) {
      Batch batch = solvedByOne(begin, end - begin, ranks);
      for (auto& [seed, line] : batch.lines) all[seed] = std::move(line);
      if (!batch.stopped) break;
      all[*batch.stopped] = {{"seed", *batch.stopped}, {"failure", batch.end}};
      begin = *batch.stopped + 1;
    }
    return all;
  }

  Batch solvedByOne(std::uint64_t begin, std::uint64_t count, int ranks) {
    const fs::path results = place_ / "results", printed = place_ / "printed";
    std::ofstream(results).close();
    std::vector<std::string> words{program_,
                                   "--solve",
                                   results,
                                   place_,
                                   std::to_string(begin),
                                   std::to_string(count),
                                   allPaths_ ? "all" : "some"};
    if (ranks > 1) words.insert(words.begin(), {SQUEAL_MPIEXEC, std::to_string(ranks)});
    const pid_t child = start(words, printed);
    std::string end = watch(child, results);
    Batch batch;
    std::istringstream lines(contentOf(results));
    std::uint64_t next = begin;
    for (std::string text; std::getline(lines, text);) {
      const json line = json::parse(text, nullptr, false);
      if (line.is_discarded()) continue;
      if (line.contains("begin")) next = line["begin"].get<std::uint64_t>();
      if (!line.contains("seed")) continue;
      batch.lines[line["seed"].get<std::uint64_t>()] = line;
      next = line["seed"].get<std::uint64_t>() + 1;
    }
    if (end.empty()) return batch;
    batch.stopped = std::min(next, begin + count - 1);
    const std::string said = contentOf(printed);
    batch.end = end + "\n" + said.substr(said.size() > 1500 ? said.size() - 1500 : 0);
    return batch;
  }

  static pid_t start(const std::vector<std::string>& words, const fs::path& printed) {
    std::vector<char*> arguments;
    for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const pid_t child = fork();
    if (child != 0) return child;
    setsid();
    const int file = open(printed.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_APPEND, 0600);
    if (file < 0 || dup2(file, 1) < 0 || dup2(file, 2) < 0) _exit(126);
    execv(arguments[0], arguments.data());
    _exit(127);
  }

  /// Waits for a process; how it ended badly, or nothing. It is ended when nothing comes for too
  /// long.
  static std::string watch(pid_t child, const fs::path& results) {
    std::uintmax_t size = 0;
    for (auto since = Clock::now();; usleep(10000)) {
      int status = 0;
      if (waitpid(child, &status, WNOHANG) == child) {
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
        return WIFSIGNALED(status) ? std::string("ends by signal ") + strsignal(WTERMSIG(status))
                                   : "ends with exit code " + std::to_string(WEXITSTATUS(status));
      }
      if (const auto now = fs::file_size(results); now != size) size = now, since = Clock::now();
      if (std::chrono::duration<double>(Clock::now() - since).count() < longestSeconds) continue;
      kill(child, SIGTERM);  // mpirun ends its ranks
      usleep(1000000);
      kill(-child, SIGKILL);
      waitpid(child, &status, 0);
      return "takes longer than " + std::to_string(int(longestSeconds)) + " s";
    }
  }

  void take(std::uint64_t seed, const json& line) {
    const std::string failure = line.value("failure", ""), refusal = line.value("refusal", "");
    if (const double seconds = line.value("seconds", 0.0); seconds > slowestSeconds_)
      slowestSeconds_ = seconds, slowest_ = seed;
    for (const auto& path : line.value("paths", json::array())) ++paths_[path[0]];
    if (std::getenv("SQUEAL_FUZZ_LIST")) std::printf("%s\n", summary(seed, line).c_str());
    if (!failure.empty()) return fail(seed, failure);
    ++(refusal.empty() ? accepted_ : refused_);
    if (!refusal.empty()) ++refusals_[refusal.substr(0, 60)];
  }

  /// A line on a model: `SQUEAL_FUZZ_LIST`.
  static std::string summary(std::uint64_t seed, const json& line) {
    std::string text = "model " + std::to_string(seed) + ": ";
    for (const auto& feature : modelOf(seed).features) text += feature + ", ";
    for (const auto& path : line.value("paths", json::array()))
      text += formatted("%s %.2f s, ", path[0].get<std::string>().c_str(), path[1].get<double>());
    return text + formatted("all %.2f s; ", line.value("seconds", 0.0)) + line.value("refusal", "");
  }

  void fail(std::uint64_t seed, const std::string& failure) {
    const fs::path kept = fs::path(SQUEAL_OUTPUT_DIR) / "fuzz" / ("model_" + std::to_string(seed));
    writeModel(modelOf(seed), kept);
    std::printf("FAILED: model %llu, kept in %s\n%s\n", static_cast<unsigned long long>(seed),
                kept.c_str(), failure.c_str());
    ++failures_;
  }

  void print(std::uint64_t count) const {
    std::printf("compared by:");
    for (const auto& [path, number] : paths_) std::printf(" %s %d,", path.c_str(), number);
    std::printf(" 2 ranks %d\n", onTwoRanks_);
    for (const auto& [refusal, number] : refusals_)
      std::printf("refused %d times: %s\n", number, refusal.c_str());
    std::printf(
        "models: %llu inputs, %d accepted, %d refused, %d failures; slowest %.3f s (model "
        "%llu)\n",
        static_cast<unsigned long long>(count), accepted_, refused_, failures_, slowestSeconds_,
        static_cast<unsigned long long>(slowest_));
  }

  std::string program_;
  bool allPaths_;
  fs::path place_;
  int accepted_ = 0, refused_ = 0, failures_ = 0, onTwoRanks_ = 0;
  std::map<std::string, int> paths_, refusals_;
  double slowestSeconds_ = 0;
  std::uint64_t slowest_ = 0;
};

bool isNumber(const char* word) {
  return *word && std::strspn(word, "0123456789") == std::strlen(word);
}

std::uint64_t number(const char* word) { return std::strtoull(word, nullptr, 10); }

}  // namespace
}  // namespace squeal::fuzz

int main(int argc, char** argv) {
  using namespace squeal::fuzz;
  const std::vector<std::string> words(argv + 1, argv + argc);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  if (words.size() == 6 && words[0] == "--solve")
    return work(words[1], words[2], number(argv[4]), number(argv[5]), words.back() == "all");
  if (words.size() == 3 && words[0] == "--seed" && isNumber(argv[2]))
    return writeModel(modelOf(number(argv[2])), words[2]), 0;
  const bool all = !words.empty() && words.back() == "--all";
  const int numbers = argc - 1 - all;
  bool valid = numbers <= 2;
  for (int i = 1; i <= numbers && valid; ++i) valid = isNumber(argv[i]);
  if (!valid) {
    std::fprintf(stderr,
                 "usage: %s [COUNT [FIRST]] [--all] (models, by their numbers; --all: compared in "
                 "all ways) or %s --seed NUMBER FOLDER (writes the files of a model)\n",
                 argv[0], argv[0]);
    return 2;
  }
  setenv("OPENBLAS_NUM_THREADS", "1", 0);  // two threads on small matrices take twice as long
  const auto program = std::filesystem::read_symlink("/proc/self/exe").string();
  return Driver(program, all)
      .run(numbers > 1 ? number(argv[2]) : 0, numbers > 0 ? number(argv[1]) : 2000);
}
