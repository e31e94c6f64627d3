// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Check that the base velocity is tangential to the surfaces on which bodies slide.
#include "model/coupling/exchange.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

/// Collective. Warns of each sliding interface whose base velocity V has a component along the
/// normal n of the contact surface. With convective terms on a body, throws Error instead.
///
/// On the flat facets of a round body, V·n is not zero even for a correct axis. It changes its sign
/// within each facet, however. Its mean over the facets around a node is at most 0.015 of the mean
/// of |V·n|, on structured and unstructured meshes. The velocity is treated as not tangential if
/// the magnitudes of these means exceed 0.2 of the means of |V·n|, and 0.01 of those of |V|, all
/// summed over the nodes. A wrong axis is therefore reported if it is off by more than 0.016 of the
/// radius and, on linear faces, by more than 0.16 of the angle of a facet.
void checkCrossing(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                   const elasticity::Bodies& bodies, const Interfaces& all);

}  // namespace squeal::interfaces
