// SPDX-License-Identifier: BSD-2-Clause
#include "base/output/manifest.hpp"

#include <sstream>
#include <stdexcept>

#include "base/session/session.hpp"
#include "base/system/regular_file.hpp"

namespace squeal::output {

namespace fs = std::filesystem;

namespace {

const std::string firstWord = "# squeal ";

std::string firstLine(std::size_t count) {
  return firstWord + version() + ": the " + std::to_string(count) + " files of a run";
}

bool staysInside(const fs::path& path) {
  if (path.empty() || path.is_absolute()) return false;
  for (const auto& part : path)
    if (part == ".." || part == ".") return false;
  return true;
}

}  // namespace

Manifest::Manifest(const std::set<fs::path>& files) {
  for (const auto& file : files) add(file);
  add(name);
}

Manifest Manifest::of(const fs::path& folder) {
  Manifest manifest;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory()) manifest.add(entry.path().lexically_relative(folder));
  manifest.add(name);
  return manifest;
}

std::optional<Manifest> Manifest::read(const fs::path& folder) {
  const fs::path path = folder / name;
  if (!whyNotRegular(path).empty()) return {};
  std::istringstream file(contentOfRegular(path).value_or(""));
  std::string line;
  if (!std::getline(file, line) || !line.starts_with(firstWord)) return {};
  const std::string head = line;
  Manifest manifest;
  std::size_t count = 0;
  for (int number = 2; std::getline(file, line); ++number) {
    const fs::path listed = line;
    if (!staysInside(listed))
      throw std::runtime_error(path.string() + ", line " + std::to_string(number) +
                               ": not a path in this folder");
    if (listed.has_filename()) {
      manifest.add(listed);
      ++count;
    } else
      manifest.retain(listed.parent_path());
  }
  if (head.find(": the " + std::to_string(count) + " files") == std::string::npos)
    throw std::runtime_error(
        path.string() +
        " is damaged: the number of files in its first line is not that of its list");
  return manifest;
}

void Manifest::add(const fs::path& file) {
  files_.insert(file);
  for (fs::path folder = file.parent_path(); folder.has_relative_path();
       folder = folder.parent_path())
    folders_.insert(folder);
}

void Manifest::retain(const fs::path& folder) {
  if (folders_.insert(folder).second) retained_.insert(folder);
}

std::string Manifest::text() const {
  std::string text = firstLine(files_.size()) + "\n";
  for (const auto& path : files_) text += path.generic_string() + "\n";
  for (const auto& path : retained_) text += path.generic_string() + "/\n";
  return text;
}

}  // namespace squeal::output
