// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A list of the files of a run, stored with them. A later run may remove only these files.
#include <filesystem>
#include <optional>
#include <set>
#include <string>

namespace squeal::output {

class Manifest {
 public:
  /// The name of the manifest's own file, which is in the list too.
  static constexpr const char* name = "manifest.txt";

  Manifest() = default;
  /// Makes a list of these files, given by relative paths, and of the manifest itself.
  explicit Manifest(const std::set<std::filesystem::path>& files);
  /// Returns the list of all files below `folder` and of the manifest. Throws
  /// std::filesystem::filesystem_error if the folder cannot be read.
  static Manifest of(const std::filesystem::path& folder);
  /// Returns the manifest in `folder`; none if the file does not exist or is not a manifest of this
  /// program. Throws std::runtime_error if it is damaged, or if a path leads out of the folder.
  static std::optional<Manifest> read(const std::filesystem::path& folder);

  const std::set<std::filesystem::path>& files() const { return files_; }
  const std::set<std::filesystem::path>& folders() const { return folders_; }
  /// Returns true if this file or folder is in the list.
  bool lists(const std::filesystem::path& path) const {
    return files_.contains(path) || folders_.contains(path);
  }
  /// Adds a folder of an earlier run that remains because it contains files of the user. In text(),
  /// its path ends with a slash.
  void retain(const std::filesystem::path& folder);
  /// Returns the content of the manifest's file.
  std::string text() const;

 private:
  void add(const std::filesystem::path& file);
  std::set<std::filesystem::path> files_;
  std::set<std::filesystem::path> folders_;  // the folders of files_, and retained_
  std::set<std::filesystem::path> retained_;
};

}  // namespace squeal::output
