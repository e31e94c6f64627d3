// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Meshes of a few boxes, or of sectors of a ring, written in gmsh's format 2.2.
#include <array>
#include <string>
#include <vector>

#include "fuzz/models/cells.hpp"

namespace squeal::fuzz {

using Vector = std::array<double, 3>;

/// A body: a box cut into cells, those into elements. In the plane the third list is {0}.
struct Box {
  std::string name;
  std::array<std::vector<double>, 3>
      cuts;  ///< [axis] ascending places, m; on a ring angle, radius, z
  Shape shape = Shape::hex8;
  bool closed = false;  ///< the first axis goes round: its last cut is its first

  int cellsAlong(int axis) const { return static_cast<int>(cuts[axis].size()) - 1; }
};

/// A group of faces on one side of a box: those between two cuts of the first other axis.
struct Side {
  std::string name;
  std::size_t box = 0;
  int axis = 0;
  bool high = false;
  int firstCell = 0, lastCell = 1000;  ///< cells [first, last) along the axis 0, or 1 on sides of 0
};

struct BoxMesh {
  int dimension = 3;
  double skew = 0;    ///< the first coordinate grows by this part of the last one
  bool ring = false;  ///< the first coordinate is an angle about −z, the second one a radius
  std::vector<Box> boxes;
  std::vector<Side> sides;
  int up() const { return dimension - 1; }
};

/// Another way to write the same mesh.
struct Writing {
  bool shuffled = false;  ///< nodes, cells and bodies in another order
  int turn = 0;           ///< the axes change places: x becomes y, y z, z x, so often
  int weldedTo = -1;  ///< this box shares the nodes of its faces with the box `welded`; -1: none
  int welded = -1;
};

/// Returns the vector in the axes of the turned model.
Vector turned(const Vector& vector, int turn);
/// Returns the text of the mesh file.
std::string meshText(const BoxMesh& mesh, const Writing& writing);

}  // namespace squeal::fuzz
