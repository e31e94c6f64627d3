// SPDX-License-Identifier: BSD-2-Clause
#include "model/interfaces/nodes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/coupling/exchange.hpp"
#include "model/elasticity/face.hpp"
#include "model/element/shape.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/interfaces/candidates.hpp"
#include "model/interfaces/chains.hpp"
#include "model/interfaces/crossing.hpp"
#include "model/interfaces/dependence.hpp"
#include "model/interfaces/equations.hpp"
#include "model/interfaces/layers.hpp"
#include "model/interfaces/lost.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::interfaces {
namespace {

/// The nodes with the gaps: on interfaces with a compliant layer the layer nodes.
class GapBearers {
 public:
  explicit GapBearers(const mesh::Mesh& mesh) : layer_(mesh.ownedNodes, -1) {
    for (const auto& [node, layer] : mesh.layers) layer_[node] = layer;
  }
  /// Returns the local node.
  PetscInt of(const Candidate& candidate, const Interfaces& all) const {
    const PetscInt node = candidate.slave.node;
    if (all.options[candidate.interface].layerStiffness == 0) return node;
    ensure(layer_[node] >= 0, "the nodes of compliant contact have layer nodes");
    return layer_[node];
  }

 private:
  std::vector<PetscInt> layer_;  // [owned node] its layer node, −1 without one
};

/// Sums over the slave faces at each node: area-weighted normals (from disc to pad) and ∫ φ̃ dA.
/// Sums of images are added to those of their primaries.
struct FaceSums {
  OwnedVec normal, area;  // nodal vectors; the area is in the component of the gap
};

FaceSums sumFaces(const mesh::Mesh& mesh, const Interfaces& all, Mat periodic) {
  FaceSums local{elasticity::nodalVector(mesh), elasticity::nodalVector(mesh)},
      sums{elasticity::nodalVector(mesh), elasticity::nodalVector(mesh)};
  for (const auto& block : mesh.faces) {
    const auto& table = element::shapeTable(block.type);
    for (std::size_t e = 0; e < block.surface.size(); ++e) {
      const SlaveSide* slave = all.slaveOf(mesh.surfaces[block.surface[e]]);
      if (!slave) continue;
      std::vector<Point> points;
      const auto nodes = block.nodesOf(e);
      for (PetscInt node : nodes) points.push_back(mesh.coordinates[node]);
      const auto faceMass = elasticity::faceMass(table, points);
      const auto normals = elasticity::nodeNormals(table, points, -slave->sign * block.sign[e]);
      const double faceArea = std::accumulate(faceMass.begin(), faceMass.end(), 0.0);
      for (int i = 0; i < block.nodesPerFace; ++i) {
        if (!all.hasGapOn(slave->surface, nodes[i])) continue;  // an edge of two surfaces
        const PetscInt row = mesh.dimension * mesh.globalNode[nodes[i]];
        double weight = 0;
        for (int j = 0; j < block.nodesPerFace; ++j) weight += faceMass[i * block.nodesPerFace + j];
        check(VecSetValue(local.area, row + mesh.dimension - 1, weight, ADD_VALUES));
        for (int d = 0; d < mesh.dimension; ++d)
          check(VecSetValue(local.normal, row + d, faceArea * normals[i][d], ADD_VALUES));
      }
    }
  }
  for (Vec vector : {local.normal.get(), local.area.get()})
    check(VecAssemblyBegin(vector)), check(VecAssemblyEnd(vector));
  check(MatMultTranspose(periodic, local.normal, sums.normal));
  check(MatMultTranspose(periodic, local.area, sums.area));
  if (all.gapBasis) {
    //   ∫ φ̃ dA = Eᵀ ∫ φ dA
    check(MatMultTranspose(all.gapBasis.matrix, sums.area, local.area));
    check(VecCopy(local.area, sums.area));
  }
  return sums;
}

/// Sets w = −V in the tangent plane [2.15] as direction and speed.
void setSlip(const Point& velocity, double fastest, ContactNode& node) {
  const Point w = mesh::scaled(mesh::tangential(velocity, node.normal), -1);
  node.slipSpeed = mesh::length(w);
  // On the axis of a rotation, or if the velocity is normal to the contact, w is only round-off;
  // gmsh places nodes to 1e-11.
  if (node.slipSpeed > 1e-9 * fastest)
    node.slip = mesh::scaled(w, 1 / node.slipSpeed);
  else
    node.slipSpeed = 0;
}

void fillNodes(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
               const std::vector<Candidate>& candidates, const GapBearers& layers, Mat periodic,
               Interfaces& all) {
  const FaceSums sums = sumFaces(mesh, all, periodic);
  const auto velocityOf = [&](const Candidate& node) {
    return node.discBody >= 0
               ? bodies.motions[node.discBody].velocity(mesh.coordinates[node.slave.node])
               : all.obstacles[node.interface].velocity;
  };
  double fastest = 0;
  for (const auto& node : candidates) fastest = std::max(fastest, mesh::length(velocityOf(node)));
  fastest = mpi::max(mesh.comm, fastest);
  const ReadArray normal(sums.normal), area(sums.area);
  for (const auto& candidate : candidates) {
    const auto& slave = candidate.slave;
    const auto& options = all.options[candidate.interface];
    const PetscInt own = layers.of(candidate, all);
    const bool paired = all.reports[candidate.interface].matching;
    ContactNode node{};
    node.position = mesh.coordinates[slave.node];
    node.node = own, node.globalNode = mesh.firstNode + own;
    node.surfaceNode = slave.node;
    node.master = candidate.partner, node.interface = candidate.interface;
    node.role = options.role, node.separates = options.separates;
    node.side = all.slaves[candidate.interface].sign;
    node.discBody = candidate.discBody;
    node.wholeArea = paired ? area[mesh.dimension * (slave.node + 1) - 1] : slave.wholeArea;
    node.area = paired ? node.wholeArea : slave.area;
    node.gap = options.gapIsMeasured ? slave.gap : options.gap;
    node.masterParts = slave.masterParts;
    for (int d = 0; d < mesh.dimension; ++d)
      node.normal[d] = normal[mesh.dimension * slave.node + d];
    node.normal = mesh::unit(node.normal);
    setSlip(velocityOf(candidate), fastest, node);
    all.nodes.push_back(std::move(node));
    all.connections.push_back(connectionOf(slave));
    all.connections.back().node = own;
  }
}

std::vector<int> interfacesOf(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                              const std::vector<Candidate>& touching) {
  std::vector<double> numbers(mesh.localNodes(), 0.0);
  for (const auto& node : touching) numbers[node.slave.node] = node.interface + 1;
  exchange.largest(numbers);
  std::vector<int> found;
  for (double number : numbers) found.push_back(std::lround(number) - 1);
  return found;
}

/// Collective. Sets the layers with a gap, and moves the gap basis to their nodes.
void moveToLayers(const mesh::Mesh& mesh, Mat periodic, Interfaces& all) {
  all.layers = layersInContact(mesh, all, periodic);
  all.layerExchange = layerExchange(mesh, all);
  if (!all.layerExchange || !all.gapBasis) return;
  for (OwnedMat* basis : {&all.gapBasis.matrix, &all.gapBasis.inverse})
    *basis = product(product(all.layerExchange, *basis), all.layerExchange);
}

/// Collective. Counts the nodes of each interface in contact.
void countNodes(MPI_Comm comm, Interfaces& all) {
  for (const auto& node : all.nodes) ++all.reports[node.interface].nodes;
  for (std::size_t i = 0; i < all.reports.size(); ++i) {
    if (all.options[i].isTied()) continue;
    PetscInt& count = all.reports[i].nodes;
    count = mpi::sum(comm, count);
    all.totalNodes += count;
  }
}

}  // namespace

bool Interfaces::slideTogether(int one, int other) const {
  const InterfaceSettings &a = options[one], &b = options[other];
  return a.role == Role::sliding && b.role == Role::sliding && !a.onObstacle() && !b.onObstacle() &&
         a.surfaces.disc.name == b.surfaces.disc.name &&
         a.surfaces.pad.name != b.surfaces.pad.name && slaves[one].sign == slaves[other].sign;
}

bool Interfaces::hasGapOn(const std::string& surface, PetscInt node) const {
  const int own = interfaceOf[node];
  if (own < 0) return false;
  if (slaves[own].surface == surface) return true;
  for (int i = 0; i < std::ssize(slaves); ++i)
    if (slaves[i].surface == surface && slideTogether(own, i)) return true;
  return false;
}

const SlaveSide* Interfaces::slaveOf(const std::string& surface) const {
  for (std::size_t i = 0; i < slaves.size(); ++i)
    if (!options[i].isTied() && slaves[i].surface == surface) return &slaves[i];
  return nullptr;
}

std::vector<std::string> Interfaces::labels(const std::vector<int>& marks) const {
  std::vector<std::string> found;
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (marks[i]) found.push_back(options[i].label());
  return found;
}

std::string describe(const Interfaces& all, int interface) {
  const InterfaceSettings& options = all.options[interface];
  const InterfaceReport& report = all.reports[interface];
  const std::string &slave = all.slaves[interface].surface,
                    &master = slave == options.surfaces.pad.name ? options.surfaces.disc.name
                                                                 : options.surfaces.pad.name;
  std::string line = options.label() + " " + text(options.role);
  if (options.onObstacle())
    line += formatted(": %" PetscInt_FMT " nodes on a rigid obstacle", report.nodes);
  else if (report.matching)
    line += formatted(": %" PetscInt_FMT " nodes, node on node", report.nodes);
  else
    line += formatted(": %" PetscInt_FMT " nodes of '%s', mortar on %" PetscInt_FMT
                      " faces of '%s'; %.4g %% of the area of the %" PetscInt_FMT
                      " faces of '%s' is covered, surfaces up to %.2g m apart",
                      report.nodes, slave.c_str(), report.master.nearFaces, master.c_str(),
                      100 * report.coveredArea / report.slave.area, report.slave.faces,
                      slave.c_str(), report.largestGap);
  if (options.isTied())
    line += formatted("; %.4g m2 are tied, %" PetscInt_FMT " nodes are not", report.coveredArea,
                      report.untied);
  else if (report.dropped > 0)
    line +=
        formatted("; %" PetscInt_FMT " nodes at the edge of the overlap have no contact condition",
                  report.dropped);
  if (report.bonded > 0)
    line += formatted("; %" PetscInt_FMT " more are bonded to it by a tie", report.bonded);
  if (options.layerStiffness > 0)
    line += formatted("; with a soft layer of %.4g N/m3", options.layerStiffness);
  if (!options.separates) line += "; they do not separate";
  if (report.carried > 0)
    line += formatted("; %" PetscInt_FMT " held components of tied nodes are held on the master",
                      report.carried);
  if (options.adjust)
    line += formatted("; nodes were moved by up to %.2g m", report.largestAdjustment);
  if (report.nearlyMatching) line += "; not node on node: " + report.whyNot;
  return line;
}

Interfaces findNodes(const mesh::Mesh& mesh, const elasticity::Bodies& bodies, Mat periodic,
                     Interfaces ties) {
  Interfaces all = std::move(ties);
  const coupling::NodeExchange exchange(mesh);
  Claims claims(mesh, exchange);
  std::vector<std::vector<PetscInt>> tied(all.options.size());
  for (const auto& node : all.tied) tied[node.interface].push_back(node.connection.node);
  for (int i = 0; i < std::ssize(all.options); ++i)
    if (all.options[i].isTied()) claims.add(tied[i], all.options, i);
  std::vector<Candidate> touching;
  for (const bool sliding : {true, false})
    for (int i = 0; i < std::ssize(all.options); ++i) {
      const Role role = all.options[i].role;
      if (role == Role::tied || (role == Role::sliding) != sliding) continue;
      auto found = candidatesOf(mesh, exchange, &bodies, i, claims.against(role, i, all), all);
      claims.add(nodesOf(found), all.options, i);
      std::move(found.begin(), found.end(), std::back_inserter(touching));
    }
  const GapBearers layers(mesh);
  const auto before = [&](const Candidate& a, const Candidate& b) {
    return layers.of(a, all) < layers.of(b, all);
  };
  std::stable_sort(touching.begin(), touching.end(), before);
  std::vector<CombinedGap> given;
  std::vector<std::string> paired;
  for (const auto& node : touching)
    if (!all.reports[node.interface].matching)
      given.push_back({node.slave.node, node.slave.jumps, node.slave.jumpsOf});
  for (std::size_t i = 0; i < all.options.size(); ++i)
    if (all.reports[i].matching && !all.options[i].isTied())
      paired.push_back(all.slaves[i].surface);
  all.interfaceOf = interfacesOf(mesh, exchange, touching);
  all.gapBasis = gapBasis(mesh, paired, all.interfaceOf, given, periodic);
  fillNodes(mesh, bodies, touching, layers, periodic, all);
  moveToLayers(mesh, periodic, all);
  countNodes(mesh.comm, all);
  checkCrossing(mesh, exchange, bodies, all);
  rejectTwoMasters(mesh, all);
  setLevels(mesh, all);
  warnOfLost(mesh, exchange, all, Role::sliding);
  solveEquations(mesh, all);
  return all;
}

}  // namespace squeal::interfaces
