#pragma once
/// From element arrays to distributed matrices and vectors of nodal displacements.
#include <compare>

#include "elasticity/element.hpp"
#include "elasticity/shape.hpp"
#include "mesh/mesh.hpp"
#include "petsc/owned.hpp"

namespace squeal::elasticity {

/// Entries of a matrix as (row, column, value) triples, the interface of MatSetPreallocationCOO.
struct Triples {
  std::vector<PetscInt> row, column;
  std::vector<PetscScalar> value;
  void reserve(std::size_t count) {
    row.reserve(count), column.reserve(count), value.reserve(count);
  }
};

/// What entries in transposed places have in common. Contributions are summed in any order, so that
/// `rounded` is symmetric to rounding; `symmetric` and `skew` are made exactly so.
enum class Symmetry { rounded, symmetric, skew };

/// Collective. N×N from the triples of all ranks; spends them.
OwnedMat toMatrix(const mesh::Mesh& mesh, Triples& triples, Symmetry symmetry);

/// Adds the entries of one element: `components` copies of a scalar matrix, or one matrix on all
/// components.
void append(Triples& triples, const mesh::Mesh& mesh, const PetscInt* nodes, int count,
            const std::vector<double>& matrix, bool scalar);

/// Adds [node][3] values of one element, times `factor`; to be followed by VecAssemblyBegin and
/// End.
void addLoad(Vec load, const mesh::Mesh& mesh, const PetscInt* nodes, int count,
             const std::vector<double>& values, double factor);

std::vector<Point> pointsOf(const mesh::Mesh& mesh, const PetscInt* nodes, int count);

/// A cell for messages; only integers, so that ranks can tell each other.
struct CellName {
  PetscInt tag, type, body;
  auto operator<=>(const CellName&) const = default;
};
inline CellName nameOf(const mesh::CellBlock& block, std::size_t e) {
  return {block.tag[e], block.type, block.body[e]};
}

/// Collective. Error on all ranks if a rank has inverted cells: how many there are, and the first
/// of them.
void failOnInverted(const mesh::Mesh& mesh, const std::vector<CellName>& inverted);

/// Collective. One line on the cells that are of use although folded(): how many, and the first of
/// them.
void warnOfFoldedCells(const mesh::Mesh& mesh);

/// Collective. Calls `visit(block, cell index, table, coordinates)` for each cell; where it throws
/// InvertedElement all ranks get an Error.
template <class Visit>
void forEachCell(const mesh::Mesh& mesh, Visit visit) {
  std::vector<CellName> inverted;
  for (const auto& block : mesh.cells) {
    const ShapeTable& table = shapeTable(block.type);
    for (std::size_t e = 0; e < block.tag.size(); ++e) try {
        visit(block, e, table,
              pointsOf(mesh, block.nodes.data() + e * static_cast<std::size_t>(block.nodesPerCell),
                       block.nodesPerCell));
      } catch (const InvertedElement&) {
        inverted.push_back(nameOf(block, e));
      }
  }
  failOnInverted(mesh, inverted);
}

}  // namespace squeal::elasticity
