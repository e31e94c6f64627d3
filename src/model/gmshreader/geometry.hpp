// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The parameters of a geometry, and its mesh. Not collective.
#include <string>
#include <vector>

#include "base/system/child_limits.hpp"
#include "model/meshfile/settings.hpp"

namespace squeal::gmshreader {

/// Gives the parameters to gmsh for the next time it opens the geometry that is open. Throws Error
/// if the geometry has no parameter of a name, if that is a text, or if a value leaves the range or
/// choices that the geometry declares.
void applyParameters(const std::vector<meshfile::GeometryParameter>& parameters);

/// Throws Error if the geometry has replaced the parameters by other values. Call it after the
/// geometry was read.
void requireParametersUsed(const std::vector<meshfile::GeometryParameter>& parameters);

/// Meshes the geometry that gmsh has open. From its edges, which are meshed first, it estimates the
/// number of cells. Throws Error if the displacements cannot be numbered, or if gmsh needs more
/// than twice the memory that is free; warns if it needs more than half of that.
void meshGeometry(const std::string& file, const Warn& warn);

}  // namespace squeal::gmshreader
