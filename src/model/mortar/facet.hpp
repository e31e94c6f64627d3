// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Replacement of a face by flat facets, which can be projected and cut.
#include <vector>

#include "model/mortar/basis.hpp"
#include "model/mortar/clip.hpp"
#include "model/mortar/face.hpp"

namespace squeal::mortar {

/// A Facet is a flat part of a face, or nearly flat: a polygon, or a segment in the plane.
struct Facet {
  std::vector<Point> corners;        ///< anticlockwise, seen from outside of the body
  std::vector<Reference> reference;  ///< [corner]
  /// True if it is the whole face: all edges of the face are then straight in the projection.
  bool whole = true;

  Point centre() const;
  Point normal() const;  ///< unit vector out of the body
};

/// Returns the whole face without its mid-edge nodes. The normal of this facet is the mean normal
/// of the face. Not collective.
Facet wholeFacet(const Face& face);
/// Returns the facets of a face to be projected along a unit vector. Not collective. That is the
/// whole face if its edges are straight in the projection and if it is convex there. Otherwise
/// there are equal triangles in the reference coordinates, 16 of a triangle and 32 of a
/// quadrilateral.
std::vector<Facet> facets(const Face& face, const Point& direction);

/// Returns how far the edges of the face leave those of its facet in the projection along a unit
/// vector, m. Not collective.
double sag(const Face& face, const Facet& facet, const Point& direction);

/// A plane with coordinates, of which the first axis is the line of a segment.
class Frame {
 public:
  explicit Frame(const Facet& facet);
  const Point& normal() const { return normal_; }  ///< that of the facet
  PlanePoint flat(const Point& x) const;           ///< the projection along the normal
  Point lifted(const PlanePoint& y) const;         ///< the point of the plane
  /// Returns a facet in the projection, anticlockwise for a normal along that of the frame.
  Region flat(const Facet& facet) const;
  /// Returns the distance along the normal from a point of the plane to the plane of a facet, as a
  /// linear function of the coordinates.
  HalfPlane distanceTo(const Facet& facet) const;

 private:
  Point origin_, along_, across_, normal_;
};

}  // namespace squeal::mortar
