// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Replacement of a face by flat facets, for projection and clipping.
#include <vector>

#include "model/mortar/basis.hpp"
#include "model/mortar/clip.hpp"
#include "model/mortar/face.hpp"

namespace squeal::mortar {

/// A flat, or nearly flat, part of a face: a polygon or, in plane problems, a segment.
struct Facet {
  std::vector<Point> corners;        ///< anticlockwise, seen from outside of the body
  std::vector<Reference> reference;  ///< [corner]
  /// True if the facet is the whole face. facets() returns such a facet only if all edges of the
  /// face are straight in the projection.
  bool whole = true;

  Point centre() const;
  Point normal() const;  ///< unit vector out of the body
};

/// Returns the whole face without its mid-edge nodes, as one facet. Its normal is the mean normal
/// that the face would have with straight edges. Not collective.
Facet wholeFacet(const Face& face);
/// Returns the facets of a face for projection along a unit vector. Not collective. If the
/// projection has straight edges and is convex, the only facet is the whole face. Otherwise the
/// facets are triangles that are equal in the reference coordinates, 16 for a triangle and 32 for a
/// quadrilateral.
std::vector<Facet> facets(const Face& face, const Point& direction);

/// Returns the largest distance, in the projection along a unit vector, between the edges of the
/// face and those of its facet, m. Not collective.
double sag(const Face& face, const Facet& facet, const Point& direction);

/// The plane of a facet, with coordinates. If the facet is a segment, the first axis lies along it.
class Frame {
 public:
  explicit Frame(const Facet& facet);
  const Point& normal() const { return normal_; }  ///< normal of the facet
  PlanePoint flat(const Point& x) const;           ///< the projection along the normal
  Point lifted(const PlanePoint& y) const;         ///< the point of the plane
  /// Returns the projection of a facet. It is anticlockwise if the normal of the facet points to
  /// the same side as that of the frame.
  Region flat(const Facet& facet) const;
  /// Returns the distance, along the normal of the frame, from a point of its plane to the plane of
  /// a facet, as a linear function of the coordinates of the point.
  HalfPlane distanceTo(const Facet& facet) const;

 private:
  Point origin_, along_, across_, normal_;
};

}  // namespace squeal::mortar
