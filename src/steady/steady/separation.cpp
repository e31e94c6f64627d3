// SPDX-License-Identifier: BSD-2-Clause
#include "steady/steady/separation.hpp"

#include <algorithm>
#include <vector>

#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/contact/loose.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::steady {
namespace {

/// Returns the coefficient of friction of contact node i. A node of a sticking interface has one
/// only if it may slide.
double frictionAt(const contact::Contact& contact, const Solution& solution, std::size_t i) {
  const auto& node = contact.interfaces.nodes[i];
  const auto& given = contact.interfaces.options[node.interface];
  if (node.role == contact::Role::sticking)
    return given.releases ? given.stickingLimit.value_or(0) : 0;
  return solution.slip[i].friction(solution.at.friction);
}

}  // namespace

std::string pulledFriction(const contact::Contact& contact, const Solution& solution) {
  const MPI_Comm comm = contact.mesh->comm;
  const auto& all = contact.interfaces;
  std::vector<int> counts(all.names.size(), 0);             // [interface]
  std::vector<std::vector<Point>> first(all.names.size());  // [interface] of this rank, at most one
  for (std::size_t i = 0; i < solution.contact.size(); ++i) {
    const auto& node = all.nodes[i];
    if (!isPulled(contact, solution, i) || frictionAt(contact, solution, i) == 0) continue;
    if (counts[node.interface]++ == 0) first[node.interface].push_back(node.position);
  }
  mpi::reduce<int>(comm, counts, MPI_SUM);
  const auto found = std::ranges::find_if(counts, [](int count) { return count > 0; });
  if (found == counts.end()) return "";
  const std::size_t interface = found - counts.begin();
  const Point where = concatenated(comm, first[interface])[0];
  return formatted(
      "interface '%s': %d %s with friction %s under tension, for example at %s, since %s off keeps "
      "the two sides together; friction needs pressure: let the sides separate, or make the "
      "interface frictionless",
      all.names[interface].c_str(), *found, *found == 1 ? "node" : "nodes",
      *found == 1 ? "is" : "are", mesh::text(where).c_str(),
      interfaces::separationName(all.names[interface]).c_str());
}

std::string heldByContactOnly(const contact::Contact& contact, const elasticity::Bodies& bodies) {
  const auto mode = contact::rigidBodyMode(*contact.mesh, contact, bodies, {.any = false});
  if (!mode) return "";
  return "; only contact holds body '" + mode->body + "' (" + mode->motion +
         "): check that the loads press it on";
}

}  // namespace squeal::steady
