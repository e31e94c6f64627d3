// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The lists of the sections that make up bodies. Not collective: all ranks have the same options,
/// and therefore the same results and Errors.
#include <map>
#include <string>
#include <vector>

namespace squeal::material {

/// Returns the sections of the bodies that have any. Throws Error for a list without a group, and
/// for a group that is in two lists or twice in one.
std::map<std::string, std::vector<std::string>> sectionsGiven();

/// Returns `-material_<body>_sections`, for messages.
std::string sectionsName(const std::string& body);

}  // namespace squeal::material
