// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The parameters of a geometry, and its mesh. Not collective.
#include <string>
#include <vector>

#include "base/system/child_limits.hpp"
#include "model/meshfile/settings.hpp"

namespace squeal::gmshreader {

/// Passes the parameters to gmsh. They take effect the next time that gmsh opens the geometry,
/// which must be open already. Throws Error for a name that no parameter of the geometry has, for a
/// parameter that is a text, and for a value outside the range or choices that the geometry
/// declares.
void applyParameters(const std::vector<meshfile::GeometryParameter>& parameters);

/// Throws Error if the geometry has overwritten a parameter with another value. Call it after the
/// geometry has been read.
void requireParametersUsed(const std::vector<meshfile::GeometryParameter>& parameters);

/// Meshes the geometry that gmsh has open. The edges are meshed first, and the number of cells is
/// estimated from them. Throws Error if so many cells have more displacements than PetscInt can
/// count, or if gmsh needs more than twice the free memory. Warns if gmsh needs more than half of
/// the free memory.
void meshGeometry(const std::string& file, const Warn& warn);

}  // namespace squeal::gmshreader
