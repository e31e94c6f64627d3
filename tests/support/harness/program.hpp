// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Starts the program as its users do and reads what it leaves behind. For tests on one rank: the
/// program has ranks of its own.
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/system/text.hpp"

namespace squeal::test {

namespace fs = std::filesystem;

/// Option names (no dash) and values; an empty value: the bare option.
using Options = std::map<std::string, std::string>;

inline Options with(Options options, const Options& changes) {
  for (const auto& [name, value] : changes) options[name] = value;
  return options;
}

inline Options without(Options options, const std::vector<std::string>& names) {
  for (const auto& name : names)
    if (options.erase(name) != 1) throw std::logic_error("no option " + name + " to take away");
  return options;
}

/// The options file first: what comes after it overrides it.
inline std::string commandLine(Options options) {
  std::string line;
  if (const auto file = options.extract("options_file"))
    line = "-options_file '" + file.mapped() + "'";
  for (const auto& [name, value] : options)
    line += " -" + name + (value.empty() ? "" : " '" + value + "'");
  return line;
}

inline std::string contentOf(const fs::path& path) {
  std::ostringstream text;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  text << file.rdbuf();
  return text.str();
}

inline void writeText(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

struct ProgramRun {
  int exitCode = -1;       ///< 124: still running after the time limit, ended
  std::string out, error;  ///< stdout, stderr (mpirun's own words on a failure among them)
  fs::path folder;         ///< -report_dir
};

/// For mpiexec, after the number of ranks: the second between the end of a rank that fails and that
/// of the others, which users have and the script of the tests saves.
inline const std::string secondToEnd = " --mca odls_base_sigkill_timeout 1";

/// A place to write for one test.
inline fs::path placeFor(const std::string& name) { return fs::path(SQUEAL_OUTPUT_DIR) / name; }

/// Runs the program in the repository's folder with the results in `name`/results, where what lies
/// there stays. `launch` holds words for mpiexec.
inline ProgramRun runAgain(const std::string& name, int ranks, const std::string& options,
                           int seconds = 120, const std::string& program = SQUEAL_EXECUTABLE,
                           const std::string& launch = "") {
  ProgramRun run;
  run.folder = placeFor(name) / "results";
  fs::create_directories(placeFor(name));
  const fs::path out = placeFor(name) / "stdout.txt", error = placeFor(name) / "stderr.txt";
  const std::string command =
      "cd '" SQUEAL_SOURCE_DIR "' && exec timeout -k 5 " + std::to_string(seconds) +
      " '" SQUEAL_MPIEXEC "' " + (ranks == 1 ? "serial" : std::to_string(ranks)) +
      (ranks == 1 ? "" : launch) + " '" + program + "' " + options + " -report_dir '" +
      run.folder.string() + "' >'" + out.string() + "' 2>'" + error.string() + "'";
  const int status = std::system(command.c_str());
  run.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  run.out = contentOf(out);
  run.error = contentOf(error);
  return run;
}

/// The same with an empty folder to begin with.
inline ProgramRun runProgram(const std::string& name, int ranks, const std::string& options,
                             int seconds = 120) {
  fs::remove_all(placeFor(name));
  return runAgain(name, ranks, options, seconds);
}

/// A comma-separated table with a header line.
struct CsvTable {
  std::string header;
  std::vector<std::vector<std::string>> rows;

  std::vector<double> column(const std::string& name) const {
    std::vector<double> values;
    for (const auto& cell : words(name)) values.push_back(std::stod(cell));
    return values;
  }
  std::vector<std::string> words(const std::string& name) const {
    const auto names = split(header, ',');
    std::size_t index = 0;
    while (index < names.size() && names[index] != name) ++index;
    if (index == names.size()) throw std::runtime_error("no column " + name + " in " + header);
    std::vector<std::string> cells;
    for (const auto& row : rows) cells.push_back(row.at(index));
    return cells;
  }
};

inline CsvTable readCsv(const fs::path& path) {
  std::istringstream text(contentOf(path));
  CsvTable table;
  std::getline(text, table.header);
  for (std::string line; std::getline(text, line);) table.rows.push_back(split(line, ','));
  return table;
}

}  // namespace squeal::test
