#pragma once
/// The list of the files of a run, kept beside them: what a later run may remove, and nothing else.
#include <filesystem>
#include <optional>
#include <set>
#include <string>

namespace squeal::output {

class Manifest {
 public:
  /// The name of the file, itself in the list.
  static constexpr const char* name = "manifest.txt";

  Manifest() = default;
  /// These files, by relative paths, and the manifest.
  explicit Manifest(const std::set<std::filesystem::path>& files);
  /// All files below `folder`, and the manifest.
  static Manifest of(const std::filesystem::path& folder);
  /// The one in `folder`; none: there is none, or the file of this name is not of this program.
  /// Error (std::runtime_error): it is damaged, or a path leads out of the folder.
  static std::optional<Manifest> read(const std::filesystem::path& folder);

  const std::set<std::filesystem::path>& files() const { return files_; }
  const std::set<std::filesystem::path>& folders() const { return folders_; }
  /// Returns true if the file, or the folder, is one of these.
  bool lists(const std::filesystem::path& path) const {
    return files_.contains(path) || folders_.contains(path);
  }
  /// Notes a folder of ours that stays for what the user has in it; in the text its path ends with
  /// a slash.
  void keep(const std::filesystem::path& folder);
  std::string text() const;

 private:
  void add(const std::filesystem::path& file);
  std::set<std::filesystem::path> files_, folders_,
      kept_;  ///< folders_: those that hold files, and kept_
};

}  // namespace squeal::output
