#include "elasticity/assembly.hpp"

#include <algorithm>

#include "petsc/text.hpp"
#include "session/stages.hpp"

namespace squeal::elasticity {

OwnedMat toMatrix(const mesh::Mesh& mesh, Triples& triples, Symmetry symmetry) {
  OwnedMat matrix;
  const PetscInt owned = mesh.dimension * mesh.ownedNodes;
  check(MatCreate(mesh.comm, matrix.out()));
  check(MatSetSizes(matrix, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetBlockSize(matrix, mesh.dimension));
  check(MatSetType(matrix, MATAIJ));
  check(MatSetPreallocationCOO(matrix, triples.row.size(), triples.row.data(),
                               triples.column.data()));
  check(MatSetValuesCOO(matrix, triples.value.data(), INSERT_VALUES));
  triples = {};
  if (symmetry != Symmetry::rounded) {  // (A ± Aᵀ)/2
    OwnedMat transposed;
    check(MatTranspose(matrix, MAT_INITIAL_MATRIX, transposed.out()));
    check(MatAXPY(matrix, symmetry == Symmetry::skew ? -1 : 1, transposed, SAME_NONZERO_PATTERN));
    check(MatScale(matrix, 0.5));
  }
  check(MatSetOption(matrix, MAT_SYMMETRIC, symmetry == Symmetry::skew ? PETSC_FALSE : PETSC_TRUE));
  return matrix;
}

void append(Triples& triples, const mesh::Mesh& mesh, std::span<const PetscInt> nodes,
            const std::vector<double>& matrix, bool scalar) {
  const int dimension = mesh.dimension, count = nodes.size();
  for (int i = 0; i < count; ++i)
    for (int a = 0; a < dimension; ++a)
      for (int j = 0; j < count; ++j)
        for (int b = 0; b < dimension; ++b) {
          if (scalar && a != b) continue;
          triples.add(dimension * mesh.globalNode[nodes[i]] + a,
                      dimension * mesh.globalNode[nodes[j]] + b,
                      scalar ? matrix[i * count + j]
                             : matrix[(i * dimension + a) * count * dimension + j * dimension + b]);
        }
}

void addLoad(Vec load, const mesh::Mesh& mesh, std::span<const PetscInt> nodes,
             const std::vector<double>& values, double factor) {
  for (int i = 0; i < std::ssize(nodes); ++i)
    for (int d = 0; d < mesh.dimension; ++d)
      check(VecSetValue(load, mesh.dimension * mesh.globalNode[nodes[i]] + d,
                        factor * values[3 * i + d], ADD_VALUES));
}

std::vector<Point> pointsOf(const mesh::Mesh& mesh, std::span<const PetscInt> nodes) {
  std::vector<Point> points;
  for (PetscInt node : nodes) points.push_back(mesh.coordinates[node]);
  return points;
}

namespace {

/// The number of some cells of all ranks, and the first ten by their tags in words.
struct CellsNamed {
  PetscInt count = 0;
  std::string words;
};

/// Collective. Returns the number and the first names of the cells that the ranks have.
CellsNamed named(const mesh::Mesh& mesh, std::vector<CellName> cells) {
  constexpr PetscInt most = 10;
  CellsNamed result;
  result.count = cells.size();
  check(MPI_Allreduce(MPI_IN_PLACE, &result.count, 1, MPIU_INT, MPI_SUM, mesh.comm));
  if (result.count == 0) return result;
  int ranks = 1;
  check(MPI_Comm_size(mesh.comm, &ranks));
  std::sort(cells.begin(), cells.end());
  cells.resize(most, CellName{PETSC_MAX_INT, 0, 0});
  std::vector<CellName> all(most * ranks);
  check(MPI_Allgather(cells.data(), 3 * most, MPIU_INT, all.data(), 3 * most, MPIU_INT, mesh.comm));
  std::sort(all.begin(), all.end());
  std::vector<std::string> words;
  for (PetscInt i = 0; i < std::min(most, result.count); ++i) {
    const auto [tag, type, body] = all[i];
    words.push_back("cell " + std::to_string(tag) + " (" + shapeTable(type).name + ") of group '" +
                    mesh.bodies[body] + "'");
  }
  result.words = joined(words) + (result.count > most ? ", …" : "");
  return result;
}

}  // namespace

InvertedCell invertedCell(const mesh::CellBlock& block, std::size_t e,
                          const std::vector<Point>& nodes) {
  const ShapeTable& table = shapeTable(block.type);
  return {nameOf(block, e), jacobianRatio(block.type, nodes),
          table.nodes == table.corners ||
              folded(stiffnessTable(block.type), straightened(block.type, nodes))};
}

void failOnInverted(const mesh::Mesh& mesh, const std::vector<InvertedCell>& inverted) {
  std::vector<CellName> names;
  double worst = 1;
  PetscInt byCorners = 0;
  for (const auto& cell : inverted) {
    names.push_back(cell.name);
    worst = std::min(worst, cell.ratio);
    byCorners += cell.byCorners;
  }
  const auto [count, words] = named(mesh, names);
  if (count == 0) return;
  check(MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MIN, mesh.comm));
  check(MPI_Allreduce(MPI_IN_PLACE, &byCorners, 1, MPIU_INT, MPI_SUM, mesh.comm));
  const std::string least = formatted(", at worst %.2g of its largest", worst);
  std::string message =
      count == 1 ? "inverted element: " + words + " has a Jacobian that is not positive" + least
                 : "inverted elements: " + std::to_string(count) +
                       " cells have a Jacobian that is not positive" + least + ": " + words;
  if (byCorners < count) message += "; -mesh_straighten bad straightens the edges of such cells";
  if (byCorners > 0)
    message += "; with straight edges too, by the corners alone, it is not in " +
               std::to_string(byCorners) + " of them: mesh anew";
  throw Error(message);
}

void warnOfFoldedCells(const mesh::Mesh& mesh) {
  std::vector<CellName> cells;
  forEachCell(mesh, [&](const mesh::CellBlock& block, std::size_t e, const ShapeTable& table,
                        const std::vector<Point>& points) {
    if (folded(table, points)) cells.push_back(nameOf(block, e));
  });
  const auto [count, words] = named(mesh, cells);
  if (count > 0)
    complain(mesh.comm, "warning: " + std::to_string(count) +
                            (count == 1 ? " curved cell has" : " curved cells have") +
                            " a Jacobian that is not positive near an edge; stiffness is "
                            "integrated at fewer points there (-mesh_straighten bad straightens "
                            "such cells): " +
                            words);
}

}  // namespace squeal::elasticity
