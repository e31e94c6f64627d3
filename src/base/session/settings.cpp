// SPDX-License-Identifier: BSD-2-Clause
#include "base/session/settings.hpp"

#include "base/options/options.hpp"

namespace squeal {
namespace {

const FlagOption quietOption("general", "quiet", false, "no output except warnings and errors");
const TextOption fileOption("general", "log_json", "",
                            "file to which events are appended, one JSON object per line: stages, "
                            "points, warnings, checkpoints, end of the run");
const ChoiceOption progressOption(
    "general", "progress", {"auto", "line", "plain"}, "auto",
    "progress on the terminal; line: a status line with stage, completed points and time; plain: "
    "no status line; auto: line on a terminal, but plain under mpirun, which hides the terminal");

}  // namespace

OutputSettings OutputSettings::given() {
  return {
      .quiet = quietOption.get(), .eventLog = fileOption.get(), .progress = progressOption.get()};
}

}  // namespace squeal
