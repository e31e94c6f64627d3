#include "interfaces/nodes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "coupling/exchange.hpp"
#include "elasticity/face.hpp"
#include "elasticity/shape.hpp"
#include "interfaces/algebra.hpp"
#include "interfaces/chains.hpp"
#include "mesh/vector.hpp"
#include "petsc/arrays.hpp"
#include "petsc/text.hpp"

namespace squeal::interfaces {
namespace {

/// A node as its interface gives it.
struct Candidate {
  int interface;
  int discBody;      // index into Mesh::bodies; −1 on a rigid obstacle
  PetscInt partner;  // global node of the master where the meshes match, otherwise −1
  coupling::SlaveNode slave;
};

std::string optionsOf(const InterfaceOptions& interface) {
  return "options " + interface.surfaces.pad.option + ", " + interface.surfaces.disc.option + ": ";
}

std::vector<Candidate> pairedNodes(const mesh::Mesh& mesh, int interface,
                                   const std::vector<unsigned char>& excluded) {
  std::vector<Candidate> found;
  for (const auto& pair : mesh.pairs) {
    if (pair.interface != interface || excluded[pair.node]) continue;
    Candidate node{pair.interface, pair.masterBody, pair.master, {}};
    node.slave.node = pair.node;
    if (pair.master >= 0) {
      node.slave.masters = {{pair.master, 1}};
      node.slave.masterParts = {{pair.masterPart, 1}};
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
std::vector<Candidate> coupledNodes(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                                    const elasticity::Bodies& bodies, int index,
                                    const std::vector<unsigned char>& excluded, Interfaces& all) {
  const InterfaceOptions& options = all.options[index];
  const std::string &pad = options.surfaces.pad.name, &disc = options.surfaces.disc.name;
  const coupling::Interface padIsSlave{pad, disc, options.searchDistance};
  const bool discIsSlave =
      options.slave == SlaveChoice::disc ||
      (options.slave == SlaveChoice::finer && coupling::masterIsFiner(mesh, padIsSlave));
  coupling::BodyVelocity velocity;
  if (elasticity::convectiveTerms() && !discIsSlave && options.role == Role::sliding)
    velocity = [&](int body, const Point& x) { return bodies.motions[body].velocity(x); };
  auto coupled = coupling::couple(
      mesh, exchange,
      discIsSlave ? coupling::Interface{disc, pad, options.searchDistance} : padIsSlave, velocity,
      excluded);
  PetscInt count = coupled.nodes.size();
  check(MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPIU_INT, MPI_SUM, mesh.comm));
  if (count == 0)
    throw Error(optionsOf(options) + "no part of '" + pad + "' faces a part of '" + disc +
                "' within " + searchName(options) +
                (options.searchDistance > 0 ? formatted(" %g m", options.searchDistance)
                                            : std::string(", half the size of a face")));
  InterfaceReport& report = all.reports[index];
  report.matching = false;
  report.whyNot = mesh.mismatch[index];
  report.slave = coupled.slave, report.master = coupled.master;
  report.coveredArea = coupled.coveredArea, report.largestGap = coupled.largestGap;
  report.dropped = coupled.droppedNodes;
  all.slaves[index] = {discIsSlave ? disc : pad, discIsSlave ? -1 : 1};
  const auto body = discIsSlave ? bodyOfNode(mesh) : std::vector<int>{};
  std::vector<Candidate> found;
  for (auto& slave : coupled.nodes) {
    const int discBody = discIsSlave ? body[slave.node] : slave.masterBody;
    found.push_back({index, discBody, -1, std::move(slave)});
  }
  return found;
}

/// The claims on nodes, [local node]: one more than the index of the interface, 0 for none.
class Claims {
 public:
  /// Collective. Clamped nodes are claimed against ties. The exchange is borrowed.
  Claims(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
         const Constraints& constraints)
      : mesh_(mesh),
        exchange_(exchange),
        clamped_(mesh.localNodes(), 0),
        tied_(clamped_),
        sliding_(clamped_),
        other_(clamped_) {
    for (PetscInt i = 0; i < std::ssize(constraints.held); ++i)
      if (constraints.held[i]) clamped_[i / mesh.dimension] = 1;
    share(clamped_);
  }
  /// Returns the nodes that an interface of this role must leave to others.
  std::vector<unsigned char> against(Role role) const {
    std::vector<unsigned char> excluded(tied_.size(), 0);
    for (std::size_t i = 0; i < excluded.size(); ++i) {
      const bool isLast = role == Role::sticking || role == Role::frictionless;
      excluded[i] =
          tied_[i] || (role == Role::tied && clamped_[i]) || (isLast && (sliding_[i] || other_[i]));
    }
    return excluded;
  }
  /// Collective. Claims the nodes. Throws Error if one of them slides on another interface.
  void add(const std::vector<Candidate>& nodes, const std::vector<InterfaceOptions>& options,
           int interface) {
    const Role role = options[interface].role;
    std::string failure;
    auto& claimed = role == Role::tied ? tied_ : role == Role::sliding ? sliding_ : other_;
    for (const auto& node : nodes) {
      const int before = claimed[node.slave.node] - 1;
      if (role == Role::sliding && before >= 0)
        failure = "interfaces '" + options[before].surfaces.name + "' and '" +
                  options[interface].surfaces.name + "' both claim the node at " +
                  text(mesh_.coordinates[node.slave.node]) + " for sliding; a node has one gap";
      claimed[node.slave.node] = interface + 1;
    }
    failTogether(mesh_.comm, failure);
    share(claimed);
  }

 private:
  void share(std::vector<int>& claims) const {
    std::vector<double> values(claims.begin(), claims.end());
    exchange_.largest(values);
    for (std::size_t i = 0; i < claims.size(); ++i) claims[i] = std::lround(values[i]);
  }
  const mesh::Mesh& mesh_;
  const coupling::NodeExchange& exchange_;
  std::vector<int> clamped_;  // 1 for a clamped node
  std::vector<int> tied_, sliding_, other_;
};

/// Returns the interfaces in the order in which they claim nodes.
std::vector<int> orderOfClaims(const std::vector<InterfaceOptions>& options) {
  std::vector<int> order(options.size());
  std::iota(order.begin(), order.end(), 0);
  const auto rank = [&](int i) {
    return options[i].isTied() ? 0 : options[i].role == Role::sliding ? 1 : 2;
  };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return rank(a) < rank(b); });
  return order;
}

/// A FaceSums holds the sums over the slave faces at each node: area-weighted normals (from disc to
/// pad) and ∫ φ̃ dA. The sums of images are added to those of their primaries.
struct FaceSums {
  OwnedVec normal, area;  // nodal vectors; the area stands in the component of the gap
};

FaceSums sumFaces(const mesh::Mesh& mesh, const Interfaces& all, Mat periodic) {
  FaceSums local{elasticity::nodalVector(mesh), elasticity::nodalVector(mesh)},
      sums{elasticity::nodalVector(mesh), elasticity::nodalVector(mesh)};
  for (const auto& block : mesh.faces) {
    const auto& table = elasticity::shapeTable(block.type);
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
  // On the axis of a rotation, and where the velocity is normal to the contact, w is only rounding;
  // gmsh places nodes to 1e-11.
  if (node.slipSpeed > 1e-9 * fastest)
    node.slip = mesh::scaled(w, 1 / node.slipSpeed);
  else
    node.slipSpeed = 0;
}

Connection connectionOf(const coupling::SlaveNode& slave) {
  return {slave.node, 1, slave.masters, slave.convected};
}

/// Collective. Fills Interfaces::nodes.
void fillNodes(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
               const std::vector<Candidate>& candidates, Mat periodic, Interfaces& all) {
  const FaceSums sums = sumFaces(mesh, all, periodic);
  const auto velocityOf = [&](const Candidate& node) {
    return node.discBody >= 0
               ? bodies.motions[node.discBody].velocity(mesh.coordinates[node.slave.node])
               : all.options[node.interface].obstacleVelocity;
  };
  double fastest = 0;
  for (const auto& node : candidates) fastest = std::max(fastest, mesh::length(velocityOf(node)));
  check(MPI_Allreduce(MPI_IN_PLACE, &fastest, 1, MPI_DOUBLE, MPI_MAX, mesh.comm));
  const ReadArray normal(sums.normal), area(sums.area);
  for (const auto& candidate : candidates) {
    const auto& slave = candidate.slave;
    const auto& options = all.options[candidate.interface];
    const bool paired = all.reports[candidate.interface].matching;
    ContactNode node{};
    node.position = mesh.coordinates[slave.node];
    node.node = slave.node, node.globalNode = mesh.firstNode + slave.node;
    node.master = candidate.partner, node.interface = candidate.interface;
    node.role = options.role;
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
  }
}

/// Collective. Returns Interfaces::interfaceOf.
std::vector<int> interfacesOf(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                              const std::vector<Candidate>& touching) {
  std::vector<double> numbers(mesh.localNodes(), 0.0);
  for (const auto& node : touching) numbers[node.slave.node] = node.interface + 1;
  exchange.largest(numbers);
  std::vector<int> found;
  for (double number : numbers) found.push_back(std::lround(number) - 1);
  return found;
}

/// Collective. Adds up the nodes of each interface.
void countNodes(MPI_Comm comm, Interfaces& all) {
  for (const auto& node : all.nodes) ++all.reports[node.interface].nodes;
  for (const auto& node : all.tied) ++all.reports[node.interface].nodes;
  for (std::size_t i = 0; i < all.reports.size(); ++i) {
    PetscInt& count = all.reports[i].nodes;
    check(MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPIU_INT, MPI_SUM, comm));
    if (!all.options[i].isTied()) all.totalNodes += count;
  }
}

}  // namespace

const SlaveSide* Interfaces::slaveOf(const std::string& surface) const {
  for (std::size_t i = 0; i < slaves.size(); ++i)
    if (!options[i].isTied() && slaves[i].surface == surface) return &slaves[i];
  return nullptr;
}

std::string describe(const Interfaces& all, int interface) {
  const InterfaceOptions& options = all.options[interface];
  const InterfaceReport& report = all.reports[interface];
  std::string line = options.label() + " " + text(options.role);
  if (options.onObstacle())
    line += formatted(": %" PetscInt_FMT " nodes on a rigid obstacle", report.nodes);
  else if (report.matching)
    line += formatted(": %" PetscInt_FMT " nodes, node on node", report.nodes);
  else
    line += formatted(
        ": %" PetscInt_FMT " nodes of '%s', mortar on %" PetscInt_FMT
        " faces; %.4g %% of its %" PetscInt_FMT " faces is covered, surfaces up to %.2g m apart",
        report.nodes, all.slaves[interface].surface.c_str(), report.master.nearFaces,
        100 * report.coveredArea / report.slave.area, report.slave.faces, report.largestGap);
  if (report.dropped > 0)
    line += formatted("; %" PetscInt_FMT " nodes at its rim carry no condition", report.dropped);
  return line;
}

Interfaces findNodes(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                     const Constraints& constraints, Mat periodic) {
  Interfaces all;
  all.options = readInterfaceOptions(mesh.dimension);
  for (const auto& interface : all.options) {
    all.slaves.push_back({interface.surfaces.pad.name, 1});
    all.reports.emplace_back();
  }
  const coupling::NodeExchange exchange(mesh);
  Claims claims(mesh, exchange, constraints);
  std::vector<Candidate> touching;
  for (int i : orderOfClaims(all.options)) {
    const auto excluded = claims.against(all.options[i].role);
    auto found = mesh.matching[i] ? pairedNodes(mesh, i, excluded)
                                  : coupledNodes(mesh, exchange, bodies, i, excluded, all);
    claims.add(found, all.options, i);
    for (auto& node : found) {
      if (all.options[i].isTied())
        all.tied.push_back({i, connectionOf(node.slave), node.slave.masterParts});
      else
        touching.push_back(std::move(node));
    }
  }
  const auto before = [](const auto& a, const auto& b) { return a.slave.node < b.slave.node; };
  std::stable_sort(touching.begin(), touching.end(), before);
  std::stable_sort(all.tied.begin(), all.tied.end(), [](const auto& a, const auto& b) {
    return a.connection.node < b.connection.node;
  });
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
  fillNodes(mesh, bodies, touching, periodic, all);
  countNodes(mesh.comm, all);
  setLevels(mesh, all);
  return all;
}

}  // namespace squeal::interfaces
