// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A geometry that is meshed once for several runs.
#include <gmsh.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "model/meshfile/geometry.hpp"

namespace squeal::test {

/// Not collective. Meshes a geometry with these parameters, as the program does, and writes the
/// mesh to a file of gmsh's format, in binary form, which keeps all digits of the coordinates.
inline void writeMesh(const std::string& geometry, const std::vector<std::string>& parameters,
                      const std::string& file) {
  gmsh::clear();
  gmsh::onelab::clear();
  gmsh::open(geometry);
  meshfile::applyParameters(meshfile::parametersOf(parameters));
  gmsh::clear();
  gmsh::open(geometry);
  meshfile::meshGeometry(geometry, [](const std::string& text) { throw std::runtime_error(text); });
  gmsh::option::setNumber("Mesh.Binary", 1);
  gmsh::write(file);
  gmsh::clear();
}

}  // namespace squeal::test
