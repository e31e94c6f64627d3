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

/// Rims of both sides that are one in truth differ by the sag of edges, and in the projection by
/// the gap between facets that are not parallel. Master facets reach beyond their edges by that
/// much, up to this part of the slave facet, if they are parallel to it up to 60°.
constexpr double farthestReach = 0.1, leastParallel = 0.5;

/// The part of a slave facet that one master facet covers.
struct Piece {
  Region region;   ///< inside of the slave facet
  Region outline;  ///< of what the master facet covers, also outside of the slave facet
  std::size_t master;
  bool beyond;      ///< true if it reaches beyond the edges of the master facet
  double distance;  ///< magnitude at the centroid, m
};

/// A flat facet of the slave face, with the plane to which master facets are projected.
struct SlaveFacet {
  const Face& face;
  Facet facet;
  Frame frame;
  Region flat;
  SlaveFacet(const Face& of, Facet part)
      : face(of), facet(std::move(part)), frame(facet), flat(frame.flat(facet)) {}
};

Region clipDistance(const Region& region, const HalfPlane& g, double limit) {
  const auto [slope, offset] = g;
  const Region above = clip(region, {slope, limit + offset});    // g ≥ −limit
  return clip(above, {{-slope[0], -slope[1]}, limit - offset});  // g ≤ limit
}

/// Returns how far a master facet counts beyond its edges.
double reach(const SlaveFacet& slave, const Face& face, const Facet& master, const Region& outline,
             double searchDistance) {
  const Point &n = slave.frame.normal(), m = master.normal();
  if (dot(n, m) > -leastParallel) return 0;
  const HalfPlane distance = slave.frame.distanceTo(master);
  double gap = 0, extent = 0;
  for (const PlanePoint& y : outline) gap = std::max(gap, std::abs(distance(y)));
  for (const PlanePoint& y : slave.flat)
    extent = std::max(extent, std::hypot(y[0] - slave.flat[0][0], y[1] - slave.flat[0][1]));
  const double tilt = length(cross(n, m));
  return std::min(
      sag(face, master, n) + sag(slave.face, slave.facet, n) + std::min(gap, searchDistance) * tilt,
      farthestReach * extent);
}

/// Returns what the master faces cover of a slave facet within the distance. With `beyond` they
/// reach beyond their edges.
std::vector<Piece> pieces(const SlaveFacet& slave, std::span<const Face* const> masters,
                          double searchDistance, bool beyond) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < masters.size(); ++i)
    for (const Facet& facet : facets(*masters[i], slave.frame.normal())) {
      if (!(dot(facet.normal(), slave.frame.normal()) < 0)) continue;
      const HalfPlane distance = slave.frame.distanceTo(facet);
      Region outline = slave.frame.flat(facet);
      std::ranges::reverse(outline);  // the master's outside is the slave's inside
      if (beyond)
        outline = intersection(slave.flat, outline,
                               reach(slave, *masters[i], facet, outline, searchDistance));
      outline = clipDistance(outline, distance, searchDistance);
      Region region = beyond || outline.empty() ? outline : intersection(slave.flat, outline);
      if (measure(region) <= sliver * measure(slave.flat)) continue;
      const double at = std::abs(distance(centroid(region)));
      pieces.push_back({std::move(region), std::move(outline), i, beyond, at});
    }
  return pieces;
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

/// Returns the pieces without what a nearer one covers, so that no place counts twice. Those that
/// reach beyond edges come last.
std::vector<Piece> nearest(std::vector<Piece> pieces, double smallest) {
  std::ranges::stable_sort(
      pieces, {}, [](const Piece& piece) { return std::pair(piece.beyond, piece.distance); });
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
      kept.push_back({std::move(region), {}, pieces[i].master, false, pieces[i].distance});
  }
  return kept;
}

/// Returns the pieces of a slave facet, which do not overlap.
std::vector<Piece> tiles(const SlaveFacet& slave, std::span<const Face* const> masters,
                         double searchDistance) {
  const double area = measure(slave.flat);
  auto all = pieces(slave, masters, searchDistance, false);
  auto tiles = nearest(all, sliver * area);
  double open = area;
  for (const Piece& tile : tiles) open -= measure(tile.region);
  if (tiles.empty() || open <= 10 * sliver * area) return tiles;
  std::ranges::move(pieces(slave, masters, searchDistance, true), std::back_inserter(all));
  return nearest(std::move(all), sliver * area);
}

/// A point of the slave face and the area of the face per area of the facet there.
struct SlavePoint {
  Reference reference;
  SurfacePoint surface;
  double stretch;
};

/// Returns the point of the face over a point of the facet that stands for the whole face. All
/// points move along the mean normal, so that straight edges stay straight.
SlavePoint above(const SlaveFacet& part, const PlanePoint& y) {
  const Point& normal = part.frame.normal();
  SlavePoint at;
  at.reference = project(part.face, part.frame.lifted(y), normal).reference;
  at.surface = surfacePoint(part.face, at.reference);
  const double cosine = dot(at.surface.normal, normal) / length(at.surface.normal);
  if (cosine < leastCosine)
    throw Error(
        "a face on the slave side of surfaces whose meshes do not match is so strongly curved or "
        "distorted that its normal turns by more than 84 degrees: refine it");
  at.stretch = 1 / cosine;
  return at;
}

/// Returns the point of the face for a point of one of its triangles. Reference coordinates are
/// linear on the triangle, so that triangles tile the face.
SlavePoint within(const SlaveFacet& triangle, const PlanePoint& y) {
  const Region& flat = triangle.flat;
  const double area = measure(flat), b = measure({flat[0], y, flat[2]}) / area,
               c = measure({flat[0], flat[1], y}) / area;
  const auto& corner = triangle.facet.reference;
  SlavePoint at;
  for (std::size_t d = 0; d < 2; ++d)
    at.reference[d] =
        corner[0][d] + b * (corner[1][d] - corner[0][d]) + c * (corner[2][d] - corner[0][d]);
  at.surface = surfacePoint(triangle.face, at.reference);
  const double inReference = std::abs(measure({corner[0], corner[1], corner[2]}));
  at.stretch = length(at.surface.normal) * inReference / area;
  return at;
}

/// Returns the degree of the rule for products of shape functions of both faces, and some more for
/// faces that are not affine, where these are no polynomials.
int degree(const FaceType& slave, const FaceType& master) {
  const auto one = [](const FaceType& type) {
    return type.corners == 3 ? type.order : 2 * type.order;
  };
  return 2 * std::max(one(slave), one(master)) + 2;
}

}  // namespace

std::vector<OverlapPoint> overlap(const Face& slave, std::span<const Face* const> masters,
                                  double searchDistance) {
  std::vector<OverlapPoint> points;
  for (const Facet& facet : facets(slave, wholeFacet(slave).normal())) {
    const SlaveFacet part(slave, facet);
    for (const Piece& tile : tiles(part, masters, searchDistance)) {
      const Face& master = *masters[tile.master];
      const int exact = degree(faceType(slave.type), faceType(master.type));
      for (const auto& [y, weight] : quadrature(tile.region, exact)) {
        const SlavePoint at = facet.whole ? above(part, y) : within(part, y);
        const Point normal = unit(at.surface.normal);
        const auto [reference, gap, met] = project(master, at.surface.position, normal);
        points.push_back({at.reference, reference, weight * at.stretch, tile.master, gap, normal});
      }
    }
  }
  return points;
}

}  // namespace squeal::mortar
