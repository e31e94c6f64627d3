// SPDX-License-Identifier: BSD-2-Clause
#include "fuzz/models/boxes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

#include "fuzz/random.hpp"

namespace squeal::fuzz {
namespace {

double coordinate(const std::vector<double>& cuts, int place) {
  const double low = cuts[place / 2];
  return place % 2 == 0 ? low : (low + cuts[place / 2 + 1]) / 2;
}

Vector positionOf(const BoxMesh& mesh, const Box& box, const Place& place) {
  Vector x{};
  for (int a = 0; a < mesh.dimension; ++a) x[a] = coordinate(box.cuts[a], place[a]);
  if (mesh.ring) return {x[1] * std::cos(x[0]), -x[1] * std::sin(x[0]), x[2]};
  x[0] += mesh.skew * x[mesh.up()];
  return x;
}

/// An element with its nodes by number and its group.
struct Written {
  int type;
  std::size_t group;
  std::vector<std::size_t> nodes;
};

class Writer {
 public:
  Writer(const BoxMesh& mesh, const Writing& writing) : mesh_(mesh), writing_(writing) {
    known_.resize(mesh.boxes.size());
    placed_.resize(mesh.boxes.size());
    std::vector<std::size_t> order(mesh.boxes.size());
    std::iota(order.begin(), order.end(), 0);
    // A welded box comes behind the one whose nodes it shares.
    if (writing.shuffled) std::reverse(order.begin(), order.end());
    if (writing.welded >= 0) std::sort(order.begin(), order.end());
    for (std::size_t box : order) addBox(box);
    if (writing.shuffled) shuffle(elements_);
  }

  std::string text() const {
    std::vector<std::size_t> order(points_.size());
    std::iota(order.begin(), order.end(), 0);
    if (writing_.shuffled) shuffle(order);
    std::vector<std::size_t> tag(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) tag[order[i]] = i + 1;
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names() + "$Nodes\n" +
                       std::to_string(order.size()) + "\n";
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Vector x = turned(points_[order[i]], writing_.turn);
      char line[120];
      std::snprintf(line, sizeof line, "%zu %.17g %.17g %.17g\n", i + 1, x[0], x[1], x[2]);
      text += line;
    }
    text += "$EndNodes\n$Elements\n" + std::to_string(elements_.size()) + "\n";
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      const auto& [type, group, nodes] = elements_[i];
      const std::string number = std::to_string(group + 1);
      text += std::to_string(i + 1) + " " + std::to_string(type) + " 2 " + number + " " + number;
      for (std::size_t node : nodes) text += " " + std::to_string(tag[node]);
      text += "\n";
    }
    return text + "$EndElements\n";
  }

 private:
  std::string names() const {
    std::string text =
        "$PhysicalNames\n" + std::to_string(mesh_.boxes.size() + mesh_.sides.size()) + "\n";
    std::size_t number = 0;
    for (const auto& box : mesh_.boxes)
      text += std::to_string(mesh_.dimension) + " " + std::to_string(++number) + " \"" + box.name +
              "\"\n";
    for (const auto& side : mesh_.sides)
      text += std::to_string(mesh_.dimension - 1) + " " + std::to_string(++number) + " \"" +
              side.name + "\"\n";
    return text + "$EndPhysicalNames\n";
  }

  template <class Value>
  void shuffle(std::vector<Value>& values) const {
    Random random(values.size());
    for (std::size_t i = values.size(); i > 1; --i)
      std::swap(values[i - 1], values[random.below(i)]);
  }

  std::size_t nodeAt(std::size_t number, Place place) {
    const Box& box = mesh_.boxes[number];
    if (box.closed) place[0] %= 2 * box.cellsAlong(0);
    const auto [found, isNew] = known_[number].try_emplace(place, points_.size());
    if (!isNew) return found->second;
    const Vector x = positionOf(mesh_, box, place);
    std::array<long, 3> key{};
    for (int a = 0; a < 3; ++a) key[a] = std::lround(x[a] * 1e9);
    if (static_cast<int>(number) == writing_.welded) {
      const auto& other = placed_[writing_.weldedTo];
      if (const auto shared = other.find(key); shared != other.end())
        return found->second = shared->second;
    }
    placed_[number][key] = points_.size();
    points_.push_back(x);
    return found->second;
  }

  void add(std::size_t box, std::size_t group, const Element& element) {
    Written written{element.type, group, {}};
    for (const auto& place : element.nodes) written.nodes.push_back(nodeAt(box, place));
    elements_.push_back(std::move(written));
  }

  bool isOn(const Side& side, const Element& face) const {
    const Box& box = mesh_.boxes[side.box];
    const int along = side.axis == 0 ? 1 : 0, plane = side.high ? 2 * box.cellsAlong(side.axis) : 0;
    int middle = 0;
    for (const auto& corner : face.corners) {
      if (corner[side.axis] != plane) return false;
      middle += corner[along];
    }
    const double cell = middle / (2.0 * static_cast<double>(face.corners.size()));
    return side.firstCell <= cell && cell < side.lastCell;
  }

  void addBox(std::size_t number) {
    const Box& box = mesh_.boxes[number];
    const int layers = mesh_.dimension == 3 ? box.cellsAlong(2) : 1;
    for (int k = 0; k < layers; ++k)
      for (int j = 0; j < box.cellsAlong(1); ++j)
        for (int i = 0; i < box.cellsAlong(0); ++i)
          for (const auto& element : elementsOf(box.shape, {2 * i, 2 * j, 2 * k})) {
            add(number, number, element);
            for (const auto& face : facesOf(box.shape, element))
              for (std::size_t s = 0; s < mesh_.sides.size(); ++s)
                if (mesh_.sides[s].box == number && isOn(mesh_.sides[s], face))
                  add(number, mesh_.boxes.size() + s, face);
          }
  }

  const BoxMesh& mesh_;
  const Writing& writing_;
  std::vector<std::map<Place, std::size_t>> known_;                 // [box]
  std::vector<std::map<std::array<long, 3>, std::size_t>> placed_;  // [box] in nanometres
  std::vector<Vector> points_;
  std::vector<Written> elements_;
};

}  // namespace

Vector turned(const Vector& vector, int turn) {
  Vector result;
  for (int a = 0; a < 3; ++a) result[(a + turn) % 3] = vector[a];
  return result;
}

std::string meshText(const BoxMesh& mesh, const Writing& writing) {
  return Writer(mesh, writing).text();
}

}  // namespace squeal::fuzz
