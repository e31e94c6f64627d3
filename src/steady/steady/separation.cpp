// SPDX-License-Identifier: BSD-2-Clause
#include "steady/steady/separation.hpp"

#include <vector>

#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/contact/loose.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::steady {
namespace {

struct Pulled {
  Point position;
  int interface;
};

}  // namespace

std::string pulledFriction(const contact::Contact& contact, const Solution& solution) {
  const MPI_Comm comm = contact.mesh->comm;
  int count = 0;
  std::vector<Pulled> first;  // of this rank, at most one
  for (std::size_t i = 0; i < solution.contact.size(); ++i) {
    const auto& node = contact.interfaces.nodes[i];
    if (node.separates || solution.contact[i].normalForce >= -solution.negligibleForce ||
        solution.slip[i].friction(solution.at.friction) == 0)
      continue;
    if (count++ == 0) first.push_back({node.position, node.interface});
  }
  count = mpi::sum(comm, count);
  if (count == 0) return "";
  first = concatenated(comm, first);
  return formatted(
      "%d %s with friction pulled, such as that at %s, and %s off keeps the sides together; "
      "friction needs pressure: let them separate, or make the interface frictionless",
      count, count == 1 ? "node is" : "nodes are", mesh::text(first[0].position).c_str(),
      interfaces::separationName(contact.interfaces.names[first[0].interface]).c_str());
}

std::string heldByContactOnly(const contact::Contact& contact, const elasticity::Bodies& bodies) {
  const auto mode = contact::rigidBodyMode(*contact.mesh, contact, bodies, {.any = false});
  if (!mode) return "";
  return "; only contact holds body '" + mode->body + "' (" + mode->motion +
         "): check that the loads press it on";
}

}  // namespace squeal::steady
