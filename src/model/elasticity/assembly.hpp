// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Assembly of element arrays into distributed matrices and vectors on nodal displacements.
#include <compare>
#include <functional>
#include <span>

#include "base/petsc/owned.hpp"
#include "model/elasticity/element.hpp"
#include "model/element/shape.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

/// Entries of a matrix as triples (row, column, value), in the format of MatSetPreallocationCOO.
struct Triples {
  std::vector<PetscInt> row, column;
  std::vector<PetscScalar> value;
  void add(PetscInt i, PetscInt j, double entry) {
    row.push_back(i), column.push_back(j), value.push_back(entry);
  }
};

/// The symmetry of a matrix. Since contributions are summed in an arbitrary order, a `rounded`
/// matrix is symmetric only within round-off. `symmetric` and `skew` matrices are made exactly
/// symmetric or skew.
enum class SymmetryClass { rounded, symmetric, skew };

/// Collective. Returns the N×N matrix of the triples of all ranks, and consumes them.
OwnedMat toMatrix(const mesh::Mesh& mesh, Triples& triples, SymmetryClass symmetry);

/// Not collective. Appends the entries of the matrix of one element with these local nodes. The
/// matrix is row-major, with rows and columns [node][component].
void append(Triples& triples, const mesh::Mesh& mesh, std::span<const PetscInt> nodes,
            const std::vector<double>& matrix);

/// Selects cells by their block and index.
using CellFilter = std::function<bool(const mesh::CellBlock&, std::size_t)>;

/// Counts the nodes that share a cell with each node of this rank, including the node itself.
struct NodePattern {
  std::vector<PetscInt> own, other;  ///< [owned node] nodes of this rank, and of other ranks
  /// Collective. Takes into account the cells of all ranks that `uses` selects.
  NodePattern(const mesh::Mesh& mesh, const CellFilter& uses);
};

/// Adds element matrices one by one to an N×N matrix, so that they need not be stored all at once.
class Assembly {
 public:
  /// Collective. Reserves entries for the pairs of nodes of the pattern, for all components or,
  /// with `diagonal`, only for equal components. Borrows the mesh during the lifetime of the
  /// object.
  Assembly(const mesh::Mesh& mesh, const NodePattern& pattern, bool diagonal);
  /// Not collective. Adds the matrix of one element with these local nodes. The matrix is
  /// row-major. With `scalar`, it is [node][node] and is added for each component; otherwise its
  /// rows and columns are [node][component].
  void add(std::span<const PetscInt> nodes, const std::vector<double>& matrix, bool scalar);
  /// Not collective. Adds a matrix that couples only components of the same node, such as springs
  /// to the ground; null adds nothing.
  void addRows(Mat matrix);
  /// Collective. Returns the sum over all ranks. The object must not be used afterwards.
  OwnedMat finish(SymmetryClass symmetry);

 private:
  const mesh::Mesh* mesh_;
  OwnedMat matrix_;
  std::vector<PetscInt> numbers_;
};

/// Not collective. Adds the values of one element, [node][3], times `factor`. VecAssemblyBegin and
/// VecAssemblyEnd must follow.
void addLoad(Vec load, const mesh::Mesh& mesh, std::span<const PetscInt> nodes,
             const std::vector<double>& values, double factor);

/// Not collective. Returns the coordinates of local nodes, [node], m.
std::vector<Point> pointsOf(const mesh::Mesh& mesh, std::span<const PetscInt> nodes);

/// Identifies a cell in messages by integers, which ranks can exchange.
struct CellName {
  PetscInt tag, type, body;
  auto operator<=>(const CellName&) const = default;
};
inline CellName nameOf(const mesh::CellBlock& block, std::size_t e) {
  return {block.tag[e], block.type, block.body[e]};
}

/// A cell that cannot be integrated.
struct InvertedCell {
  CellName name;
  double ratio;    ///< jacobianRatio()
  bool byCorners;  ///< true if it is also inverted with straight edges
};
/// Not collective. Describes a cell whose integration throws InvertedElement.
InvertedCell invertedCell(const mesh::CellBlock& block, std::size_t e,
                          const std::vector<Point>& nodes);
/// Collective. Throws Error on all ranks if any rank has inverted cells. The message contains their
/// number, the worst Jacobian, the names of the first ten and the remedy.
void failOnInverted(const mesh::Mesh& mesh, const std::vector<InvertedCell>& inverted);

/// Collective. Prints one warning about the cells that are folded() but usable, with their number
/// and the names of the first ten.
void warnOfFoldedCells(const mesh::Mesh& mesh);

/// Collective. Calls `visit(block, cell index, table, coordinates)` for each cell of this rank.
/// Throws Error on all ranks if a call throws InvertedElement.
template <class Visit>
void forEachCell(const mesh::Mesh& mesh, Visit visit) {
  std::vector<InvertedCell> inverted;
  for (const auto& block : mesh.cells) {
    const ShapeTable& table = shapeTable(block.type);
    for (std::size_t e = 0; e < block.tag.size(); ++e) try {
        visit(block, e, table, pointsOf(mesh, block.nodesOf(e)));
      } catch (const InvertedElement&) {
        inverted.push_back(invertedCell(block, e, pointsOf(mesh, block.nodesOf(e))));
      }
  }
  failOnInverted(mesh, inverted);
}

}  // namespace squeal::elasticity
