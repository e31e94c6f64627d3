// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Shapes of CAD programs: STEP, IGES and BREP. Not collective.
#include <string>

#include "base/system/child_limits.hpp"
#include "model/meshfile/settings.hpp"

namespace squeal::gmshreader {

/// Makes a shape the model of gmsh. Lengths come in millimetres from STEP and IGES, whatever their
/// unit, and as they are from BREP. Solids that touch are cut where they do, so that their meshes
/// share nodes there. Each solid and face becomes a physical group by the last part of its label,
/// entities of equal labels together. One without a label of its own is `solid_N` or `face_N`, with
/// the number that gmsh shows for the file. Throws Error if there is no solid; warns of labels
/// whose faces are not found again after the cuts.
void importShape(const std::string& file, const meshfile::ShapeMesh& mesh, const Warn& warn);

}  // namespace squeal::gmshreader
