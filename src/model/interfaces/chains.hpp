// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The order of connections in chains, in which the masters of a slave are slaves themselves.
#include "model/interfaces/nodes.hpp"

namespace squeal::interfaces {

/// Collective. Sets the level of all connections and Interfaces::levels. Throws Error, naming the
/// interfaces, if slaves depend on each other in a circle.
void setLevels(const mesh::Mesh& mesh, Interfaces& all);

}  // namespace squeal::interfaces
