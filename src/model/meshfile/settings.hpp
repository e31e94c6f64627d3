// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Settings of the file that the mesh is read from or made from. Not collective.
#include <string>
#include <vector>

namespace squeal::meshfile {

/// A parameter of a geometry and the value to set.
struct GeometryParameter {
  std::string name;
  double value;
};

/// How a shape is meshed.
struct ShapeMesh {
  double size = 0;                 ///< edge length, mm (BREP: unit of the file); 0: gmsh chooses it
  int order = 2;                   ///< of the tetrahedra
  std::vector<std::string> given;  ///< options given for shapes, with their dash
};

struct Settings {
  std::string file;                           ///< path of the mesh, shape or geometry
  std::vector<GeometryParameter> parameters;  ///< of a geometry
  ShapeMesh shape;                            ///< for a shape
  double scale = 1;                           ///< factor on all coordinates

  /// Reads the options. Throws Error unless each parameter is name=number with a finite number, and
  /// no name is given twice.
  static Settings given();
};

/// Returns the parameters in items "name=number". Throws Error as Settings::given() does.
std::vector<GeometryParameter> parametersOf(const std::vector<std::string>& items);

/// Throws Error if an option for shapes is given although the file is not a shape.
void rejectShapeMesh(const std::string& file, const ShapeMesh& shape);

}  // namespace squeal::meshfile
