// SPDX-License-Identifier: BSD-2-Clause
#include "model/mortar/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/petsc/check.hpp"
#include "model/mesh/vector.hpp"
#include "model/mortar/facet.hpp"
#include "model/mortar/overlap_rule.hpp"
#include "model/mortar/surface.hpp"

namespace squeal::mortar {

using mesh::cross;
using mesh::dot;
using mesh::length;
using mesh::unit;

namespace {

/// Pieces below this fraction of a facet of the slave face are omitted; such slivers are round-off.
constexpr double sliver = 1e-13;
/// A face whose normal turns by more than about 84° from its mean cannot be projected.
constexpr double leastCosine = 0.1;

/// Coinciding rims of both sides differ by the sag of edges and, in the projection, by the gap
/// between facets that are not parallel. Master facets are extended beyond their edges by this
/// difference, up to this fraction of the slave facet, if the angle between the facets is at most
/// 60°.
constexpr double farthestReach = 0.1, leastParallel = 0.5;

/// A master facet in the projection along the mean normal of the slave face.
struct Shadow {
  Region outline;
  HalfPlane distance;  ///< from the plane of the projection to the facet
  std::size_t master;
  bool whole;        ///< true if the facet is all of the master face
  double sag, tilt;  ///< of edges, m; sine of the angle to the slave face, or −1 beyond 60°
};

/// The part of a slave facet that one master facet covers.
struct Piece {
  Region region;   ///< inside the slave facet
  Region outline;  ///< of the part that the master facet covers, also outside the slave facet
  std::size_t master;
  bool whole;       ///< true if the facet is all of the master face
  bool beyond;      ///< true if it extends beyond the edges of the master facet
  double distance;  ///< magnitude at the centroid, m
};

std::vector<Shadow> shadows(const Frame& frame, std::span<const Face* const> masters) {
  std::vector<Shadow> shadows;
  for (std::size_t i = 0; i < masters.size(); ++i)
    for (const Facet& facet : facets(*masters[i], frame.normal())) {
      const Point normal = facet.normal();
      const double cosine = dot(normal, frame.normal());
      if (!(cosine < 0)) continue;
      Region outline = frame.flat(facet);
      std::ranges::reverse(outline);  // the master's outside is the slave's inside
      shadows.push_back({std::move(outline), frame.distanceTo(facet), i, facet.whole,
                         sag(*masters[i], facet, frame.normal()),
                         cosine > -leastParallel ? -1 : length(cross(normal, frame.normal()))});
    }
  return shadows;
}

Region clipDistance(const Region& region, const HalfPlane& g, double limit) {
  const auto [slope, offset] = g;
  const Region above = clip(region, {slope, limit + offset});    // g ≥ −limit
  return clip(above, {{-slope[0], -slope[1]}, limit - offset});  // g ≤ limit
}

/// Returns the extension of a master facet beyond its edges.
double reach(const Region& slave, double slaveSag, const Shadow& shadow, double searchDistance) {
  if (shadow.tilt < 0) return 0;
  double gap = 0, extent = 0;
  for (const PlanePoint& y : shadow.outline) gap = std::max(gap, std::abs(shadow.distance(y)));
  for (const PlanePoint& y : slave)
    extent = std::max(extent, std::hypot(y[0] - slave[0][0], y[1] - slave[0][1]));
  return std::min(slaveSag + shadow.sag + std::min(gap, searchDistance) * shadow.tilt,
                  farthestReach * extent);
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

/// Returns the parts of a slave facet that master facets cover within the distance. With a positive
/// sag of the slave, they extend beyond their edges.
std::vector<Piece> pieces(const Region& slave, const std::vector<Shadow>& shadows,
                          double searchDistance, std::optional<double> slaveSag) {
  std::vector<Piece> pieces;
  const double smallest = sliver * measure(slave);
  for (const Shadow& shadow : shadows) {
    Region outline = shadow.outline;
    if (slaveSag)
      outline = intersection(slave, outline, reach(slave, *slaveSag, shadow, searchDistance));
    else if (!boxesTouch(slave, outline))
      continue;
    outline = clipDistance(outline, shadow.distance, searchDistance);
    if (outline.empty()) continue;
    Region region = slaveSag ? outline : intersection(slave, outline);
    if (measure(region) <= smallest) continue;
    const double at = std::abs(shadow.distance(centroid(region)));
    pieces.push_back({std::move(region), std::move(outline), shadow.master, shadow.whole,
                      slaveSag.has_value(), at});
  }
  return pieces;
}

/// Returns the pieces without the parts that a nearer piece covers, so no place counts twice.
/// Pieces that extend beyond edges come last.
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
      kept.push_back(
          {std::move(region), {}, pieces[i].master, pieces[i].whole, false, pieces[i].distance});
  }
  return kept;
}

double openPart(const Region& slave, const std::vector<Piece>& tiles) {
  double open = measure(slave);
  for (const Piece& tile : tiles) open -= measure(tile.region);
  return open;
}

/// Returns the pieces of a slave facet, which do not overlap. An open part counts as covered if
/// extended masters close all of it. Otherwise it is an overhang.
std::vector<Piece> tiles(const Region& slave, const std::vector<Shadow>& shadows,
                         double searchDistance, double slaveSag) {
  const double smallest = sliver * measure(slave);
  auto all = pieces(slave, shadows, searchDistance, {});
  auto tiles = nearest(all, smallest);
  if (tiles.empty() || openPart(slave, tiles) <= 10 * smallest) return tiles;
  std::ranges::move(pieces(slave, shadows, searchDistance, slaveSag), std::back_inserter(all));
  auto reaching = nearest(std::move(all), smallest);
  return openPart(slave, reaching) <= 10 * smallest ? reaching : tiles;
}

/// A point of the slave face.
struct SlavePoint {
  Reference reference;
  FacePoint surface;
  double stretch;  ///< area of the face per area of the projection (length in the plane)
};

[[noreturn]] void failFolded() {
  throw Error(
      "a face on the slave side of surfaces whose meshes do not match is so strongly curved or "
      "distorted that its normal turns by more than 84 degrees: refine it");
}

/// Returns the point of the face above a point of the projection of the whole face. All points move
/// along the mean normal, so straight edges stay straight.
SlavePoint above(const Face& slave, const Frame& frame, const PlanePoint& y,
                 const Reference& start) {
  SlavePoint at;
  at.reference = project(slave, frame.lifted(y), frame.normal(), start).reference;
  at.surface = facePoint(slave, at.reference);
  const double cosine = dot(at.surface.normal, frame.normal()) / length(at.surface.normal);
  if (!(cosine > leastCosine)) failFolded();
  at.stretch = 1 / cosine;
  return at;
}

/// Returns the point of the face for a point of the projection of a triangle. Reference coordinates
/// are linear on the triangle, so triangles tile the face even at curved edges.
SlavePoint within(const Face& slave, const Facet& triangle, const Region& flat,
                  const PlanePoint& y) {
  const double area = measure(flat);
  const double b = measure({flat[0], y, flat[2]}) / area, c = measure({flat[0], flat[1], y}) / area;
  const auto& corner = triangle.reference;
  SlavePoint at;
  for (std::size_t d = 0; d < 2; ++d)
    at.reference[d] =
        corner[0][d] + b * (corner[1][d] - corner[0][d]) + c * (corner[2][d] - corner[0][d]);
  at.surface = facePoint(slave, at.reference);
  at.stretch =
      length(at.surface.normal) * std::abs(measure({corner[0], corner[1], corner[2]})) / area;
  return at;
}

}  // namespace

std::vector<OverlapPoint> overlap(const Face& slave, std::span<const Face* const> masters,
                                  double searchDistance) {
  std::vector<OverlapPoint> points;
  const Facet whole = wholeFacet(slave);
  const Frame frame(whole);
  const auto projected = shadows(frame, masters);
  for (const Facet& facet : facets(slave, frame.normal())) {
    const Region flat = frame.flat(facet);
    if (!(measure(flat) > 0)) failFolded();
    const double slaveSag = sag(slave, facet, frame.normal());
    for (const Piece& tile : tiles(flat, projected, searchDistance, slaveSag)) {
      const Face& master = *masters[tile.master];
      // The points of a tile are close together: each solve starts from the previous one.
      Reference onSlave = faceType(slave.type).centre(), onMaster = faceType(master.type).centre();
      for (const auto& [y, weight] :
           overlapRule(tile.region, frame, slave, master, facet.whole && tile.whole)) {
        const SlavePoint at =
            facet.whole ? above(slave, frame, y, onSlave) : within(slave, facet, flat, y);
        const Point normal = unit(at.surface.normal);
        const auto [reference, gap, met] = project(master, at.surface.position, normal, onMaster);
        points.push_back({at.reference, reference, weight * at.stretch, tile.master, gap, normal});
        onSlave = at.reference;
        onMaster = met ? reference : faceType(master.type).centre();
      }
    }
  }
  return points;
}

}  // namespace squeal::mortar
