// SPDX-License-Identifier: BSD-2-Clause
#include <algorithm>
#include <cmath>

#include "base/system/mpi.hpp"
#include "model/attachments/forms.hpp"
#include "model/frame/frame.hpp"
#include "run/audit/masses.hpp"

namespace squeal::audit {
namespace {

using attachments::MassSettings;

std::string nameOf(const MassSettings& given) { return "mass of '" + given.group + "'"; }

/// Returns the mass of a reference node, with its inertia turned into global axes.
BodyMass massAt(const mesh::Mesh& mesh, const mesh::Reference& reference, const MassSettings& given,
                const frame::Frame& frame) {
  const Matrix3 axes = frame.axesAt(reference.position);
  const Point offset = given.offset.in(mesh.dimension);
  const Point centre = mesh::plus(reference.position, mesh::along(axes, offset));
  BodyMass mass{.body = nameOf(given), .mass = given.total, .centre = centre};
  mass.low = mass.high = mass.centre;
  const auto& j = given.inertia;
  if (given.hasInertia && j.size() == 6) {
    mass.inertia = attachments::inertiaTensor(j, axes);
  } else if (given.hasInertia) {
    mass.inertia[2][2] = j[0];
  }
  return mass;
}

/// Collective. Returns the mass that the nodes of a group share.
BodyMass massOf(const mesh::Mesh& mesh, const MassSettings& given) {
  const auto& nodes = mesh.nodeGroups.at(given.group);
  double sums[4] = {0, 0, 0, double(nodes.size())};
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (const PetscInt node : nodes)
    for (std::size_t d = 0; d < 3; ++d) {
      const double x = mesh.coordinates[node][d];
      sums[d] += x, low[d] = std::min(low[d], x), high[d] = std::max(high[d], x);
    }
  mpi::reduce<double>(mesh.comm, sums, MPI_SUM);
  mpi::reduce<double>(mesh.comm, low, MPI_MIN);
  mpi::reduce<double>(mesh.comm, high, MPI_MAX);
  BodyMass mass{.body = nameOf(given), .mass = given.total};
  for (std::size_t d = 0; d < 3; ++d)
    mass.centre[d] = sums[d] / sums[3], mass.low[d] = low[d], mass.high[d] = high[d];
  for (const PetscInt node : nodes) {
    const Point r = mesh::minus(mesh.coordinates[node], mass.centre);
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b)
        mass.inertia[a][b] +=
            given.total / sums[3] * ((a == b ? mesh::dot(r, r) : 0) - r[a] * r[b]);
  }
  mpi::reduce<double>(mesh.comm, {mass.inertia.data()->data(), 9}, MPI_SUM);
  return mass;
}

}  // namespace

std::vector<BodyMass> pointMasses(const Subject& model) {
  const auto& mesh = model.mesh;
  const auto& attachments = model.bodies.settings.attachments;
  std::vector<BodyMass> masses;
  for (const auto& given : attachments.masses) {
    const auto* reference = mesh.reference(given.group);
    masses.push_back(reference ? massAt(mesh, *reference, given,
                                        frame::named(attachments.frames, given.frame,
                                                     attachments::massFrameName(given.group), mesh))
                               : massOf(mesh, given));
  }
  return masses;
}

}  // namespace squeal::audit
