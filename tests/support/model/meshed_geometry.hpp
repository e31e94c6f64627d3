// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A geometry that is meshed once for several runs. The test program must be linked with gmsh and
/// compile the reader's geometry.cpp.
#include <string>
#include <vector>

#include "base/system/error.hpp"
#include "model/gmshreader/geometry.hpp"
#include "model/meshfile/settings.hpp"
#include "support/model/gmsh_library.hpp"

namespace squeal::test {

/// Not collective. Meshes a geometry with these parameters (`name=number`), as the program does,
/// and writes the mesh to a binary file of gmsh's format, which keeps all digits of the
/// coordinates.
inline void writeMesh(const std::string& geometry, const std::vector<std::string>& parameters,
                      const std::string& file) {
  startGmsh();
  gmsh::clear();
  gmsh::onelab::clear();
  gmsh::open(geometry);  // once with its own values, to declare the parameters
  gmshreader::applyParameters(meshfile::parametersOf(parameters));
  gmsh::clear();
  gmsh::open(geometry);
  gmshreader::meshGeometry(geometry, [](const std::string& text) { throw Error(text); });
  gmsh::option::setNumber("Mesh.Binary", 1);
  gmsh::write(file);
  gmsh::clear();
}

}  // namespace squeal::test
