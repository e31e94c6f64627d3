// SPDX-License-Identifier: BSD-2-Clause
#include "base/options/options.hpp"
#include "base/options/settings.hpp"
#include "base/petsc/check.hpp"
#include "fuzz/fuzz.hpp"

namespace squeal::fuzz {

// Names and values as they are found, on to the check of all options against their rules.
Target target() {
  return {"yaml",
          ".yaml",
          {"mesh:\n  file: meshes/layer.geo  # a comment\n  set: \"nx=6, "
           "ny=3\"\nquiet:\nflutter:\n  friction: 0:0.6:0.05\n",
           "material: {disc: {young: 1e11, poisson: 0.3, density: 7200}}\nmodes: {count: 200}\n",
           "flutter:\n  friction:\n    - 0\n    - 0.2\n  speed: [1, 3, 10]\nmotion:\n  disc:\n    "
           "axis: '0,0,1'\n",
           "material:\n  hat: &iron\n    young: 1\n    density: 7\n  plate: *iron\n  disc:\n    "
           "<<: *iron\n    young: 2\n",
           "%YAML 1.1\n---\nreport: {dir: \"x\", frames: 16}\n...\n",
           "{\"modes\": {\"count\": 5}, \"flutter\": {\"band\": 1.5}}\n",
           "report:\n  dir: >\n    folded\n    text\n  fields: |\n    off\n"},
          [](const std::string& path) {
            clearOptions();
            insert(settingsOfFile(path));
            rejectUnknownOptions();
          }};
}

}  // namespace squeal::fuzz
