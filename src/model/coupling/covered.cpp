// SPDX-License-Identifier: BSD-2-Clause
#include "model/coupling/covered.hpp"

#include <algorithm>

#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/coupling/periodic.hpp"
#include "model/mesh/vector.hpp"
#include "model/mortar/dual.hpp"

namespace squeal::coupling {
namespace {

using mortar::faceType;
using mortar::wholeIntegrals;

/// A node of the slave is dropped if less than this fraction of its area is covered: a sliver would
/// determine its condition.
constexpr double leastCover = 1e-2;
/// A slave face counts as fully covered from this fraction of its area on. Curved rims leave small
/// parts open, and rules on different cells differ on curved faces. The open part is far below the
/// least integral of φ̃ of a fully covered face, a twentieth of the area.
constexpr double nearlyAll = 1 - 1e-3;

/// Returns the largest distance of two corners of a face, m.
double sizeOf(const Face& face) {
  double size = 0;
  const int corners = faceType(face.type).corners;
  for (int i = 0; i < corners; ++i)
    for (int j = 0; j < i; ++j)
      size = std::max(size, mesh::length(mesh::minus(face.points[i], face.points[j])));
  return size;
}

/// Replaces the node numbers of images by those of their primaries.
void fold(const NodeExchange& exchange, std::vector<Face>& faces) {
  for (auto& face : faces)
    for (auto& node : face.nodes) node = exchange.primary(exchange.local(node));
}

/// Collective. Sums values at the nodes of faces over all ranks, [local node].
template <class Values>
std::vector<double> nodalSums(const NodeExchange& exchange, std::size_t nodes,
                              const std::vector<CoveredFace>& faces, const Values& valuesOf) {
  std::vector<double> sums(nodes, 0.0);
  for (const auto& face : faces) {
    const std::vector<double> values = valuesOf(face);
    for (std::size_t i = 0; i < values.size(); ++i) sums[face.local[i]] += values[i];
  }
  exchange.sum(sums);
  return sums;
}

/// Returns true for a face with an open part. Excludes uncovered faces, which have no negative
/// integrals.
bool isPartial(const CoveredFace& face) {
  return face.moments.covered > 0 && face.moments.covered < nearlyAll * face.area;
}

/// Collective. Returns α of the edges, [local node].
std::vector<double> chooseAlpha(const NodeExchange& exchange, std::size_t nodes,
                                const std::vector<CoveredFace>& faces) {
  std::vector<double> chosen(nodes, 0.0);
  for (const auto& face : faces) {
    const bool partial = isPartial(face);
    for (const auto& edge : face.type->edges) {
      double& alpha = chosen[face.local[edge.node]];
      alpha = std::max(
          alpha, usualAlpha(*face.type, partial ? mortar::Cover::partial : mortar::Cover::full));
    }
  }
  exchange.largest(chosen);
  return chosen;
}

/// Returns W, [node], of a face: φ̃ of quad9 and line3 changes its sign, so a node may have a
/// positive integral over the covered part but no positive weight.
std::vector<double> weights(const CoveredFace& face, const SlaveBasis& basis) {
  const auto kept = pivots(*face.type, mortar::Multiplier::nodes, basis.droppedOf(face));
  const auto terms = integrate(face.moments, basis.alphaOf(face), kept);
  std::vector<double> values(face.local.size(), 0.0);
  for (std::size_t p = 0; p < kept.nodes.size(); ++p) values[kept.nodes[p]] = terms.weight[p];
  return values;
}

/// Drops nodes with too little covered area. Returns true if there were any.
bool drop(const std::vector<double>& covered, SlaveBasis& basis) {
  bool any = false;
  for (std::size_t node = 0; node < covered.size(); ++node) {
    if (basis.dropped[node] || !(covered[node] < leastCover * basis.whole[node])) continue;
    basis.dropped[node] = any = true;
    basis.alpha[node] = 0;
  }
  return any;
}

/// Collective. Returns the dropped nodes of this rank at partly covered faces.
std::vector<PetscInt> droppedOwned(const mesh::Mesh& mesh, const NodeExchange& exchange,
                                   const std::vector<CoveredFace>& faces, const SlaveBasis& basis) {
  std::vector<double> atCovered(mesh.localNodes(), 0.0);
  for (const auto& face : faces)
    if (face.moments.covered > 0)
      for (PetscInt node : face.local) atCovered[node] = 1;
  exchange.largest(atCovered);
  std::vector<PetscInt> owned;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    if (basis.dropped[node] && atCovered[node] > 0 &&
        exchange.primary(node) == mesh.globalNode[node])
      owned.push_back(node);
  return owned;
}

}  // namespace

std::vector<double> searchDistances(const std::vector<Face>& faces, double searchDistance) {
  std::vector<double> distances;
  for (const auto& face : faces)
    distances.push_back(searchDistance > 0 ? searchDistance : 0.5 * sizeOf(face));
  return distances;
}

double areaOf(const Face& face) {
  const std::vector<double> none(faceType(face.type).edges.size(), 0.0);
  double area = 0;
  for (double part : wholeIntegrals(face, none)) area += part;
  return area;
}

Surfaces surfacesOf(const mesh::Mesh& mesh, const NodeExchange& exchange, const std::string& slave,
                    const std::string& master, double searchDistance) {
  Surfaces surfaces{mortar::facesOf(mesh, slave), mortar::facesOf(mesh, master), {}, {}, {}, {}};
  for (const auto& face : surfaces.slaves) {
    auto& local = surfaces.localNodes.emplace_back();
    for (PetscInt node : face.nodes) local.push_back(exchange.local(node));
  }
  fold(exchange, surfaces.slaves);
  fold(exchange, surfaces.masters);
  surfaces.distances = searchDistances(surfaces.slaves, searchDistance);
  surfaces.translations = translations(mesh, surfaces.slaves, surfaces.masters);
  surfaces.candidates =
      candidates(mesh.comm, surfaces.slaves, repeated(surfaces.masters, surfaces.translations),
                 surfaces.distances);
  return surfaces;
}

std::vector<CoveredFace> cover(MPI_Comm comm, const Surfaces& surfaces, const std::string& slave,
                               const BodyVelocity& velocity) {
  std::vector<CoveredFace> faces;
  faces.reserve(surfaces.slaves.size());
  std::string failure;
  for (std::size_t i = 0; i < surfaces.slaves.size() && failure.empty(); ++i) {
    const Face& face = surfaces.slaves[i];
    CoveredFace& found = faces.emplace_back(
        CoveredFace{&face, &faceType(face.type), surfaces.localNodes[i], {}, {}, areaOf(face)});
    for (std::size_t k : surfaces.candidates.ofSlave[i])
      found.masters.push_back(&surfaces.candidates.masters[k]);
    mortar::Velocity at;
    if (velocity)
      at = [&](std::size_t master, const Point& x) {
        return velocity(found.masters[master]->body, x);
      };
    try {
      const auto points = mortar::overlap(face, found.masters, surfaces.distances[i]);
      found.moments = moments(face, found.masters, points, at);
    } catch (const Error& error) {
      failure = formatted("surface '%s' near (%g, %g, %g): %s", slave.c_str(), face.points[0][0],
                          face.points[0][1], face.points[0][2], error.what());
    }
    if (!isPartial(found))  // the points take most of the memory, which {} would retain
      found.moments.points = decltype(found.moments.points)();
  }
  failTogether(comm, failure);
  return faces;
}

std::vector<double> SlaveBasis::alphaOf(const CoveredFace& face) const {
  std::vector<double> values;
  for (const auto& edge : face.type->edges) values.push_back(alpha[face.local[edge.node]]);
  return values;
}

std::vector<bool> SlaveBasis::droppedOf(const CoveredFace& face) const {
  std::vector<bool> values;
  for (PetscInt node : face.local) values.push_back(dropped[node]);
  return values;
}

SlaveBasis chooseBasis(const mesh::Mesh& mesh, const NodeExchange& exchange,
                       const std::vector<CoveredFace>& faces,
                       const std::vector<unsigned char>& excluded) {
  const std::size_t nodes = mesh.localNodes();
  SlaveBasis basis{chooseAlpha(exchange, nodes, faces), {}, std::vector<bool>(nodes, false), 0, {}};
  const auto wholeOf = [&](const CoveredFace& face) {
    return wholeIntegrals(*face.face, basis.alphaOf(face));
  };
  const auto coveredOf = [&](const CoveredFace& face) {
    return coveredIntegrals(face.moments, basis.alphaOf(face));
  };
  const auto weightOf = [&](const CoveredFace& face) {
    return isPartial(face) ? weights(face, basis) : coveredOf(face);
  };
  basis.whole = nodalSums(exchange, nodes, faces, wholeOf);
  for (const auto& face : faces)
    for (PetscInt node : face.local)
      if (excluded[node]) basis.dropped[node] = true, basis.alpha[node] = 0;
  // Dropping a node changes D and W of its neighbours, some of which may then be dropped too.
  bool again = true;
  while (again) {
    again = drop(nodalSums(exchange, nodes, faces, coveredOf), basis);
    again = drop(nodalSums(exchange, nodes, faces, weightOf), basis) || again;
    again = mpi::any(mesh.comm, again);
  }
  basis.droppedOwned = droppedOwned(mesh, exchange, faces, basis);
  basis.droppedNodes = basis.droppedOwned.size();
  basis.droppedNodes = mpi::sum(mesh.comm, basis.droppedNodes);
  return basis;
}

}  // namespace squeal::coupling
