// SPDX-License-Identifier: BSD-2-Clause
// The searches of ContactSolver for the friction due to given forces.
#include "steady/impedance/contact_search.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/rows.hpp"
#include "base/system/mpi.hpp"
#include "steady/impedance/symmetric_inverse.hpp"

namespace squeal::impedance {

using linalg::DenseMatrix;
using linalg::DenseView;

namespace {

/// A problem has no solution if its friction stays unbalanced by more than this fraction of its
/// causes.
constexpr double accepted = 1e-8;
/// Remaining forces on free unknowns above this fraction of the largest given one show a rigid-body
/// mode.
constexpr double balancedForces = 1e-6;
/// The largest number of directions per call, and four more for each given force after the first.
constexpr PetscInt mostDirections = 500;
/// The remainder of a direction, a unit vector, must be longer than this after orthogonalisation
/// against the space of friction magnitudes, and against its block. The next block contains the
/// directions omitted here.
constexpr double newInSpace = 1e-10, newInBlock = 0.05;
/// Memory for the free unknowns of several blocks on one rank, bytes.
constexpr double mostTogether = 64e6;

/// Collective. Returns for each column b the coefficients a that minimise |b − G a|. It refines the
/// normal equations, which gives all digits if the condition number of G is below some 1e7. `gram`
/// is GᵀG.
DenseMatrix leastSquares(MPI_Comm comm, const DenseView& g, const DenseMatrix& gram,
                         const DenseView& b) {
  const SymmetricInverse inverse(gram);
  DenseMatrix sum(g.columns(), b.columns()), rest(b);
  for (int pass = 0; pass < 3; ++pass) {
    DenseMatrix step = linalg::transposedProduct(comm, g, rest);
    inverse.apply(step);
    linalg::addScaled(sum, 1, step);
    linalg::multiplyAdd(g, step, rest, -1);
  }
  return sum;
}

/// Collective. Returns the 2-norms of the columns.
std::vector<double> lengths(MPI_Comm comm, const DenseView& columns) {
  std::vector<double> result;
  for (PetscInt j = 0; j < columns.columns(); ++j)
    result.push_back(linalg::squaredLength(columns.column(j)));
  mpi::sumAlike(comm, result);
  for (double& length : result) length = std::sqrt(length);
  return result;
}

}  // namespace

/// Collective. Releases the free unknowns of each search until F = 0 there, and adds what they
/// cause to the effects of the search. Returns their values for each search, [known
/// column]×[column].
std::vector<DenseMatrix> ContactSolver::release(const std::vector<Search>& searches,
                                                std::vector<DenseMatrix>& effects) const {
  std::vector<ReleaseTask> tasks;
  for (std::size_t k = 0; k < searches.size(); ++k)
    tasks.push_back({*searches[k].block, effects[k]});
  auto amounts = free_.released(tasks);
  const DenseMatrix& columns = free_.columns();
  if (columns.columns() == 0) return amounts;
  if (searches.size() == 1) {
    linalg::multiplyAdd(columns, amounts.front(), effects.front());
    return amounts;
  }
  DenseMatrix all(columns.columns());  // one product reads the columns once
  for (const auto& some : amounts) all.append(some);
  const DenseMatrix changes = linalg::product(columns, all);
  PetscInt first = 0;
  for (auto& one : effects) {
    linalg::addScaled(one, 1, changes.columnRange(first, first + one.columns()));
    first += one.columns();
  }
  return amounts;
}

/// Adds the direct effects of the friction t, which may have several columns, to `effects`.
void ContactSolver::addDirect(const FreeBlock& block, const DenseView& t,
                              DenseMatrix& effects) const {
  if (!block.direct) return;
  const PetscInt n = impedance_.nodes();
  DenseMatrix forces(impedance_.length() - n);
  linalg::appendProduct(block.direct, t, forces);
  for (PetscInt j = 0; j < forces.columns(); ++j)
    for (PetscInt i = 0; i < forces.rows(); ++i) effects(n + i, j) += forces(i, j);
}

/// Collective. Updates these blocks, each listed once, to the present space of friction magnitudes.
/// Takes as many of them together as `mostTogether` allows, at least one.
void ContactSolver::update(std::span<FreeBlock* const> blocks) const {
  const PetscInt all = magnitudes_.columns();
  double bytes = 0;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const PetscInt order = blocks[k]->baseOrSelf().unknowns.ranks.size(),
                   columns = all - blocks[k]->normal.columns();
    bytes += 8.0 * columns * (order + free_.columns().columns());
    if (k == 0 || bytes <= mostTogether) continue;
    update(blocks.first(k));
    return update(blocks.subspan(k));
  }
  std::vector<DenseMatrix> fresh(blocks.size());  // of the blocks with direct friction
  std::vector<ReleaseTask> tasks;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    FreeBlock& block = *blocks[k];
    const PetscInt known = block.normal.columns();
    const DenseView responses = responses_.columnRange(known, all);
    if (block.direct) {
      fresh[k] = DenseMatrix(responses);
      addDirect(block, magnitudes_.columnRange(known, all), fresh[k]);
      tasks.push_back({block, fresh[k]});
    } else {
      tasks.push_back({block, responses, known});
    }
  }
  const auto amounts = free_.released(tasks);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    // Elsewhere c = 0, and R is not needed: most of the nodes of a brake have no friction.
    DenseMatrix normal = linalg::rowsOf(frictional_, tasks[k].effects);
    if (!amounts[k].empty()) linalg::multiplyAdd(frictionalColumns_, amounts[k], normal);
    blocks[k]->normal.append(normal);
  }
}

/// Collective. Updates a search, whose block is up to date, to the present space of friction
/// magnitudes.
void ContactSolver::update(Search& search) const {
  const PetscInt known = search.g.columns(), all = magnitudes_.columns();
  if (known == all) return;
  const auto& coefficient = search.conditions.coefficient;
  DenseMatrix fresh(magnitudes_.columnRange(known, all));
  for (PetscInt j = 0; j < fresh.columns(); ++j)
    for (std::size_t i = 0; i < frictional_.size(); ++i)
      fresh(frictional_[i], j) -= coefficient[frictional_[i]] * search.block->normal(i, known + j);
  search.g.append(fresh);
  search.gram = linalg::bordered(
      search.gram, linalg::transposedProduct(impedance_.comm(), search.g, fresh), DenseMatrix());
}

/// Adds directions, [contact node]×[direction], to the space of friction magnitudes, without their
/// components in it. Returns false if nothing remains.
bool ContactSolver::extend(const DenseMatrix& directions) {
  const PetscInt n = impedance_.nodes();
  const MPI_Comm comm = impedance_.comm();
  DenseMatrix rest = linalg::unitColumns(comm, directions), fresh(n);
  for (int pass = 0; pass < 2; ++pass)
    linalg::multiplyAdd(magnitudes_, linalg::transposedProduct(comm, magnitudes_, rest), rest, -1);
  for (PetscInt j = 0; j < rest.columns(); ++j) {
    DenseMatrix column(rest.columnRange(j, j + 1));
    double length = linalg::length(comm, column.entries());
    if (!(length > newInSpace)) continue;
    for (double& entry : column.entries()) entry /= length;
    for (int pass = 0; pass < 2; ++pass)
      linalg::multiplyAdd(fresh, linalg::transposedProduct(comm, fresh, column), column, -1);
    length = linalg::length(comm, column.entries());
    if (!(length > newInBlock)) continue;
    for (double& entry : column.entries()) entry /= length;
    fresh.append(column);
  }
  if (fresh.columns() == 0) return false;
  DenseMatrix causes(impedance_.length(), fresh.columns());
  for (PetscInt j = 0; j < fresh.columns(); ++j)
    std::ranges::copy(fresh.column(j), causes.column(j).begin());
  magnitudes_.append(fresh);
  responses_.append(impedance_.responses(causes));
  return true;
}

/// Begins searches with the friction due to the given forces, without its own effects.
void ContactSolver::begin(std::vector<Search>& searches) {
  std::vector<std::shared_ptr<FreeBlock>> blocks;
  for (Search& search : searches)
    blocks.push_back(search.block =
                         free_.blockOf(search.conditions.free, search.conditions.direct));
  free_.makeReady(blocks);
  const PetscInt n = impedance_.nodes();
  std::vector<DenseMatrix> effects;
  for (const Search& search : searches) effects.push_back(search.given);
  release(searches, effects);
  for (std::size_t k = 0; k < searches.size(); ++k) {
    Search& search = searches[k];
    search.g = DenseMatrix(n);
    search.wanted = linalg::rowRange(effects[k], 0, n);
    for (PetscInt j = 0; j < effects[k].columns(); ++j)
      for (PetscInt i = 0; i < n; ++i) search.wanted(i, j) *= search.conditions.coefficient[i];
    search.left = lengths(impedance_.comm(), search.wanted);
    for (std::size_t j = 0; j < search.unit.size(); ++j)
      search.unit[j] = std::max(search.left[j], search.unit[j]);
  }
}

/// Searches for the friction of all cases until each is balanced or the space no longer grows.
void ContactSolver::balance(std::vector<Search>& searches, double accuracy) {
  const PetscInt n = impedance_.nodes();
  PetscInt most = magnitudes_.columns() + mostDirections;
  for (const Search& search : searches) most += 4 * (search.given.columns() - 1);
  const MPI_Comm comm = impedance_.comm();
  DenseMatrix unbalanced(n);
  do {
    unbalanced.resizeColumns(0);
    std::vector<FreeBlock*> blocks;
    for (const Search& search : searches)
      if (FreeBlock* block = search.block.get(); !search.isBalanced(accuracy) &&
                                                 block->normal.columns() < magnitudes_.columns() &&
                                                 std::ranges::find(blocks, block) == blocks.end())
        blocks.push_back(block);
    update(blocks);
    for (Search& search : searches) {
      if (search.isBalanced(accuracy)) continue;
      update(search);
      std::vector<PetscInt> open;  // columns
      for (PetscInt j = 0; j < search.given.columns(); ++j)
        if (!search.isBalanced(j, accuracy)) open.push_back(j);
      DenseMatrix rest(n);
      for (const PetscInt j : open) rest.append(search.wanted.column(j));
      const DenseMatrix weights = leastSquares(comm, search.g, search.gram, rest);
      linalg::multiplyAdd(search.g, weights, rest, -1);
      const auto left = lengths(comm, rest);
      DenseMatrix all(weights.rows(), search.given.columns());
      for (PetscInt j = 0; j < all.columns(); ++j)
        std::ranges::copy(search.weights.column(j), all.column(j).begin());
      for (std::size_t i = 0; i < open.size(); ++i) {
        const PetscInt j = open[i];
        std::ranges::copy(weights.column(i), all.column(j).begin());
        search.left[j] = left[i];
        if (!search.isBalanced(j, accuracy)) unbalanced.append(rest.column(i));
      }
      search.weights = std::move(all);
      if (searches.size() > 1) search.g = DenseMatrix(n), search.gram = {};  // for lack of memory
    }
  } while (unbalanced.columns() > 0 && magnitudes_.columns() < most && extend(unbalanced));
}

/// Collective. Returns the responses of all searches.
std::vector<ContactResponses> ContactSolver::responses(const std::vector<Search>& searches,
                                                       double accuracy) const {
  std::vector<DenseMatrix> friction, effects;
  for (const Search& search : searches) {
    const PetscInt known = search.weights.rows();
    const auto& t =
        friction.emplace_back(linalg::product(magnitudes_.columnRange(0, known), search.weights));
    auto& all = effects.emplace_back(search.given);
    linalg::multiplyAdd(responses_.columnRange(0, known), search.weights, all);
    addDirect(*search.block, t, all);
  }
  const auto freed = release(searches, effects);
  std::vector<ContactResponses> result;
  for (std::size_t k = 0; k < searches.size(); ++k)
    result.push_back(
        responsesOf(searches[k], friction[k], freed[k], std::move(effects[k]), accuracy));
  return result;
}

/// Collective. Returns the responses of a search from its friction t, the values of its free
/// unknowns and all effects (R, F).
ContactResponses ContactSolver::responsesOf(const Search& search, const DenseMatrix& t,
                                            const DenseMatrix& freed, DenseMatrix all,
                                            double accuracy) const {
  const PetscInt n = impedance_.nodes(), columns = search.given.columns();
  ContactResponses result{DenseMatrix(impedance_.length(), columns), std::move(all),
                          std::vector<int>(columns)};
  const DenseMatrix& effects = result.effects;
  const auto& local = search.block->unknowns.local;
  // No reaction balances forces on a rigid-body mode.
  std::vector<double> largest(2 * columns, 0.0);  // of forces on free unknowns, and of given ones
  for (PetscInt j = 0; j < columns; ++j) {
    for (const PetscInt i : local)
      largest[2 * j] = std::max(largest[2 * j], std::abs(effects(n + i, j)));
    for (const double force : search.given.column(j))
      largest[2 * j + 1] = std::max(largest[2 * j + 1], std::abs(force));
  }
  mpi::reduce<double>(impedance_.comm(), largest, MPI_MAX);
  for (PetscInt j = 0; j < columns; ++j) {
    result.found[j] = std::isfinite(search.left[j]) &&
                      search.isBalanced(j, std::max(accuracy, accepted)) &&
                      largest[2 * j] <= balancedForces * largest[2 * j + 1];
    std::ranges::copy(t.column(j), result.causes.column(j).begin());
    for (const PetscInt i : local) result.causes(n + i, j) = freed(free_.placeOf(i), j);
  }
  return result;
}

}  // namespace squeal::impedance
