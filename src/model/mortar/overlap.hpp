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
  Reference slave, master;  ///< its position on both faces
  double weight;            ///< quadrature weight on the slave face, m² (m in plane problems)
  std::size_t masterFace;   ///< index into the master faces
  /// Signed distance of the point on the master from the point on the slave, m, positive if open:
  ///   x_master = x_slave + gap · normal.
  double gap;
  Point normal;  ///< unit normal out of the slave face at the point
};

/// Returns integration points and weights for the part of the slave face that the master faces
/// cover; the weights refer to the area of the (curved) slave face. Not collective.
///
/// A master face covers its projection along the mean normal of the slave face if the two faces
/// point towards each other and the magnitude of their distance is at most `searchDistance`, m. If
/// two master faces cover the same place, the nearer one is used. At an uncovered rim of the slave
/// face, master faces are extended beyond their edges if this closes the open part. The extension
/// is the sag of curved edges plus the shift that a gap between inclined faces causes in the
/// projection. A rim that is common to two different meshes is therefore covered, but an overhang
/// is not.
///
/// If edges are straight in the projection, faces are cut at the edges of both sides, and the
/// covered part is exact within round-off; for the quadrature rules see overlapRule(). Otherwise
/// each edge is replaced by four straight pieces. The resulting triangles tile the slave face
/// exactly, and master faces are extended beyond their edges by their sag.
///
/// Throws Error for a type of face without a faceType(), and for a slave face whose normal turns by
/// more than 84° from its mean.
std::vector<OverlapPoint> overlap(const Face& slave, std::span<const Face* const> masters,
                                  double searchDistance);

}  // namespace squeal::mortar
