// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Check that the base velocity is tangential to the surfaces on which bodies slide.
#include "model/coupling/exchange.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

/// Collective. Warns of each sliding interface whose base velocity V has a component along the
/// normal n of the contact surface. Throws Error instead if a body moves there (not a rigid
/// obstacle) and the convective terms are on.
///
/// On the flat facets of a round body, V·n is not zero even for a correct axis, but it changes its
/// sign within each facet. Its mean over the facets around a node is at most 0.015 of the mean of
/// |V·n|, on structured and unstructured meshes. The velocity is treated as not tangential if the
/// sum of the magnitudes of these means over the nodes exceeds both 0.2 of the sum of the means of
/// |V·n| and 0.01 of that of |V|. An error in the position of the axis is therefore reported if it
/// exceeds 0.016 of the radius and, on linear faces, 0.16 of the length of a facet.
void checkCrossing(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                   const elasticity::Bodies& bodies, const Interfaces& all);

}  // namespace squeal::interfaces
