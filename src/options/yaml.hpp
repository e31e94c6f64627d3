#pragma once
/// This function reads the YAML of options files.
#include <string>
#include <vector>

#include "options/settings.hpp"

namespace squeal {

/// Returns the options of a YAML text: names of nested maps are joined by `_`, items of lists by
/// commas. Throws Error with a message that begins with `name`.
std::vector<Setting> settingsOfYaml(const std::string& text, const std::string& name);

}  // namespace squeal
