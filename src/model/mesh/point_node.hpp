// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A single node that options name.
#include <string>

#include "model/mesh/mesh.hpp"

namespace squeal::mesh {

/// A node that all ranks know: the only node of a group, or a reference node.
struct PointNode {
  PetscInt displacement = -1;  ///< global node
  PetscInt rotation = -1;      ///< global node whose components are its rotation; −1: it has none
  Point position{};            ///< m
};

/// Collective. Returns the node of the group or reference node with this name. Throws Error, with a
/// message that begins with `head`, for a group that does not have exactly one node.
PointNode pointNode(const Mesh& mesh, const std::string& name, const std::string& head);

}  // namespace squeal::mesh
