// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Shapes of CAD programs: STEP, IGES and BREP. Not collective.
#include <string>

#include "base/system/child_limits.hpp"
#include "model/meshfile/settings.hpp"

namespace squeal::gmshreader {

/// Loads a shape into gmsh as its model. Lengths from STEP and IGES are converted to millimetres,
/// whatever their unit; those from BREP are unchanged. Touching solids are cut along their common
/// faces, so that their meshes share nodes there. Solids with equal labels form one physical group,
/// named by the last part of the label; so do faces, unless a group of solids has that name. Each
/// entity that is in no such group, or that shares one with others, gets a group of its own,
/// `solid_N` or `face_N`, where N is the number that gmsh shows for it. `mesh` gives edge length
/// and order of the mesh. Throws Error for a truncated STEP file and for a file without a solid.
/// Warns of each labelled face that cannot be identified after the cuts.
void importShape(const std::string& file, const meshfile::ShapeMesh& mesh, const Warn& warn);

}  // namespace squeal::gmshreader
