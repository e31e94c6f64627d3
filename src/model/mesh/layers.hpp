// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The nodes of compliant contact layers. Not collective: for rank 0 only.
#include "model/mesh/whole.hpp"

namespace squeal::mesh {

/// Adds a layer node for each node of the surfaces InterfaceRequest::layered. If the node is a
/// periodic image, its layer node is an image too. Call this after pairNodes() and straighten().
void addLayers(WholeMesh& mesh, const Request& request);

}  // namespace squeal::mesh
