// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/pairing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "base/petsc/check.hpp"
#include "base/system/text.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::mesh {
namespace {

std::string positionText(const Point& p) {
  return formatted("(%.6g, %.6g, %.6g)", p[0], p[1], p[2]);
}

double squaredDistance(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t d = 0; d < 3; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return sum;
}

/// Finds nodes by position with buckets of twice the tolerance.
class Locator {
 public:
  Locator(const WholeMesh& mesh, const std::vector<PetscInt>& nodes, double tolerance)
      : mesh_(mesh), tolerance_(tolerance) {
    for (PetscInt node : nodes) buckets_[bucket(mesh.points[node])].push_back(node);
  }
  /// Returns the nodes within the tolerance of `where`.
  std::vector<PetscInt> at(const Point& where) const {
    std::vector<PetscInt> found;
    const auto centre = bucket(where);
    for (long i = -1; i <= 1; ++i)
      for (long j = -1; j <= 1; ++j)
        for (long k = -1; k <= 1; ++k) {
          const auto entry = buckets_.find({centre[0] + i, centre[1] + j, centre[2] + k});
          if (entry == buckets_.end()) continue;
          for (PetscInt node : entry->second)
            if (squaredDistance(mesh_.points[node], where) <= tolerance_ * tolerance_)
              found.push_back(node);
        }
    return found;
  }

 private:
  using Bucket = std::array<long, 3>;
  Bucket bucket(const Point& p) const {
    Bucket b;
    for (std::size_t d = 0; d < 3; ++d) b[d] = std::lround(std::floor(p[d] / (2 * tolerance_)));
    return b;
  }
  const WholeMesh& mesh_;
  double tolerance_;
  std::map<Bucket, std::vector<PetscInt>> buckets_;
};

/// Returns the distance below which nodes are at the same place: coordinates in mesh files have 6
/// to 16 digits.
double tolerance(const WholeMesh& mesh) {
  Point low = mesh.points[0], high = low;
  for (const auto& p : mesh.points)
    for (std::size_t d = 0; d < 3; ++d)
      low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
  return 1e-6 * std::sqrt(squaredDistance(low, high));
}

Point lowCorner(const WholeMesh& mesh, const std::vector<PetscInt>& nodes) {
  Point low = mesh.points[nodes.at(0)];
  for (PetscInt node : nodes)
    for (std::size_t d = 0; d < 3; ++d) low[d] = std::min(low[d], mesh.points[node][d]);
  return low;
}

void pairImages(WholeMesh& mesh, const PeriodicRequest& request, double near) {
  const auto& images = mesh.nodeGroups.at(request.image);
  const auto& primaries = mesh.nodeGroups.at(request.of);
  const Point from = lowCorner(mesh, primaries), to = lowCorner(mesh, images);
  const Locator locator(mesh, primaries, near);
  for (PetscInt image : images) {
    const auto& p = mesh.points[image];
    const Point where = plus(minus(p, to), from);
    // Two bodies may meet here at one place (a contact node on the periodic boundary): the image
    // follows its own body.
    PetscInt partner = -1;
    for (PetscInt node : locator.at(where))
      if (partner < 0 || mesh.part[node] == mesh.part[image]) partner = node;
    const std::string option = "option " + request.option;
    if (partner < 0)
      throw Error(option + ": the node at " + positionText(p) + " of '" + request.image +
                  "' has no partner in '" + request.of +
                  "'; the two must be meshed alike, one the translate of the other");
    if (partner == image) throw Error(option + ": a group cannot be its own image");
    if (mesh.primary[image] == image) mesh.primary[image] = partner;
  }
  if (images.size() != primaries.size())
    throw Error(formatted("option %s: the groups have %zu and %zu nodes; they must be meshed alike",
                          request.option.c_str(), images.size(), primaries.size()));
}

/// Replaces images of images, as at the edge of a doubly periodic box, by images of the last
/// primary.
void resolveImages(WholeMesh& mesh, const Request& request) {
  for (PetscInt node = 0; node < mesh.nodeCount(); ++node) {
    PetscInt end = node;
    int steps = 0;
    while (mesh.primary[end] != end) {
      end = mesh.primary[end];
      if (++steps > 8)
        throw Error("option " + request.periodic.front().option +
                    ": the images go round in a circle");
    }
    mesh.primary[node] = end;
    if (end == node) continue;
    mesh.images.push_back({node, end, minus(mesh.points[node], mesh.points[end]), mesh.part[end]});
  }
  for (auto& [name, nodes] : mesh.nodeGroups) {
    std::set<PetscInt> primaries;
    for (PetscInt node : nodes) primaries.insert(mesh.primary[node]);
    nodes.assign(primaries.begin(), primaries.end());
  }
}

std::vector<int> bodyOfNode(const WholeMesh& mesh) {
  std::vector<int> body(mesh.points.size(), -1);
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e)
      for (PetscInt node : block.nodesOf(e)) body[node] = block.label[e];
  return body;
}

int surfaceIndex(const WholeMesh& mesh, const std::string& surface) {
  return std::find(mesh.surfaces.begin(), mesh.surfaces.end(), surface) - mesh.surfaces.begin();
}

std::set<PetscInt> padNodes(const WholeMesh& mesh, const std::string& surface) {
  const int index = surfaceIndex(mesh, surface);
  std::set<PetscInt> nodes;
  for (const auto& block : mesh.faces)
    for (std::size_t e = 0; e < block.tag.size(); ++e)
      if (block.label[e] == index)
        for (PetscInt node : block.nodesOf(e)) nodes.insert(mesh.primary[node]);
  return nodes;
}

/// Returns the reason why a node of the pad has no partner in the group of the disc.
std::string whyUnpaired(const WholeMesh& mesh, PetscInt node, const std::string& group,
                        const std::vector<int>& body, double near) {
  const auto& place = mesh.points[node];
  for (std::size_t other = 0; other < mesh.points.size(); ++other)
    if (mesh.part[other] != mesh.part[node] && body[other] >= 0 &&
        squaredDistance(mesh.points[other], place) <= near * near)
      return "although body '" + mesh.bodies[body[other]] +
             "' has one: is a face missing in the group '" + group + "'?";
  return "where no other body has one either: the two are not meshed alike";
}

std::vector<PetscInt> discNodes(const WholeMesh& mesh, const InterfaceRequest& request,
                                const std::set<PetscInt>& pad) {
  std::vector<PetscInt> disc;  // shared nodes: the group holds the twins of both sides
  for (PetscInt node : mesh.nodeGroups.at(request.disc.name))
    if (!pad.count(node)) disc.push_back(node);
  if (disc.empty())
    throw Error(
        "options " + request.pad.option + ", " + request.disc.option +
        ": pad and disc are the same surface, of one body; contact is between the surfaces of two");
  return disc;
}

/// Returns why the faces of the pad do not each lie on one face of the disc, node on node; empty if
/// they do. A finer face of the disc would have nodes without a gap.
std::string whyFacesDiffer(const WholeMesh& mesh, const InterfaceRequest& request,
                           const std::map<PetscInt, PetscInt>& master) {
  std::set<std::vector<PetscInt>> discFaces;
  for (auto face : mesh.discFaces.at(request.disc.name)) {
    for (auto& node : face) node = mesh.primary[node];
    std::sort(face.begin(), face.end());
    discFaces.insert(face);
  }
  const int index = surfaceIndex(mesh, request.pad.name);
  for (const auto& block : mesh.faces)
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      if (block.label[e] != index) continue;
      std::vector<PetscInt> masters;
      for (PetscInt node : block.nodesOf(e))
        masters.push_back(mesh.primary[master.at(mesh.primary[node])]);
      std::sort(masters.begin(), masters.end());
      if (!discFaces.count(masters))
        return "the face of '" + request.pad.name + "' at " +
               positionText(mesh.points[block.nodesOf(e)[0]]) + " does not lie on one face of '" +
               request.disc.name + "': is a face missing in this group?";
    }
  return "";
}

/// Why the sides of an interface do not match; an empty text if they do.
struct Mismatch {
  std::string why;
  bool isSmall = false;  ///< most nodes of the pad have a partner
};

/// Adds the pairs of an interface if pad and disc are meshed alike. Returns why they are not.
Mismatch pairContact(WholeMesh& mesh, const InterfaceRequest& request, int interface,
                     const std::vector<int>& body, double near) {
  if (request.discIsSlave) return {"the nodes of the disc bear the gaps", false};
  const std::set<PetscInt> pad = padNodes(mesh, request.pad.name);
  if (request.disc.name.empty()) {
    for (PetscInt node : pad) mesh.pairs.push_back({node, -1, interface, -1, -1, {}});
    return {};
  }
  const auto disc = discNodes(mesh, request, pad);
  const Locator locator(mesh, disc, near);
  std::map<PetscInt, PetscInt> master;
  std::vector<PetscInt> unpaired;
  for (PetscInt node : pad)
    if (const auto found = locator.at(mesh.points[node]); found.empty())
      unpaired.push_back(node);
    else
      master[node] = found[0];
  if (!unpaired.empty())
    return {
        formatted("%zu of %zu nodes of '%s' have no node of '%s' within %.2g m, first that at "
                  "%s, %s",
                  unpaired.size(), pad.size(), request.pad.name.c_str(), request.disc.name.c_str(),
                  near, positionText(mesh.points[unpaired[0]]).c_str(),
                  whyUnpaired(mesh, unpaired[0], request.disc.name, body, near).c_str()),
        2 * unpaired.size() < pad.size()};
  const std::string why = whyFacesDiffer(mesh, request, master);
  if (why.empty())
    for (const auto& [node, other] : master) {
      const Point &x = mesh.points[node], &y = mesh.points[other];
      mesh.pairs.push_back({node,
                            other,
                            interface,
                            body[other],
                            mesh.part[other],
                            {y[0] - x[0], y[1] - x[1], y[2] - x[2]}});
    }
  return {why, true};
}

}  // namespace

void pairNodes(WholeMesh& mesh, const Request& request) {
  const double near = tolerance(mesh);
  mesh.primary.resize(mesh.points.size());
  for (PetscInt node = 0; node < mesh.nodeCount(); ++node) mesh.primary[node] = node;
  for (const auto& periodic : request.periodic) pairImages(mesh, periodic, near);
  resolveImages(mesh, request);
  const auto body = bodyOfNode(mesh);
  for (int i = 0; i < std::ssize(request.interfaces); ++i) {
    const Mismatch found = pairContact(mesh, request.interfaces[i], i, body, near);
    mesh.interfaces.push_back({.label = request.interfaces[i].label,
                               .matching = found.why.empty(),
                               .mismatch = found.why,
                               .nearlyMatching = !found.why.empty() && found.isSmall});
  }
}

}  // namespace squeal::mesh
