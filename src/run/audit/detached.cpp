// SPDX-License-Identifier: BSD-2-Clause
#include "run/audit/detached.hpp"

#include <map>
#include <set>

#include "base/system/concatenation.hpp"
#include "base/system/disjoint_sets.hpp"
#include "base/system/text.hpp"

namespace squeal::audit {
namespace {

struct Joint {
  int one, other;  // parts
};

/// Collective. Returns the sets of connected parts that ties, couplings and bolts join.
DisjointSets<int> piecesOf(const Subject& model) {
  const auto& mesh = model.mesh;
  std::set<std::pair<int, int>> own;
  const auto add = [&](PetscInt node, int part) { own.insert({mesh.nodePart[node], part}); };
  for (const auto& tied : model.contact.interfaces.tied)
    for (const auto& [part, share] : tied.masterParts) add(tied.connection.node, part);
  for (const auto& coupled : model.contact.interfaces.coupled)
    for (const auto& master : coupled.masters) add(coupled.node, master.part);
  std::vector<Joint> joints;
  for (const auto& [one, other] : own) joints.push_back({one, other});
  DisjointSets<int> pieces(mesh.parts);
  for (const auto& [one, other] : concatenated(mesh.comm, joints)) pieces.join(one, other);
  return pieces;
}

struct Place {
  int group, part;
};

/// Collective. Returns the parts that have cells of each material group, [material group].
std::vector<std::set<int>> partsOfGroups(const mesh::Mesh& mesh) {
  std::set<std::pair<int, int>> own;
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e)
      own.insert({block.material[e], mesh.nodePart[block.nodesOf(e)[0]]});
  std::vector<Place> places;
  for (const auto& [group, part] : own) places.push_back({group, part});
  std::vector<std::set<int>> parts(mesh.materialGroups.size());
  for (const auto& [group, part] : concatenated(mesh.comm, places)) parts[group].insert(part);
  return parts;
}

}  // namespace

Findings detachedFindings(const Subject& model) {
  const auto& mesh = model.mesh;
  if (!mesh.hasSections()) return {};
  DisjointSets<int> pieces = piecesOf(model);
  const auto parts = partsOfGroups(mesh);
  Findings findings;
  for (int body = 0; body < std::ssize(mesh.bodies); ++body) {
    std::map<int, std::vector<std::string>> sections;  // [piece]
    for (std::size_t group = 0; group < parts.size(); ++group) {
      const auto& [name, owner, isSection] = mesh.materialGroups[group];
      if (owner != body || !isSection) continue;
      std::set<int> found;
      for (const int part : parts[group]) found.insert(pieces.smallest(part));
      for (const int piece : found) sections[piece].push_back("'" + name + "'");
    }
    if (sections.size() < 2) continue;
    std::vector<std::string> lists;
    for (const auto& [piece, names] : sections) lists.push_back(joined(names));
    findings.push_back({Kind::detached, Severity::warning,
                        formatted("the sections of body '%s' form %zu pieces that share no node: ",
                                  mesh.bodies[body].c_str(), sections.size()) +
                            joined(lists, "; "),
                        "merge the nodes of the sections, tie them, or give separate bodies names "
                        "of their own"});
  }
  return findings;
}

}  // namespace squeal::audit
