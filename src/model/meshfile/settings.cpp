// SPDX-License-Identifier: BSD-2-Clause
#include "model/meshfile/settings.hpp"

#include <charconv>
#include <cmath>

#include "base/options/options.hpp"
#include "base/petsc/check.hpp"
#include "base/system/text.hpp"

namespace squeal::meshfile {
namespace {

const FileOption fileOption(
    "mesh", "mesh_file",
    "mesh (.msh, .unv), CAD shape (.step, .iges, .brep) or gmsh geometry (.geo); a shape is meshed "
    "in memory; a .geo is code: gmsh executes it and meshes its geometry");
const RealOption scaleOption(
    "mesh", "mesh_scale", 1.0, "", positive,
    "factor on all coordinates; 0.001 if the mesh is in mm and all other values are in SI units");
const TextOption setOption(
    "mesh", "mesh_set", "",
    "values of parameters that a .geo file defines by DefineConstant: name=number,…");
const RealOption sizeOption(
    "mesh", "mesh_size", 0.0, "", nonNegative,
    "edge length with which a CAD shape (.step, …) is meshed, in mm, before the factor "
    "-mesh_scale; 0 = automatic (chosen by gmsh: a tenth of the diagonal of the bounding box)");
const IntegerOption orderOption(
    "mesh", "mesh_order", 2, 1, 2,
    "order of the tetrahedra with which a CAD shape is meshed; 1: linear; 2: quadratic");

/// Returns the number that a text is, if it is finite.
bool readFinite(const std::string& text, double& value) {
  const char *first = text.data() + (text[0] == '+'), *last = text.data() + text.size();
  const auto [stop, error] = std::from_chars(first, last, value);
  return error == std::errc() && stop == last && std::isfinite(value);
}

}  // namespace

std::vector<GeometryParameter> parametersOf(const std::vector<std::string>& items) {
  std::vector<GeometryParameter> parameters;
  for (const auto& item : items) {
    const auto parts = split(item, '=');
    double value = 0;
    if (parts.size() != 2 || parts[0].empty() || parts[1].empty() || !readFinite(parts[1], value))
      throw Error("option -mesh_set " + item + ": must be a list of name=number, finite");
    for (const auto& earlier : parameters)
      if (earlier.name == parts[0]) throw Error("option -mesh_set: gives '" + parts[0] + "' twice");
    parameters.push_back({parts[0], value});
  }
  return parameters;
}

Settings Settings::given() {
  Settings settings;
  settings.file = fileOption.get();
  settings.parameters = parametersOf(setOption.list());
  settings.shape.size = sizeOption.get();
  settings.shape.order = orderOption.get();
  for (const Option* option : std::vector<const Option*>{&sizeOption, &orderOption})
    if (option->given()) settings.shape.given.push_back("-" + option->name);
  settings.scale = scaleOption.get();
  return settings;
}

void rejectShapeMesh(const std::string& file, const ShapeMesh& shape) {
  for (const auto& option : shape.given)
    throw Error("option " + option + ": it is for shapes, .step and the like; -mesh_file " + file +
                " is a mesh, or a geometry that sets this itself");
}

}  // namespace squeal::meshfile
