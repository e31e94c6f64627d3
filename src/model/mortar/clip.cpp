// SPDX-License-Identifier: BSD-2-Clause
#include "model/mortar/clip.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace squeal::mortar {
namespace {

PlanePoint from(const PlanePoint& a, const PlanePoint& b) { return {b[0] - a[0], b[1] - a[1]}; }

double cross(const PlanePoint& a, const PlanePoint& b) { return a[0] * b[1] - a[1] * b[0]; }

double size(const PlanePoint& a) { return std::hypot(a[0], a[1]); }

bool isSegment(const Region& region) { return region.size() == 2; }

/// Returns the half-planes whose intersection is the region; for a segment, those through its ends.
/// Omits very short edges, whose direction is round-off; this adds about the square of their
/// length.
std::vector<HalfPlane> sides(const Region& region) {
  std::vector<HalfPlane> sides;
  const std::size_t n = region.size();
  double longest = 0;
  for (const PlanePoint& y : region) longest = std::max(longest, size(from(region[0], y)));
  for (std::size_t i = 0; i < n; ++i) {
    const PlanePoint& a = region[i];
    const PlanePoint along = from(a, region[(i + 1) % n]);
    if (size(along) <= 1e-8 * longest) continue;
    const PlanePoint inwards = isSegment(region) ? along : PlanePoint{-along[1], along[0]};
    sides.push_back({inwards, -(inwards[0] * a[0] + inwards[1] * a[1])});
  }
  return sides;
}

/// A Gauss rule on the line from 0 to 1, or on the triangle (0, 0), (1, 0), (0, 1).
using Rule = std::vector<WeightedPoint>;

/// Returns the rule of Gauss and Legendre. gmsh has no rule with more than 20 points, which
/// strongly distorted faces need. Its points are the roots of the polynomial P_n, by Newton's
/// method from their asymptotes (Abramowitz and Stegun, 25.4.29), with
///   k P_k = (2k − 1) x P_{k−1} − (k − 1) P_{k−2}.
Rule makeLineRule(int degree) {
  const int n = degree / 2 + 1;
  Rule rule;
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 0;
    for (int step = 0; step < 6; ++step) {
      double last = 1, value = x;
      for (int k = 2; k <= n; ++k)
        last = std::exchange(value, ((2 * k - 1) * x * value - (k - 1) * last) / k);
      slope = n * (last - x * value) / (1 - x * x);
      x -= value / slope;
    }
    rule.push_back({{(1 + x) / 2, 0}, 1 / ((1 - x * x) * slope * slope)});
  }
  return rule;
}

/// Returns the rule of a square that is collapsed into a triangle, x = s and y = (1 − s) t. It is
/// exact within round-off for any degree, whereas gmsh tabulates triangle rules of degree 10 and
/// above with only 12 digits.
Rule makeTriangleRule(int degree) {
  Rule rule;
  const Rule line = makeLineRule(degree + 1);
  for (const auto& [s, ws] : line)
    for (const auto& [t, wt] : line)
      rule.push_back({{s[0], (1 - s[0]) * t[0]}, ws * wt * (1 - s[0])});
  return rule;
}

/// Returns a rule, computed on first use.
const Rule& ruleOf(Rule (*make)(int), std::map<int, Rule>& rules, int degree) {
  const auto found = rules.find(degree);
  return found != rules.end() ? found->second : rules.emplace(degree, make(degree)).first->second;
}

const Rule& lineRule(int degree) {
  static std::map<int, Rule> rules;
  return ruleOf(makeLineRule, rules, degree);
}

const Rule& triangleRule(int degree) {
  static std::map<int, Rule> rules;
  return ruleOf(makeTriangleRule, rules, degree);
}

void appendSegment(std::vector<WeightedPoint>& points, int degree, const Region& ab) {
  const PlanePoint along = from(ab[0], ab[1]);
  const double size = measure(ab);
  for (const auto& [s, weight] : lineRule(degree))
    points.push_back({{ab[0][0] + s[0] * along[0], ab[0][1] + s[0] * along[1]}, size * weight});
}

void appendTriangle(std::vector<WeightedPoint>& points, int degree, const PlanePoint& a,
                    const PlanePoint& b, const PlanePoint& c) {
  const PlanePoint ab = from(a, b), ac = from(a, c);
  const double twice = cross(ab, ac);
  for (const auto& [s, weight] : triangleRule(degree))
    points.push_back(
        {{a[0] + s[0] * ab[0] + s[1] * ac[0], a[1] + s[0] * ab[1] + s[1] * ac[1]}, twice * weight});
}

}  // namespace

double measure(const Region& region) {
  if (region.size() < 2) return 0;
  if (isSegment(region)) return size(from(region[0], region[1]));
  double twice = 0;  // relative to a vertex, which avoids cancellation far from the origin
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
  // A remaining corner of a polygon, or end of a segment, has no measure.
  const std::size_t fewest = isSegment(region) ? 2 : 3;
  return kept.size() < fewest ? Region{} : kept;
}

Region intersection(const Region& region, const Region& other, double margin) {
  Region kept = region;
  for (const HalfPlane& side : sides(other)) {
    kept = clip(kept, {side.normal, side.offset + margin * size(side.normal)});
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
  std::vector<WeightedPoint> points;
  if (isSegment(region)) appendSegment(points, degree, region);
  for (std::size_t i = 2; i < region.size(); ++i)
    appendTriangle(points, degree, region[0], region[i - 1], region[i]);
  return points;
}

}  // namespace squeal::mortar
