// SPDX-License-Identifier: BSD-2-Clause
#include "base/options/options.hpp"
#include "base/options/settings.hpp"
#include "base/petsc/check.hpp"
#include "fuzz/fuzz.hpp"

namespace squeal::fuzz {

// Options files of lines `-name value`, as options.txt of a run.
Target target() {
  return {"lines",
          ".txt",
          {"# comment\n-flutter_friction \"0, 0.2\"\n-material_disc_young 1e11\n-quiet\n-mesh_set "
           "'nx=6'\n",
           "-prefix_push material_\n-disc_density 7200 # one\n-prefix_pop\n-modes_count 5\r\n",
           "-options_string_yaml \"{modes: {count: 5}}\"\n-motion_disc_axis -1e3,.5,+2\n"},
          [](const std::string& path) {
            clearOptions();
            insert(settingsOfFile(path));
            rejectUnknownOptions();
          }};
}

}  // namespace squeal::fuzz
