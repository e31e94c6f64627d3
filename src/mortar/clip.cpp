#include "mortar/clip.hpp"

#include <gmsh.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace squeal::mortar {
namespace {

PlanePoint from(const PlanePoint& a, const PlanePoint& b) { return {b[0] - a[0], b[1] - a[1]}; }

double cross(const PlanePoint& a, const PlanePoint& b) { return a[0] * b[1] - a[1] * b[0]; }

bool isSegment(const Region& region) { return region.size() == 2; }

/// Returns the half-planes whose intersection is the region; for a segment, those through its ends.
std::vector<HalfPlane> sides(const Region& region) {
  std::vector<HalfPlane> sides;
  const std::size_t n = region.size();
  for (std::size_t i = 0; i < n; ++i) {
    const PlanePoint& a = region[i];
    const PlanePoint along = from(a, region[(i + 1) % n]);
    const PlanePoint inwards = isSegment(region) ? along : PlanePoint{-along[1], along[0]};
    sides.push_back({inwards, -(inwards[0] * a[0] + inwards[1] * a[1])});
  }
  return sides;
}

/// A rule of gmsh on its reference line or triangle.
struct Rule {
  std::vector<double> point;  ///< [point][3]
  std::vector<double> weight;
};

const Rule& rule(int gmshType, int degree) {
  static std::map<std::pair<int, int>, Rule> rules;
  auto [found, isNew] = rules.try_emplace({gmshType, degree});
  if (isNew)
    gmsh::model::mesh::getIntegrationPoints(gmshType, "Gauss" + std::to_string(degree),
                                            found->second.point, found->second.weight);
  return found->second;
}

/// Appends the rule on the segment ab, ξ = −1 … 1.
void appendSegment(std::vector<WeightedPoint>& points, const Rule& rule, const Region& ab) {
  const PlanePoint along = from(ab[0], ab[1]);
  const double half = measure(ab) / 2;
  for (std::size_t q = 0; q < rule.weight.size(); ++q) {
    const double s = (1 + rule.point[3 * q]) / 2;
    points.push_back({{ab[0][0] + s * along[0], ab[0][1] + s * along[1]}, half * rule.weight[q]});
  }
}

/// Appends the rule on the triangle abc; the reference triangle has the area 1/2.
void appendTriangle(std::vector<WeightedPoint>& points, const Rule& rule, const PlanePoint& a,
                    const PlanePoint& b, const PlanePoint& c) {
  const PlanePoint ab = from(a, b), ac = from(a, c);
  const double twice = cross(ab, ac);
  for (std::size_t q = 0; q < rule.weight.size(); ++q) {
    const double s = rule.point[3 * q], t = rule.point[3 * q + 1];
    points.push_back(
        {{a[0] + s * ab[0] + t * ac[0], a[1] + s * ab[1] + t * ac[1]}, twice * rule.weight[q]});
  }
}

}  // namespace

double measure(const Region& region) {
  if (region.size() < 2) return 0;
  if (isSegment(region))
    return std::hypot(region[1][0] - region[0][0], region[1][1] - region[0][1]);
  double twice = 0;  // from a vertex on, so that no distance from the origin is cancelled
  for (std::size_t i = 2; i < region.size(); ++i)
    twice += cross(from(region[0], region[i - 1]), from(region[0], region[i]));
  return twice / 2;
}

PlanePoint centroid(const Region& region) {
  PlanePoint centre{};
  double total = 0;
  for (const auto& [point, weight] : quadrature(region, 1)) {
    for (std::size_t d = 0; d < 2; ++d) centre[d] += weight * point[d];
    total += weight;
  }
  return {centre[0] / total, centre[1] / total};
}

bool isConvex(const Region& region) {
  const std::size_t n = region.size();
  if (isSegment(region)) return true;
  for (std::size_t i = 0; i < n; ++i) {
    const PlanePoint &a = region[i], &b = region[(i + 1) % n], &c = region[(i + 2) % n];
    if (!(cross(from(a, b), from(b, c)) > 0)) return false;
  }
  return true;
}

Region clip(const Region& region, const HalfPlane& half) {
  Region kept;
  const std::size_t n = region.size(), edges = isSegment(region) ? 1 : n;
  for (std::size_t i = 0; i < n; ++i) {
    const PlanePoint &a = region[i], &b = region[(i + 1) % n];
    const double fa = half(a), fb = half(b);
    if (fa >= 0) kept.push_back(a);
    if (i >= edges || (fa >= 0) == (fb >= 0)) continue;
    const double s = fa / (fa - fb);
    kept.push_back({a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])});
  }
  // What a corner leaves of a polygon, or an end of a segment, has no measure.
  const std::size_t fewest = isSegment(region) ? 2 : 3;
  return kept.size() < fewest ? Region{} : kept;
}

Region intersection(const Region& region, const Region& other) {
  Region kept = region;
  for (const HalfPlane& side : sides(other)) {
    kept = clip(kept, side);
    if (kept.empty()) break;
  }
  return kept;
}

std::vector<Region> difference(const Region& region, const Region& other, double smallest) {
  std::vector<Region> pieces;
  Region inside = region;
  for (const HalfPlane& side : sides(other)) {
    const Region outside = clip(inside, {{-side.normal[0], -side.normal[1]}, -side.offset});
    if (measure(outside) > smallest) pieces.push_back(outside);
    inside = clip(inside, side);
    if (inside.empty()) break;
  }
  return pieces;
}

std::vector<WeightedPoint> quadrature(const Region& region, int degree) {
  constexpr int lines = 1, triangles = 2;  // of gmsh
  std::vector<WeightedPoint> points;
  if (isSegment(region)) appendSegment(points, rule(lines, degree), region);
  for (std::size_t i = 2; i < region.size(); ++i)
    appendTriangle(points, rule(triangles, degree), region[0], region[i - 1], region[i]);
  return points;
}

}  // namespace squeal::mortar
