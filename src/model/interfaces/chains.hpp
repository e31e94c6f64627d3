// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A chain is a slave that rests on nodes which are slaves themselves. This file puts the
/// connections in order.
#include "model/interfaces/nodes.hpp"

namespace squeal::interfaces {

/// Collective. Sets the level of all connections and Interfaces::levels. Throws Error, naming the
/// interfaces, if slaves rest on each other in a circle.
void setLevels(const mesh::Mesh& mesh, Interfaces& all);

}  // namespace squeal::interfaces
