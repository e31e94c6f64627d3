// SPDX-License-Identifier: BSD-2-Clause
#include "model/interfaces/lost.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/session/stages.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/mortar/basis.hpp"
#include "model/mortar/dual.hpp"
#include "model/mortar/face.hpp"

namespace squeal::interfaces {
namespace {

/// Collective. Returns the area of a surface at marked nodes, [local node], and the whole area.
std::array<double, 2> areasOf(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                              const std::string& surface, std::vector<double> marks) {
  exchange.largest(marks);
  std::array<double, 2> areas{};
  for (const auto& face : mortar::facesOf(mesh, surface)) {
    const auto& type = mortar::faceType(face.type);
    const std::vector<double> alpha(type.edges.size(),
                                    mortar::usualAlpha(type, mortar::Cover::full));
    const auto integrals = mortar::wholeIntegrals(face, alpha);
    for (std::size_t i = 0; i < integrals.size(); ++i) {
      areas[1] += integrals[i];
      if (marks[exchange.local(face.nodes[i])] > 0) areas[0] += integrals[i];
    }
  }
  mpi::reduce<double>(mesh.comm, areas, MPI_SUM);
  return areas;
}

/// The interfaces that own the lost nodes of this rank.
class Owners {
 public:
  /// Collective.
  Owners(const mesh::Mesh& mesh, const Interfaces& all) : mesh_(mesh), all_(all) {
    std::vector<Gap> gaps;
    for (const auto& node : all.nodes)
      gaps.push_back({mesh.firstNode + node.surfaceNode, node.interface});
    for (const auto& gap : concatenated(mesh.comm, gaps)) gaps_[gap.node] = gap.interface;
    for (const auto& tied : all.tied) tied_[tied.connection.node] = &tied;
    std::vector<Link> links;
    for (const auto& tied : all.tied)
      if (tied.connection.masters.size() == 1)
        links.push_back({mesh.firstNode + tied.connection.node, tied.connection.masters[0].node});
    for (const auto& link : concatenated(mesh.comm, links)) leader_[link.node] = link.leader;
    std::set<std::pair<int, int>> sides;  // interface and part, once each
    for (int i = 0; i < std::ssize(all.options); ++i)
      for (const auto* side : {&all.options[i].surfaces.pad, &all.options[i].surfaces.disc})
        if (side->name != all.slaves[i].surface && !side->name.empty())
          for (const auto& face : mortar::facesOf(mesh, side->name))
            for (const auto node : face.nodes)
              if (node >= mesh.firstNode && node < mesh.firstNode + mesh.ownedNodes)
                sides.insert({i, mesh.nodePart[node - mesh.firstNode]});
    std::vector<Side> own;
    for (const auto& [interface, part] : sides) own.push_back({interface, part});
    for (const auto& side : concatenated(mesh.comm, own)) parts_[side.interface].insert(side.part);
  }
  /// Returns the interface that has the node, −1 if none has.
  int of(PetscInt node) const {
    if (const auto found = tied_.find(node); found != tied_.end()) return found->second->interface;
    const auto found = gaps_.find(mesh_.firstNode + node);
    return found == gaps_.end() ? -1 : found->second;
  }
  /// Returns true if another interface has the gap of the lost node, with the same friction.
  bool isShared(const LostNode& lost) const {
    const auto own = gaps_.find(mesh_.firstNode + lost.node);
    return own != gaps_.end() && all_.slideTogether(own->second, lost.interface) &&
           all_.options[own->second].friction == all_.options[lost.interface].friction;
  }
  /// Returns true if a tie binds the lost node of a contact to what it touches.
  bool isBonded(const LostNode& lost) const {
    const auto tied = tied_.find(lost.node);
    if (tied == tied_.end() || all_.options[lost.interface].isTied()) return false;
    if (const auto other = parts_.find(lost.interface); other != parts_.end())
      if (std::ranges::all_of(tied->second->masterParts, [&](const auto& share) {
            return other->second.count(share.part) > 0;
          }))
        return true;
    PetscInt leader = mesh_.firstNode + lost.node;
    for (auto at = leader_.find(leader); at != leader_.end(); at = leader_.find(leader))
      leader = at->second;
    const auto gap = gaps_.find(leader);
    return gap != gaps_.end() && surfaceBelow(gap->second) == surfaceBelow(lost.interface);
  }

 private:
  struct Gap {
    PetscInt node;
    int interface;
  };
  struct Link {
    PetscInt node, leader;
  };
  struct Side {
    int interface, part;
  };
  std::string surfaceBelow(int interface) const {
    const auto& disc = all_.options[interface].surfaces.disc.name;
    return disc.empty() ? "an obstacle of " + all_.options[interface].label() : disc;
  }
  const mesh::Mesh& mesh_;
  const Interfaces& all_;
  std::map<PetscInt, int> gaps_;              // [global node] interface of all contact nodes
  std::map<PetscInt, const TiedNode*> tied_;  // [local node]
  std::map<PetscInt, PetscInt> leader_;       // [global node] the node that it follows
  std::map<int, std::set<int>> parts_;        // [interface] parts of its master side
};

/// The lost nodes of an interface, of all ranks.
struct Loss {
  LossReport report;
  std::array<double, 2> areas{};  // of the lost nodes, of the slave, m² (m)
  PetscInt bonded = 0;            // nodes that a tie binds to what they touch
  std::vector<std::string> ties;  // the labels of these ties
};

/// Collective.
Loss lossOf(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange, const Interfaces& all,
            int interface, const Owners& owners) {
  std::vector<Point> places;
  std::vector<int> owns(all.options.size(), 0), ties = owns;
  std::vector<double> marks(mesh.localNodes(), 0.0);
  Loss loss;
  for (const auto& lost : all.lost) {
    if (lost.interface != interface || owners.isShared(lost)) continue;
    const int owner = owners.of(lost.node);
    if (owners.isBonded(lost)) {
      ++loss.bonded;
      ties[owner] = 1;
      continue;
    }
    places.push_back(mesh.coordinates[lost.node]);
    marks[lost.node] = 1;
    if (owner >= 0) owns[owner] = 1;
  }
  places = concatenated(mesh.comm, places);
  mpi::reduce<int>(mesh.comm, owns, MPI_MAX);
  mpi::reduce<int>(mesh.comm, ties, MPI_MAX);
  loss.bonded = mpi::sum(mesh.comm, loss.bonded);
  loss.ties = all.labels(ties);
  loss.report.nodes = places.size();
  if (places.empty()) return loss;
  loss.report.first = *std::min_element(places.begin(), places.end());
  loss.areas = areasOf(mesh, exchange, all.slaves[interface].surface, marks);
  loss.report.owners = all.labels(owns);
  return loss;
}

}  // namespace

double areaOfLost(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                  const Interfaces& all, int interface) {
  std::vector<double> marks(mesh.localNodes(), 0.0);
  for (const auto& lost : all.lost)
    if (lost.interface == interface) marks[lost.node] = 1;
  return areasOf(mesh, exchange, all.slaves[interface].surface, marks)[0];
}

void warnOfLost(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange, Interfaces& all,
                Role role) {
  if (!mpi::any(mesh.comm, !all.lost.empty()))
    return;  // the usual case, which avoids gathering the owners of all nodes
  const Owners owners(mesh, all);
  for (int i = 0; i < std::ssize(all.options); ++i) {
    const auto& options = all.options[i];
    if (options.isTied() != (role == Role::tied)) continue;
    const auto [loss, areas, bonded, ties] = lossOf(mesh, exchange, all, i, owners);
    if (bonded > 0 && all.reports[i].nodes == 0)
      throw Error(formatted("%s: no node of '%s' is left: %" PetscInt_FMT
                            " are bonded to what they touch, by %s; remove one of the two",
                            options.label().c_str(), all.slaves[i].surface.c_str(), bonded,
                            joined(ties, " and ").c_str()));
    all.reports[i].bonded = bonded;
    if (loss.nodes == 0) continue;
    if (all.reports[i].matching && !options.isTied()) all.reports[i].dropped = loss.nodes;
    all.reports[i].loss = loss;
    printWarning(
        mesh.comm,
        formatted("warning: %s: %" PetscInt_FMT " nodes of '%s', %.3g of %.4g m2, first that "
                  "at %s, follow from %s and %s; %s",
                  options.label().c_str(), loss.nodes, all.slaves[i].surface.c_str(), areas[0],
                  areas[1], text(loss.first).c_str(), joined(loss.owners, " and ").c_str(),
                  options.isTied() ? "are not tied here" : "have no gap here",
                  options.isTied() ? "exchange slave and master of one of the ties"
                                   : "if that is a tie, exchange its slave and master"));
  }
}

}  // namespace squeal::interfaces
