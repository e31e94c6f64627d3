// SPDX-License-Identifier: BSD-2-Clause
#include "steady/steady/resultants.hpp"

#include <algorithm>
#include <cmath>

#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::steady {
namespace {

/// Returns the tangential part of a nodal force at a contact node, from the rows of its unknowns z;
/// the tangents are the columns of its block of A.
Point alongSurface(const contact::Contact& contact, const contact::ContactNode& node,
                   const double* z) {
  const int dimension = contact.mesh->dimension;
  std::vector<PetscInt> entries;
  for (int d = 0; d < dimension; ++d) entries.push_back(dimension * node.globalNode + d);
  std::vector<double> block(dimension * dimension);
  check(MatGetValues(contact.kinematics.matrix, dimension, entries.data(), dimension,
                     entries.data(), block.data()));
  Point force{};
  for (int d = 0; d < dimension; ++d)
    for (int t = 0; t < dimension - 1; ++t) force[d] += block[d * dimension + t] * z[t];
  return force;
}

/// Collective. Returns the first position, m, in the order of coordinates, over all ranks.
Point firstOf(MPI_Comm comm, std::vector<Point> positions) {
  Point first{};
  for (std::size_t d = 0; d < 3; ++d) {
    first[d] = INFINITY;
    for (const auto& p : positions) first[d] = std::min(first[d], p[d]);
    first[d] = mpi::min(comm, first[d]);
    std::erase_if(positions, [&](const Point& p) {
      return p[d] > first[d] + 1e-9 * (1 + std::abs(first[d]));
    });
  }
  return std::isfinite(first[0]) ? first : Point{};
}

/// Collective. Sets the members of a resultant on sticking nodes.
void addSticking(const contact::Contact& contact, int interface, const Solution& solution,
                 Resultant& resultant) {
  const MPI_Comm comm = contact.mesh->comm;
  resultant.stickingLimit = contact.interfaces.options[interface].stickingLimit;
  const auto ratio = [&](std::size_t k) {
    return mesh::length(solution.contact[k].frictionForce) / solution.contact[k].normalForce;
  };
  std::vector<std::size_t> held;
  for (std::size_t k = 0; k < contact.interfaces.nodes.size(); ++k) {
    if (contact.interfaces.nodes[k].interface != interface || !solution.closed[k]) continue;
    if (solution.sticking.holds[k] == Hold::released) ++resultant.released;
    if (solution.sticking.holds[k] == Hold::open) ++resultant.unheld;
    const bool over = exceedsLimit(contact, solution, k), pulled = isPulled(contact, solution, k);
    if (solution.sticking.holds[k] == Hold::held && !pulled) held.push_back(k);
    resultant.overLimit += over;
    resultant.pulled += over && pulled;
  }
  for (const std::size_t k : held)
    resultant.leastFriction = std::max(resultant.leastFriction, ratio(k));
  resultant.leastFriction = mpi::max(comm, resultant.leastFriction);
  std::vector<Point> worst;
  for (const std::size_t k : held)
    if (ratio(k) >= (1 - 1e-9) * resultant.leastFriction)
      worst.push_back(contact.interfaces.nodes[k].position);
  resultant.worst = firstOf(comm, worst);
  for (PetscInt* count :
       {&resultant.released, &resultant.unheld, &resultant.overLimit, &resultant.pulled})
    *count = mpi::sum(comm, *count);
}

/// Adds the forces of a coupling on a node and on those that it follows.
void addCouplingForces(const mesh::Mesh& mesh, const constraints::CoupledNode& coupled,
                       const ReadArray& forces, const ReadArray& others, Vec sums) {
  const int dimension = mesh.dimension;
  for (int d = 0; d < dimension; ++d) {
    const PetscInt row = dimension * coupled.node + d;
    const double force = forces[row] - others[row];
    check(VecSetValue(sums, dimension * mesh.firstNode + row, force, ADD_VALUES));
    for (const auto& master : coupled.masters)
      for (int e = 0; e < dimension; ++e)
        check(VecSetValue(sums, dimension * master.node + e, -master.block[d][e] * force,
                          ADD_VALUES));
  }
}

}  // namespace

std::vector<Point> tangentialForces(const contact::Contact& contact, const Solution& solution,
                                    const std::vector<contact::Slip>& slip, Vec nodalForces) {
  const auto& mesh = *contact.mesh;
  const int dimension = mesh.dimension;
  std::vector<double> normal;
  for (const auto& state : solution.contact) normal.push_back(state.normalForce);
  normal = contact.nodalForce(normal);
  std::vector<Point> found;
  const OwnedVec friction = elasticity::nodalVector(mesh), rest = elasticity::nodalVector(mesh),
                 left = elasticity::nodalVector(mesh);
  {
    const WriteArray values(friction);
    for (std::size_t i = 0; i < contact.interfaces.nodes.size(); ++i) {
      Point force{};
      for (int d = 0; d < dimension; ++d) {
        force[d] = -slip[i].friction(solution.at.friction) * normal[i] * slip[i].direction[d];
        values[dimension * contact.interfaces.nodes[i].node + d] = -force[d];
      }
      found.push_back(force);
    }
  }
  //   Aᵀ (r + Jᵀ f φ E⁻ᵀ R_N τ)
  check(MatMultTransposeAdd(contact.sliding.jump, friction, nodalForces, rest));
  check(MatMultTranspose(contact.kinematics.matrix, rest, left));
  const ReadArray values(left);
  for (std::size_t i = 0; i < contact.interfaces.nodes.size(); ++i) {
    const auto& node = contact.interfaces.nodes[i];
    if (node.role != contact::Role::sticking) continue;
    const Point held = alongSurface(contact, node, values.begin() + dimension * node.node);
    for (std::size_t d = 0; d < 3; ++d) found[i][d] += node.side * held[d];
  }
  return found;
}

void setStickingForces(const contact::Contact& contact, const std::vector<Point>& tangential,
                       Solution& solution) {
  for (std::size_t d = 0; d < 3; ++d) {
    std::vector<double> component;
    for (const auto& force : tangential) component.push_back(force[d]);
    component = contact.gapForce(component);
    for (std::size_t i = 0; i < contact.interfaces.nodes.size(); ++i)
      if (contact.interfaces.nodes[i].role == contact::Role::sticking)
        solution.contact[i].frictionForce[d] = component[i];
  }
}

std::vector<Point> forcesOnPads(const contact::Contact& contact, const Solution& solution,
                                std::vector<Point> tangential) {
  std::vector<double> normal;
  for (const auto& state : solution.contact) normal.push_back(state.normalForce);
  normal = contact.nodalForce(normal);
  for (std::size_t i = 0; i < contact.interfaces.nodes.size(); ++i)
    tangential[i] = mesh::plus(tangential[i], contact.interfaces.nodes[i].normal, normal[i]);
  return tangential;
}

Resultant resultantOf(const contact::Contact& contact, int interface, const Solution& solution,
                      const std::vector<Point>& onPads) {
  const auto& mesh = *contact.mesh;
  const int dimension = mesh.dimension;
  Resultant resultant;
  resultant.interface = contact.interfaces.names[interface];
  std::vector<unsigned char> isMaster(mesh.parts, 0);
  int side = 1;
  for (const auto& node : contact.interfaces.nodes) {
    if (node.interface != interface) continue;
    side = node.side;
    for (const auto& [part, share] : node.masterParts) isMaster[part] = 1;
  }
  mpi::reduce<unsigned char>(mesh.comm, isMaster, MPI_MAX);
  side = mpi::min(mesh.comm, side);
  const bool onObstacle = contact.interfaces.options[interface].onObstacle();
  Point moments[2]{};  // about the origin, on pad and disc
  for (const bool tangential : {false, true}) {
    const OwnedVec part = elasticity::nodalVector(mesh), forces = elasticity::nodalVector(mesh);
    {
      const WriteArray values(part);
      for (std::size_t k = 0; k < contact.interfaces.nodes.size(); ++k) {
        const auto& node = contact.interfaces.nodes[k];
        if (node.interface != interface) continue;
        const Point friction = mesh::tangential(onPads[k], node.normal),
                    f = tangential ? friction : mesh::minus(onPads[k], friction);
        for (int d = 0; d < dimension; ++d) values[dimension * node.node + d] = f[d];
      }
    }
    check(MatMultTranspose(contact.sliding.jump, part, forces));
    Point& sum = tangential ? resultant.frictionForce : resultant.normalForce;
    const ReadArray values(forces);
    for (PetscInt node = 0; node < mesh.ownedNodes; ++node) {
      const bool onPad = onObstacle || (isMaster[mesh.nodePart[node]] != 0) == (side < 0);
      Point f{};
      for (int d = 0; d < dimension; ++d) f[d] = values[dimension * node + d];
      if (onPad) sum = mesh::plus(sum, f);
      Point& moment = moments[onPad ? 0 : 1];
      moment = mesh::plus(moment, mesh::cross(mesh.coordinates[node], f));
    }
  }
  if (contact.interfaces.options[interface].role == contact::Role::sticking)
    addSticking(contact, interface, solution, resultant);
  for (Point* sum : {&resultant.normalForce, &resultant.frictionForce, &moments[0], &moments[1]})
    mpi::reduce<double>(mesh.comm, *sum, MPI_SUM);
  resultant.moment = moments[0];
  resultant.momentDefect = onObstacle ? 0 : mesh::length(mesh::plus(moments[0], moments[1]));
  return resultant;
}

OwnedVec withTieForces(const contact::Contact& contact, Vec nodalForces, OwnedVec contactForces) {
  const auto& mesh = *contact.mesh;
  const int dimension = mesh.dimension;
  for (int level = contact.interfaces.levels; level > 0; --level) {
    const OwnedVec ties = elasticity::nodalVector(mesh);
    {
      const ReadArray forces(nodalForces), others(contactForces);
      for (const auto& [interface, connection, parts, offset, apart] : contact.interfaces.tied) {
        if (connection.level != level) continue;
        for (int d = 0; d < dimension; ++d) {
          if (apart[d]) continue;
          const PetscInt row = dimension * connection.node + d;
          const double force = forces[row] - others[row];
          check(VecSetValue(ties, dimension * mesh.firstNode + row, force, ADD_VALUES));
          for (const auto& [master, weight] : connection.masters)
            check(VecSetValue(ties, dimension * master + d, -weight * force, ADD_VALUES));
        }
      }
      for (const auto& coupled : contact.interfaces.coupled)
        if (coupled.level == level) addCouplingForces(mesh, coupled, forces, others, ties);
    }
    check(VecAssemblyBegin(ties));
    check(VecAssemblyEnd(ties));
    check(VecAXPY(contactForces, 1, ties));
  }
  return contactForces;
}

}  // namespace squeal::steady
