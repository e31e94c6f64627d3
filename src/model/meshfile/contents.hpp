// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Contents of a mesh that gmsh has read or made. The program `squeal_gmsh`, which calls gmsh,
/// passes them to the main program. Not collective.
#include <petscsystypes.h>

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace squeal::meshfile {

/// The elements of one gmsh type. `squeal_gmsh` leaves `label` and `material` empty.
struct ElementBlock {
  int type = 0, nodesPerElement = 0, corners = 0;
  std::vector<PetscInt> nodes;     ///< [element][node] index of the node
  std::vector<int> label;          ///< [element] body (cells) or surface (faces)
  std::vector<PetscInt> tag;       ///< [element] gmsh's tag
  std::string typeName = {};       ///< gmsh's name of the type, for messages
  std::vector<int> material = {};  ///< [element] material group of a cell

  std::span<PetscInt> nodesOf(std::size_t element) {
    return std::span(nodes).subspan(element * nodesPerElement, nodesPerElement);
  }
  std::span<const PetscInt> nodesOf(std::size_t element) const {
    return std::span(nodes).subspan(element * nodesPerElement, nodesPerElement);
  }
  std::span<const PetscInt> cornersOf(std::size_t element) const {
    return nodesOf(element).first(corners);
  }
};

/// The elements of one physical group, with nodes as indices into Contents::points.
struct GroupElements {
  int dimension = 0;
  std::vector<ElementBlock> blocks;
};

/// The mesh in gmsh: its nodes in gmsh's order, and its groups by the names that options use.
struct Contents {
  std::vector<std::array<double, 3>> points;
  std::vector<PetscInt> tags;
  std::map<std::string, GroupElements> groups;
  int dimension = 0;  ///< largest dimension of an element
  std::vector<PetscInt> ungrouped;
  std::vector<char> atPoint;  ///< [node] 1: at a point of the geometry
  PetscInt droppedNodes = 0;
};

/// Returns the name of a group as options use it, with underscores in place of blanks.
std::string groupName(std::string name);

}  // namespace squeal::meshfile
