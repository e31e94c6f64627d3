// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// gmsh in a test program, which must be linked with it (tests/CMakeLists.txt); the library of
/// squeal does not call gmsh. Not collective.
#include <gmsh.h>

#include <string>

namespace squeal::test {

/// Starts gmsh on the first call; it ends with the process.
inline void startGmsh() {
  static bool started = false;
  if (started) return;
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  started = true;
}

/// Converts a mesh file that gmsh can read to the binary format.
inline void writeBinaryMsh(const std::string& from, const std::string& to, double version) {
  startGmsh();
  gmsh::clear();
  gmsh::open(from);
  gmsh::option::setNumber("Mesh.MshFileVersion", version);
  gmsh::option::setNumber("Mesh.Binary", 1);
  gmsh::write(to);
  gmsh::clear();
}

}  // namespace squeal::test
