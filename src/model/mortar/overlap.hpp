// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The parts of a slave face that the faces of a master surface cover.
#include <span>
#include <vector>

#include "model/mortar/basis.hpp"
#include "model/mortar/face.hpp"

namespace squeal::mortar {

/// An integration point on the covered part of a slave face.
struct OverlapPoint {
  Reference slave, master;  ///< where it is on both faces
  double weight;            ///< area of the slave face that it stands for, m² (m in the plane)
  std::size_t masterFace;   ///< index into the master faces
  /// Signed distance of the master's point from the slave's, m, positive where open:
  ///   x_master = x_slave + gap · normal.
  double gap;
  Point normal;  ///< unit normal out of the slave face at the point
};

/// Returns points with weights that integrate over the part of the slave face that the master faces
/// cover; the weights are a part of the area of the (curved) slave face. Not collective.
///
/// A master face covers what it hides in the projection along the mean normal of the slave face,
/// if both face each other and if their distance, positive or negative, is at most
/// `searchDistance`, m. Where two master faces cover the same place, the one that is nearer counts.
/// Where a rim of the slave is not covered, master faces reach beyond their edges by the sag of
/// curved edges and by the shift that a gap between inclined faces makes in the projection, if that
/// closes what is open. So common rims of different meshes stay covered, and an overhang does not.
///
/// Where edges are straight in the projection, faces are cut at the edges of both sides. Then the
/// covered part is exact to rounding; for the rules see overlapRule(). Otherwise four straight
/// pieces stand for each edge, the triangles between them tile the slave face exactly, and master
/// faces are extrapolated beyond their edges by their sag.
///
/// Throws Error for a type of face that faceType() does not know, and for a slave face whose normal
/// turns by more than 84° from its mean.
std::vector<OverlapPoint> overlap(const Face& slave, std::span<const Face* const> masters,
                                  double searchDistance);

}  // namespace squeal::mortar
