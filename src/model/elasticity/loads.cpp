// SPDX-License-Identifier: BSD-2-Clause
#include "model/elasticity/loads.hpp"

#include <algorithm>

#include "base/petsc/check.hpp"
#include "base/system/error.hpp"
#include "base/system/mpi.hpp"
#include "model/elasticity/assembly.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/elasticity/face.hpp"
#include "model/elasticity/inertia.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::elasticity {
namespace {

void assembled(Vec vector) {
  check(VecAssemblyBegin(vector));
  check(VecAssemblyEnd(vector));
}

void addVector(Vec sum, int dimension, PetscInt node, const Point& value) {
  for (int d = 0; d < dimension; ++d)
    check(VecSetValue(sum, dimension * node + d, value[d], ADD_VALUES));
}

/// Returns the acceleration of each body, [body], m/s².
std::vector<Point> accelerationsOf(const LoadInput& input) {
  const auto& [mesh, materials, settings] = input;
  std::vector<Point> accelerations(mesh.bodies.size(), settings.gravity.in(mesh.dimension));
  for (const auto& [body, given] : settings.accelerations) {
    const auto found = std::ranges::find(mesh.bodies, body);
    if (found == mesh.bodies.end())
      throw Error("option " + accelerationName(body) + ": '" + body +
                  "' is not a body (a group with a material)");
    Point& sum = accelerations[found - mesh.bodies.begin()];
    sum = mesh::plus(sum, given.in(mesh.dimension));
  }
  return accelerations;
}

/// Adds the pressures.
void addPressures(const LoadInput& input, const SurfaceLoads& loads) {
  const auto& [mesh, materials, settings] = input;
  std::vector<double> pressure;
  std::vector<bool> isHydraulic;
  for (const auto& surface : mesh.surfaces) {
    const auto given = settings.pressure.find(surface);
    pressure.push_back(given == settings.pressure.end() ? 0 : given->second);
    isHydraulic.push_back(!settings.constantPressure.contains(surface));
  }
  for (const auto& block : mesh.faces)
    for (std::size_t e = 0; e < block.surface.size(); ++e) {
      const double p = pressure[block.surface[e]];
      const auto nodes = block.nodesOf(e);
      if (p != 0)
        addLoad(isHydraulic[block.surface[e]] ? loads.hydraulic : loads.constant, mesh, nodes,
                faceNormals(shapeTable(block.type), pointsOf(mesh, nodes), block.sign[e]), -p);
    }
}

}  // namespace

OwnedVec centrifugalForces(const LoadInput& input, const std::vector<Motion>& motions) {
  const auto& [mesh, materials, settings] = input;
  OwnedVec forces = nodalVector(mesh);
  if (settings.centrifugal)
    forEachCell(mesh, [&](const mesh::CellBlock& block, std::size_t e, const ShapeTable& table,
                          const std::vector<Point>& points) {
      const Motion& motion = motions[block.body[e]];
      if (motion.speed != 0)
        addLoad(forces, input.mesh, block.nodesOf(e),
                centrifugal(table, points, input.materials[block.material[e]].density, motion), 1);
    });
  assembled(forces);
  return forces;
}

OwnedVec bodyForces(const LoadInput& input, std::optional<int> material) {
  const auto& [mesh, materials, settings] = input;
  OwnedVec forces = nodalVector(mesh);
  const auto accelerations = accelerationsOf(input);
  const auto spins = motionsOf(mesh.bodies, mesh.dimension, settings.spins);
  forEachCell(mesh, [&](const mesh::CellBlock& block, std::size_t e, const ShapeTable& table,
                        const std::vector<Point>& points) {
    const int own = block.body[e];
    if (material && block.material[e] != *material) return;
    const double density = input.materials[block.material[e]].density;
    const auto nodes = block.nodesOf(e);
    if (accelerations[own] != Point{}) {
      const std::size_t count = nodes.size();
      const auto m = mass(table, points, density, MassKind::consistent);
      std::vector<double> force(3 * count, 0.0);
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j)
          for (std::size_t d = 0; d < 3; ++d)
            force[3 * i + d] += m[i * count + j] * accelerations[own][d];
      addLoad(forces, input.mesh, nodes, force, 1);
    }
    if (spins[own].speed != 0)
      addLoad(forces, input.mesh, nodes, centrifugal(table, points, density, spins[own]), 1);
  });
  assembled(forces);
  return forces;
}

SurfaceLoads surfaceLoads(const LoadInput& input, const std::vector<attachments::Form>& masses) {
  const mesh::Mesh& mesh = input.mesh;
  SurfaceLoads loads{nodalVector(mesh), nodalVector(mesh)};
  addPressures(input, loads);
  for (const auto& [node, value, hydraulic] :
       attachments::forcesOf(mesh, input.settings.attachments))
    addVector(hydraulic ? loads.hydraulic : loads.constant, mesh.dimension, node, value);
  const Point gravity = input.settings.gravity.in(mesh.dimension);
  if (mpi::rank(mesh.comm) == 0)
    for (const auto& mass : masses)
      for (const auto& term : mass.terms)
        addVector(loads.constant, mesh.dimension, term.node,
                  mesh::scaled(term.direction, mass.mass * mesh::dot(mass.accelerated, gravity)));
  assembled(loads.hydraulic);
  assembled(loads.constant);
  return loads;
}

}  // namespace squeal::elasticity
