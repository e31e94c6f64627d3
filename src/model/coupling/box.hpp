// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Bounding boxes of faces, for a cheap test that excludes most pairs of faces.
#include "model/mortar/face.hpp"

namespace squeal::coupling {

using mesh::Point;
using mortar::Face;

/// An axis-parallel box, m.
struct Box {
  Point low, high;
};

/// Returns a box that contains all points of a face of first or second order, not only its nodes,
/// within round-off. For a face with straight edges, this is the box of its nodes. Not collective.
Box boxOf(const Face& face);

/// Returns the box moved outwards on all sides by this distance, m.
Box widened(Box box, double distance);

/// Returns at most `most` boxes that contain all of `boxes`, each around faces that are close
/// together.
std::vector<Box> summary(std::vector<Box> boxes, std::size_t most);

}  // namespace squeal::coupling
