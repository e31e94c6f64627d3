#include "coupling/coupling.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "coupling/exchange.hpp"
#include "coupling/search.hpp"
#include "mortar/dual.hpp"
#include "petsc/arrays.hpp"
#include "petsc/owned.hpp"

namespace squeal::coupling {
namespace {

using mortar::Cover;
using mortar::facesOf;
using mortar::FaceTerms;
using mortar::FaceType;
using mortar::faceType;
using mortar::integrate;
using mortar::MidEdge;
using mortar::Multiplier;
using mortar::OverlapPoint;
using mortar::Pivots;
using mortar::pivots;
using mortar::usualAlpha;
using mortar::wholeIntegrals;

/// A node of the slave is dropped if less than this part of its area is covered: its condition
/// would follow from a sliver.
constexpr double leastCover = 1e-2;
/// A slave face counts as fully covered up to this part of its area, which curved rims leave open.
constexpr double nearlyAll = 1 - 1e-6;

/// A matrix with a row per node of the mesh, as triples.
struct Triples {
  std::vector<PetscInt> row, column;
  std::vector<PetscScalar> value;
  void add(PetscInt i, PetscInt j, double entry) {
    row.push_back(i), column.push_back(j), value.push_back(entry);
  }
};

/// Collective. Returns the matrix of the triples of all ranks, with a row per node and `columns`
/// columns, or one per node.
OwnedMat toMatrix(const mesh::Mesh& mesh, const Triples& triples,
                  PetscInt columns = PETSC_DETERMINE) {
  OwnedMat matrix;
  check(MatCreate(mesh.comm, matrix.out()));
  check(MatSetSizes(matrix, mesh.ownedNodes,
                    columns == PETSC_DETERMINE ? mesh.ownedNodes : PETSC_DECIDE, PETSC_DETERMINE,
                    columns));
  check(MatSetType(matrix, MATAIJ));
  check(MatSetPreallocationCOO(matrix, triples.row.size(),
                               const_cast<PetscInt*>(triples.row.data()),
                               const_cast<PetscInt*>(triples.column.data())));
  check(MatSetValuesCOO(matrix, triples.value.data(), ADD_VALUES));
  return matrix;
}

std::vector<Weight> rowOf(Mat matrix, PetscInt row) {
  PetscInt count = 0;
  const PetscInt* columns = nullptr;
  const PetscScalar* values = nullptr;
  std::vector<Weight> weights;
  check(MatGetRow(matrix, row, &count, &columns, &values));
  for (PetscInt k = 0; k < count; ++k)
    if (values[k] != 0) weights.push_back({columns[k], values[k]});
  check(MatRestoreRow(matrix, row, &count, &columns, &values));
  return weights;
}

double areaOf(const Face& face) {
  const std::vector<double> none(faceType(face.type).edges.size(), 0.0);
  double area = 0;
  for (double part : wholeIntegrals(face, none)) area += part;
  return area;
}

/// Returns the largest distance of two corners of a face, m.
double sizeOf(const Face& face) {
  double size = 0;
  const int corners = faceType(face.type).corners;
  for (int i = 0; i < corners; ++i)
    for (int j = 0; j < i; ++j) {
      double squared = 0;
      for (std::size_t d = 0; d < 3; ++d)
        squared +=
            (face.points[i][d] - face.points[j][d]) * (face.points[i][d] - face.points[j][d]);
      size = std::max(size, std::sqrt(squared));
    }
  return size;
}

std::vector<double> distancesOf(const std::vector<Face>& slaves, double searchDistance) {
  std::vector<double> distances;
  for (const auto& face : slaves)
    distances.push_back(searchDistance > 0 ? searchDistance : 0.5 * sizeOf(face));
  return distances;
}

/// A slave face with what covers it.
struct CoveredFace {
  const Face* face;
  const FaceType* type;
  std::vector<PetscInt> local;  ///< [node] local number
  std::vector<const Face*> masters;
  std::vector<OverlapPoint> points;
  double area = 0, covered = 0;
};

/// The two surfaces of an interface on this rank, and the masters near its slaves.
struct Surfaces {
  std::vector<Face> slaves, masters;
  std::vector<double> distances;  ///< [slave]
  Candidates candidates;

  Surfaces(const mesh::Mesh& mesh, const Interface& interface)
      : slaves(facesOf(mesh, interface.slave)),
        masters(facesOf(mesh, interface.master)),
        distances(distancesOf(slaves, interface.searchDistance)) {}
};

/// Replaces the numbers of images by those of their primaries, so that the entries of both meet.
void fold(const NodeExchange& exchange, std::vector<Face>& faces) {
  for (auto& face : faces)
    for (auto& node : face.nodes) node = exchange.primary(exchange.local(node));
}

std::vector<CoveredFace> cover(const Surfaces& surfaces,
                               const std::vector<std::vector<PetscInt>>& localNodes) {
  std::vector<CoveredFace> faces;
  for (std::size_t i = 0; i < surfaces.slaves.size(); ++i) {
    const Face& slave = surfaces.slaves[i];
    CoveredFace face{&slave, &faceType(slave.type), localNodes[i], {}, {}, areaOf(slave), 0};
    for (std::size_t k : surfaces.candidates.ofSlave[i])
      face.masters.push_back(&surfaces.candidates.masters[k]);
    face.points = mortar::overlap(slave, face.masters, surfaces.distances[i]);
    for (const auto& point : face.points) face.covered += point.weight;
    if (!face.points.empty()) faces.push_back(std::move(face));
  }
  return faces;
}

/// The values at the nodes of the slave that decide on the basis, [local node].
struct Basis {
  std::vector<double> alpha;  ///< of the edge of a mid-edge node
  std::vector<double> whole;  ///< ∫ φ̃ dA over all faces of the slave
  std::vector<bool> dropped;

  std::vector<double> alphaOf(const CoveredFace& face) const {
    std::vector<double> values;
    for (const auto& edge : face.type->edges) values.push_back(alpha[face.local[edge.node]]);
    return values;
  }
  std::vector<bool> droppedOf(const CoveredFace& face) const {
    std::vector<bool> values;
    for (PetscInt node : face.local) values.push_back(dropped[node]);
    return values;
  }
};

/// Adds ∫ φ̃ dA over the whole faces, or over what is covered of them, at their nodes.
template <class Integrals>
std::vector<double> nodalIntegrals(const NodeExchange& exchange, std::size_t nodes,
                                   const std::vector<CoveredFace>& faces,
                                   const Integrals& integrals) {
  std::vector<double> sums(nodes, 0.0);
  for (const auto& face : faces) {
    const std::vector<double> values = integrals(face);
    for (std::size_t i = 0; i < values.size(); ++i) sums[face.local[i]] += values[i];
  }
  exchange.sum(sums);
  return sums;
}

std::vector<double> coveredIntegrals(const CoveredFace& face, const Basis& basis) {
  const Pivots all =
      pivots(*face.type, Multiplier::nodes, std::vector<bool>(face.face->points.size(), false));
  return integrate(*face.face, basis.alphaOf(face), all, face.masters, face.points).covered;
}

/// Collective. Returns α and the nodes to be dropped. Partly covered faces need a larger α, on
/// which all faces at an edge agree. A dropped mid-edge node has α = 0, so that ũ = u there.
Basis chooseBasis(const mesh::Mesh& mesh, const NodeExchange& exchange,
                  const std::vector<CoveredFace>& faces,
                  const std::vector<unsigned char>& excluded) {
  const std::size_t nodes = mesh.localNodes();
  Basis basis{std::vector<double>(nodes, 0.0), {}, std::vector<bool>(nodes, false)};
  for (const auto& face : faces) {
    const Cover cover = face.covered < nearlyAll * face.area ? Cover::partial : Cover::full;
    for (const auto& edge : face.type->edges) {
      double& alpha = basis.alpha[face.local[edge.node]];
      alpha = std::max(alpha, usualAlpha(*face.type, cover));
    }
  }
  exchange.largest(basis.alpha);
  const auto wholeOf = [&](const CoveredFace& face) {
    return wholeIntegrals(*face.face, basis.alphaOf(face));
  };
  const auto coveredOf = [&](const CoveredFace& face) { return coveredIntegrals(face, basis); };
  const auto covered = nodalIntegrals(exchange, nodes, faces, coveredOf);
  basis.whole = nodalIntegrals(exchange, nodes, faces, wholeOf);
  for (const auto& face : faces)
    for (PetscInt node : face.local)
      basis.dropped[node] = excluded[node] || covered[node] < leastCover * basis.whole[node];
  for (const auto& face : faces)
    for (const auto& edge : face.type->edges)
      if (basis.dropped[face.local[edge.node]]) basis.alpha[face.local[edge.node]] = 0;
  basis.whole = nodalIntegrals(exchange, nodes, faces, wholeOf);
  return basis;
}

/// The sums over the faces, by nodes of the mesh.
struct Sums {
  Triples masters;                         ///< M − B, [pivot][node of the master or dropped node]
  Triples convected;                       ///< C
  Triples parts;                           ///< M by connected parts of the master
  Triples bodies;                          ///< M by bodies of the master
  std::vector<double> slave, weight, gap;  ///< D, W, G, [local node]
  PetscInt slivers = 0;
};

void addFace(const CoveredFace& face, const Basis& basis, const BodyVelocity& velocity,
             Sums& sums) {
  const Pivots kept = pivots(*face.type, Multiplier::nodes, basis.droppedOf(face));
  mortar::Velocity at;
  if (velocity)
    at = [&](std::size_t master, const Point& x) {
      return velocity(face.masters[master]->body, x);
    };
  const FaceTerms terms =
      integrate(*face.face, basis.alphaOf(face), kept, face.masters, face.points, at);
  sums.slivers += !terms.dual;
  for (std::size_t p = 0; p < kept.nodes.size(); ++p) {
    const PetscInt local = face.local[kept.nodes[p]], row = face.face->nodes[kept.nodes[p]];
    sums.slave[local] += terms.slave[p], sums.weight[local] += terms.weight[p];
    sums.gap[local] += terms.gap[p];
    for (std::size_t o = 0; o < kept.others.size(); ++o)
      sums.masters.add(row, face.face->nodes[kept.others[o]], -terms.others(p, o));
    for (const auto& master : terms.masters) {
      const Face& other = *face.masters[master.face];
      for (std::size_t l = 0; l < other.nodes.size(); ++l) {
        const double value = master.values(p, l);
        sums.masters.add(row, other.nodes[l], value);
        sums.parts.add(row, other.parts[l], value);
        sums.bodies.add(row, other.body, value);
        if (!master.convected.empty())
          sums.convected.add(row, other.nodes[l], master.convected(p, l));
      }
    }
  }
}

/// The pivots of this rank and, on all local nodes, the factors W/D of their jumps, which are zero
/// at nodes that are no pivots.
struct Pivoting {
  std::vector<PetscInt> owned;  // local nodes, ascending
  std::vector<double> ratio;    // [local node]
};

Pivoting pivotsOf(const mesh::Mesh& mesh, const NodeExchange& exchange, const Basis& basis,
                  const Sums& sums) {
  Pivoting found{{}, std::vector<double>(mesh.localNodes(), 0.0)};
  for (PetscInt node = 0; node < mesh.localNodes(); ++node) {
    if (basis.dropped[node] || sums.slave[node] == 0) continue;
    found.ratio[node] = sums.weight[node] / sums.slave[node];
    if (node < mesh.ownedNodes && exchange.primary(node) == mesh.globalNode[node])
      found.owned.push_back(node);
  }
  return found;
}

/// Collective. Scales the rows, or the columns, of a matrix by values at nodes, [local node].
void scale(const mesh::Mesh& mesh, Mat matrix, const std::vector<double>& values, bool columns) {
  OwnedVec factors;
  check(VecCreateMPI(mesh.comm, mesh.ownedNodes, PETSC_DETERMINE, factors.out()));
  std::copy(values.begin(), values.begin() + mesh.ownedNodes, WriteArray(factors).begin());
  check(MatDiagonalScale(matrix, columns ? nullptr : factors.get(),
                         columns ? factors.get() : nullptr));
}

std::vector<double> inverted(std::vector<double> values) {
  for (double& value : values) value = value == 0 ? 0 : 1 / value;
  return values;
}

/// Collective. Returns the matrix with the rows
///   1 on the diagonal of a pivot at a corner,   (middle, end, end) of a pivot within an edge.
OwnedMat edgeMatrix(const mesh::Mesh& mesh, const NodeExchange& exchange,
                    const std::vector<CoveredFace>& faces, const Basis& basis,
                    const Pivoting& pivoting,
                    const std::function<std::array<double, 2>(double alpha)>& middleAndEnd) {
  std::vector<double> facesAt(mesh.localNodes(), 0.0);  // [mid-edge node]: both add to one row
  const auto forEachEdge = [&](const auto& action) {
    for (const auto& face : faces)
      for (const auto& edge : face.type->edges) {
        const PetscInt middle = face.local[edge.node];
        if (basis.alpha[middle] > 0 && pivoting.ratio[middle] != 0) action(face, edge, middle);
      }
  };
  forEachEdge([&](const auto&, const auto&, PetscInt middle) { ++facesAt[middle]; });
  exchange.sum(facesAt);
  Triples triples;
  forEachEdge([&](const CoveredFace& face, const MidEdge& edge, PetscInt middle) {
    const auto [atMiddle, atEnd] = middleAndEnd(basis.alpha[middle]);
    const PetscInt row = face.face->nodes[edge.node];
    triples.add(row, row, atMiddle / facesAt[middle]);
    for (int corner : edge.corners)
      triples.add(row, face.face->nodes[corner], atEnd / facesAt[middle]);
  });
  for (PetscInt node : pivoting.owned)
    if (facesAt[node] == 0) triples.add(mesh.globalNode[node], mesh.globalNode[node], 1);
  return toMatrix(mesh, triples);
}

/// The matrices of one coupling, with a row per node that is empty unless the node is a pivot.
struct Matrices {
  OwnedMat masters, jumps, jumpsOf, convected;  ///< P, G, G⁻¹, rows of SlaveNode::convected
  OwnedMat parts, bodies;                       ///< shares, a column per part or body
};

OwnedMat product(Mat a, Mat b) {
  OwnedMat result;
  check(MatMatMult(a, b, MAT_INITIAL_MATRIX, PETSC_DEFAULT, result.out()));
  return result;
}

Matrices matricesOf(const mesh::Mesh& mesh, const NodeExchange& exchange,
                    const std::vector<CoveredFace>& faces, const Basis& basis,
                    const Pivoting& pivoting, Sums& sums) {
  const OwnedMat edges = edgeMatrix(mesh, exchange, faces, basis, pivoting, [](double alpha) {
    return std::array{1 - 2 * alpha, alpha};
  });
  //   P = E D⁻¹ (M − B), where ũ = u at the nodes of E that are no pivots
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    if (pivoting.ratio[node] == 0)
      sums.masters.add(mesh.globalNode[node], mesh.globalNode[node], 1);
  const OwnedMat conditions = toMatrix(mesh, sums.masters);
  std::vector<double> divisors = sums.slave;
  for (std::size_t i = 0; i < divisors.size(); ++i)
    if (pivoting.ratio[i] == 0) divisors[i] = 1;
  scale(mesh, conditions, inverted(divisors), false);
  Matrices result;
  result.masters = product(edges, conditions);
  //   G = E W/D
  check(MatDuplicate(edges, MAT_COPY_VALUES, result.jumps.out()));
  scale(mesh, result.jumps, pivoting.ratio, true);
  //   G⁻¹ = D/W E⁻¹
  result.jumpsOf = edgeMatrix(mesh, exchange, faces, basis, pivoting, [](double alpha) {
    return std::array{1 / (1 - 2 * alpha), -alpha / (1 - 2 * alpha)};
  });
  std::vector<double> isPivot;
  for (double ratio : pivoting.ratio) isPivot.push_back(ratio != 0);
  scale(mesh, result.jumpsOf, isPivot, true);
  scale(mesh, result.jumpsOf, inverted(pivoting.ratio), false);
  const auto weights = inverted(sums.weight);
  const OwnedMat convected = toMatrix(mesh, sums.convected);
  scale(mesh, convected, weights, false);
  result.convected = product(result.jumps, convected);
  result.parts = toMatrix(mesh, sums.parts, mesh.parts);
  result.bodies = toMatrix(mesh, sums.bodies, mesh.bodies.size());
  for (Mat shares : {result.parts.get(), result.bodies.get()}) scale(mesh, shares, weights, false);
  return result;
}

std::vector<SlaveNode> slaveNodes(const mesh::Mesh& mesh, const Basis& basis,
                                  const Pivoting& pivoting, const Sums& sums,
                                  const Matrices& matrices) {
  std::vector<SlaveNode> nodes;
  for (PetscInt local : pivoting.owned) {
    const PetscInt row = mesh.globalNode[local];
    SlaveNode node;
    node.node = local;
    node.masters = rowOf(matrices.masters, row);
    node.jumps = rowOf(matrices.jumps, row), node.jumpsOf = rowOf(matrices.jumpsOf, row);
    node.convected = rowOf(matrices.convected, row);
    node.partShare.resize(mesh.parts);
    for (const auto& [part, share] : rowOf(matrices.parts, row)) node.partShare[part] = share;
    double most = 0;
    for (const auto& [body, share] : rowOf(matrices.bodies, row))
      if (share > most) most = share, node.masterBody = body;
    node.area = sums.weight[local], node.wholeArea = basis.whole[local];
    node.gap = sums.gap[local] / sums.weight[local];
    nodes.push_back(std::move(node));
  }
  return nodes;
}

SideReport sideReport(MPI_Comm comm, const std::vector<Face>& faces,
                      const std::vector<bool>& isNear) {
  double sums[4] = {0, 0, 0, 0};
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const double area = areaOf(faces[i]);
    sums[0] += 1, sums[1] += area;
    if (isNear[i]) sums[2] += 1, sums[3] += area;
  }
  check(MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, comm));
  return {PetscInt(sums[0]), PetscInt(sums[2]), sums[1], sums[3]};
}

/// Collective. Returns which faces have a face of the other side near them.
std::vector<bool> nearOthers(MPI_Comm comm, const std::vector<Face>& faces,
                             const std::vector<Face>& others, double searchDistance) {
  std::vector<bool> isNear;
  const auto found = candidates(comm, faces, others, distancesOf(faces, searchDistance));
  for (const auto& list : found.ofSlave) isNear.push_back(!list.empty());
  return isNear;
}

}  // namespace

Coupling couple(const mesh::Mesh& mesh, const Interface& interface, const BodyVelocity& velocity,
                const std::vector<unsigned char>& excluded) {
  const NodeExchange exchange(mesh);
  Surfaces surfaces(mesh, interface);
  std::vector<std::vector<PetscInt>> localNodes;
  for (const auto& face : surfaces.slaves) {
    localNodes.emplace_back();
    for (PetscInt node : face.nodes) localNodes.back().push_back(exchange.local(node));
  }
  fold(exchange, surfaces.slaves);
  fold(exchange, surfaces.masters);
  surfaces.candidates =
      candidates(mesh.comm, surfaces.slaves, surfaces.masters, surfaces.distances);
  const auto faces = cover(surfaces, localNodes);
  const Basis basis = chooseBasis(mesh, exchange, faces, excluded);

  Sums sums;
  for (auto* values : {&sums.slave, &sums.weight, &sums.gap}) values->resize(mesh.localNodes());
  for (const auto& face : faces) addFace(face, basis, velocity, sums);
  for (auto* values : {&sums.slave, &sums.weight, &sums.gap}) exchange.sum(*values);
  const Pivoting pivoting = pivotsOf(mesh, exchange, basis, sums);
  const Matrices matrices = matricesOf(mesh, exchange, faces, basis, pivoting, sums);

  Coupling coupling;
  coupling.nodes = slaveNodes(mesh, basis, pivoting, sums, matrices);
  std::vector<bool> isNear;
  for (const auto& list : surfaces.candidates.ofSlave) isNear.push_back(!list.empty());
  coupling.slave = sideReport(mesh.comm, surfaces.slaves, isNear);
  coupling.master = sideReport(
      mesh.comm, surfaces.masters,
      nearOthers(mesh.comm, surfaces.masters, surfaces.slaves, interface.searchDistance));
  double totals[3] = {0, 0, double(sums.slivers)};
  for (const auto& face : faces) {
    totals[0] += face.covered;
    for (const auto& point : face.points)
      coupling.largestGap = std::max(coupling.largestGap, std::abs(point.gap));
  }
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    totals[1] += basis.dropped[node] && exchange.primary(node) == mesh.globalNode[node];
  check(MPI_Allreduce(MPI_IN_PLACE, totals, 3, MPI_DOUBLE, MPI_SUM, mesh.comm));
  check(MPI_Allreduce(MPI_IN_PLACE, &coupling.largestGap, 1, MPI_DOUBLE, MPI_MAX, mesh.comm));
  coupling.coveredArea = totals[0];
  coupling.droppedNodes = PetscInt(totals[1]), coupling.sliverFaces = PetscInt(totals[2]);
  return coupling;
}

bool masterIsFiner(const mesh::Mesh& mesh, const Interface& interface) {
  const Surfaces sides(mesh, interface);
  const auto mean = [&](const std::vector<Face>& faces, const std::vector<Face>& others) {
    const auto report = sideReport(mesh.comm, faces,
                                   nearOthers(mesh.comm, faces, others, interface.searchDistance));
    return report.nearFaces > 0 ? report.nearArea / report.nearFaces : INFINITY;
  };
  // Equal faces differ by rounding, which must not decide.
  return mean(sides.masters, sides.slaves) < 0.99 * mean(sides.slaves, sides.masters);
}

}  // namespace squeal::coupling
