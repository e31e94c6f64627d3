// SPDX-License-Identifier: BSD-2-Clause
#include "model/contact/hourglass.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "algebra/linalg/symmetric.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/contact/supports.hpp"
#include "model/elasticity/hourglass.hpp"

namespace squeal::contact {
namespace {

using elasticity::ExposedCell;
using elasticity::strainlessMotions;

// A dense problem finds motions without strain energy: six unknowns for each connected part, which
// moves rigidly, and twelve for each exposed cell, which also has its hourglass modes. Its rows are
// the supports, and the displacements that cells share with each other and with their part.

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
  void add(std::vector<double>& row, const CellNode& at, const Point& direction,
           double factor) const {
    double* a = row.data() + firstOf(at.cell);
    for (int m = 0; m < strainlessMotions; ++m)
      for (int d = 0; d < 3; ++d)
        a[m] += factor * direction[d] * basis_[at.cell](3 * at.node + d, m);
  }
  int firstOf(int cell) const { return rigid_.size() + strainlessMotions * cell; }

 private:
  RigidMotions rigid_;
  std::span<const ExposedCell> cells_;
  std::vector<linalg::DenseMatrix> basis_;  // [cell]
  std::map<PetscInt, CellNode> first_;      // [global node]
};

/// Adds the row of a support.
void addSupport(const mesh::Mesh& mesh, const Motions& motions, const Support& support,
                GramMatrix& gram) {
  const auto& first = motions.first();
  if (const auto own = first.find(mesh.globalNode[support.node]); own != first.end())
    motions.add(gram.row, own->second, support.direction, 1);
  else
    motions.rigid().addNode(mesh, support.node, support.direction, 1, gram.row);
  std::map<int, double> shares;  // [part] of the masters outside the cells
  for (const auto& [part, share] : support.masterParts) shares[part] += share;
  for (const auto& [node, weight] : support.masters)
    if (const auto master = first.find(node); master != first.end()) {
      motions.add(gram.row, master->second, support.direction, -weight);
      shares[master->second.part] -= weight;
    }
  for (const auto& [part, share] : shares)
    if (std::abs(share) > 1e-12)
      motions.rigid().add(gram.row, part, support.masterPosition, support.direction, -share);
  for (const auto& master : support.coupled)
    if (const auto node = first.find(master.node); node != first.end())
      motions.add(gram.row, node->second, master.block[support.component], -1);
    else
      motions.rigid().addMaster(master, support.component, gram.row);
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

/// Collective. Adds the rows of the displacements that cells share, which all ranks know.
void addShared(const mesh::Mesh& mesh, std::span<const ExposedCell> cells, const Motions& motions,
               GramMatrix& gram) {
  const auto ofOthers = nodesOfOthers(mesh, cells, motions);
  for (int c = 0; c < std::ssize(cells); ++c)
    for (int i = 0; i < std::ssize(cells[c].node); ++i) {
      const PetscInt node = cells[c].node[i];
      const CellNode& first = motions.first().at(node);
      for (int d = 0; d < 3; ++d) {
        Point direction{};
        direction[d] = 1;
        if (first.cell != c) {
          motions.add(gram.row, {c, i, cells[c].part}, direction, 1);
          motions.add(gram.row, first, direction, -1);
        } else if (ofOthers.contains(node)) {
          motions.add(gram.row, first, direction, 1);
          motions.rigid().add(gram.row, cells[c].part, cells[c].point[i], direction, -1);
        }
        gram.keep();
      }
    }
}

/// Collective. Returns the matrix Σ cᵀc over all rows c; its null space contains the hourglass
/// modes.
linalg::DenseMatrix gramOf(const mesh::Mesh& mesh, const Contact& contact,
                           const elasticity::Bodies& bodies, std::span<const ExposedCell> cells,
                           const Motions& motions) {
  GramMatrix gram(motions.size());
  forEachSupport(mesh, contact, bodies.springs, {},
                 [&](const Support& support) { addSupport(mesh, motions, support, gram); });
  addEquations(mesh, contact, bodies, motions.rigid(), gram);
  mpi::reduce<double>(mesh.comm, {gram.sum.data(), std::size_t(gram.sum.size())}, MPI_SUM);
  addShared(mesh, cells, motions, gram);
  for (int i = 0; i < motions.rigid().size(); ++i)
    if (gram.sum(i, i) == 0) gram.sum(i, i) = 1;  // no row contains a part of only exposed cells
  return std::move(gram.sum);
}

/// Returns true if all eigenvalues of a Gram matrix are well above `relative` times the largest. A
/// factorisation takes a small part of the time of the eigenvalues.
bool isRegular(const linalg::DenseMatrix& gram, double relative) {
  linalg::DenseMatrix factor = gram;
  double bound = 1;  // of the largest eigenvalue
  for (int i = 0; i < gram.rows(); ++i) {
    double sum = 0;
    for (int j = 0; j < gram.rows(); ++j) sum += std::abs(gram(j, i));
    bound = std::max(bound, sum);
  }
  for (int i = 0; i < gram.rows(); ++i) factor(i, i) -= relative * bound;
  PetscBLASInt n = gram.rows(), info = 0;
  LAPACKpotrf_("L", &n, factor.data(), &n, &info);
  return info == 0;
}

}  // namespace

void rejectHourglassModes(const mesh::Mesh& mesh, const Contact& contact,
                          const elasticity::Bodies& bodies) {
  constexpr std::size_t most = 100;
  if (bodies.exposed.empty()) return;
  const auto cells = std::span(bodies.exposed).first(std::min(bodies.exposed.size(), most));
  const Motions motions(mesh, cells);
  linalg::DenseMatrix vectors = gramOf(mesh, contact, bodies, cells, motions);
  constexpr double relative = 1e-12;
  if (isRegular(vectors, relative)) return;
  const auto eigenvalues = linalg::symmetricEigen(vectors);
  const double limit = relative * std::max(eigenvalues.back(), 1.0);
  const auto count = std::ranges::count_if(eigenvalues, [&](double x) { return x <= limit; });
  if (count == 0) return;
  int worst = 0;
  double largest = -1;
  for (int c = 0; c < std::ssize(cells); ++c) {
    double weight = 0;
    for (int m = 0; m < strainlessMotions; ++m)
      weight += std::pow(vectors(motions.firstOf(c) + m, 0), 2);
    if (weight > largest) largest = weight, worst = c;
  }
  const int material = cells[worst].material;
  throw Error(
      "singular problem: " + mesh.materialText(material) + " has " +
      (count == 1 ? "an hourglass mode" : std::to_string(count) + " hourglass modes") +
      " without strain energy: reduced integration, with closed frictionless contact, does not "
      "resist a motion of cell " +
      std::to_string(cells[worst].tag) + "; give " +
      material::integrationName(mesh.materialGroups[material].name) +
      " full, or use two cells across the body in two directions");
}

}  // namespace squeal::contact
