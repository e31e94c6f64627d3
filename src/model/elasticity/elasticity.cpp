#include "model/elasticity/elasticity.hpp"

#include <algorithm>

#include "base/options/options.hpp"
#include "base/petsc/arrays.hpp"
#include "base/session/stages.hpp"
#include "base/system/text.hpp"
#include "model/elasticity/assembly.hpp"
#include "model/elasticity/convection.hpp"
#include "model/elasticity/element.hpp"
#include "model/elasticity/face.hpp"
#include "model/elasticity/ground.hpp"
#include "model/elasticity/inertia.hpp"
#include "model/material/material.hpp"

namespace squeal::elasticity {
namespace {

const ChoiceOption massOption("elasticity", "elasticity_mass", {"consistent", "higher_order"},
                              "consistent",
                              "mass matrix; higher_order: mean of consistent and lumped, "
                              "fourth-order frequencies on linear elements");
const TextOption incompatibleOption(
    "elasticity", "elasticity_incompatible_modes", "hex8",
    "element types (quad4, hex8) given incompatible bending modes, or none");
const FlagOption prestressOption(
    "elasticity", "elasticity_prestress", false,
    "on: the stress of steady sliding stiffens or softens the vibrations (geometric stiffness)");
const RealOption pressureOption("load", "load_<group>_pressure", 0.0, "Pa", anyReal,
                                "pressure on a surface group, positive inwards");
const FlagOption centrifugalOption("load", "load_centrifugal", true,
                                   "centrifugal forces on rotating bodies");

std::vector<std::string> incompatibleElements() {
  auto names = incompatibleOption.list();
  if (names == std::vector<std::string>{"none"}) names.clear();
  for (const auto& name : names)
    if (name != "quad4" && name != "hex8")
      throw Error("option -elasticity_incompatible_modes " + incompatibleOption.get() +
                  ": must be none or a list of quad4, hex8");
  return names;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (auto& value : values) value *= factor;
  return values;
}

/// Returns the matrix that has the same scalar matrix on each component, with rows and columns
/// [node][component].
std::vector<double> onAllComponents(const std::vector<double>& scalar, int count, int dimension) {
  const int size = count * dimension;
  std::vector<double> full(size * size, 0.0);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      for (int d = 0; d < dimension; ++d)
        full[(i * dimension + d) * size + j * dimension + d] = scalar[i * count + j];
  return full;
}

/// Selects the cells of one body, or all.
CellFilter cellsOf(std::optional<int> body) {
  return [body](const mesh::CellBlock& block, std::size_t e) {
    return !body || block.body[e] == *body;
  };
}

/// Collective. Warns of bodies that hardly change their volume and have linear cells, which then
/// lock: such a cell cannot keep the volume at each point of its rule and deform otherwise.
/// Incompatible modes give the cell this freedom.
void warnOfLocking(const mesh::Mesh& mesh, const std::vector<Material>& materials) {
  constexpr double least = 0.49;  // the bulk modulus is 50 times the shear modulus
  const auto incompatible = incompatibleElements();
  std::vector<PetscInt> counts(materials.size(), 0);
  forEachCell(mesh, [&](const mesh::CellBlock& block, std::size_t e, const ShapeTable& table,
                        const std::vector<Point>&) {
    if (table.order == 1 && std::ranges::find(incompatible, table.name) == incompatible.end())
      ++counts[block.body[e]];
  });
  check(MPI_Allreduce(MPI_IN_PLACE, counts.data(), counts.size(), MPIU_INT, MPI_SUM, mesh.comm));
  for (std::size_t b = 0; b < counts.size(); ++b)
    if (counts[b] > 0 && materials[b].poisson > least)
      complain(mesh.comm,
               formatted("warning: body '%s', with a Poisson's ratio of %.6g, has %" PetscInt_FMT
                         " linear cells, which lock above %g: they are too stiff; use a mesh of "
                         "second order",
                         mesh.bodies[b].c_str(), materials[b].poisson, counts[b], least));
}

/// The matrices of all cells, or of those of one body.
struct CellMatrices {
  Assembly stiffness, mass;
  std::optional<Assembly> damping;  // C = α M + (β + η / 2πf) K, dashpots
};

/// Collective. Sums over the cells. `dashpots` tells whether there are any.
CellMatrices cellMatrices(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                          std::optional<int> body, bool dashpots) {
  const auto incompatible = incompatibleElements();
  const MassKind kind =
      massOption.get() == "consistent" ? MassKind::consistent : MassKind::higherOrder;
  const CellFilter uses = cellsOf(body);
  const NodePattern pattern(mesh, uses);
  CellMatrices sums{{mesh, pattern, false}, {mesh, pattern, true}, {}};
  const auto any = [&](double Material::*damping) {
    return std::ranges::any_of(materials, [&](const auto& given) { return given.*damping > 0; });
  };
  const bool stiff = any(&Material::stiffnessDamping);
  if (!body && (stiff || any(&Material::massDamping) || dashpots))
    sums.damping.emplace(mesh, pattern, !stiff);
  forEachCell(mesh, [&](const mesh::CellBlock& block, std::size_t e, const ShapeTable& table,
                        const std::vector<Point>& points) {
    if (!uses(block, e)) return;
    const Material& material = materials[block.body[e]];
    const auto nodes = block.nodesOf(e);
    const bool bubbles =
        std::find(incompatible.begin(), incompatible.end(), table.name) != incompatible.end();
    const auto cellStiffness =
        stiffness(gradientTable(table, points), points, material.law, bubbles);
    const auto cellMass = mass(table, points, material.density, kind);
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

void assembleMatrices(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                      Bodies& bodies) {
  Ground ground = readGround(mesh);
  auto sums = cellMatrices(mesh, materials, {}, ground.dashpots.get() != nullptr);
  sums.stiffness.addDiagonal(ground.springs);
  bodies.stiffness = sums.stiffness.finish(Symmetry::rounded);
  bodies.mass = sums.mass.finish(Symmetry::rounded);
  bodies.springs = std::move(ground.springs);
  if (!sums.damping) return;
  sums.damping->addDiagonal(ground.dashpots);
  bodies.damping = sums.damping->finish(Symmetry::rounded);
}

void assembleCentrifugal(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                         Bodies& bodies) {
  bodies.centrifugal = nodalVector(mesh);
  if (centrifugalOption.get())
    forEachCell(mesh, [&](const mesh::CellBlock& block, std::size_t e, const ShapeTable& table,
                          const std::vector<Point>& points) {
      const Motion& motion = bodies.motions[block.body[e]];
      if (motion.speed != 0)
        addLoad(bodies.centrifugal, mesh, block.nodesOf(e),
                centrifugal(table, points, materials[block.body[e]].density, motion.speed,
                            motion.axis, motion.origin),
                1);
    });
  check(VecAssemblyBegin(bodies.centrifugal));
  check(VecAssemblyEnd(bodies.centrifugal));
}

void assembleLoad(const mesh::Mesh& mesh, Bodies& bodies) {
  bodies.load = nodalVector(mesh);
  std::vector<double> pressure;
  for (const auto& surface : mesh.surfaces) pressure.push_back(pressureOption.get(surface));
  for (const auto& block : mesh.faces)
    for (std::size_t e = 0; e < block.surface.size(); ++e) {
      const double p = pressure[block.surface[e]];
      const auto nodes = block.nodesOf(e);
      if (p != 0)
        addLoad(bodies.load, mesh, nodes,
                faceNormals(shapeTable(block.type), pointsOf(mesh, nodes), block.sign[e]), -p);
    }
  check(VecAssemblyBegin(bodies.load));
  check(VecAssemblyEnd(bodies.load));
  check(VecAXPY(bodies.load, 1, bodies.centrifugal));
}

}  // namespace

std::vector<mesh::GroupRequest> loadedSurfaces() {
  std::vector<mesh::GroupRequest> requests;
  for (const auto& surface : pressureOption.subjects())
    requests.push_back({surface, "-" + pressureOption.fullName(surface)});
  return requests;
}

bool prestressWanted() { return prestressOption.get(); }

OwnedVec nodalVector(const mesh::Mesh& mesh) {
  OwnedVec vector;
  check(VecCreate(mesh.comm, vector.out()));
  check(VecSetSizes(vector, mesh.dimension * mesh.ownedNodes, PETSC_DETERMINE));
  check(VecSetBlockSize(vector, mesh.dimension));
  check(VecSetType(vector, VECSTANDARD));
  return vector;
}

Bodies assemble(const mesh::Mesh& mesh) {
  Bodies bodies;
  bodies.motions = readMotions(mesh.bodies, mesh.dimension);
  const auto materials = material::readMaterials(mesh);
  assembleMatrices(mesh, materials, bodies);
  warnOfFoldedCells(mesh);
  warnOfLocking(mesh, materials);
  if (convectiveTerms()) assembleConvection(mesh, materials, bodies);
  assembleCentrifugal(mesh, materials, bodies);
  assembleLoad(mesh, bodies);
  return bodies;
}

BodyPart bodyPart(const mesh::Mesh& mesh, int body) {
  Bodies alone;
  alone.motions = readMotions(mesh.bodies, mesh.dimension);
  for (int i = 0; i < std::ssize(alone.motions); ++i)
    if (i != body) alone.motions[i] = {};
  const auto materials = material::readMaterials(mesh);
  auto sums = cellMatrices(mesh, materials, body, false);
  if (convectiveTerms()) assembleConvection(mesh, materials, alone);
  assembleCentrifugal(mesh, materials, alone);
  const Material& material = materials[body];
  return {sums.stiffness.finish(Symmetry::rounded),
          sums.mass.finish(Symmetry::rounded),
          std::move(alone.gyroscopic),
          std::move(alone.rotationStiffness),
          std::move(alone.centrifugal),
          material.massDamping,
          material.stiffnessDamping};
}

OwnedMat geometricStiffness(const mesh::Mesh& mesh, Vec displacement, std::optional<int> body) {
  const auto materials = material::readMaterials(mesh);
  const auto incompatible = incompatibleElements();
  const auto values = localValues(mesh, displacement);
  const CellFilter uses = cellsOf(body);
  const NodePattern pattern(mesh, uses);
  Assembly k(mesh, pattern, false);
  forEachCell(mesh, [&](const mesh::CellBlock& block, std::size_t e, const ShapeTable& table,
                        const std::vector<Point>& points) {
    if (!uses(block, e)) return;
    const auto nodes = block.nodesOf(e);
    std::vector<double> u;
    for (PetscInt node : nodes)
      for (int d = 0; d < mesh.dimension; ++d) u.push_back(values[mesh.dimension * node + d]);
    const bool bubbles =
        std::find(incompatible.begin(), incompatible.end(), table.name) != incompatible.end();
    const auto cell = geometricStiffness(gradientTable(table, points), points,
                                         materials[block.body[e]].law, bubbles, u);
    k.add(nodes, onAllComponents(cell, block.nodesPerCell, mesh.dimension), false);  // pattern of K
  });
  return k.finish(Symmetry::symmetric);
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
