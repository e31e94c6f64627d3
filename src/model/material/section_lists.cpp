// SPDX-License-Identifier: BSD-2-Clause
#include "model/material/section_lists.hpp"

#include "base/options/options.hpp"
#include "base/petsc/check.hpp"

namespace squeal::material {
namespace {

const TextOption sectionsOption(
    "material", "material_<body>_sections", "",
    "volume groups (sections) that make up a body, each with a material of its own; an option that "
    "is not given for a section has the value of the body");

}  // namespace

std::map<std::string, std::vector<std::string>> sectionsGiven() {
  std::map<std::string, std::vector<std::string>> sections;
  std::map<std::string, std::string> bodyOf;
  for (const auto& body : sectionsOption.subjects()) {
    const std::string option = "option " + sectionsOption.dashed(body);
    sections[body] = sectionsOption.list(body);
    if (sections[body].empty()) throw Error(option + ": names no group");
    for (const auto& section : sections[body]) {
      const auto [known, isNew] = bodyOf.emplace(section, body);
      if (!isNew && known->second == body)
        throw Error(option + ": names the group '" + section + "' twice");
      if (!isNew)
        throw Error(option + ": '" + section + "' is also in " +
                    sectionsOption.dashed(known->second) + "; a section belongs to one body");
    }
  }
  for (const auto& [section, body] : bodyOf)
    if (sectionsOption.given(section))
      throw Error("option " + sectionsOption.dashed(body) + ": '" + section + "' " +
                  (section == body ? "is the body itself; its sections are other groups"
                                   : "has sections itself; name these instead"));
  return sections;
}

std::string sectionsName(const std::string& body) { return sectionsOption.dashed(body); }

}  // namespace squeal::material
