// SPDX-License-Identifier: BSD-2-Clause
#include "model/meshfile/contents.hpp"

#include <algorithm>
#include <cctype>

namespace squeal::meshfile {

std::string groupName(std::string name) {
  const auto isBlank = [](unsigned char c) { return std::isspace(c); };
  std::replace_if(name.begin(), name.end(), isBlank, '_');
  return name;
}

}  // namespace squeal::meshfile
