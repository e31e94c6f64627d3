// SPDX-License-Identifier: BSD-2-Clause
#include "run/audit/near_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/coupling/exchange.hpp"
#include "model/coupling/search.hpp"
#include "model/element/shape.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/mesh/vector.hpp"
#include "run/audit/labelled_faces.hpp"

namespace squeal::audit {
namespace {

using mesh::Point;
using mortar::Face;

constexpr double nearness = 0.1;      // largest distance of near faces, of the smaller size
constexpr double touching = 1e-3;     // the same of faces that touch
constexpr double coincidence = 1e-6;  // the same of nodes at one place
constexpr double opposed = -0.9;      // largest product of the unit normals of facing faces

/// A face as a flat polygon.
struct Flat {
  std::vector<Point> corners;
  Point centre{}, normal{};  // outward unit normal
  double area = 0;           // m² (m in the plane)
  bool isLine = false;

  explicit Flat(const Face& face) {
    const auto& table = element::shapeTable(face.type);
    corners.assign(face.points.begin(), face.points.begin() + table.corners);
    isLine = table.dimension == 1;
    for (const auto& corner : corners)
      centre = mesh::plus(centre, corner, 1.0 / double(corners.size()));
    Point sum{};
    if (isLine)
      sum = mesh::cross(mesh::minus(corners[1], corners[0]), {0, 0, 1});
    else
      for (std::size_t i = 0; i < corners.size(); ++i)
        sum = mesh::plus(sum,
                         mesh::cross(mesh::minus(corners[i], centre),
                                     mesh::minus(corners[(i + 1) % corners.size()], centre)),
                         0.5);
    area = mesh::length(sum);
    normal = mesh::scaled(sum, face.sign / area);
  }
  double size() const { return isLine ? area : std::sqrt(area); }
  /// Returns true if a point lies above or below the polygon, its edges included.
  bool covers(const Point& x) const {
    const double edge = 1e-9 * size();
    if (isLine) {
      const Point along = mesh::minus(corners[1], corners[0]);
      const double at = mesh::dot(mesh::minus(x, corners[0]), along) / area;
      return at >= -edge && at <= area + edge;
    }
    int inside = 0, outside = 0;  // of the edges, for either order of the corners
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point along = mesh::minus(corners[(i + 1) % corners.size()], corners[i]);
      const double height =
          mesh::dot(mesh::cross(along, mesh::minus(x, corners[i])), normal) / mesh::length(along);
      inside += height >= -edge, outside += height <= edge;
    }
    return inside == std::ssize(corners) || outside == std::ssize(corners);
  }
};

/// Returns the distance from the centre of a face to another one along the normal of the first, if
/// they face each other there.
std::optional<double> gapOf(const Flat& face, const Flat& other) {
  const double product = mesh::dot(face.normal, other.normal);
  if (product > opposed) return {};
  const Point apart = mesh::minus(other.centre, face.centre);
  const double gap = mesh::dot(apart, other.normal) / product;
  if (std::abs(gap) > nearness * std::min(face.size(), other.size())) return {};
  if (!other.covers(mesh::plus(face.centre, face.normal, gap))) return {};
  return gap;
}

/// The faces of one body that face another one, of one rank or of all.
struct Facing {
  PetscInt faces = 0;
  double area = 0;
  double least = INFINITY, largest = -INFINITY;  // gap, m
  double relative = 0;                           // largest |gap| over the size of its face
  Point first{INFINITY, INFINITY, INFINITY};
};

/// A pair of bodies in one order, or of a body with itself: indices into Mesh::bodies.
using Pair = std::pair<int, int>;

/// What this rank finds.
struct Found {
  std::map<Pair, Facing> facing;
  std::map<Pair, std::set<PetscInt>> nodes;  // global nodes of the first body
  std::map<Pair, std::set<int>> groups;      // of the facing faces of the first body
};

/// Returns true if two sorted lists have a common entry.
bool intersect(const std::vector<int>& a, const std::vector<int>& b) {
  return std::ranges::any_of(a, [&](int x) { return std::ranges::binary_search(b, x); });
}

/// Compares the faces of this rank with those near them.
class Comparison {
 public:
  Comparison(const LabelledFaces& all, const std::vector<Flat>& flat,
             const coupling::Candidates& near)
      : all_(all), flat_(flat), near_(near) {
    for (const auto& face : near.masters) others_.emplace_back(face);
  }
  Found run() {
    for (std::size_t f = 0; f < all_.faces.size(); ++f) compare(f);
    return std::move(found_);
  }

 private:
  void compare(std::size_t f) {
    const auto& face = all_.faces[f];
    const auto& label = all_.labels[face.body];
    std::map<int, double> gaps;           // [body] the smallest one
    std::map<int, std::set<int>> groups;  // [body] of the faces there
    std::set<int> joined;                 // bodies that an interface joins here
    for (const std::size_t m : near_.ofSlave[f]) {
      const auto& other = all_.labels[near_.masters[m].body];
      compareNodes(f, near_.masters[m], other.body);
      const bool isOnePart = near_.masters[m].parts[0] == face.parts[0];
      if (other.body == label.body && isOnePart) continue;
      const auto gap = gapOf(flat_[f], others_[m]);
      if (!gap) continue;
      if (intersect(label.interfaces, other.interfaces)) joined.insert(other.body);
      const auto [at, isNew] = gaps.try_emplace(other.body, *gap);
      if (std::abs(*gap) < std::abs(at->second)) at->second = *gap;
      groups[other.body].insert(other.groups.begin(), other.groups.end());
    }
    for (const auto& [body, gap] : gaps)
      if (!joined.contains(body)) {
        add(found_.facing[{label.body, body}], flat_[f], gap);
        found_.groups[{label.body, body}].insert(label.groups.begin(), label.groups.end());
        found_.groups[{body, label.body}].insert(groups[body].begin(), groups[body].end());
      }
  }
  static void add(Facing& facing, const Flat& face, double gap) {
    ++facing.faces, facing.area += face.area;
    facing.least = std::min(facing.least, gap), facing.largest = std::max(facing.largest, gap);
    facing.relative = std::max(facing.relative, std::abs(gap) / face.size());
    facing.first = std::min(facing.first, face.centre);
  }
  void compareNodes(std::size_t f, const Face& other, int body) {
    const auto& face = all_.faces[f];
    const double distance = coincidence * flat_[f].size();
    for (std::size_t i = 0; i < face.nodes.size(); ++i) {
      if (all_.joined[f][i]) continue;
      for (std::size_t j = 0; j < other.nodes.size(); ++j)
        if (face.nodes[i] != other.nodes[j] &&
            mesh::length(mesh::minus(face.points[i], other.points[j])) < distance)
          found_.nodes[{all_.labels[face.body].body, body}].insert(face.nodes[i]);
    }
  }

  const LabelledFaces& all_;
  const std::vector<Flat>& flat_;
  const coupling::Candidates& near_;
  std::vector<Flat> others_;
  Found found_;
};

/// Collective. Returns the sums over all ranks.
std::map<Pair, Facing> summed(MPI_Comm comm, const std::map<Pair, Facing>& own) {
  struct Entry {
    int body, other;
    Facing facing;
  };
  std::vector<Entry> entries;
  for (const auto& [pair, facing] : own) entries.push_back({pair.first, pair.second, facing});
  std::map<Pair, Facing> all;
  for (const auto& [body, other, facing] : concatenated(comm, entries)) {
    auto& sum = all[{body, other}];
    sum.faces += facing.faces, sum.area += facing.area;
    sum.least = std::min(sum.least, facing.least);
    sum.largest = std::max(sum.largest, facing.largest);
    sum.relative = std::max(sum.relative, facing.relative);
    sum.first = std::min(sum.first, facing.first);
  }
  return all;
}

/// Collective. Returns the groups of all ranks.
std::map<Pair, std::set<int>> unitedGroups(MPI_Comm comm,
                                           const std::map<Pair, std::set<int>>& own) {
  std::vector<std::array<int, 3>> entries;
  for (const auto& [pair, groups] : own)
    for (const int group : groups) entries.push_back({pair.first, pair.second, group});
  std::map<Pair, std::set<int>> all;
  for (const auto& [body, other, group] : concatenated(comm, entries))
    all[{body, other}].insert(group);
  return all;
}

/// The nodes of one body that coincide with others, of all ranks.
struct Coincident {
  PetscInt nodes = 0;
  Point first{INFINITY, INFINITY, INFINITY};
};

/// Collective. Counts each node once, for the last of its pairs, on the rank that owns it.
std::map<Pair, Coincident> coincidentNodes(const mesh::Mesh& mesh,
                                           const std::map<Pair, std::set<PetscInt>>& own) {
  const int bodies = std::ssize(mesh.bodies);
  bool any = false;
  for (const auto& [pair, nodes] : own) any = any || !nodes.empty();
  std::map<Pair, Coincident> all;
  if (!mpi::any(mesh.comm, any)) return all;
  const coupling::NodeExchange exchange(mesh);
  std::vector<double> marks(mesh.localNodes(), 0.0);  // one more than the number of the pair
  for (const auto& [pair, nodes] : own)
    for (const PetscInt node : nodes)
      marks[exchange.local(node)] = pair.first * bodies + pair.second + 1;
  exchange.largest(marks);
  struct Entry {
    int body, other;
    Coincident nodes;
  };
  std::map<Pair, Coincident> here;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    if (const int number = int(std::lround(marks[node])) - 1; number >= 0) {
      auto& entry = here[{number / bodies, number % bodies}];
      ++entry.nodes, entry.first = std::min(entry.first, mesh.coordinates[node]);
    }
  std::vector<Entry> entries;
  for (const auto& [pair, nodes] : here) entries.push_back({pair.first, pair.second, nodes});
  for (const auto& [body, other, nodes] : concatenated(mesh.comm, entries)) {
    auto& sum = all[{body, other}];
    sum.nodes += nodes.nodes, sum.first = std::min(sum.first, nodes.first);
  }
  return all;
}

/// The names of the groups to which facing faces belong.
class GroupNames {
 public:
  /// Collective.
  GroupNames(const mesh::Mesh& mesh, const LabelledFaces& all, const Found& found)
      : mesh_(mesh), names_(all.groups), groups_(unitedGroups(mesh.comm, found.groups)) {}
  /// Returns the groups of the faces of the first body.
  std::string text(const Pair& pair) const {
    std::vector<std::string> list;
    if (const auto found = groups_.find(pair); found != groups_.end())
      for (const int group : found->second) list.push_back("'" + names_[group] + "'");
    const std::string body = "those of '" + mesh_.bodies[pair.first] + "' ";
    if (list.empty()) return body + "are in no group that an option names";
    return body + "are in " + joined(list, " and ");
  }

 private:
  const mesh::Mesh& mesh_;
  const std::vector<std::string>& names_;
  std::map<Pair, std::set<int>> groups_;
};

/// Returns a finding on one pair of bodies, from the side with more area, or on two parts of a
/// body.
Finding facingFinding(const mesh::Mesh& mesh, const Pair& pair, const Facing& facing,
                      const GroupNames& groups) {
  const bool touches = facing.relative <= touching;
  const std::string one = "'" + mesh.bodies[pair.first] + "'",
                    other = "'" + mesh.bodies[pair.second] + "'";
  const std::string what = std::string(touches ? "touches " : "lies close to ") +
                           (pair.first == pair.second ? "another part of " : "body ") + other,
                    distance = touches ? ""
                                       : formatted(" at distances from %.3g to %.3g m",
                                                   facing.least, facing.largest);
  return {
      Kind::nearFaces, touches ? Severity::warning : Severity::note,
      (pair.first == pair.second ? "a part of body " : "body ") + one + " " + what +
          " without an interface: " + counted(facing.faces, "face") + " of " + one +
          formatted(", %.4g %s%s, the first at %s", facing.area, mesh.dimension == 2 ? "m" : "m2",
                    distance.c_str(), interfaces::text(facing.first).c_str()) +
          "; " + groups.text(pair) +
          (pair.first == pair.second ? "" : "; " + groups.text({pair.second, pair.first})),
      "if the parts touch there, name these faces in a contact, -contact_<interface>_pad and "
      "_disc, or in a tie, -tie_<name>_slave and _master"};
}

Finding coincidentFinding(const mesh::Mesh& mesh, const Pair& pair, const Coincident& nodes) {
  const std::string one = "body '" + mesh.bodies[pair.first] + "' has " +
                          counted(nodes.nodes, "node") + " at the place of ",
                    where = ", the first at " + interfaces::text(nodes.first);
  if (pair.first == pair.second)
    return {Kind::unmergedNodes, Severity::warning,
            one + "another of its nodes: the body is cut there" + where,
            "merge the nodes in the mesh"};
  return {Kind::unmergedNodes, Severity::note,
          one + "a node of body '" + mesh.bodies[pair.second] + "', and nothing joins them" + where,
          "if the parts are joined there, merge the nodes in the mesh or give a contact or a tie"};
}

}  // namespace

Findings nearFindings(const Subject& model) {
  const auto& mesh = model.mesh;
  const auto all = labelledFaces(model);
  std::vector<Flat> flat;
  std::vector<double> distances;
  for (const auto& face : all.faces) {
    flat.emplace_back(face);
    distances.push_back(nearness * flat.back().size());
  }
  const auto near = coupling::candidates(mesh.comm, all.faces, all.faces, distances);
  const Found found = Comparison(all, flat, near).run();
  const auto facing = summed(mesh.comm, found.facing);
  const auto nodes = coincidentNodes(mesh, found.nodes);
  const GroupNames groups(mesh, all, found);
  Findings findings;
  for (const auto& [pair, here] : facing) {
    if (pair.first == pair.second && nodes.contains(pair)) continue;  // the nodes show it better
    const auto back = facing.find({pair.second, pair.first});
    // Of both sides the one with more area; they may differ where one is smaller than a face.
    const double opposite =
        back == facing.end() || pair.first == pair.second ? 0 : back->second.area;
    const bool isSmaller = std::abs(here.area - opposite) > 1e-6 * here.area
                               ? here.area < opposite
                               : opposite > 0 && pair.first > pair.second;
    if (!isSmaller) findings.push_back(facingFinding(mesh, pair, here, groups));
  }
  for (const auto& [pair, here] : nodes) {
    const Pair reversed{pair.second, pair.first};
    const bool isKnown =
        pair.first != pair.second && (facing.contains(pair) || facing.contains(reversed) ||
                                      (pair.first > pair.second && nodes.contains(reversed)));
    if (!isKnown) findings.push_back(coincidentFinding(mesh, pair, here));
  }
  return findings;
}

}  // namespace squeal::audit
