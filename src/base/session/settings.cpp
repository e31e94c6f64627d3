// SPDX-License-Identifier: BSD-2-Clause
#include "base/session/settings.hpp"

#include "base/options/options.hpp"

namespace squeal {
namespace {

const FlagOption quietOption("general", "quiet", false, "no output except warnings and errors");
const TextOption fileOption("general", "log_json", "",
                            "event log to append to, one JSON object per line: stages, points, "
                            "warnings, checkpoints, end of the run");
const ChoiceOption progressOption(
    "general", "progress", {"auto", "line", "plain"}, "auto",
    "status line with stage, completed points and time (line) or without it (plain); auto = line "
    "on a terminal, but not under mpirun, which hides the terminal");

}  // namespace

OutputSettings OutputSettings::given() {
  return {
      .quiet = quietOption.get(), .eventLog = fileOption.get(), .progress = progressOption.get()};
}

}  // namespace squeal
