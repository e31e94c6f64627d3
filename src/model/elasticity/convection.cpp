// SPDX-License-Identifier: BSD-2-Clause
#include "model/elasticity/convection.hpp"

#include <algorithm>
#include <cmath>

#include "base/petsc/arrays.hpp"
#include "base/system/text.hpp"
#include "model/elasticity/assembly.hpp"
#include "model/elasticity/inertia.hpp"

namespace squeal::elasticity {
namespace {

/// The flux of matter through the surface of one body at each node i, and its scale:
///   flux cᵢ = ∮ φᵢ V·n dA = Σ_cells ∫ Dφᵢ,   scale = Σ_cells ∫ |Dφᵢ|.
struct Crossing {
  OwnedVec flux, scale;
};

OwnedVec nodeScalars(const mesh::Mesh& mesh) {
  OwnedVec vector;
  check(VecCreateMPI(mesh.comm, mesh.ownedNodes, PETSC_DETERMINE, vector.out()));
  return vector;
}

void assembled(Vec vector) {
  check(VecAssemblyBegin(vector));
  check(VecAssemblyEnd(vector));
}

/// Adds the values of periodic images to those of their primaries: the flux out of one surface
/// enters through the other.
void fold(const mesh::Mesh& mesh, Vec vector) {
  std::vector<double> values;
  for (const ReadArray array(vector); const auto& image : mesh.images)
    values.push_back(array[image.node]);
  for (std::size_t i = 0; i < mesh.images.size(); ++i) {
    check(VecSetValue(vector, mesh.images[i].primary, values[i], ADD_VALUES));
    check(VecSetValue(vector, mesh.firstNode + mesh.images[i].node, -values[i], ADD_VALUES));
  }
  assembled(vector);
}

/// Collective. Throws Error if the flux is too large for a body that does not change its place. A
/// faceted body of revolution has a small flux: none if neighbouring facets have equal lengths,
/// 0.015 of the scale on unstructured tetrahedra, and 0.14 with 12 facets whose neighbours have a
/// ratio of lengths of 2 to 1. A square body reaches 0.5 to 1, and an axis off the centre by a
/// tenth of the radius 0.24.
void rejectCrossing(const mesh::Mesh& mesh, const std::string& subject, const Motion& motion,
                    Crossing& crossing) {
  const double tolerance = motion.speed != 0 ? 0.15 : 1e-6;
  for (Vec vector : {crossing.flux.get(), crossing.scale.get()})
    assembled(vector), fold(mesh, vector);
  const ReadArray flux(crossing.flux), scale(crossing.scale);
  double worst = tolerance;
  PetscInt where = -1;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    if (scale[node] > 0 && std::abs(flux[node]) > worst * scale[node])
      worst = std::abs(flux[node]) / scale[node], where = node;
  std::string failure;
  if (where >= 0) {
    const Point& x = mesh.coordinates[where];
    failure = "option -motion_convective: " + subject +
              " is not a figure of revolution about its axis (or not uniform along its "
              "translation): its matter crosses its " +
              formatted("surface at (%g, %g, %g); use -motion_convective off (approximation A)",
                        x[0], x[1], x[2]);
  }
  failTogether(mesh.comm, failure);
}

}  // namespace

ConvectiveTerms convectiveTerms(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                                const std::vector<Motion>& motions) {
  if (std::ranges::none_of(motions, &Motion::moves)) return {};
  // Matter that crosses the boundary of a section would change its material.
  const auto motionOf = [&](std::size_t group) -> const Motion& {
    return motions[mesh.materialGroups[group].body];
  };
  std::vector<Crossing> crossing(mesh.materialGroups.size());
  for (std::size_t m = 0; m < crossing.size(); ++m)
    if (motionOf(m).moves()) crossing[m] = {nodeScalars(mesh), nodeScalars(mesh)};
  const NodePattern pattern(mesh, [&](const mesh::CellBlock& block, std::size_t e) {
    return motions[block.body[e]].moves();
  });
  Assembly g(mesh, pattern, true), k(mesh, pattern, true);
  forEachCell(mesh, [&](const mesh::CellBlock& block, std::size_t e, const ShapeTable& table,
                        const std::vector<Point>& points) {
    const int material = block.material[e];
    const Motion& motion = motions[block.body[e]];
    if (!motion.moves()) return;
    std::vector<Point> velocity;
    for (const auto& x : points) velocity.push_back(motion.velocity(x));
    const Convection cell =
        convection(gradientTable(table, points), points, velocity, materials[material].density);
    const auto nodes = block.nodesOf(e);
    g.add(nodes, cell.gyroscopic, true);
    k.add(nodes, cell.rotationStiffness, true);
    for (int i = 0; i < block.nodesPerCell; ++i) {
      const PetscInt node = mesh.globalNode[nodes[i]];
      check(VecSetValue(crossing[material].flux, node, cell.flux[i], ADD_VALUES));
      check(VecSetValue(crossing[material].scale, node, cell.fluxScale[i], ADD_VALUES));
    }
  });
  for (std::size_t m = 0; m < crossing.size(); ++m)
    if (crossing[m].flux) rejectCrossing(mesh, mesh.materialText(m), motionOf(m), crossing[m]);
  ConvectiveTerms terms;
  terms.gyroscopic = g.finish(SymmetryClass::skew);
  terms.rotationStiffness = k.finish(SymmetryClass::symmetric);
  return terms;
}

}  // namespace squeal::elasticity
