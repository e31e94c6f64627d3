// SPDX-License-Identifier: BSD-2-Clause
#include "steady/impedance/contact_solver.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

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

/// The search, in the space of friction magnitudes, for the friction due to several given forces
/// under the same conditions.
struct ContactSolver::Search {
  const ContactConditions& conditions;
  DenseMatrix given;         // (R, F)0, one column for each
  std::vector<double> unit;  // [column] reference of the unbalanced part, N
  std::shared_ptr<FreeBlock> block = nullptr;
  DenseMatrix wanted = {};                  // t without its own effects, [contact node]×[column]
  DenseMatrix weights{0, given.columns()};  // [direction]×[column]
  std::vector<double> left = {};            // [column] 2-norm of the unbalanced part, N
  DenseMatrix g = {}, gram = {};  // t − c R of the space, [contact node]×[direction]; GᵀG

  bool isBalanced(std::size_t column, double accuracy) const {
    return left[column] <= accuracy * unit[column];
  }
  bool isBalanced(double accuracy) const {
    for (std::size_t j = 0; j < left.size(); ++j)
      if (!isBalanced(j, accuracy)) return false;
    return true;
  }
};

ContactSolver::ContactSolver(const Impedance& impedance)
    : impedance_(impedance),
      free_(impedance),
      magnitudes_(impedance.nodes()),
      responses_(impedance.length()) {}

/// Collective. Makes the columns of these unknowns known.
void ContactSolver::computeColumns(std::span<const unsigned char> free) {
  free_.compute(free);
  const DenseMatrix& all = free_.columns();
  frictionalColumns_.append(
      linalg::rowsOf(frictional_, all.columnRange(frictionalColumns_.columns(), all.columns())));
}

/// Collective. Extends the list of nodes with friction by those of these cases.
void ContactSolver::noteFriction(std::span<const ContactCase> cases) {
  std::vector<unsigned char> known(impedance_.nodes(), 0);
  for (const PetscInt node : frictional_) known[node] = 1;
  const std::size_t before = frictional_.size();
  for (const auto& one : cases)
    for (std::size_t i = 0; i < known.size(); ++i)
      if (one.conditions.coefficient[i] != 0 && !known[i]) {
        known[i] = 1;
        frictional_.push_back(i);
      }
  if (!mpi::any(impedance_.comm(), frictional_.size() > before)) return;
  frictionalColumns_ = linalg::rowsOf(frictional_, free_.columns());
  for (const auto& block : free_.blocks()) block->normal = DenseMatrix(std::ssize(frictional_));
}

double ContactSolver::stiffness(std::size_t unknown) const {
  const PetscInt place = free_.placeOf(unknown);
  return place < 0 ? 0 : free_.columns()(impedance_.nodes() + unknown, place);
}

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

/// Returns the first case of each group of cases with stiffnesses in memory together, followed by
/// the number of cases.
std::vector<std::size_t> ContactSolver::groups(std::span<const ContactCase> cases) const {
  std::vector<double> orders;
  for (const auto& one : cases) orders.push_back(std::ranges::count(one.conditions.free, 1));
  mpi::reduce<double>(impedance_.comm(), orders, MPI_SUM);
  const double most = FreeUnknowns::mostBytes(impedance_.comm());
  std::vector<std::size_t> begins{0};
  double bytes = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double more = 8 * orders[i] * orders[i];
    if (i > begins.back() && bytes + more > most) begins.push_back(i), bytes = 0;
    bytes += more;
  }
  begins.push_back(cases.size());
  return begins;
}

std::vector<ContactSolution> ContactSolver::solve(std::span<const ContactCase> cases,
                                                  double accuracy) {
  const PetscInt n = impedance_.nodes(), length = impedance_.length();
  std::vector<unsigned char> free(length - n);
  for (const auto& one : cases)
    std::ranges::transform(free, one.conditions.free, free.begin(), std::bit_or<unsigned char>());
  computeColumns(free);
  noteFriction(cases);
  std::vector<ContactSolution> solutions;
  const auto begins = groups(cases);
  for (std::size_t group = 0; group + 1 < begins.size(); ++group) {
    std::vector<Search> searches;
    for (std::size_t k = begins[group]; k < begins[group + 1]; ++k)
      searches.push_back(
          {cases[k].conditions, DenseMatrix(length, 1, cases[k].given), {cases[k].frictionUnit}});
    begin(searches);
    balance(searches, accuracy);
    for (const auto& [causes, effects, found] : responses(searches, accuracy))
      solutions.push_back({{causes.entries().begin(), causes.entries().end()},
                           {effects.entries().begin(), effects.entries().end()},
                           found[0] != 0});
  }
  return solutions;
}

std::vector<ContactResponses> ContactSolver::respond(std::span<const ContactCase> cases,
                                                     const std::vector<PetscInt>& changed,
                                                     const std::vector<double>& frictionUnits) {
  const PetscInt n = impedance_.nodes(), m = impedance_.length() - n, first = free_.first();
  const auto isOwn = [&](PetscInt unknown) { return unknown >= first && unknown < first + m; };
  std::vector<unsigned char> known = cases.front().conditions.free;
  std::vector<int> isFree;
  for (const PetscInt unknown : changed) {
    isFree.push_back(isOwn(unknown) && known[unknown - first]);
    if (isOwn(unknown)) known[unknown - first] = 1;
  }
  mpi::reduce<int>(impedance_.comm(), isFree, MPI_LOR);
  computeColumns(known);
  noteFriction(cases);
  DenseMatrix causes(impedance_.length());
  for (std::size_t k = 0; k < changed.size(); ++k)
    if (isFree[k]) {
      causes.resizeColumns(causes.columns() + 1);
      if (isOwn(changed[k])) causes(n + changed[k] - first, causes.columns() - 1) = 1;
    } else {
      causes.append(free_.columns().column(free_.columnOf(changed[k])));
    }
  std::vector<double> units{0};
  units.insert(units.end(), frictionUnits.begin(), frictionUnits.end());
  std::vector<ContactResponses> result;
  for (const auto& one : cases) {
    DenseMatrix given(impedance_.length(), 1, one.given);
    given.append(causes);
    units[0] = one.frictionUnit;
    std::vector<Search> searches;
    searches.push_back({one.conditions, std::move(given), units});
    begin(searches);
    balance(searches, balanced);
    auto& [t, effects, found] =
        result.emplace_back(std::move(responses(searches, balanced).front()));
    for (std::size_t k = 0; k < changed.size(); ++k) {
      if (!isOwn(changed[k])) continue;
      const PetscInt row = n + changed[k] - first;
      if (isFree[k])
        effects(row, k + 1) -= 1;  // what remains is the force of the contact
      else
        t(row, k + 1) = 1;
    }
  }
  return result;
}

ContactSolution ContactSolver::withGaps(const std::vector<double>& gaps, ContactCase one) {
  const PetscInt n = impedance_.nodes();
  std::vector<unsigned char> open(one.conditions.free.size(), 0);
  for (PetscInt i = 0; i < n; ++i) open[i] = gaps[i] != 0;
  computeColumns(open);
  DenseMatrix weights(free_.columns().columns(), 1), effects(impedance_.length(), 1, one.given);
  for (PetscInt i = 0; i < n; ++i)
    if (open[i]) weights(free_.placeOf(i), 0) = gaps[i];
  mpi::reduce<double>(impedance_.comm(), {weights.data(), std::size_t(weights.size())}, MPI_SUM);
  if (!weights.empty()) linalg::multiplyAdd(free_.columns(), weights, effects);
  std::fill_n(one.conditions.free.begin(), n, 0);
  one.given.assign(effects.entries().begin(), effects.entries().end());
  auto result = solve(one);
  std::ranges::copy(gaps, result.causes.begin() + n);
  return result;
}

}  // namespace squeal::impedance
