// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The material of each cell: that of its body or, if the body has sections, of its section. Not
/// collective: for rank 0 only.
#include "model/mesh/bodies.hpp"
#include "model/mesh/gmsh_model.hpp"
#include "model/mesh/whole.hpp"

namespace squeal::mesh {

/// Fills WholeMesh::materialGroups and ElementBlock::material of all cells. A section contains a
/// cell if it has an element on the same nodes. Throws Error, naming cell, sections and body, for a
/// cell that is in none of the sections of its body or in two of them, and for an element of a
/// section that is not a cell of the body.
void assignMaterials(WholeMesh& mesh, const GmshModel& model, const Request& request,
                     const NodeIndex& index);

/// Throws Error if two sections of a body have an element with this tag.
void rejectTwoSections(const WholeMesh& mesh, const GmshModel& model, const Request& request,
                       int body, PetscInt tag);

}  // namespace squeal::mesh
