// SPDX-License-Identifier: BSD-2-Clause
#include "base/checkpoint/settings.hpp"

#include "base/options/options.hpp"

namespace squeal::checkpoint {
namespace {

const FlagOption checkpointOption(
    "general", "checkpoint", true,
    "write checkpoints to the subfolder 'interrupted' of the results folder");
const RealOption intervalOption(
    "general", "checkpoint_interval", 60, "s", nonNegative,
    "minimum wall time between checkpoint entries; 0 = an entry for every result");
const FlagOption resumeOption(
    "general", "resume", false,
    "resume from the checkpoint in the results folder, or start from scratch if there is none");

}  // namespace

Settings Settings::given() {
  return {.enabled = checkpointOption.get(),
          .interval = intervalOption.get(),
          .resume = resumeOption.get()};
}

}  // namespace squeal::checkpoint
