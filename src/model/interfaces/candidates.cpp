// SPDX-License-Identifier: BSD-2-Clause
#include "model/interfaces/candidates.hpp"

#include <algorithm>
#include <cmath>

#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/elasticity/face.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/mortar/face.hpp"

namespace squeal::interfaces {
namespace {

std::string optionsOf(const InterfaceSettings& interface) {
  return "options " + interface.surfaces.pad.option + ", " + interface.surfaces.disc.option + ": ";
}

std::vector<Candidate> pairedNodes(const mesh::Mesh& mesh, int interface,
                                   const std::vector<unsigned char>& excluded, Interfaces& all) {
  std::vector<Candidate> found;
  for (const auto& pair : mesh.pairs) {
    if (pair.interface != interface) continue;
    if (excluded[pair.node]) {
      all.lost.push_back({interface, pair.node});
      continue;
    }
    Candidate node{pair.interface, pair.masterBody, pair.master, {}};
    node.slave.node = pair.node;
    if (pair.master >= 0) {
      node.slave.masters = {{pair.master, 1}};
      node.slave.offset = pair.offset;
      node.slave.masterParts = {{pair.masterPart, 1}};
    }
    found.push_back(std::move(node));
  }
  return found;
}

/// Returns the body of each local node, any one if several meet there.
std::vector<int> bodyOfNode(const mesh::Mesh& mesh) {
  std::vector<int> body(mesh.localNodes(), -1);
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.body.size(); ++e)
      for (PetscInt node : block.nodesOf(e)) body[node] = block.body[e];
  return body;
}

/// Collective. Returns the labels of the ties that have nodes of this surface.
std::string earlierOwners(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                          const Interfaces& all, const std::string& surface) {
  const auto nodes = slaveNodesOf(mesh, exchange, surface);
  std::vector<int> owns(all.options.size(), 0);
  for (const auto& tied : all.tied)
    if (std::ranges::binary_search(nodes, tied.connection.node)) owns[tied.interface] = 1;
  mpi::reduce<int>(mesh.comm, owns, MPI_MAX);
  const auto labels = all.labels(owns);
  return labels.empty() ? "interfaces that come first" : joined(labels, " and ");
}

/// Collective. Couples the two sides of an interface whose meshes do not match.
std::vector<Candidate> coupledNodes(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                                    const elasticity::Bodies* bodies, int index,
                                    const std::vector<unsigned char>& excluded, Interfaces& all) {
  const InterfaceSettings& options = all.options[index];
  const std::string &pad = options.surfaces.pad.name, &disc = options.surfaces.disc.name;
  const bool discIsSlave = slaveSurface(mesh, options) != pad;
  coupling::BodyVelocity velocity;
  if (bodies && bodies->settings.convective && !discIsSlave && options.role == Role::sliding)
    velocity = [&](int body, const Point& x) { return bodies->motions[body].velocity(x); };
  auto coupled =
      coupling::couple(mesh, exchange,
                       discIsSlave ? coupling::Interface{disc, pad, options.searchDistance}
                                   : coupling::Interface{pad, disc, options.searchDistance},
                       velocity, excluded);
  PetscInt count = coupled.nodes.size();
  count = mpi::sum(mesh.comm, count);
  if (count == 0 && coupled.coveredArea > 0)
    throw Error(optionsOf(options) + "all nodes of '" + (discIsSlave ? disc : pad) +
                "' on the other side belong to " +
                earlierOwners(mesh, exchange, all, discIsSlave ? disc : pad) +
                (options.isTie() ? "; exchange slave and master, or remove one of the ties" : ""));
  if (count == 0)
    throw Error(optionsOf(options) + "no part of '" + pad + "' faces a part of '" + disc +
                "' within " + searchText(options));
  InterfaceReport& report = all.reports[index];
  report.matching = false;
  report.whyNot = mesh.interfaces[index].mismatch;
  report.nearlyMatching = mesh.interfaces[index].nearlyMatching;
  report.slave = coupled.slave, report.master = coupled.master;
  report.coveredArea = coupled.coveredArea, report.largestGap = coupled.largestGap;
  report.dropped = coupled.droppedNodes;
  for (const PetscInt node : coupled.excluded) all.lost.push_back({index, node});
  all.slaves[index] = {discIsSlave ? disc : pad, discIsSlave ? -1 : 1};
  const auto body = discIsSlave ? bodyOfNode(mesh) : std::vector<int>{};
  std::vector<Candidate> found;
  for (auto& slave : coupled.nodes) {
    const int discBody = discIsSlave ? body[slave.node] : slave.masterBody;
    found.push_back({index, discBody, -1, std::move(slave)});
  }
  return found;
}

}  // namespace

std::string slaveSurface(const mesh::Mesh& mesh, const InterfaceSettings& options) {
  const std::string &pad = options.surfaces.pad.name, &disc = options.surfaces.disc.name;
  const bool discIsSlave =
      options.slave == SlaveChoice::disc ||
      (options.slave == SlaveChoice::finer &&
       coupling::masterIsFiner(mesh, coupling::Interface{pad, disc, options.searchDistance}));
  return discIsSlave ? disc : pad;
}

std::vector<PetscInt> slaveNodesOf(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                                   const std::string& surface) {
  std::vector<double> isSlave(mesh.localNodes(), 0.0);
  for (const auto& face : mortar::facesOf(mesh, surface))
    for (const PetscInt node : face.nodes) isSlave[exchange.local(node)] = 1;
  exchange.largest(isSlave);
  std::vector<PetscInt> nodes;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    if (isSlave[node] > 0 && exchange.primary(node) == mesh.globalNode[node]) nodes.push_back(node);
  return nodes;
}

Claims::Claims(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange)
    : mesh_(mesh),
      exchange_(exchange),
      tied_(mesh.localNodes(), 0),
      sliding_(tied_),
      other_(tied_) {}

std::vector<unsigned char> Claims::against(Role role, int interface, const Interfaces& all) const {
  std::vector<unsigned char> excluded(tied_.size(), 0);
  for (std::size_t i = 0; i < excluded.size(); ++i) {
    const bool isLast = role == Role::sticking || role == Role::frictionless;
    const bool isShared =
        role == Role::sliding && sliding_[i] > 0 && all.slideTogether(interface, sliding_[i] - 1);
    excluded[i] = tied_[i] || isShared || (isLast && (sliding_[i] || other_[i]));
  }
  return excluded;
}

void Claims::add(const std::vector<PetscInt>& nodes, const std::vector<InterfaceSettings>& options,
                 int interface) {
  const Role role = options[interface].role;
  std::string failure;
  auto& claimed = role == Role::tied ? tied_ : role == Role::sliding ? sliding_ : other_;
  for (PetscInt node : nodes) {
    const int before = claimed[node] - 1;
    if (role == Role::sliding && before >= 0)
      failure = "interfaces '" + options[before].surfaces.name + "' and '" +
                options[interface].surfaces.name + "' both contain the node at " +
                text(mesh_.coordinates[node]) +
                " as sliding; a node has only one gap: give both the same disc group, and " +
                slaveName(options[interface].surfaces.name) + " pad";
    claimed[node] = interface + 1;
  }
  failTogether(mesh_.comm, failure);
  share(claimed);
}

void Claims::share(std::vector<int>& claims) const {
  std::vector<double> values(claims.begin(), claims.end());
  exchange_.largest(values);
  for (std::size_t i = 0; i < claims.size(); ++i) claims[i] = std::lround(values[i]);
}

std::vector<Candidate> candidatesOf(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                                    const elasticity::Bodies* bodies, int interface,
                                    const std::vector<unsigned char>& excluded, Interfaces& all) {
  return mesh.interfaces[interface].matching
             ? pairedNodes(mesh, interface, excluded, all)
             : coupledNodes(mesh, exchange, bodies, interface, excluded, all);
}

std::vector<PetscInt> nodesOf(const std::vector<Candidate>& candidates) {
  std::vector<PetscInt> nodes;
  for (const auto& candidate : candidates) nodes.push_back(candidate.slave.node);
  return nodes;
}

Connection connectionOf(const coupling::SlaveNode& slave) {
  return {slave.node, 1, slave.masters, slave.convected};
}

}  // namespace squeal::interfaces
