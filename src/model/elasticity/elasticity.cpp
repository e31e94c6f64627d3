// SPDX-License-Identifier: BSD-2-Clause
#include "model/elasticity/elasticity.hpp"

#include <algorithm>

#include "base/petsc/arrays.hpp"
#include "base/session/stages.hpp"
#include "base/system/error.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/attachments/forms.hpp"
#include "model/elasticity/assembly.hpp"
#include "model/elasticity/attached_parts.hpp"
#include "model/elasticity/carried_axes.hpp"
#include "model/elasticity/convection.hpp"
#include "model/elasticity/element.hpp"
#include "model/elasticity/ground.hpp"
#include "model/elasticity/hourglass.hpp"
#include "model/elasticity/inertia.hpp"
#include "model/elasticity/loads.hpp"
#include "model/material/material.hpp"

namespace squeal::elasticity {
namespace {

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (auto& value : values) value *= factor;
  return values;
}

/// Repeats a scalar matrix on each component, with rows and columns [node][component].
std::vector<double> onAllComponents(const std::vector<double>& scalar, int count, int dimension) {
  const int size = count * dimension;
  std::vector<double> full(size * size, 0.0);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      for (int d = 0; d < dimension; ++d)
        full[(i * dimension + d) * size + j * dimension + d] = scalar[i * count + j];
  return full;
}

/// Returns the table of a cell for its stiffness.
const ShapeTable& stiffnessRule(const Material& material, const ShapeTable& table,
                                const std::vector<Point>& points) {
  return material.reducedIntegration ? *element::underintegratedTable(table.type)
                                     : gradientTable(table, points);
}

/// Selects the cells of one material group, or all.
CellFilter cellsOf(std::optional<int> material) {
  return [material](const mesh::CellBlock& block, std::size_t e) {
    return !material || block.material[e] == *material;
  };
}

constexpr double leastLocking = 0.49;  // the bulk modulus is 50 times the shear modulus

/// Collective. Warns of nearly incompressible materials with linear cells.
void warnOfLocking(const mesh::Mesh& mesh, const Bodies& bodies) {
  const auto& materials = bodies.materials;
  const auto counts = linearCells(mesh, bodies.settings);
  for (std::size_t m = 0; m < counts.size(); ++m)
    if (counts[m] > 0 && locks(materials[m].poisson))
      printWarning(
          mesh.comm,
          formatted("warning: %s, with a Poisson's ratio of %.6g, has %" PetscInt_FMT
                    " linear cells, which lock above %g: use a mesh of second order",
                    mesh.materialText(m).c_str(), materials[m].poisson, counts[m], leastLocking));
}

/// The matrices of all cells, or of those of one material group.
struct CellMatrices {
  Assembly stiffness, mass;
  std::optional<Assembly> damping;  // C = α M + (β + η / 2πf) K, dashpots
};

/// Collective. Sums over the cells that `uses` selects. The damping matrix is formed if a ground is
/// given, with entries for its dashpots, and if anything damps.
CellMatrices cellMatrices(const mesh::Mesh& mesh, const Bodies& bodies, const CellFilter& uses,
                          const Ground* ground) {
  const auto& materials = bodies.materials;
  const NodePattern pattern(mesh, uses);
  CellMatrices sums{{mesh, pattern, false}, {mesh, pattern, true}, {}};
  const auto any = [&](double Material::*damping) {
    return std::ranges::any_of(materials, [&](const auto& given) { return given.*damping > 0; });
  };
  const bool stiff = any(&Material::stiffnessDamping);
  if (ground && (stiff || any(&Material::massDamping) || ground->dashpots))
    sums.damping.emplace(mesh, pattern, !stiff && !ground->turnedDashpots);
  forEachCell(mesh, [&](const mesh::CellBlock& block, std::size_t e, const ShapeTable& table,
                        const std::vector<Point>& points) {
    if (!uses(block, e)) return;
    const Material& material = materials[block.material[e]];
    const auto nodes = block.nodesOf(e);
    const bool bubbles = bodies.settings.isIncompatible(table.name);
    const auto cellStiffness =
        stiffness(stiffnessRule(material, table, points), points, material.law, bubbles);
    const auto cellMass = mass(table, points, material.density, bodies.settings.mass);
    sums.stiffness.add(nodes, cellStiffness, false);
    sums.mass.add(nodes, cellMass, true);
    if (!sums.damping) return;
    if (material.massDamping > 0)
      sums.damping->add(nodes, scaled(cellMass, material.massDamping), true);
    if (material.stiffnessDamping > 0)
      sums.damping->add(nodes, scaled(cellStiffness, material.stiffnessDamping), false);
  });
  return sums;
}

/// Throws Error for a motion or a body force of a section: they are those of whole bodies.
void rejectSections(const mesh::Mesh& mesh, const Settings& settings) {
  const auto reject = [&](const std::string& name, const std::string& option) {
    for (const auto& group : mesh.materialGroups)
      if (group.isSection && group.name == name)
        throw Error("option " + option + ": '" + name + "' is not a body but a section of '" +
                    mesh.bodies[group.body] + "'; give the option for the body");
  };
  for (const auto& [name, motion] : settings.motions) reject(name, motion.option);
  for (const auto& [name, spin] : settings.spins) reject(name, spin.option);
  for (const auto& [name, given] : settings.accelerations) reject(name, accelerationName(name));
}

void assembleMatrices(const mesh::Mesh& mesh, Bodies& bodies) {
  Ground ground = groundOf(mesh, bodies.settings);
  auto sums = cellMatrices(mesh, bodies, cellsOf({}), &ground);
  sums.stiffness.addRows(ground.springs);
  bodies.stiffness = sums.stiffness.finish(SymmetryClass::rounded);
  bodies.mass = sums.mass.finish(SymmetryClass::rounded);
  bodies.springs = std::move(ground.springs);
  if (!sums.damping) return;
  sums.damping->addRows(ground.dashpots);
  bodies.damping = sums.damping->finish(SymmetryClass::rounded);
}

/// Collective. Adds a matrix, which may be null, to another one, which is created if it is null.
void addMatrix(OwnedMat& sum, Mat matrix) {
  if (!matrix) return;
  if (!sum)
    check(MatDuplicate(matrix, MAT_COPY_VALUES, sum.out()));
  else
    check(MatAXPY(sum, 1, matrix, DIFFERENT_NONZERO_PATTERN));
  check(MatSetOption(sum, MAT_SYMMETRIC, PETSC_TRUE));
}

/// Collective. Adds springs, bushings and point masses to the matrices.
void attach(const mesh::Mesh& mesh, const std::vector<attachments::Form>& masses, Bodies& bodies) {
  using attachments::Form;
  bodies.links = attachments::linksOf(mesh, bodies.settings.attachments);
  bodies.linkStiffness = formMatrix(mesh, bodies.links, &Form::stiffness);
  addMatrix(bodies.stiffness, bodies.linkStiffness);
  addMatrix(bodies.damping, formMatrix(mesh, bodies.links, &Form::damping));
  addMatrix(bodies.mass, formMatrix(mesh, masses, &Form::mass));
}

/// Collective. Adds the terms of point masses that move with a body.
void carry(const mesh::Mesh& mesh, Bodies& bodies) {
  const auto& settings = bodies.settings;
  if (settings.centrifugal && !bodies.carried.empty())
    addCentrifugal(mesh, bodies.carried, bodies.motions, bodies.centrifugal);
  if (!settings.convective) return;
  const OwnedMat spin = gyroscopicOf(mesh, bodies.carried, bodies.motions);
  if (!spin) return;
  check(MatAXPY(bodies.gyroscopic, 1, spin, DIFFERENT_NONZERO_PATTERN));
  check(MatSetOption(bodies.gyroscopic, MAT_SYMMETRIC, PETSC_FALSE));
}

/// Collective. Sets the loads.
void assembleLoads(const mesh::Mesh& mesh, const std::vector<attachments::Form>& masses,
                   Bodies& bodies) {
  const LoadInput input{mesh, bodies.materials, bodies.settings};
  bodies.centrifugal = centrifugalForces(input, bodies.motions);
  carry(mesh, bodies);
  auto [hydraulic, constant] = surfaceLoads(input, masses);
  if (bodies.settings.bodyForces) check(VecAXPY(constant, 1, bodyForces(input, {})));
  bodies.load = std::move(hydraulic);
  check(VecAXPY(bodies.load, 1, bodies.centrifugal));
  check(VecAXPY(bodies.load, 1, constant));
  PetscReal size = 0;
  check(VecNorm(constant, NORM_INFINITY, &size));
  if (size > 0) bodies.constantLoad = std::move(constant);
}

}  // namespace

Bodies withLayers(Bodies bodies, OwnedMat stiffness) {
  addMatrix(bodies.stiffness, stiffness);
  bodies.layerStiffness = std::move(stiffness);
  return bodies;
}

bool locks(double poisson) { return poisson > leastLocking; }

std::vector<PetscInt> linearCells(const mesh::Mesh& mesh, const Settings& settings) {
  std::vector<PetscInt> counts(mesh.materialGroups.size(), 0);
  for (const auto& block : mesh.cells) {
    const ShapeTable& table = shapeTable(block.type);
    if (table.order == 1 && !settings.isIncompatible(table.name))
      for (const int material : block.material) ++counts[material];
  }
  mpi::reduce<PetscInt>(mesh.comm, counts, MPI_SUM);
  return counts;
}

OwnedVec nodalVector(const mesh::Mesh& mesh) {
  OwnedVec vector;
  check(VecCreate(mesh.comm, vector.out()));
  check(VecSetSizes(vector, mesh.dimension * mesh.ownedNodes, PETSC_DETERMINE));
  check(VecSetBlockSize(vector, mesh.dimension));
  check(VecSetType(vector, VECSTANDARD));
  return vector;
}

Bodies assemble(const mesh::Mesh& mesh, const material::Settings& materials,
                const std::vector<constraints::CouplingSettings>& couplings,
                const Settings& settings) {
  Bodies bodies;
  bodies.settings = settings;
  rejectSections(mesh, settings);
  bodies.motions = motionsOf(mesh.bodies, mesh.dimension, settings.motions);
  bodies.materials = material::materialsOf(mesh, materials);
  requireHex20(mesh, bodies.materials);
  requireMaterialAxes(mesh, bodies.materials);
  checkCarriedAxes(mesh, bodies.materials, bodies.motions, settings.convective);
  assembleMatrices(mesh, bodies);
  bodies.exposed = exposedCells(mesh, bodies.materials);
  warnOfHourglass(mesh, bodies.exposed);
  warnOfFoldedCells(mesh);
  warnOfLocking(mesh, bodies);
  if (settings.convective) {
    auto terms = convectiveTerms(mesh, bodies.materials, bodies.motions);
    bodies.gyroscopic = std::move(terms.gyroscopic);
    bodies.rotationStiffness = std::move(terms.rotationStiffness);
  }
  const auto masses = attachments::massesOf(mesh, settings.attachments);
  attach(mesh, masses, bodies);
  bodies.carried = carriedMasses(mesh, settings, couplings, bodies.motions);
  assembleLoads(mesh, masses, bodies);
  return bodies;
}

MaterialPart materialPart(const mesh::Mesh& mesh, const Bodies& bodies, int group) {
  const int body = mesh.materialGroups[group].body;
  std::vector<Motion> motions(bodies.motions.size());
  motions[body] = bodies.motions[body];
  auto sums = cellMatrices(mesh, bodies, cellsOf(group), nullptr);
  // These terms are linear in the densities.
  auto materials = bodies.materials;
  for (int m = 0; m < std::ssize(materials); ++m)
    if (m != group) materials[m].density = 0;
  ConvectiveTerms terms;
  if (bodies.settings.convective) terms = convectiveTerms(mesh, materials, motions);
  MaterialPart part;
  part.gyroscopic = std::move(terms.gyroscopic);
  part.rotationStiffness = std::move(terms.rotationStiffness);
  const LoadInput input{mesh, materials, bodies.settings};
  part.centrifugal = centrifugalForces(input, motions);
  if (bodies.settings.bodyForces) part.weight = bodyForces(input, group);
  part.stiffness = sums.stiffness.finish(SymmetryClass::rounded);
  part.mass = sums.mass.finish(SymmetryClass::rounded);
  part.massDamping = bodies.materials[group].massDamping;
  part.stiffnessDamping = bodies.materials[group].stiffnessDamping;
  return part;
}

MaterialRows materialRows(const mesh::Mesh& mesh, const Bodies& bodies, int group,
                          const std::vector<PetscInt>& nodes) {
  const OwnedVec marked = nodalVector(mesh);
  {
    const WriteArray values(marked);
    for (const PetscInt node : nodes) values[mesh.dimension * node] = 1;
  }
  const CellFilter uses = [&, marks = localValues(mesh, marked)](const mesh::CellBlock& block,
                                                                 std::size_t e) {
    return block.material[e] == group && std::ranges::any_of(block.nodesOf(e), [&](PetscInt node) {
             return marks[mesh.dimension * node] == 1;
           });
  };
  auto sums = cellMatrices(mesh, bodies, uses, nullptr);
  const OwnedIS own = rowsOf(mesh, nodes);
  MaterialRows part;
  const auto keep = [&](Assembly& sum, OwnedMat& kept) {
    const OwnedMat all = sum.finish(SymmetryClass::rounded);
    check(MatCreateSubMatrix(all, own, nullptr, MAT_INITIAL_MATRIX, kept.out()));
  };
  keep(sums.stiffness, part.stiffness);
  keep(sums.mass, part.mass);
  return part;
}

OwnedMat geometricStiffness(const mesh::Mesh& mesh, const Bodies& bodies, Vec displacement,
                            std::optional<int> group) {
  const auto values = localValues(mesh, displacement);
  const CellFilter uses = cellsOf(group);
  const NodePattern pattern(mesh, uses);
  Assembly k(mesh, pattern, false);
  forEachCell(mesh, [&](const mesh::CellBlock& block, std::size_t e, const ShapeTable& table,
                        const std::vector<Point>& points) {
    if (!uses(block, e)) return;
    const auto nodes = block.nodesOf(e);
    std::vector<double> u;
    for (PetscInt node : nodes)
      for (int d = 0; d < mesh.dimension; ++d) u.push_back(values[mesh.dimension * node + d]);
    const bool bubbles = bodies.settings.isIncompatible(table.name);
    const Material& material = bodies.materials[block.material[e]];
    const auto cell = geometricStiffness(stiffnessRule(material, table, points), points,
                                         material.law, bubbles, u);
    k.add(nodes, onAllComponents(cell, block.nodesPerCell, mesh.dimension), false);  // pattern of K
  });
  return k.finish(SymmetryClass::symmetric);
}

OwnedIS rowsOf(const mesh::Mesh& mesh, const std::vector<PetscInt>& nodes) {
  std::vector<PetscInt> rows;
  for (const PetscInt node : nodes)
    for (int d = 0; d < mesh.dimension; ++d)
      rows.push_back(mesh.dimension * (mesh.firstNode + node) + d);
  OwnedIS own;
  check(ISCreateGeneral(mesh.comm, rows.size(), rows.data(), PETSC_COPY_VALUES, own.out()));
  return own;
}

std::vector<double> localValues(const mesh::Mesh& mesh, Vec u) {
  OwnedIS nodes;
  OwnedVec local;
  OwnedScatter scatter;
  check(ISCreateBlock(PETSC_COMM_SELF, mesh.dimension, mesh.localNodes(), mesh.globalNode.data(),
                      PETSC_COPY_VALUES, nodes.out()));
  check(VecCreateSeq(PETSC_COMM_SELF, mesh.dimension * mesh.localNodes(), local.out()));
  check(VecScatterCreate(u, nodes, local, nullptr, scatter.out()));
  check(VecScatterBegin(scatter, u, local, INSERT_VALUES, SCATTER_FORWARD));
  check(VecScatterEnd(scatter, u, local, INSERT_VALUES, SCATTER_FORWARD));
  const ReadArray values(local);
  return {values.begin(), values.end()};
}

}  // namespace squeal::elasticity
