// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Shapes of CAD programs: STEP, IGES and BREP. Not collective.
#include <string>

#include "base/system/child_limits.hpp"
#include "model/meshfile/settings.hpp"

namespace squeal::gmshreader {

/// Loads a shape into gmsh as its model. Lengths from STEP and IGES are converted to millimetres,
/// whatever their unit; those from BREP are unchanged. Touching solids are cut along their common
/// faces, so that their meshes share nodes there. Each solid and face becomes a physical group,
/// named by the last part of its label. Entities with equal labels form one group. An entity
/// without a label, or with a label that other entities have too, is also a group of its own,
/// `solid_N` or `face_N`, where N is the number that gmsh shows for it. Throws Error if the file
/// has no solid. Warns of labels whose faces cannot be identified after the cuts.
void importShape(const std::string& file, const meshfile::ShapeMesh& mesh, const Warn& warn);

}  // namespace squeal::gmshreader
