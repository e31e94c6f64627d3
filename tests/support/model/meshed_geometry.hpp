// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A geometry that is meshed once for several runs. The test program must be linked with gmsh.
#include <string>
#include <vector>

#include "support/model/gmsh_library.hpp"

namespace squeal::test {

/// Not collective. Meshes a geometry with these parameters (`name=number`) and writes the mesh to a
/// binary file of gmsh's format, which keeps all digits of the coordinates.
inline void writeMesh(const std::string& geometry, const std::vector<std::string>& parameters,
                      const std::string& file) {
  startGmsh();
  gmsh::clear();
  gmsh::onelab::clear();
  gmsh::open(geometry);  // once with its own values, to declare the parameters
  for (const auto& parameter : parameters) {
    const auto equals = parameter.find('=');
    gmsh::onelab::setNumber(parameter.substr(0, equals), {std::stod(parameter.substr(equals + 1))});
  }
  gmsh::clear();
  gmsh::open(geometry);
  gmsh::model::mesh::generate(gmsh::model::getDimension());
  gmsh::option::setNumber("Mesh.Binary", 1);
  gmsh::write(file);
  gmsh::clear();
}

}  // namespace squeal::test
