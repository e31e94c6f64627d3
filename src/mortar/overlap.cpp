#include "mortar/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mortar/facet.hpp"
#include "mortar/surface.hpp"
#include "mortar/vector.hpp"
#include "petsc/check.hpp"

namespace squeal::mortar {
namespace {

/// Pieces below this part of a facet of the slave face are left out; rounding makes such slivers.
constexpr double sliver = 1e-13;
/// A face whose normal turns by more than about 84° from its mean cannot be projected.
constexpr double leastCosine = 0.1;

/// The part of a slave facet that one master facet covers.
struct Piece {
  Region region;   ///< inside of the slave facet
  Region outline;  ///< of the master facet, also outside of the slave facet
  std::size_t master;
  double distance;  ///< magnitude at the centroid, m
};

/// Appends what one master facet covers of the slave facet, within the distance.
void cover(std::vector<Piece>& pieces, const Region& slave, const Frame& frame, const Facet& master,
           std::size_t index, double searchDistance) {
  if (!(dot(master.normal(), frame.normal()) < 0)) return;
  Region outline = frame.flat(master);
  std::ranges::reverse(outline);  // the master's outside is the slave's inside
  const HalfPlane distance = frame.distanceTo(master);
  const auto [slope, offset] = distance;
  outline = clip(outline, {slope, searchDistance + offset});                   // g ≥ −limit
  outline = clip(outline, {{-slope[0], -slope[1]}, searchDistance - offset});  // g ≤ limit
  if (outline.empty()) return;
  Region region = intersection(slave, outline);
  if (measure(region) <= sliver * measure(slave)) return;
  const double at = std::abs(distance(centroid(region)));
  pieces.push_back({std::move(region), std::move(outline), index, at});
}

bool boxesTouch(const Region& a, const Region& b) {
  for (std::size_t d = 0; d < 2; ++d) {
    const auto less = [d](const PlanePoint& x, const PlanePoint& y) { return x[d] < y[d]; };
    const auto [aLow, aHigh] = std::ranges::minmax(a, less);
    const auto [bLow, bHigh] = std::ranges::minmax(b, less);
    if (aHigh[d] < bLow[d] || bHigh[d] < aLow[d]) return false;
  }
  return true;
}

/// Returns the pieces without what a nearer one covers, so that no place counts twice.
std::vector<Piece> nearest(std::vector<Piece> pieces, double smallest) {
  std::ranges::stable_sort(pieces, {}, &Piece::distance);
  std::vector<Piece> kept;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    std::vector<Region> left{pieces[i].region};
    for (std::size_t k = 0; k < i; ++k) {
      const Region& nearer = pieces[k].outline;
      std::vector<Region> rest;
      for (Region& region : left)
        if (boxesTouch(region, nearer) && measure(intersection(region, nearer)) > smallest)
          std::ranges::move(difference(region, nearer, smallest), std::back_inserter(rest));
        else
          rest.push_back(std::move(region));
      left = std::move(rest);
    }
    for (Region& region : left)
      kept.push_back({std::move(region), {}, pieces[i].master, pieces[i].distance});
  }
  return kept;
}

/// A point of the slave face and the area of the face per area of the facet there.
struct SlavePoint {
  Reference reference;
  SurfacePoint surface;
  double stretch;
};

/// Returns the point of the face over a point of the facet that stands for the whole face. All
/// points move along the mean normal, so that straight edges stay straight.
SlavePoint above(const Face& slave, const Frame& frame, const PlanePoint& y) {
  SlavePoint at;
  at.reference = project(slave, frame.lifted(y), frame.normal()).reference;
  at.surface = surfacePoint(slave, at.reference);
  const double cosine = dot(at.surface.normal, frame.normal()) / length(at.surface.normal);
  if (cosine < leastCosine)
    throw Error(
        "a face on the slave side of surfaces whose meshes do not match is so strongly "
        "curved or distorted that its normal turns by more than 84 degrees: refine it");
  at.stretch = 1 / cosine;
  return at;
}

/// Returns the point of the face for a point of one of its triangles. Reference coordinates are
/// linear on the triangle, so that triangles tile the face.
SlavePoint within(const Face& slave, const Facet& triangle, const Region& flat,
                  const PlanePoint& y) {
  const double area = measure(flat), b = measure({flat[0], y, flat[2]}) / area,
               c = measure({flat[0], flat[1], y}) / area;
  const auto& corner = triangle.reference;
  SlavePoint at;
  for (std::size_t d = 0; d < 2; ++d)
    at.reference[d] =
        corner[0][d] + b * (corner[1][d] - corner[0][d]) + c * (corner[2][d] - corner[0][d]);
  at.surface = surfacePoint(slave, at.reference);
  const double inReference = std::abs(measure({corner[0], corner[1], corner[2]}));
  at.stretch = length(at.surface.normal) * inReference / area;
  return at;
}

/// Returns the degree of the rule for products of shape functions of both faces. On quadrilaterals
/// that are no parallelograms these are no polynomials: a higher degree makes up for that.
int degree(const FaceType& slave, const FaceType& master) {
  const auto one = [](const FaceType& type) {
    return type.dimension == 2 && type.corners == 4 ? 2 * type.order : type.order;
  };
  return 2 * std::max(one(slave), one(master)) + 2;
}

}  // namespace

std::vector<OverlapPoint> overlap(const Face& slave, std::span<const Face* const> masters,
                                  double searchDistance) {
  std::vector<OverlapPoint> points;
  for (const Facet& facet : facets(slave, wholeFacet(slave).normal())) {
    const Frame frame(facet);
    const Region flat = frame.flat(facet);
    std::vector<Piece> pieces;
    for (std::size_t m = 0; m < masters.size(); ++m)
      for (const Facet& part : facets(*masters[m], frame.normal()))
        cover(pieces, flat, frame, part, m, searchDistance);
    for (const Piece& piece : nearest(std::move(pieces), sliver * measure(flat))) {
      const Face& master = *masters[piece.master];
      const int exact = degree(faceType(slave.type), faceType(master.type));
      for (const auto& [y, weight] : quadrature(piece.region, exact)) {
        const SlavePoint at = facet.whole ? above(slave, frame, y) : within(slave, facet, flat, y);
        const Point normal = unit(at.surface.normal);
        const auto [reference, gap, met] = project(master, at.surface.position, normal);
        points.push_back({at.reference, reference, weight * at.stretch, piece.master, gap, normal});
      }
    }
  }
  return points;
}

}  // namespace squeal::mortar
