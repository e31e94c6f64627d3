#include "elasticity/assembly.hpp"

namespace squeal::elasticity {

OwnedMat toMatrix(const mesh::Mesh& mesh, Triples& triples, Symmetry symmetry) {
  OwnedMat matrix;
  const PetscInt owned = mesh.dimension * mesh.ownedNodes;
  check(MatCreate(mesh.comm, matrix.out()));
  check(MatSetSizes(matrix, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetBlockSize(matrix, mesh.dimension));
  check(MatSetType(matrix, MATAIJ));
  check(MatSetPreallocationCOO(matrix, static_cast<PetscCount>(triples.row.size()), triples.row.data(), triples.column.data()));
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

void addLoad(Vec load, const mesh::Mesh& mesh, const PetscInt* nodes, int count, const std::vector<double>& values, double factor) {
  for (int i = 0; i < count; ++i)
    for (int d = 0; d < mesh.dimension; ++d)
      check(VecSetValue(load, mesh.dimension * mesh.globalNode[static_cast<std::size_t>(nodes[i])] + d,
                        factor * values[static_cast<std::size_t>(3 * i + d)], ADD_VALUES));
}

std::vector<Point> pointsOf(const mesh::Mesh& mesh, const PetscInt* nodes, int count) {
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) points.push_back(mesh.coordinates[static_cast<std::size_t>(nodes[i])]);
  return points;
}

std::string invertedCell(const mesh::Mesh& mesh, const mesh::CellBlock& block, std::size_t e) {
  return "inverted element: cell " + std::to_string(block.tag[e]) + " (" + shapeTable(block.type).name + ") of group '" +
         mesh.bodies[static_cast<std::size_t>(block.body[e])] + "' has a Jacobian that is not positive";
}

}  // namespace squeal::elasticity
