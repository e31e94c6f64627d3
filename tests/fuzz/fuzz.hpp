// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The parts that all programs of this folder share: main(), which reads damaged files by the
/// thousand, and demands of the reader that it takes them or refuses them by a message of one line.
#include <functional>
#include <string>
#include <vector>

namespace squeal::fuzz {

/// A reader and what it reads.
struct Target {
  std::string name;    ///< of the program's files
  std::string suffix;  ///< of the file name, ".msh"
  /// Sound contents, of every kind that the reader knows and as small as can be. They are to be
  /// accepted as they stand.
  std::vector<std::string> seeds;
  /// Reads the file; returns, or throws squeal::Error. Called many times in one process, on one
  /// rank.
  std::function<void(const std::string& path)> read;
};

/// Each program defines its own. Called within a session of MPI and PETSc.
Target target();

/// The bytes of a file that `write(path)` makes: seeds by the libraries of the formats.
std::string bytesWritten(const std::function<void(const std::string& path)>& write);

}  // namespace squeal::fuzz
