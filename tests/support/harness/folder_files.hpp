// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// All files of a folder with their contents.
#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "support/harness/program.hpp"

namespace squeal::test {

/// Files below a folder with their content; the content of a link is where it leads.
using Files = std::map<std::string, std::string>;

inline Files filesIn(const fs::path& folder) {
  Files files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder);
    if (entry.is_symlink())
      files[name] = "-> " + fs::read_symlink(entry.path()).string();
    else if (!entry.is_directory())
      files[name] = contentOf(entry.path());
  }
  return files;
}

inline std::vector<std::string> namesOf(const Files& files) {
  std::vector<std::string> names;
  for (const auto& [name, content] : files) names.push_back(name);
  return names;
}

/// The names of files that are in only one of the two or differ in content, for readable
/// messages.
inline std::vector<std::string> differing(const Files& a, const Files& b) {
  std::vector<std::string> names;
  for (const auto& [name, content] : a)
    if (const auto other = b.find(name); other == b.end() || other->second != content)
      names.push_back(name);
  for (const auto& [name, content] : b)
    if (!a.contains(name)) names.push_back(name);
  return names;
}
inline const std::vector<std::string> none;

/// All files of the two; one that both have is as in `a`.
inline Files both(Files a, const Files& b) {
  a.insert(b.begin(), b.end());
  return a;
}

/// Writes files into a folder, which it makes where there is none.
inline void put(const fs::path& folder, const Files& files) {
  for (const auto& [name, content] : files) writeText(folder / name, content);
}

}  // namespace squeal::test
