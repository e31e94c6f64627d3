#include "elasticity/elasticity.hpp"

#include <algorithm>

#include "elasticity/element.hpp"
#include "petsc/options.hpp"
#include "petsc/text.hpp"

namespace squeal::elasticity {
namespace {

const RealOption youngOption("elasticity", "material_<group>_young", std::nullopt, "Pa", positive, "Young's modulus of the body");
const RealOption poissonOption("elasticity", "material_<group>_poisson", std::nullopt, "", {-1, 0.5, true, true},
                               "Poisson's ratio of the body");
const RealOption densityOption("elasticity", "material_<group>_density", std::nullopt, "kg/m3", positive,
                               "mass density of the body");
const ChoiceOption massOption(
    "elasticity", "elasticity_mass", {"consistent", "higher_order"}, "consistent",
    "mass matrix; higher_order: mean of consistent and lumped, fourth-order frequencies on linear elements");
const TextOption incompatibleOption("elasticity", "elasticity_incompatible_modes", "hex8",
                                    "element types (quad4, hex8) given incompatible bending modes, or none");
const ChoiceOption planeOption("elasticity", "elasticity_plane", {"strain", "stress"}, "strain",
                               "plane problems: plane strain or plane stress");
const RealOption pressureOption("load", "load_<group>_pressure", 0.0, "Pa", anyReal,
                                "pressure on a surface group, positive inwards");
const FlagOption centrifugalOption("load", "load_centrifugal", true, "centrifugal forces on rotating bodies");

struct Material {
  Hooke hooke;
  double density;
};

std::vector<Material> readMaterials(const mesh::Mesh& mesh) {
  const bool planeStress = planeOption.get() == "stress";
  std::vector<Material> materials;
  for (const auto& body : mesh.bodies)
    materials.push_back(
        {isotropic(youngOption.get(body), poissonOption.get(body), mesh.dimension, planeStress), densityOption.get(body)});
  return materials;
}

std::vector<std::string> incompatibleElements() {
  auto names = incompatibleOption.list();
  if (names == std::vector<std::string>{"none"}) names.clear();
  for (const auto& name : names)
    if (name != "quad4" && name != "hex8")
      throw Error("option -elasticity_incompatible_modes " + incompatibleOption.get() + ": must be none or a list of quad4, hex8");
  return names;
}

std::vector<Point> cellNodes(const mesh::Mesh& mesh, const PetscInt* nodes, int count) {
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) points.push_back(mesh.coordinates[static_cast<std::size_t>(nodes[i])]);
  return points;
}

/// Entries of a matrix as (row, column, value) triples, the interface of MatSetPreallocationCOO.
struct Triples {
  std::vector<PetscInt> row, column;
  std::vector<PetscScalar> value;
  void reserve(std::size_t count) { row.reserve(count), column.reserve(count), value.reserve(count); }
};

OwnedMat toMatrix(const mesh::Mesh& mesh, Triples& triples) {
  OwnedMat matrix;
  const PetscInt owned = mesh.dimension * mesh.ownedNodes;
  check(MatCreate(mesh.comm, matrix.out()));
  check(MatSetSizes(matrix, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetBlockSize(matrix, mesh.dimension));
  check(MatSetType(matrix, MATAIJ));
  check(MatSetPreallocationCOO(matrix, static_cast<PetscCount>(triples.row.size()), triples.row.data(), triples.column.data()));
  check(MatSetValuesCOO(matrix, triples.value.data(), INSERT_VALUES));
  check(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
  return matrix;
}

/// Calls `visit(block, cell index, table, coordinates)` for each cell; where it throws InvertedElement all ranks get an Error.
template <class Visit>
void forEachCell(const mesh::Mesh& mesh, Visit visit) {
  std::string failure;
  for (const auto& block : mesh.cells) {
    const ShapeTable& table = shapeTable(block.type);
    for (std::size_t e = 0; e < block.tag.size(); ++e) try {
        visit(block, e, table,
              cellNodes(mesh, block.nodes.data() + e * static_cast<std::size_t>(block.nodesPerCell), block.nodesPerCell));
      } catch (const InvertedElement&) {
        if (failure.empty())
          failure = "inverted element: cell " + std::to_string(block.tag[e]) + " (" + table.name + ") of group '" +
                    mesh.bodies[static_cast<std::size_t>(block.body[e])] + "' has a Jacobian that is not positive";
      }
  }
  failTogether(mesh.comm, failure);
}

/// Adds the entries of one element: `components` copies of a scalar matrix, or one matrix on all components.
void append(Triples& triples, const mesh::Mesh& mesh, const PetscInt* nodes, int count, const std::vector<double>& matrix,
            bool scalar) {
  const int dimension = mesh.dimension;
  for (int i = 0; i < count; ++i)
    for (int a = 0; a < dimension; ++a)
      for (int j = 0; j < count; ++j)
        for (int b = 0; b < dimension; ++b) {
          if (scalar && a != b) continue;
          triples.row.push_back(dimension * mesh.globalNode[static_cast<std::size_t>(nodes[i])] + a);
          triples.column.push_back(dimension * mesh.globalNode[static_cast<std::size_t>(nodes[j])] + b);
          triples.value.push_back(
              scalar ? matrix[static_cast<std::size_t>(i * count + j)]
                     : matrix[static_cast<std::size_t>((i * dimension + a) * count * dimension + j * dimension + b)]);
        }
}

void assembleMatrices(const mesh::Mesh& mesh, const std::vector<Material>& materials, Bodies& bodies) {
  const auto incompatible = incompatibleElements();
  const MassKind kind = massOption.get() == "consistent" ? MassKind::consistent : MassKind::higherOrder;
  std::size_t entries = 0;
  for (const auto& block : mesh.cells)
    entries +=
        block.tag.size() * static_cast<std::size_t>(block.nodesPerCell * block.nodesPerCell * mesh.dimension * mesh.dimension);
  Triples k, m;
  k.reserve(entries);
  m.reserve(entries / static_cast<std::size_t>(mesh.dimension));
  forEachCell(mesh, [&](const mesh::CellBlock& block, std::size_t e, const ShapeTable& table, const std::vector<Point>& points) {
    const Material& material = materials[static_cast<std::size_t>(block.body[e])];
    const PetscInt* nodes = block.nodes.data() + e * static_cast<std::size_t>(block.nodesPerCell);
    const bool bubbles = std::find(incompatible.begin(), incompatible.end(), table.name) != incompatible.end();
    append(k, mesh, nodes, block.nodesPerCell, stiffness(table, points, material.hooke, bubbles), false);
    append(m, mesh, nodes, block.nodesPerCell, mass(table, points, material.density, kind), true);
  });
  bodies.stiffness = toMatrix(mesh, k);
  k = {};
  bodies.mass = toMatrix(mesh, m);
}

/// Adds [node][3] values of one element to the load.
void addLoad(Vec load, const mesh::Mesh& mesh, const PetscInt* nodes, int count, const std::vector<double>& values, double factor) {
  for (int i = 0; i < count; ++i)
    for (int d = 0; d < mesh.dimension; ++d)
      check(VecSetValue(load, mesh.dimension * mesh.globalNode[static_cast<std::size_t>(nodes[i])] + d,
                        factor * values[static_cast<std::size_t>(3 * i + d)], ADD_VALUES));
}

void assembleLoad(const mesh::Mesh& mesh, const std::vector<Material>& materials, Bodies& bodies) {
  bodies.load = nodalVector(mesh);
  std::vector<double> pressure;
  for (const auto& surface : mesh.surfaces) pressure.push_back(pressureOption.get(surface));
  for (const auto& block : mesh.faces)
    for (std::size_t e = 0; e < block.surface.size(); ++e) {
      const double p = pressure[static_cast<std::size_t>(block.surface[e])];
      const PetscInt* nodes = block.nodes.data() + e * static_cast<std::size_t>(block.nodesPerFace);
      if (p != 0)
        addLoad(bodies.load, mesh, nodes, block.nodesPerFace,
                faceNormals(shapeTable(block.type), cellNodes(mesh, nodes, block.nodesPerFace), block.sign[e]), -p);
    }
  if (centrifugalOption.get())
    forEachCell(mesh, [&](const mesh::CellBlock& block, std::size_t e, const ShapeTable& table, const std::vector<Point>& points) {
      const Motion& motion = bodies.motions[static_cast<std::size_t>(block.body[e])];
      if (motion.speed != 0)
        addLoad(bodies.load, mesh, block.nodes.data() + e * static_cast<std::size_t>(block.nodesPerCell), block.nodesPerCell,
                centrifugal(table, points, materials[static_cast<std::size_t>(block.body[e])].density, motion.speed, motion.axis,
                            motion.origin),
                1);
    });
  check(VecAssemblyBegin(bodies.load));
  check(VecAssemblyEnd(bodies.load));
}

}  // namespace

std::vector<std::string> materialGroups() {
  auto groups = youngOption.subjects();
  for (const Option* option : {static_cast<const Option*>(&poissonOption), static_cast<const Option*>(&densityOption)})
    for (const auto& group : option->subjects())
      if (!youngOption.given(group))
        throw Error("option -" + youngOption.fullName(group) + " is missing, but -" + option->fullName(group) + " is given");
  if (groups.empty()) throw Error("no body: give -material_<group>_young, _poisson and _density for each volume group of the mesh");
  for (const auto& group : groups)
    youngOption.get(group), poissonOption.get(group), densityOption.get(group);  // checks before the mesh is read
  return groups;
}

std::vector<std::string> loadedSurfaces() { return pressureOption.subjects(); }

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
  bodies.motions = readMotions(mesh.bodies);
  const auto materials = readMaterials(mesh);
  assembleMatrices(mesh, materials, bodies);
  assembleLoad(mesh, materials, bodies);
  return bodies;
}

}  // namespace squeal::elasticity
