#pragma once
/// These functions set the parameters of a geometry and mesh it. Not collective.
#include <string>
#include <vector>

#include "base/system/child.hpp"

namespace squeal::meshfile {

/// Returns the items of the option `-mesh_set`, each "name=number".
std::vector<std::string> geometryParameters();

/// A parameter of a geometry and the value that it is given.
struct Setting {
  std::string name;
  double value;
};

/// Returns the settings. Throws Error unless each is name=number with a finite number, and no name
/// is given twice.
std::vector<Setting> readSettings(const std::vector<std::string>& parameters);

/// Gives the settings to gmsh for the next time it opens the geometry that is open. Throws Error if
/// the geometry has no parameter of a name, if that is a text, or if a value leaves the range or
/// choices that the geometry declares.
void applySettings(const std::vector<Setting>& settings);

/// Throws Error if the geometry has replaced the settings by other values. Call it after the
/// geometry was read.
void requireSettingsUsed(const std::vector<Setting>& settings);

/// Meshes the geometry that gmsh has open. From its edges, which are meshed first, it estimates the
/// number of cells. Throws Error if the displacements cannot be numbered, or if gmsh needs more
/// than twice the memory that is free; warns if it needs more than half of that.
void meshGeometry(const std::string& file, const Warn& warn);

}  // namespace squeal::meshfile
