#include "contact/nodes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "contact/algebra.hpp"
#include "elasticity/face.hpp"
#include "elasticity/shape.hpp"
#include "petsc/arrays.hpp"
#include "petsc/text.hpp"

namespace squeal::contact {
namespace {

/// A contact node as its interface gives it.
struct Candidate {
  int interface;
  int discBody;      // index into Mesh::bodies; −1 on a rigid obstacle
  PetscInt partner;  // global node of the master where the meshes match, otherwise −1
  coupling::SlaveNode slave;
};

std::string optionsOf(const InterfaceOptions& interface) {
  return "options " + interface.surfaces.pad.option + ", " + interface.surfaces.disc.option + ": ";
}

std::vector<Candidate> pairedNodes(const mesh::Mesh& mesh) {
  std::vector<Candidate> found;
  for (const auto& pair : mesh.pairs) {
    Candidate node{pair.interface, pair.masterBody, pair.master, {}};
    node.slave.node = pair.node;
    node.slave.masterBody = pair.masterBody;
    if (pair.master >= 0) {
      node.slave.masters = {{pair.master, 1}};
      node.slave.partShare.resize(mesh.parts);
      node.slave.partShare[pair.masterPart] = 1;
    }
    found.push_back(std::move(node));
  }
  return found;
}

/// Returns the body of each local node, one of them where several meet.
std::vector<int> bodyOfNode(const mesh::Mesh& mesh) {
  std::vector<int> body(mesh.localNodes(), -1);
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.body.size(); ++e)
      for (PetscInt node : block.nodesOf(e)) body[node] = block.body[e];
  return body;
}

/// Collective. Couples the two sides of an interface whose meshes do not match.
std::vector<Candidate> coupledNodes(const elasticity::Bodies& bodies, int index,
                                    const InterfaceOptions& options, Contact& contact) {
  const mesh::Mesh& mesh = *contact.mesh;
  const std::string &pad = options.surfaces.pad.name, &disc = options.surfaces.disc.name;
  const coupling::Interface padIsSlave{pad, disc, options.searchDistance};
  const bool discIsSlave =
      options.slave == SlaveChoice::disc ||
      (options.slave == SlaveChoice::finer && coupling::masterIsFiner(mesh, padIsSlave));
  coupling::BodyVelocity velocity;
  if (elasticity::convectiveTerms() && !discIsSlave)
    velocity = [&](int body, const Point& x) { return bodies.motions[body].velocity(x); };
  auto coupled = coupling::couple(
      mesh, discIsSlave ? coupling::Interface{disc, pad, options.searchDistance} : padIsSlave,
      velocity);
  PetscInt count = coupled.nodes.size();
  check(MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPIU_INT, MPI_SUM, mesh.comm));
  if (count == 0)
    throw Error(optionsOf(options) + "no part of '" + pad + "' faces a part of '" + disc +
                "' within " + searchName(options.surfaces.name) +
                (options.searchDistance > 0 ? formatted(" %g m", options.searchDistance)
                                            : std::string(", half the size of a face")));
  InterfaceReport& report = contact.reports[index];
  report.matching = false;
  report.whyNot = mesh.mismatch[index];
  report.slave = coupled.slave, report.master = coupled.master;
  report.coveredArea = coupled.coveredArea, report.largestGap = coupled.largestGap;
  report.droppedNodes = coupled.droppedNodes;
  contact.slaves[index] = {discIsSlave ? disc : pad, discIsSlave ? -1 : 1};
  const auto body = bodyOfNode(mesh);
  std::vector<Candidate> found;
  for (auto& slave : coupled.nodes) {
    const int discBody = discIsSlave ? body[slave.node] : slave.masterBody;
    found.push_back({index, discBody, -1, std::move(slave)});
  }
  return found;
}

/// A FaceSums holds the sums over the slave faces at each node: area-weighted normals (from disc to
/// pad) and ∫ φ̃ dA. The sums of images are added to those of their primaries.
struct FaceSums {
  OwnedVec normal, area;  // nodal vectors; the area stands in the component of the gap
};

FaceSums sumFaces(const mesh::Mesh& mesh, const Contact& contact) {
  FaceSums local{elasticity::nodalVector(mesh), elasticity::nodalVector(mesh)},
      sums{elasticity::nodalVector(mesh), elasticity::nodalVector(mesh)};
  for (const auto& block : mesh.faces) {
    const auto& table = elasticity::shapeTable(block.type);
    for (std::size_t e = 0; e < block.surface.size(); ++e) {
      const SlaveSide* slave = contact.slaveOf(mesh.surfaces[block.surface[e]]);
      if (!slave) continue;
      std::vector<Point> points;
      const auto nodes = block.nodesOf(e);
      for (PetscInt node : nodes) points.push_back(mesh.coordinates[node]);
      const auto faceMass = elasticity::faceMass(table, points);
      const auto normals = elasticity::nodeNormals(table, points, -slave->sign * block.sign[e]);
      const double faceArea = std::accumulate(faceMass.begin(), faceMass.end(), 0.0);
      for (int i = 0; i < block.nodesPerFace; ++i) {
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
  check(MatMultTranspose(contact.periodic, local.normal, sums.normal));
  check(MatMultTranspose(contact.periodic, local.area, sums.area));
  if (contact.gapBasis) {
    //   ∫ φ̃ dA = Eᵀ ∫ φ dA
    check(MatMultTranspose(contact.gapBasis.matrix, sums.area, local.area));
    check(VecCopy(local.area, sums.area));
  }
  return sums;
}

/// Throws Error if two interfaces claim one node.
void rejectSharedNodes(const std::vector<Candidate>& nodes,
                       const std::vector<InterfaceOptions>& interfaces, const mesh::Mesh& mesh) {
  std::string failure;
  for (std::size_t i = 1; i < nodes.size() && failure.empty(); ++i)
    if (nodes[i].slave.node == nodes[i - 1].slave.node)
      failure = "interfaces '" + interfaces[nodes[i - 1].interface].surfaces.name + "' and '" +
                interfaces[nodes[i].interface].surfaces.name + "' both claim the node at " +
                text(mesh.coordinates[nodes[i].slave.node]) + " for a gap; a node has one gap";
  failTogether(mesh.comm, failure);
}

/// Throws Error if a node of the master of one interface is a slave of another: its displacement
/// would follow from others that follow from it.
void rejectChains(const std::vector<Candidate>& nodes,
                  const std::vector<InterfaceOptions>& interfaces, const mesh::Mesh& mesh) {
  OwnedMat masters;
  OwnedVec slaves, found;
  check(MatCreateAIJ(mesh.comm, mesh.ownedNodes, mesh.ownedNodes, PETSC_DETERMINE, PETSC_DETERMINE,
                     8, nullptr, 8, nullptr, masters.out()));
  check(MatSetOption(masters, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  check(MatCreateVecs(masters, slaves.out(), found.out()));
  for (const auto& node : nodes) {
    const PetscInt row = mesh.globalNode[node.slave.node];
    check(VecSetValue(slaves, row, 1, INSERT_VALUES));
    for (const auto& [column, weight] : node.slave.masters)
      check(MatSetValue(masters, row, column, 1, INSERT_VALUES));
  }
  assembled(masters);
  check(VecAssemblyBegin(slaves));
  check(VecAssemblyEnd(slaves));
  check(MatMult(masters, slaves, found));
  std::string failure;
  const ReadArray counts(found);
  for (const auto& node : nodes)
    if (counts[node.slave.node] > 0 && failure.empty())
      failure = "interface '" + interfaces[node.interface].surfaces.name + "': the node at " +
                text(mesh.coordinates[node.slave.node]) +
                " rests on a node that is itself a slave of an interface";
  failTogether(mesh.comm, failure);
}

/// Returns w = −V in the tangent plane [2.15] as direction and speed.
void setSlip(const Point& velocity, double fastest, ContactNode& node) {
  const double along = dot(velocity, node.normal);
  Point w{};
  for (std::size_t d = 0; d < 3; ++d) w[d] = -(velocity[d] - along * node.normal[d]);
  node.slipSpeed = std::sqrt(dot(w, w));
  // On the axis of a rotation, and where the velocity is normal to the contact, w is only rounding;
  // gmsh places nodes to 1e-11.
  if (node.slipSpeed > 1e-9 * fastest)
    node.slip = scaled(w, 1 / node.slipSpeed);
  else
    node.slipSpeed = 0;
}

/// Collective. Fills Contact::nodes.
void fillNodes(const elasticity::Bodies& bodies, const std::vector<InterfaceOptions>& interfaces,
               const std::vector<Candidate>& candidates, Contact& contact) {
  const mesh::Mesh& mesh = *contact.mesh;
  const FaceSums sums = sumFaces(mesh, contact);
  const auto velocityOf = [&](const Candidate& node) {
    return node.discBody >= 0
               ? bodies.motions[node.discBody].velocity(mesh.coordinates[node.slave.node])
               : interfaces[node.interface].obstacleVelocity;
  };
  double fastest = 0;
  for (const auto& node : candidates)
    fastest = std::max(fastest, std::sqrt(dot(velocityOf(node), velocityOf(node))));
  check(MPI_Allreduce(MPI_IN_PLACE, &fastest, 1, MPI_DOUBLE, MPI_MAX, mesh.comm));
  const ReadArray normal(sums.normal), area(sums.area);
  for (const auto& candidate : candidates) {
    const auto& slave = candidate.slave;
    ContactNode node{};
    node.position = mesh.coordinates[slave.node];
    node.node = slave.node, node.globalNode = mesh.firstNode + slave.node;
    node.master = candidate.partner, node.interface = candidate.interface;
    node.side = contact.slaves[candidate.interface].sign;
    node.discBody = candidate.discBody;
    const bool paired = contact.reports[candidate.interface].matching;
    node.wholeArea = area[mesh.dimension * (slave.node + 1) - 1];
    node.area = paired ? node.wholeArea : slave.area;
    if (!paired) node.wholeArea = slave.wholeArea;
    for (int part = 0; part < std::ssize(slave.partShare); ++part)
      if (slave.partShare[part] != 0) node.masterParts.push_back({part, slave.partShare[part]});
    for (int d = 0; d < mesh.dimension; ++d)
      node.normal[d] = normal[mesh.dimension * slave.node + d];
    node.normal = scaled(node.normal, 1 / std::sqrt(dot(node.normal, node.normal)));
    setSlip(velocityOf(candidate), fastest, node);
    contact.nodes.push_back(std::move(node));
  }
  for (const auto& node : contact.nodes) ++contact.reports[node.interface].nodes;
  for (auto& report : contact.reports) {
    check(MPI_Allreduce(MPI_IN_PLACE, &report.nodes, 1, MPIU_INT, MPI_SUM, mesh.comm));
    contact.totalNodes += report.nodes;
  }
}

}  // namespace

std::vector<PetscInt> blocksOfRows(const Contact& contact,
                                   const std::vector<Connection>& connections) {
  std::vector<PetscInt> blocks(contact.mesh->ownedNodes, 1);
  for (std::size_t k = 0; k < connections.size(); ++k)
    blocks[contact.nodes[k].node] += connections[k].masters.size();
  return blocks;
}

std::vector<Connection> findNodes(const elasticity::Bodies& bodies,
                                  const std::vector<InterfaceOptions>& interfaces,
                                  Contact& contact) {
  const mesh::Mesh& mesh = *contact.mesh;
  std::vector<Candidate> nodes = pairedNodes(mesh);
  for (const auto& interface : interfaces) {
    contact.slaves.push_back({interface.surfaces.pad.name, 1});
    contact.reports.emplace_back();
  }
  for (int i = 0; i < std::ssize(interfaces); ++i)
    if (!mesh.matching[i])
      for (auto& node : coupledNodes(bodies, i, interfaces[i], contact))
        nodes.push_back(std::move(node));
  std::stable_sort(nodes.begin(), nodes.end(),
                   [](const auto& a, const auto& b) { return a.slave.node < b.slave.node; });
  rejectSharedNodes(nodes, interfaces, mesh);
  rejectChains(nodes, interfaces, mesh);
  std::vector<Connection> connections;
  for (const auto& node : nodes) {
    const auto& slave = node.slave;
    connections.push_back({slave.masters, slave.jumps, slave.jumpsOf, slave.convected});
  }
  std::vector<CombinedGap> combined;
  for (const auto& node : nodes)
    if (!contact.reports[node.interface].matching)
      combined.push_back({node.slave.node, node.slave.jumps, node.slave.jumpsOf});
  std::vector<std::string> paired;
  for (std::size_t i = 0; i < interfaces.size(); ++i)
    if (contact.reports[i].matching) paired.push_back(contact.slaves[i].surface);
  contact.gapBasis = gapBasis(mesh, paired, combined, contact.periodic);
  fillNodes(bodies, interfaces, nodes, contact);
  return connections;
}

}  // namespace squeal::contact
