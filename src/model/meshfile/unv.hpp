// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Checks of I-deas universal files before gmsh reads them.
#include <cstdint>
#include <string>

namespace squeal::meshfile {

/// The numbers of nodes and elements of a .unv file.
struct UnvContents {
  std::int64_t nodes = 0, elements = 0;
  /// False if gmsh would omit groups (those of section 2467 as Salome writes it) or all words of a
  /// name except the first. In this case, read a UnvCopy.
  bool groupsAreRead = true;
};

/// Not collective. Returns the contents of a .unv file. Throws Error, with the line, unless the
/// sections of nodes (2411) and elements (2412) contain tags that are positive and given once,
/// finite coordinates, and elements on existing nodes. Also throws Error if two groups (2435, 2452,
/// 2467, 2477) have the same name. These checks are necessary since gmsh's reader silently ends a
/// section at a line that it does not understand.
UnvContents requireSoundUnv(const std::string& file);

/// A UnvCopy is a copy of a sound .unv file in the folder for temporary files, with groups in the
/// form that gmsh reads, and underscores in place of blanks in their names. The copy is removed
/// with the object.
class UnvCopy {
 public:
  /// Throws Error if the copy cannot be written.
  explicit UnvCopy(const std::string& file);
  ~UnvCopy();
  UnvCopy(const UnvCopy&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace squeal::meshfile
