// SPDX-License-Identifier: BSD-2-Clause
#include "model/contact/build.hpp"

#include <algorithm>

#include "base/system/mpi.hpp"
#include "model/contact/hourglass.hpp"
#include "model/contact/loose.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/interfaces/layers.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::contact {

using interfaces::assembled;
using interfaces::nodalMatrix;
using interfaces::text;
using mesh::plus;

namespace {

/// Returns P, which copies u of primaries to their images.
OwnedMat periodicity(const mesh::Mesh& mesh) {
  OwnedMat matrix = nodalMatrix(mesh, 1);
  std::vector<PetscInt> source;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node) source.push_back(mesh.firstNode + node);
  for (const auto& image : mesh.images) source[image.node] = image.primary;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    for (int d = 0; d < mesh.dimension; ++d)
      check(MatSetValue(matrix, mesh.dimension * (mesh.firstNode + node) + d,
                        mesh.dimension * source[node] + d, 1, INSERT_VALUES));
  assembled(matrix);
  return matrix;
}

void requireFlatObstacles(const mesh::Mesh& mesh, const interfaces::Interfaces& all) {
  const auto& interfaces = all.options;
  std::string failure;
  for (int i = 0; i < std::ssize(interfaces); ++i) {
    if (!interfaces[i].onObstacle()) continue;
    Point sum{};
    double count = 0;
    for (const auto& node : all.nodes)
      if (node.interface == i) {
        sum = plus(sum, node.normal);
        ++count;
      }
    mpi::reduce<double>(mesh.comm, sum, MPI_SUM);
    count = mpi::sum(mesh.comm, count);
    for (const auto& node : all.nodes)
      if (node.interface == i && mesh::dot(sum, node.normal) < (1 - 1e-10) * count)
        failure = "option " + interfaces[i].surfaces.pad.option +
                  ": the face on the rigid obstacle must be flat; its normal turns at " +
                  text(node.position);
  }
  failTogether(mesh.comm, failure);
}

/// Throws Error if a pad moves: w = −V holds for a resting pad on a moving disc.
void requireRestingPads(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                        const interfaces::Interfaces& all) {
  std::vector<int> moving(mesh.localNodes(),
                          -1);  // [local node] its moving body
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.body.size(); ++e)
      if (const int body = block.body[e]; bodies.motions[body].moves())
        for (PetscInt node : block.nodesOf(e)) moving[node] = body;
  std::string failure;
  for (const auto& block : mesh.faces)
    for (std::size_t e = 0; e < block.surface.size(); ++e) {
      const auto& surface = mesh.surfaces[block.surface[e]];
      if (std::ranges::none_of(all.options, [&](const auto& i) {
            return i.role == Role::sliding && i.surfaces.pad.name == surface;
          }))
        continue;
      for (PetscInt node : block.nodesOf(e))
        if (const int body = moving[node]; body >= 0)
          failure = "body '" + mesh.bodies[body] + "' has a -motion_" + mesh.bodies[body] +
                    "_* but bears the pad surface '" + surface +
                    "'; the side that moves is the disc, -contact_<interface>_disc";
    }
  failTogether(mesh.comm, failure);
}

}  // namespace

Assembled assemble(const mesh::Mesh& mesh, elasticity::Bodies bodies, interfaces::Interfaces ties,
                   const Settings& settings) {
  OwnedMat periodic = periodicity(mesh);
  auto all = interfaces::findNodes(mesh, bodies, periodic, std::move(ties));
  bodies =
      elasticity::withLayers(std::move(bodies), interfaces::layerStiffness(mesh, all, periodic));
  requireRestingPads(mesh, bodies, all);
  requireFlatObstacles(mesh, all);
  auto kinematics = kinematicsOf(mesh, all, periodic);
  auto sliding = slidingOf({mesh, bodies, all, kinematics, periodic});
  return {.bodies = std::move(bodies),
          .contact = {.mesh = &mesh,
                      .interfaces = std::move(all),
                      .law = settings.law,
                      .periodic = std::move(periodic),
                      .kinematics = std::move(kinematics),
                      .sliding = std::move(sliding)}};
}

void requireSupports(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                     const Contact& contact) {
  rejectRigidBodyModes(mesh, contact, bodies);
  rejectHourglassModes(mesh, contact, bodies);
}

void lockBolts(Contact& contact, const elasticity::Bodies& bodies,
               const std::vector<double>& openings) {
  const mesh::Mesh& mesh = *contact.mesh;
  for (std::size_t i = 0; i < openings.size(); ++i)
    constraints::lockBolt(mesh, i, openings[i], contact.interfaces.constraints);
  contact.kinematics = kinematicsOf(mesh, contact.interfaces, contact.periodic);
  contact.sliding =
      slidingOf({mesh, bodies, contact.interfaces, contact.kinematics, contact.periodic});
}

void requireMotion(const Contact& contact) {
  std::vector<double> fastest(contact.interfaces.options.size(), 0.0);  // [interface]
  for (const auto& node : contact.interfaces.nodes)
    fastest[node.interface] = std::max(fastest[node.interface], node.slipSpeed);
  mpi::reduce<double>(contact.mesh->comm, fastest, MPI_MAX);
  for (std::size_t i = 0; i < fastest.size(); ++i) {
    const auto& interface = contact.interfaces.options[i];
    if (interface.role != Role::sliding || contact.interfaces.reports[i].nodes == 0 ||
        fastest[i] > 0)
      continue;
    const std::string& name = interface.surfaces.name;
    throw Error(interface.label() + " slides, but |w| = 0 at all its nodes; give " +
                (interface.onObstacle() ? interfaces::obstacleVelocityName(name)
                                        : "-motion_<body>_velocity or _speed of its disc") +
                ", or " + interfaces::roleName(name) +
                (interface.onObstacle() ? " frictionless" : " sticking or frictionless"));
  }
}

void requireSlip(const Contact& contact, const std::vector<Slip>& slip, const Mask& active,
                 double swept) {
  std::string failure;
  for (std::size_t i = 0; i < slip.size(); ++i)
    if (active[i] && slip[i].speed == 0 && slip[i].coefficient.at(swept) > 0 && failure.empty()) {
      const auto& node = contact.interfaces.nodes[i];
      const std::string& name = contact.interfaces.names[node.interface];
      failure =
          "option -flutter_friction: friction needs a sliding velocity, but |w| = 0 at the contact "
          "node at " +
          text(node.position) + " of interface '" + name +
          "'; give -motion_<body>_velocity or _speed, or " +
          interfaces::obstacleVelocityName(name) + ", or " + interfaces::roleName(name) +
          " sticking or frictionless";
    }
  failTogether(contact.mesh->comm, failure);
}

}  // namespace squeal::contact
