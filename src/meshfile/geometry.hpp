#pragma once
/// The parameters of a geometry, and how large a mesh it asks for. Not collective.
#include <string>
#include <vector>

#include "petsc/child.hpp"

namespace squeal::meshfile {

/// `-mesh_set`: "name=number", each.
std::vector<std::string> geometryParameters();

struct Setting {
  std::string name;
  double value;
};

/// Error unless each is name=number, finite, and no name comes twice.
std::vector<Setting> readSettings(const std::vector<std::string>& parameters);

/// Gives the settings to gmsh for the next time it opens the geometry that it has open. Error if
/// the geometry has no parameter of a name, or declares a range or choices that a value leaves.
void applySettings(const std::vector<Setting>& settings);

/// After the geometry was read. Error if it has put other values in place of the settings.
void requireSettingsUsed(const std::vector<Setting>& settings);

/// Meshes the geometry that gmsh has open. Its edges come first: an Error if they ask for more
/// cells than can be numbered, a warning for more than there is memory.
void meshGeometry(const std::string& file, const Warn& warn);

}  // namespace squeal::meshfile
