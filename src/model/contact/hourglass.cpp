// SPDX-License-Identifier: BSD-2-Clause
#include "model/contact/hourglass.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "algebra/factor/mumps.hpp"
#include "base/petsc/object.hpp"
#include "base/session/stages.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/contact/supports.hpp"
#include "model/elasticity/hourglass.hpp"

namespace squeal::contact {
namespace {

using elasticity::ExposedCell;
using elasticity::strainlessMotions;

// A sparse problem finds motions without strain energy: six unknowns for each connected part, which
// moves rigidly, and twelve for each exposed cell, which also has its hourglass modes. Its rows are
// the supports, and the displacements that cells share with each other and with their part.

constexpr std::size_t mostExamined = 2000;  // a basis takes about a millisecond

/// The Gram matrix Σ cᵀc of sparse rows c, of the unknowns of the parts and then of the cells.
class SparseGram {
 public:
  SparseGram(int rigid, int size) : rigid(rigid), size_(size) {}
  std::vector<double> rigid;    ///< the part of the row to add in the unknowns of the parts
  std::map<int, double> cells;  ///< and its entries in those of the cells, by index in the row
  /// Not collective. Adds the row, and clears it.
  void keep();
  /// Not collective. Adds a matrix in the unknowns of the parts.
  void add(const linalg::DenseMatrix& ofParts);
  /// Collective. Returns the sum over all ranks. A part without a row, all of whose cells are
  /// exposed, gets a diagonal of one.
  OwnedMat finish(MPI_Comm comm);

 private:
  int size_;
  std::map<std::pair<int, int>, double> entries_;
};

void SparseGram::keep() {
  std::vector<std::pair<int, double>> used;
  for (int i = 0; i < std::ssize(rigid); ++i)
    if (rigid[i] != 0) used.emplace_back(i, rigid[i]);
  for (const auto& [i, x] : cells)
    if (x != 0) used.emplace_back(i, x);
  for (const auto& [i, x] : used)
    for (const auto& [j, y] : used) entries_[{i, j}] += x * y;
  std::ranges::fill(rigid, 0.0);
  cells.clear();
}

void SparseGram::add(const linalg::DenseMatrix& ofParts) {
  for (int i = 0; i < ofParts.rows(); ++i)
    for (int j = 0; j < ofParts.rows(); ++j)
      if (ofParts(i, j) != 0) entries_[{i, j}] += ofParts(i, j);
}

OwnedMat SparseGram::finish(MPI_Comm comm) {
  std::vector<double> diagonal(size_, 0.0);
  for (const auto& [place, x] : entries_)
    if (place.first == place.second) diagonal[place.first] += x;
  mpi::reduce<double>(comm, diagonal, MPI_SUM);
  std::vector<PetscInt> row, column;
  std::vector<PetscScalar> value;
  const auto append = [&](PetscInt i, PetscInt j, double x) {
    row.push_back(i), column.push_back(j), value.push_back(x);
  };
  for (const auto& [place, x] : entries_) append(place.first, place.second, x);
  if (mpi::rank(comm) == 0)
    for (int i = 0; i < size_; ++i)  // all of the diagonal, for the shift
      append(i, i, i < std::ssize(rigid) && diagonal[i] == 0 ? 1 : 0);
  OwnedMat matrix;
  check(MatCreate(comm, matrix.out()));
  check(MatSetSizes(matrix, PETSC_DECIDE, PETSC_DECIDE, size_, size_));
  check(MatSetType(matrix, MATAIJ));
  check(MatSetPreallocationCOO(matrix, row.size(), row.data(), column.data()));
  check(MatSetValuesCOO(matrix, value.data(), INSERT_VALUES));
  check(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
  return matrix;
}

/// A node of an exposed cell.
struct CellNode {
  int cell, node;  ///< index of the cell, and of the node in it
  int part;
};

/// The motions without strain of the parts and of the exposed cells.
class Motions {
 public:
  Motions(const mesh::Mesh& mesh, std::span<const ExposedCell> cells)
      : rigid_(rigidMotions(mesh)), cells_(cells) {
    for (int c = 0; c < std::ssize(cells); ++c) {
      basis_.push_back(elasticity::strainlessBasis(cells[c]));
      for (int i = 0; i < std::ssize(cells[c].node); ++i)
        first_.try_emplace(cells[c].node[i], CellNode{c, i, cells[c].part});
    }
  }
  int size() const { return rigid_.size() + strainlessMotions * std::ssize(cells_); }
  const RigidMotions& rigid() const { return rigid_; }
  /// Returns the first cell with each global node.
  const std::map<PetscInt, CellNode>& first() const { return first_; }
  /// Adds the coefficients of factor · direction·u at the node of a cell to the row.
  void add(SparseGram& gram, const CellNode& at, const Point& direction, double factor) const {
    for (int m = 0; m < strainlessMotions; ++m) {
      double& a = gram.cells[firstOf(at.cell) + m];
      for (int d = 0; d < 3; ++d) a += factor * direction[d] * basis_[at.cell](3 * at.node + d, m);
    }
  }
  std::span<const ExposedCell> cells() const { return cells_; }
  int firstOf(int cell) const { return rigid_.size() + strainlessMotions * cell; }

 private:
  RigidMotions rigid_;
  std::span<const ExposedCell> cells_;
  std::vector<linalg::DenseMatrix> basis_;  // [cell]
  std::map<PetscInt, CellNode> first_;      // [global node]
};

/// Adds the row of a support.
void addSupport(const mesh::Mesh& mesh, const Motions& motions, const Support& support,
                SparseGram& gram) {
  const auto& first = motions.first();
  if (const auto own = first.find(mesh.globalNode[support.node]); own != first.end())
    motions.add(gram, own->second, support.direction, 1);
  else
    motions.rigid().addNode(mesh, support.node, support.direction, 1, gram.rigid);
  std::map<int, double> shares;  // [part] of the masters outside the cells
  for (const auto& [part, share] : support.masterParts) shares[part] += share;
  for (const auto& [node, weight] : support.masters)
    if (const auto master = first.find(node); master != first.end()) {
      motions.add(gram, master->second, support.direction, -weight);
      shares[master->second.part] -= weight;
    }
  for (const auto& [part, share] : shares)
    if (std::abs(share) > 1e-12)
      motions.rigid().add(gram.rigid, part, support.masterPosition, support.direction, -share);
  for (const auto& master : support.coupled)
    if (const auto node = first.find(master.node); node != first.end())
      motions.add(gram, node->second, master.block[support.component], -1);
    else
      motions.rigid().addMaster(master, support.component, gram.rigid);
  gram.keep();
}

/// Collective. Returns the nodes of the cells that belong to another cell as well.
std::set<PetscInt> nodesOfOthers(const mesh::Mesh& mesh, std::span<const ExposedCell> cells,
                                 const Motions& motions) {
  std::set<PetscInt> tags;
  for (const auto& cell : cells) tags.insert(cell.tag);
  std::map<PetscInt, int> index;  // [global node]
  for (const auto& [node, at] : motions.first()) index.emplace(node, index.size());
  std::vector<int> shared(index.size(), 0);
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      if (tags.contains(block.tag[e])) continue;
      for (const PetscInt node : block.nodesOf(e))
        if (const auto found = index.find(mesh.globalNode[node]); found != index.end())
          shared[found->second] = 1;
    }
  mpi::reduce<int>(mesh.comm, shared, MPI_MAX);
  std::set<PetscInt> result;
  for (const auto& [node, i] : index)
    if (shared[i]) result.insert(node);
  return result;
}

/// Collective. Adds the rows of the displacements that cells share, which all ranks know, on rank
/// 0.
void addShared(const mesh::Mesh& mesh, std::span<const ExposedCell> cells, const Motions& motions,
               SparseGram& gram) {
  const auto ofOthers = nodesOfOthers(mesh, cells, motions);
  if (mpi::rank(mesh.comm) > 0) return;
  for (int c = 0; c < std::ssize(cells); ++c)
    for (int i = 0; i < std::ssize(cells[c].node); ++i) {
      const PetscInt node = cells[c].node[i];
      const CellNode& first = motions.first().at(node);
      for (int d = 0; d < 3; ++d) {
        Point direction{};
        direction[d] = 1;
        if (first.cell != c) {
          motions.add(gram, {c, i, cells[c].part}, direction, 1);
          motions.add(gram, first, direction, -1);
        } else if (ofOthers.contains(node)) {
          motions.add(gram, first, direction, 1);
          motions.rigid().add(gram.rigid, cells[c].part, cells[c].point[i], direction, -1);
        }
        gram.keep();
      }
    }
}

/// Collective. Returns the matrix Σ cᵀc over all rows c; its null space contains the hourglass
/// modes.
OwnedMat gramOf(const mesh::Mesh& mesh, const Contact& contact, const elasticity::Bodies& bodies,
                const SupportingContact& holding, const Motions& motions) {
  const auto cells = motions.cells();
  SparseGram gram(motions.rigid().size(), motions.size());
  forEachSupport(mesh, contact, bodies.springs, holding,
                 [&](const Support& support) { addSupport(mesh, motions, support, gram); });
  GramMatrix equations(motions.rigid().size());
  addEquations(mesh, contact, bodies, motions.rigid(), equations);
  gram.add(equations.sum);
  addShared(mesh, cells, motions, gram);
  return gram.finish(mesh.comm);
}

/// The null space of a Gram matrix.
struct NullSpace {
  PetscInt dimension = 0;
  std::vector<double> vector = {};  ///< one of its vectors
};

/// Collective. Returns the null space, within round-off: the number of eigenvalues below 1e-12 of a
/// bound of the largest one, by inertia, and a vector by inverse iteration.
NullSpace nullSpaceOf(Mat gram) {
  PetscReal bound = 0;
  check(MatNorm(gram, NORM_INFINITY, &bound));
  check(MatShift(gram, -1e-12 * std::max(bound, 1.0)));
  const MPI_Comm comm = commOf(gram);
  factor::MumpsFactor factor(comm, "");
  factor.enableInertia();
  factor.analyse(gram);
  if (const std::string why = factor.factorise(); !why.empty())
    throw Error("the search for hourglass modes: " + why);
  NullSpace found{factor.inertia().negative};
  if (found.dimension == 0) return found;
  PetscInt begin = 0, end = 0;
  check(MatGetOwnershipRange(gram, &begin, &end));
  std::vector<double> own;
  for (PetscInt i = begin; i < end; ++i) own.push_back(std::cos(1.0 + i));
  for (int step = 0; step < 3; ++step) {
    std::vector<double> next(own.size());
    factor.solve(own.data(), next.data(), 1);
    double square = 0;
    for (const double x : next) square += x * x;
    square = mpi::sum(comm, square);
    for (double& x : next) x /= std::sqrt(square);
    own = std::move(next);
  }
  found.vector = concatenated(comm, own);
  return found;
}

}  // namespace

std::string hourglassModes(const mesh::Mesh& mesh, const Contact& contact,
                           const elasticity::Bodies& bodies, const SupportingContact& holding) {
  if (bodies.exposed.empty()) return "";
  const auto cells = std::span(bodies.exposed).first(std::min(bodies.exposed.size(), mostExamined));
  const Motions motions(mesh, cells);
  const OwnedMat gram = gramOf(mesh, contact, bodies, holding, motions);
  const NullSpace found = nullSpaceOf(gram);
  if (found.dimension == 0) return "";
  int worst = 0;
  double largest = -1;
  for (int c = 0; c < std::ssize(cells); ++c) {
    double weight = 0;
    for (int m = 0; m < strainlessMotions; ++m)
      weight += std::pow(found.vector[motions.firstOf(c) + m], 2);
    if (weight > 1.01 * largest) largest = weight, worst = c;  // equal ones differ by round-off
  }
  const int material = cells[worst].material;
  return mesh.materialText(material) + " has " +
         (found.dimension == 1 ? "an hourglass mode"
                               : std::to_string(found.dimension) + " hourglass modes") +
         " without strain energy: reduced integration, with " +
         (holding.closed.empty() ? "closed frictionless contact"
                                 : "the open and sliding nodes of this point") +
         ", does not resist a motion of cell " + std::to_string(cells[worst].tag) + "; give " +
         material::integrationName(mesh.materialGroups[material].name) +
         " full, or use two cells across the body in two directions";
}

void rejectHourglassModes(const mesh::Mesh& mesh, const Contact& contact,
                          const elasticity::Bodies& bodies) {
  if (bodies.exposed.size() > mostExamined)
    printWarning(mesh.comm,
                 formatted("warning: %zu cells with reduced integration may have hourglass modes; "
                           "only the first %zu are examined",
                           bodies.exposed.size(), mostExamined));
  if (const std::string found = hourglassModes(mesh, contact, bodies, {}); !found.empty())
    throw Error("singular problem: " + found);
}

}  // namespace squeal::contact
