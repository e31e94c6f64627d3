#include "steady/resultants.hpp"

#include <algorithm>

#include "mesh/vector.hpp"
#include "petsc/arrays.hpp"

namespace squeal::steady {

std::vector<Point> forcesOnPads(const contact::Contact& contact, const Solution& solution,
                                Vec nodalForces) {
  const auto& mesh = *contact.mesh;
  std::vector<double> normal;
  for (const auto& state : solution.contact) normal.push_back(state.normalForce);
  normal = contact.nodalForce(normal);
  const ReadArray forces(nodalForces);
  std::vector<Point> found;
  for (std::size_t i = 0; i < contact.nodes.size(); ++i) {
    const auto& node = contact.nodes[i];
    const auto& slip = solution.slip[i];
    Point force{};
    for (int d = 0; d < mesh.dimension; ++d)
      force[d] =
          node.role == contact::Role::sticking
              ? node.side * forces[mesh.dimension * node.node + d]
              : normal[i] * (node.normal[d] - solution.at.friction * slip.law * slip.direction[d]);
    found.push_back(force);
  }
  return found;
}

void setStickingForces(const contact::Contact& contact, Vec nodalForces, Solution& solution) {
  const auto& mesh = *contact.mesh;
  const ReadArray forces(nodalForces);
  std::vector<Point> onPads;
  for (const auto& node : contact.nodes) {
    Point force{};
    for (int d = 0; d < mesh.dimension; ++d)
      force[d] = node.side * forces[mesh.dimension * node.node + d];
    onPads.push_back(mesh::tangential(force, node.normal));
  }
  for (int d = 0; d < mesh.dimension; ++d) {
    std::vector<double> component;
    for (const Point& force : onPads) component.push_back(force[d]);
    component = contact.gapForce(component);
    for (std::size_t i = 0; i < contact.nodes.size(); ++i)
      if (contact.nodes[i].role == contact::Role::sticking)
        solution.contact[i].frictionForce[d] = component[i];
  }
}

Resultant resultantOf(const contact::Contact& contact, int interface, const Solution& solution,
                      const std::vector<Point>& onPads) {
  const auto& mesh = *contact.mesh;
  const int dimension = mesh.dimension;
  Resultant resultant{contact.interfaces[interface], {}, {}, {}, 0, 0};
  std::vector<unsigned char> isMaster(mesh.parts, 0);
  int side = 1;
  for (const auto& node : contact.nodes) {
    if (node.interface != interface) continue;
    side = node.side;
    for (const auto& [part, share] : node.masterParts) isMaster[part] = 1;
  }
  check(MPI_Allreduce(MPI_IN_PLACE, isMaster.data(), isMaster.size(), MPI_UNSIGNED_CHAR, MPI_MAX,
                      mesh.comm));
  check(MPI_Allreduce(MPI_IN_PLACE, &side, 1, MPI_INT, MPI_MIN, mesh.comm));
  const bool onObstacle = contact.options[interface].onObstacle();
  Point moments[2]{};  // about the origin, on pad and disc
  for (const bool tangential : {false, true}) {
    const OwnedVec part = elasticity::nodalVector(mesh), forces = elasticity::nodalVector(mesh);
    {
      const WriteArray values(part);
      for (std::size_t k = 0; k < contact.nodes.size(); ++k) {
        const auto& node = contact.nodes[k];
        if (node.interface != interface) continue;
        const Point friction = mesh::tangential(onPads[k], node.normal),
                    f = tangential ? friction : mesh::minus(onPads[k], friction);
        for (int d = 0; d < dimension; ++d) values[dimension * node.node + d] = f[d];
      }
    }
    check(MatMultTranspose(contact.jump, part, forces));
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
  for (std::size_t k = 0; k < contact.nodes.size(); ++k) {
    const auto& node = contact.nodes[k];
    const auto& state = solution.contact[k];
    if (node.interface == interface && node.role == contact::Role::sticking && solution.closed[k])
      resultant.leastFriction =
          std::max(resultant.leastFriction, mesh::length(state.frictionForce) / state.normalForce);
  }
  for (Point* sum : {&resultant.normalForce, &resultant.frictionForce, &moments[0], &moments[1]})
    check(MPI_Allreduce(MPI_IN_PLACE, sum->data(), 3, MPI_DOUBLE, MPI_SUM, mesh.comm));
  check(MPI_Allreduce(MPI_IN_PLACE, &resultant.leastFriction, 1, MPI_DOUBLE, MPI_MAX, mesh.comm));
  resultant.moment = moments[0];
  resultant.momentDefect = onObstacle ? 0 : mesh::length(mesh::plus(moments[0], moments[1]));
  return resultant;
}

void addTieForces(const contact::Contact& contact, Vec nodalForces, Vec contactForces) {
  const auto& mesh = *contact.mesh;
  const int dimension = mesh.dimension;
  for (int level = contact.levels; level > 0; --level) {
    const OwnedVec ties = elasticity::nodalVector(mesh);
    {
      const ReadArray forces(nodalForces), others(contactForces);
      for (const auto& [interface, connection, parts, offset] : contact.tied) {
        if (connection.level != level) continue;
        for (int d = 0; d < dimension; ++d) {
          const PetscInt row = dimension * connection.node + d;
          const double force = forces[row] - others[row];
          check(VecSetValue(ties, dimension * mesh.firstNode + row, force, ADD_VALUES));
          for (const auto& [master, weight] : connection.masters)
            check(VecSetValue(ties, dimension * master + d, -weight * force, ADD_VALUES));
        }
      }
    }
    check(VecAssemblyBegin(ties));
    check(VecAssemblyEnd(ties));
    check(VecAXPY(contactForces, 1, ties));
  }
}

}  // namespace squeal::steady
