// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Sections that cut a body in two, for the pretension of bolts. Not collective: for rank 0 only.
#include <map>
#include <string>

#include "model/mesh/whole.hpp"

namespace squeal::mesh {

/// Duplicates the nodes of each section. The cells on the upper side, to which the normal of the
/// section points, get the new nodes, and so do elements of other groups on this side. Fills
/// WholeMesh::sections and WholeMesh::sectionPairs. Throws Error, naming option and place, for a
/// section that is not flat, that does not cut through its body, or whose nodes belong to another
/// body or section, and for an axis perpendicular to its normal. Also throws Error for another
/// option whose group has a face of a section. Such a group would be ambiguous, since the two sides
/// of a section have different nodes. An option may, however, place a reference node at the centre
/// of a section.
void cutSections(WholeMesh& mesh, std::map<std::string, meshfile::GroupElements>& groups,
                 const Request& request);

}  // namespace squeal::mesh
