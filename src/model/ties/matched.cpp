// SPDX-License-Identifier: BSD-2-Clause
#include "model/ties/matched.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <set>

#include "base/system/concatenation.hpp"
#include "base/system/text.hpp"
#include "model/interfaces/candidates.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::ties {

using namespace interfaces;

namespace {

/// A pair of nodes with equal displacements, u_node = u_master.
struct Edge {
  PetscInt node, master;  // global
  int interface, nodePart, masterPart;
  Point offset;  // position of the master minus that of the node in the file, m
  Point place;   // of the node
};

/// A node that should preferably follow no other one.
struct Preference {
  PetscInt node;  // global
  enum Kind { other, slides, rests } kind;
  PetscInt partner;  // of the contact, where its meshes match; otherwise −1
};

/// Returns the edges of all ranks, tie by tie, ordered by position, independent of the partition.
std::vector<Edge> edgesOf(const mesh::Mesh& mesh, const Interfaces& all) {
  std::vector<Edge> own;
  for (const auto& pair : mesh.pairs)
    if (all.options[pair.interface].isTied())
      own.push_back({mesh.firstNode + pair.node, pair.master, pair.interface,
                     mesh.nodePart[pair.node], pair.masterPart, pair.offset,
                     mesh.coordinates[pair.node]});
  auto edges = concatenated(mesh.comm, own);
  std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.interface, a.place) < std::tie(b.interface, b.place);
  });
  return edges;
}

/// Collective. Returns the preferences of all ranks.
std::vector<Preference> preferencesOf(const mesh::Mesh& mesh,
                                      const coupling::NodeExchange& exchange,
                                      const Interfaces& all) {
  std::vector<Preference> own;
  for (const auto& tied : all.tied)
    own.push_back({mesh.firstNode + tied.connection.node, Preference::rests, -1});
  for (const auto& pair : mesh.pairs)
    if (const Role role = all.options[pair.interface].role; role != Role::tied)
      own.push_back({mesh.firstNode + pair.node,
                     role == Role::sliding ? Preference::slides : Preference::other, pair.master});
  for (int i = 0; i < std::ssize(all.options); ++i) {
    const Role role = all.options[i].role;
    if (mesh.interfaces[i].matching || role == Role::tied) continue;
    for (const PetscInt node : slaveNodesOf(mesh, exchange, slaveSurface(mesh, all.options[i])))
      own.push_back({mesh.firstNode + node,
                     role == Role::sliding ? Preference::slides : Preference::other, -1});
  }
  return concatenated(mesh.comm, own);
}

/// A set of nodes with equal displacements.
struct Equal {
  std::set<PetscInt> nodes;
  std::vector<const Edge*> edges;
};

/// Returns the sets that the edges connect, in the order of their first edges.
std::vector<Equal> setsOf(const std::vector<Edge>& edges) {
  std::map<PetscInt, std::vector<const Edge*>> at;
  for (const auto& edge : edges) at[edge.node].push_back(&edge), at[edge.master].push_back(&edge);
  std::set<const Edge*> taken;
  std::vector<Equal> sets;
  for (const auto& first : edges) {
    if (taken.count(&first)) continue;
    Equal& set = sets.emplace_back();
    std::deque<PetscInt> next{first.node};
    set.nodes.insert(first.node);
    while (!next.empty()) {
      for (const Edge* edge : at[next.front()]) {
        if (taken.insert(edge).second) set.edges.push_back(edge);
        for (const PetscInt node : {edge->node, edge->master})
          if (set.nodes.insert(node).second) next.push_back(node);
      }
      next.pop_front();
    }
    std::sort(set.edges.begin(), set.edges.end());
  }
  return sets;
}

/// Returns the nodes of a set that follow no other one: all nodes with several masters or, without
/// these, one node.
std::vector<PetscInt> independentOf(
    const Equal& set, const std::map<PetscInt, std::vector<Preference>>& preferences) {
  std::vector<PetscInt> resting;
  PetscInt chosen = -1;
  int best = -1;
  // Ends of chains first, then in the order of the edges, independent of the partition.
  std::vector<PetscInt> order;
  for (const Edge* edge : set.edges) order.push_back(edge->master), order.push_back(edge->node);
  std::stable_partition(order.begin(), order.end(), [&](PetscInt node) {
    return std::none_of(set.edges.begin(), set.edges.end(),
                        [&](const Edge* edge) { return edge->node == node; });
  });
  for (const PetscInt node : order) {
    int most = 0;
    const auto found = preferences.find(node);
    if (found != preferences.end())
      for (const auto& preference : found->second)
        // A gap between tied nodes stays closed automatically.
        if (!set.nodes.count(preference.partner)) most = std::max(most, 1 + preference.kind);
    if (most == 1 + Preference::rests &&
        std::find(resting.begin(), resting.end(), node) == resting.end())
      resting.push_back(node);
    if (most > best) best = most, chosen = node;
  }
  return resting.empty() ? std::vector{chosen} : resting;
}

/// A node that follows another one by an edge, in either direction.
struct Follower {
  PetscInt node, leader;
  const Edge* edge;
};

/// Returns the followers of a set, and the edges between nodes of different leaders, which cannot
/// be satisfied. Redundant edges are in neither list.
std::pair<std::vector<Follower>, std::vector<const Edge*>> spanned(
    const Equal& set, const std::vector<PetscInt>& independent) {
  std::vector<Follower> followers;
  std::map<PetscInt, PetscInt> leads;  // [node] the independent node that it follows in the end
  std::deque<PetscInt> next(independent.begin(), independent.end());
  for (const PetscInt node : independent) leads[node] = node;
  for (; !next.empty(); next.pop_front())
    for (const Edge* edge : set.edges) {
      const PetscInt leader = next.front();
      if (edge->node != leader && edge->master != leader) continue;
      const PetscInt node = edge->node == leader ? edge->master : edge->node;
      if (!leads.emplace(node, leads[leader]).second) continue;
      followers.push_back({node, leader, edge});
      next.push_back(node);
    }
  std::vector<const Edge*> lost;
  for (const Edge* edge : set.edges)
    if (leads[edge->node] != leads[edge->master]) lost.push_back(edge);
  return {followers, lost};
}

TiedNode tiedNode(const mesh::Mesh& mesh, const Follower& follower) {
  const Edge& edge = *follower.edge;
  const bool along = follower.node == edge.node;
  TiedNode tied;
  tied.interface = edge.interface;
  tied.connection.node = follower.node - mesh.firstNode;
  tied.connection.masters = {{follower.leader, 1}};
  tied.masterParts = {{along ? edge.masterPart : edge.nodePart, 1}};
  tied.offset = along ? edge.offset : mesh::scaled(edge.offset, -1);
  return tied;
}

/// Throws Error for a tie whose edges are all redundant.
void rejectRepeated(const std::vector<Equal>& sets, const Interfaces& all) {
  std::vector<PetscInt> edges(all.options.size(), 0), repeated(edges);
  std::vector<std::set<int>> others(all.options.size());
  for (const auto& set : sets) {
    // An edge of a later tie is redundant if earlier edges connect its nodes.
    std::map<PetscInt, PetscInt> root;
    for (const PetscInt node : set.nodes) root[node] = node;
    for (const Edge* edge : set.edges) {
      ++edges[edge->interface];
      const PetscInt from = root[edge->node], to = root[edge->master];
      if (from == to) {
        ++repeated[edge->interface];
        for (const Edge* other : set.edges)
          if (other->interface != edge->interface) others[edge->interface].insert(other->interface);
      }
      for (auto& [node, end] : root)
        if (end == from) end = to;
    }
  }
  for (int i = 0; i < std::ssize(edges); ++i) {
    if (edges[i] == 0 || repeated[i] < edges[i] || others[i].empty()) continue;
    std::vector<std::string> labels;
    for (const int other : others[i]) labels.push_back(all.options[other].label());
    throw Error(all.options[i].label() + ": all " + std::to_string(edges[i]) +
                " nodes are already tied by " + joined(labels, " and ") +
                "; use these surfaces in only one tie");
  }
}

}  // namespace

void tieMatched(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange, Interfaces& all) {
  const auto edges = edgesOf(mesh, all);
  if (edges.empty()) return;
  std::map<PetscInt, std::vector<Preference>> preferences;
  for (const auto& preference : preferencesOf(mesh, exchange, all))
    preferences[preference.node].push_back(preference);
  const auto sets = setsOf(edges);
  rejectRepeated(sets, all);
  for (const auto& edge : edges) ++all.reports[edge.interface].nodes;
  for (const auto& set : sets) {
    const auto [followers, lost] = spanned(set, independentOf(set, preferences));
    for (const auto& follower : followers)
      if (follower.node >= mesh.firstNode && follower.node < mesh.firstNode + mesh.ownedNodes)
        all.tied.push_back(tiedNode(mesh, follower));
    for (const Edge* edge : lost) {
      --all.reports[edge->interface].nodes;
      if (edge->node >= mesh.firstNode && edge->node < mesh.firstNode + mesh.ownedNodes)
        all.lost.push_back({edge->interface, edge->node - mesh.firstNode});
    }
  }
}

}  // namespace squeal::ties
