// SPDX-License-Identifier: BSD-2-Clause
#include "model/coupling/box.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "model/element/shape.hpp"

namespace squeal::coupling {
namespace {

/// Returns the control points of the face in the Bernstein basis. Its polynomials are nonnegative
/// and sum to one, so the face lies in the convex hull of these points (Farin, Curves and Surfaces
/// for CAGD). On an edge of second order from x_a over x_e to x_b,
///   c_e = 2 x_e − (x_a + x_b)/2.
/// The middle of a quadrilateral follows from the same rule in both directions. quad8 is a quad9
/// with the middle node x_m = Σ x_e / 2 − Σ x_c / 4.
std::vector<Point> controlPoints(const Face& face) {
  const auto& table = element::shapeTable(face.type);
  const auto& x = face.points;
  if (table.order == 1) return x;
  std::vector<Point> control = x;
  const int corners = table.corners, edges = table.dimension == 1 ? 1 : corners;
  Point cornerSum{}, edgeSum{};
  for (int e = 0; e < edges; ++e)
    for (std::size_t d = 0; d < 3; ++d) {
      control[corners + e][d] = 2 * x[corners + e][d] - (x[e][d] + x[(e + 1) % corners][d]) / 2;
      cornerSum[d] += x[e][d];
      edgeSum[d] += x[corners + e][d];
    }
  if (corners != 4) return control;
  control.resize(9);
  for (std::size_t d = 0; d < 3; ++d)
    control[8][d] = table.nodes == 9 ? 4 * x[8][d] - edgeSum[d] + cornerSum[d] / 4
                                     : edgeSum[d] - 3 * cornerSum[d] / 4;
  return control;
}

void include(Box& box, const Box& other) {
  for (std::size_t d = 0; d < 3; ++d) {
    box.low[d] = std::min(box.low[d], other.low[d]);
    box.high[d] = std::max(box.high[d], other.high[d]);
  }
}

/// Returns the cost of a group of boxes with the union `box`: the group attracts faces in
/// proportion to its size, and each is compared with the whole group (Goldsmith and Salmon 1987).
double sizeCost(const Box& box, std::size_t count) {
  double size = 0;
  for (std::size_t d = 0; d < 3; ++d) size += box.high[d] - box.low[d];
  return size * count;
}

/// A part of a list of boxes with its bounding box.
struct Group {
  std::span<Box> boxes;
  Box around;

  explicit Group(std::span<Box> part) : boxes(part), around(part[0]) {
    for (const auto& box : part) include(around, box);
  }
  double cost() const { return sizeCost(around, boxes.size()); }
};

/// Divides a group of at least two boxes along its longest axis, with the least sum of the costs of
/// both parts. This reorders its boxes.
std::pair<Group, Group> divide(const Group& group) {
  const auto& [low, high] = group.around;
  std::size_t axis = 0;
  for (std::size_t d = 1; d < 3; ++d)
    if (high[d] - low[d] > high[axis] - low[axis]) axis = d;
  const auto& boxes = group.boxes;
  std::sort(boxes.begin(), boxes.end(), [axis](const Box& a, const Box& b) {
    return a.low[axis] + a.high[axis] < b.low[axis] + b.high[axis];
  });
  std::vector<double> upper(boxes.size());  // [box] cost of the part from this box to the end
  Box box = boxes.back();
  for (std::size_t i = boxes.size(); i-- > 0;) {
    include(box, boxes[i]);
    upper[i] = sizeCost(box, boxes.size() - i);
  }
  box = boxes.front();
  std::size_t best = 1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < boxes.size(); ++i) {
    include(box, boxes[i - 1]);
    if (const double sum = sizeCost(box, i) + upper[i]; sum < least) least = sum, best = i;
  }
  return {Group(boxes.first(best)), Group(boxes.subspan(best))};
}

}  // namespace

Box boxOf(const Face& face) {
  const auto control = controlPoints(face);
  Box box{control[0], control[0]};
  for (const auto& point : control) include(box, {point, point});
  return box;
}

Box widened(Box box, double distance) {
  for (std::size_t d = 0; d < 3; ++d) box.low[d] -= distance, box.high[d] += distance;
  return box;
}

std::vector<Box> summary(std::vector<Box> boxes, std::size_t most) {
  std::vector<Group> groups;
  if (!boxes.empty()) groups.emplace_back(std::span(boxes));
  while (groups.size() < std::min(most, boxes.size())) {
    // A single box cannot be divided.
    const auto largest =
        std::max_element(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
          return std::pair(a.boxes.size() > 1, a.cost()) < std::pair(b.boxes.size() > 1, b.cost());
        });
    auto [left, right] = divide(*largest);
    *largest = left;
    groups.push_back(right);
  }
  std::vector<Box> result;
  for (const auto& group : groups) result.push_back(group.around);
  return result;
}

}  // namespace squeal::coupling
