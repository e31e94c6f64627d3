// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/recipe.hpp"

#include <string>

#include "base/options/options.hpp"
#include "base/options/settings.hpp"
#include "base/session/session.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "run/report/report.hpp"

namespace squeal::report {
namespace {

std::string recipe(MPI_Comm comm) {
  std::string text =
      formatted("# squeal %s, %d ranks: the options of this run; defaults in comments\n", version(),
                mpi::size(comm));
  const auto given = givenOptions();
  // A run that repeats this one writes to another folder and starts from scratch.
  const auto ofThisRun = [](const std::string& name) {
    return name == "report_dir" || name == "resume" || name == "progress" || name == "log_json";
  };
  for (const auto& [name, value] : given) {
    if (ofThisRun(name)) continue;
    text += optionLine(name, FileOption::isDeclared(name)
                                 ? std::filesystem::absolute(value).lexically_normal().string()
                                 : value);
  }
  for (const auto& [name, value] : resolvedOptions())
    if (!given.count(name) && !ofThisRun(name)) text += "# " + optionLine(name, value);
  return text;
}

}  // namespace

void writeRecipe(MPI_Comm comm, const std::filesystem::path& folder) {
  writeText(comm, folder / "options.txt", recipe(comm));
}

}  // namespace squeal::report
