// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Couplings of blocks that are meshed apart, with what must hold of any coupling.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "model/coupling/coupling.hpp"
#include "model/elasticity/face.hpp"
#include "model/element/shape.hpp"
#include "support/model/blocks_apart.hpp"
#include "support/model/model.hpp"

namespace squeal::test {

using coupling::Coupling;
using coupling::SlaveNode;
using mesh::Point;

/// A mesh with the positions of all its nodes.
struct Case {
  mesh::Mesh mesh;
  std::vector<Point> at;  ///< [global node]

  const Point& place(const SlaveNode& node) const { return mesh.coordinates[node.node]; }
  PetscInt global(const SlaveNode& node) const { return mesh.globalNode[node.node]; }
};

/// Collective on the communicator.
inline Case caseOf(const std::string& options, MPI_Comm comm = PETSC_COMM_WORLD) {
  setOptions(options);
  Case c{readMesh(comm), {}};
  c.at.resize(c.mesh.totalNodes);
  for (PetscInt i = 0; i < c.mesh.ownedNodes; ++i)
    c.at[c.mesh.globalNode[i]] = c.mesh.coordinates[i];
  check(MPI_Allreduce(MPI_IN_PLACE, c.at.data(), 3 * c.mesh.totalNodes, MPI_DOUBLE, MPI_SUM, comm));
  return c;
}

inline Coupling padOnDisc(const mesh::Mesh& mesh, double distance = 0) {
  return coupling::couple(mesh, coupling::NodeExchange(mesh), {"pad_low", "disc_high", distance},
                          {}, std::vector<unsigned char>(mesh.localNodes(), 0));
}

/// A ring of radii 1 and 2 in place of the box [0, 1] x [0, 1] x height; it closes at x = 1.
inline Point ring(const Point& x) {
  const double angle = 2 * std::numbers::pi * x[0], radius = 2 - x[1];
  return {radius * std::cos(angle), radius * std::sin(angle), x[2]};
}

inline double linear(const Point& x) { return 0.3 + 0.7 * x[0] - 1.1 * x[1] + 0.4 * x[2]; }

/// What must hold of any coupling of faces in one plane. Every figure is an error.
struct Defects {
  double rowSum = 0, linear = 0, inverse = 0, share = 0, area = 0;
  double least = 1e300;   ///< smallest W relative to ∫ φ̃ over whole faces
  double largestRow = 0;  ///< largest sum of magnitudes of a row of P
  double pivots = 0, areaSum = 0;
};

/// Collective.
inline Defects defectsOf(const Case& c, const Coupling& coupling) {
  Defects d;
  std::map<PetscInt, const SlaveNode*> nodes;
  std::vector<double> jump(c.at.size(), 0.0), back(c.at.size(), 0.0);
  for (const auto& node : coupling.nodes) {
    double sum = 0, value = 0, magnitude = 0, share = 0;
    for (const auto& [l, weight] : node.masters) {
      sum += weight, value += weight * linear(c.at[l]), magnitude += std::abs(weight);
    }
    for (const auto& part : node.masterParts) share += part.share;
    d.rowSum = std::max(d.rowSum, std::abs(sum - 1));
    d.linear = std::max(d.linear, std::abs(value - linear(c.place(node))));
    d.share = std::max(d.share, std::abs(share - 1));
    d.least = std::min(d.least, node.area / node.wholeArea);
    d.largestRow = std::max(d.largestRow, magnitude);
    d.areaSum += node.area, d.pivots += 1;
    // any h on pivots: g = G h
    for (const auto& [j, weight] : node.jumps)
      jump[c.global(node)] += weight * std::cos(3 * c.at[j][0] + 5 * c.at[j][1] + 1);
  }
  check(MPI_Allreduce(MPI_IN_PLACE, jump.data(), jump.size(), MPI_DOUBLE, MPI_SUM, c.mesh.comm));
  for (const auto& node : coupling.nodes) {
    double h = 0;
    for (const auto& [j, weight] : node.jumpsOf) h += weight * jump[j];
    const Point& x = c.place(node);
    d.inverse = std::max(d.inverse, std::abs(h - std::cos(3 * x[0] + 5 * x[1] + 1)));
  }
  for (double* worst : {&d.rowSum, &d.linear, &d.inverse, &d.share, &d.largestRow})
    check(MPI_Allreduce(MPI_IN_PLACE, worst, 1, MPI_DOUBLE, MPI_MAX, c.mesh.comm));
  check(MPI_Allreduce(MPI_IN_PLACE, &d.least, 1, MPI_DOUBLE, MPI_MIN, c.mesh.comm));
  for (double* sum : {&d.areaSum, &d.pivots})
    check(MPI_Allreduce(MPI_IN_PLACE, sum, 1, MPI_DOUBLE, MPI_SUM, c.mesh.comm));
  d.area = std::abs(d.areaSum - coupling.coveredArea);
  return d;
}

/// Collective. Returns ∫ φ dA over the faces of a group, [global node].
inline std::vector<double> nodalLoads(const Case& c, const std::string& group) {
  std::vector<double> load(c.at.size(), 0.0);
  const int label =
      std::find(c.mesh.surfaces.begin(), c.mesh.surfaces.end(), group) - c.mesh.surfaces.begin();
  for (const auto& block : c.mesh.faces)
    for (std::size_t e = 0; e < block.surface.size(); ++e) {
      if (block.surface[e] != label) continue;
      std::vector<Point> points;
      for (PetscInt node : block.nodesOf(e)) points.push_back(c.mesh.coordinates[node]);
      const auto mass = elasticity::faceMass(element::shapeTable(block.type), points);
      const int n = block.nodesPerFace;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) load[c.mesh.globalNode[block.nodesOf(e)[i]]] += mass[i * n + j];
    }
  check(MPI_Allreduce(MPI_IN_PLACE, load.data(), load.size(), MPI_DOUBLE, MPI_SUM, c.mesh.comm));
  return load;
}

/// A record of a contact node that does not depend on numbers: its position, what P and G make of
/// smooth fields, its areas and its gap.
using Record = std::array<double, 9>;

/// Collective on the communicator of the case. Returns the records of all ranks, by position.
inline std::vector<Record> records(const Case& c, const Coupling& coupling) {
  std::vector<double> mine;
  for (const auto& node : coupling.nodes) {
    double master = 0, jump = 0, back = 0;
    for (const auto& [l, weight] : node.masters)
      master += weight * std::sin(3 * c.at[l][0] + 2 * c.at[l][1] + c.at[l][2]);
    for (const auto& [j, weight] : node.jumps) jump += weight * std::cos(c.at[j][0] + c.at[j][1]);
    for (const auto& [j, weight] : node.jumpsOf) back += weight * std::cos(c.at[j][0] - c.at[j][1]);
    const Point& x = c.place(node);
    mine.insert(mine.end(),
                {x[0], x[1], x[2], master, jump, back, node.area, node.wholeArea, node.gap});
  }
  int ranks = 1;
  const int count = int(mine.size());
  check(MPI_Comm_size(c.mesh.comm, &ranks));
  std::vector<int> counts(ranks), offsets(ranks, 0);
  check(MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, c.mesh.comm));
  for (int r = 1; r < ranks; ++r) offsets[r] = offsets[r - 1] + counts[r - 1];
  std::vector<Record> all((offsets.back() + counts.back()) / 9);
  check(MPI_Allgatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), offsets.data(),
                       MPI_DOUBLE, c.mesh.comm));
  // The positions are those of the file, the same on any number of ranks.
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace squeal::test
