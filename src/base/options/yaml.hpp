// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Reads options files in YAML.
#include <string>
#include <vector>

#include "base/options/settings.hpp"

namespace squeal {

/// Returns the options of a YAML text: names of nested maps are joined by `_`, items of lists by
/// commas. Throws Error, with `name` and the line, for text that is not a YAML map of options.
std::vector<Setting> settingsOfYaml(const std::string& text, const std::string& name);

}  // namespace squeal
