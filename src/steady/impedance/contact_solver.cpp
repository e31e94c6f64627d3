// SPDX-License-Identifier: BSD-2-Clause
#include "steady/impedance/contact_solver.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/rows.hpp"
#include "algebra/linalg/spread.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/petsc/object.hpp"
#include "base/system/concatenation.hpp"
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
/// The largest number of directions per call.
constexpr PetscInt mostDirections = 500;
/// The remainder of a direction, a unit vector, must be longer than this after orthogonalisation
/// against the space of friction magnitudes, and against its block. The next block contains the
/// directions omitted here.
constexpr double newInSpace = 1e-10, newInBlock = 0.3;
/// Returns the largest number of bytes on all ranks for stiffnesses of free unknowns, unless a
/// single one needs more.
double mostBytes(MPI_Comm comm) { return 256e6 * mpi::size(comm); }
/// The largest number of active sets in memory.
constexpr std::size_t mostBlocks = 32;

/// Collective. Returns the coefficients a that minimise |b − G a|. It refines the normal equations,
/// which gives all digits if the condition number of G is below some 1e7.
DenseMatrix leastSquares(MPI_Comm comm, const DenseView& g, const DenseView& b) {
  const SymmetricInverse inverse(linalg::transposedProduct(comm, g, g));
  DenseMatrix sum(g.columns(), 1), rest(b);
  for (int pass = 0; pass < 3; ++pass) {
    DenseMatrix step = linalg::transposedProduct(comm, g, rest);
    inverse.apply(step);
    linalg::addScaled(sum, 1, step);
    linalg::multiplyAdd(g, step, rest, -1);
  }
  return sum;
}

}  // namespace

/// The quantities that depend on the free unknowns: their stiffness, and the effects of friction
/// while they are free.
struct ContactSolver::FreeBlock {
  std::vector<unsigned char> free;  // [released unknown]
  OwnedMat direct;                  // stored, so its address stays unique
  std::vector<PetscInt> local;      // free unknowns of this rank
  std::vector<PetscInt> places;     // [free unknown of any rank] its column
  Concatenation ranks;              // of `local`
  int owner;                        // the rank that has the next two
  DenseMatrix matrix;               // F of w among the free unknowns, until it is factorised
  SymmetricInverse stiffness;       // the same, factorised
  /// R of the friction magnitudes with the free unknowns released, [frictional node]
  DenseMatrix normal;

  double bytes() const { return 8.0 * ranks.size() * ranks.size(); }
  /// Not collective: the owners of several blocks factorise them at the same time.
  void factorise() {
    if (!matrix.empty()) stiffness = SymmetricInverse(linalg::symmetricPart(matrix));
    matrix = {};
  }
};

/// The search for the friction of one case in the space of friction magnitudes.
struct ContactSolver::Search {
  const ContactCase& contactCase;
  std::shared_ptr<FreeBlock> block;
  DenseMatrix wanted;         // t without its own effects, [contact node]
  double unit = 0;            // reference of the unbalanced part, N
  DenseMatrix weights{0, 1};  // [direction]
  double left = 0;            // 2-norm of the unbalanced part, N
};

ContactSolver::ContactSolver(const Impedance& impedance)
    : impedance_(impedance),
      columns_(impedance.length()),
      magnitudes_(impedance.nodes()),
      responses_(impedance.length()) {
  first_ = mpi::sumBefore<PetscInt>(impedance.comm(), impedance.nodeOf().size());
}

ContactSolver::~ContactSolver() = default;

/// Computes the columns of unknowns that have not been free before.
void ContactSolver::computeColumns(std::span<const unsigned char> free) {
  std::vector<PetscInt> wanted;
  for (std::size_t i = 0; i < free.size(); ++i)
    if (free[i] && place_.count(first_ + i) == 0) wanted.push_back(first_ + i);
  const auto all = concatenated(impedance_.comm(), wanted);
  if (all.empty()) return;
  for (const PetscInt unknown : all) place_.emplace(unknown, place_.size());
  const DenseMatrix fresh = impedance_.responsesToUnits(all);
  columns_.append(fresh);
  frictionalColumns_.append(linalg::rowsOf(frictional_, fresh));
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
  frictionalColumns_ = linalg::rowsOf(frictional_, columns_);
  for (auto& block : blocks_) block->normal = DenseMatrix(std::ssize(frictional_));
}

double ContactSolver::gapStiffness(std::size_t node) const {
  const auto place = place_.find(first_ + node);
  return place == place_.end() ? 0 : columns_(impedance_.nodes() + node, place->second);
}

std::shared_ptr<ContactSolver::FreeBlock> ContactSolver::blockOf(
    const ContactConditions& conditions) {
  const MPI_Comm comm = impedance_.comm();
  const auto& free = conditions.free;
  const PetscInt n = impedance_.nodes();
  std::vector<int> same;
  for (const auto& block : blocks_)
    same.push_back(block->free == free && block->direct.get() == conditions.direct);
  mpi::reduce<int>(comm, same, MPI_LAND);
  if (const auto known = std::ranges::find(same, 1); known != same.end()) {
    const auto place = blocks_.begin() + (known - same.begin());
    std::rotate(blocks_.begin(), place, place + 1);
    return blocks_.front();
  }
  computeColumns(free);
  std::vector<PetscInt> local, mine;
  for (std::size_t i = 0; i < free.size(); ++i)
    if (free[i]) local.push_back(i), mine.push_back(place_.at(first_ + i));
  const Concatenation ranks(comm, local.size());
  auto places = ranks.gathered(mine);
  // Row by row, so that one message has all rows of a rank. The matrix is symmetric except for
  // round-off, so its rows serve as columns.
  DenseMatrix rows(std::ssize(places), local.size()), matrix(std::ssize(places), ranks.size());
  for (PetscInt j = 0; j < rows.rows(); ++j)
    for (std::size_t i = 0; i < local.size(); ++i) rows(j, i) = columns_(n + local[i], places[j]);
  ranks.gather(rows.data(), matrix.data(), static_cast<int>(rows.rows()));
  const int owner = static_cast<int>(blocksSoFar_++ % mpi::size(comm));
  if (owner != mpi::rank(comm)) matrix = {};
  OwnedMat direct;
  if (conditions.direct) {
    check(PetscObjectReference(object(conditions.direct)));
    direct = OwnedMat(conditions.direct);
  }
  blocks_.insert(blocks_.begin(),
                 std::make_shared<FreeBlock>(
                     free, std::move(direct), std::move(local), std::move(places), ranks, owner,
                     std::move(matrix), SymmetricInverse(), DenseMatrix(std::ssize(frictional_))));
  const double most = mostBytes(comm);
  double bytes = 0;
  const auto kept =
      std::ranges::find_if(blocks_.begin() + 1, blocks_.end(), [&](const auto& block) {
        return (bytes += block->bytes()) + blocks_.front()->bytes() > most;
      });
  blocks_.erase(kept, blocks_.end());
  if (blocks_.size() > mostBlocks) blocks_.resize(mostBlocks);
  return blocks_.front();
}

/// Returns the values of the free unknowns, [known column], that make F = 0 there; each rank has
/// all of them.
DenseMatrix ContactSolver::released(const FreeBlock& block, const DenseView& effects) const {
  const PetscInt n = impedance_.nodes();
  DenseMatrix rows(block.local.size(), effects.columns());
  for (PetscInt j = 0; j < effects.columns(); ++j)
    for (std::size_t i = 0; i < block.local.size(); ++i)
      rows(i, j) = -effects(n + block.local[i], j);
  DenseMatrix freed = linalg::gatheredRows(block.ranks, rows);
  const MPI_Comm comm = impedance_.comm();
  if (mpi::rank(comm) == block.owner) block.stiffness.apply(freed);
  mpi::broadcastEntries(comm, freed.entries(), block.owner);
  DenseMatrix amounts(columns_.columns(), freed.columns());
  for (PetscInt j = 0; j < freed.columns(); ++j)
    for (PetscInt i = 0; i < freed.rows(); ++i) amounts(block.places[i], j) = freed(i, j);
  return amounts;
}

/// Releases the free unknowns until F = 0 there. Returns their values, [known column], and adds
/// their effects to `effects`.
DenseMatrix ContactSolver::release(const FreeBlock& block, DenseMatrix& effects) const {
  DenseMatrix amounts = released(block, effects);
  if (!amounts.empty()) linalg::multiplyAdd(columns_, amounts, effects);
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

/// Updates a block to the present space of friction magnitudes.
void ContactSolver::update(FreeBlock& block) const {
  const PetscInt known = block.normal.columns(), all = magnitudes_.columns();
  if (known == all) return;
  DenseMatrix fresh(responses_.columnRange(known, all));
  addDirect(block, magnitudes_.columnRange(known, all), fresh);
  // Elsewhere c = 0, and R is not needed: most of the nodes of a brake have no friction.
  DenseMatrix normal = linalg::rowsOf(frictional_, fresh);
  const DenseMatrix amounts = released(block, fresh);
  if (!amounts.empty()) linalg::multiplyAdd(frictionalColumns_, amounts, normal);
  block.normal.append(normal);
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

/// Searches for the friction of all cases until each is balanced or the space no longer grows.
void ContactSolver::balance(std::vector<Search>& searches, double accuracy) {
  const PetscInt n = impedance_.nodes(), most = magnitudes_.columns() + mostDirections;
  const MPI_Comm comm = impedance_.comm();
  DenseMatrix unbalanced(n);
  do {
    unbalanced.resizeColumns(0);
    for (Search& search : searches) {
      if (search.left <= accuracy * search.unit) continue;
      update(*search.block);
      const auto& coefficient = search.contactCase.conditions.coefficient;
      DenseMatrix g = magnitudes_;  // t − c R
      for (PetscInt j = 0; j < g.columns(); ++j)
        for (std::size_t i = 0; i < frictional_.size(); ++i)
          g(frictional_[i], j) -= coefficient[frictional_[i]] * search.block->normal(i, j);
      search.weights = leastSquares(comm, g, search.wanted);
      DenseMatrix rest = search.wanted;
      linalg::multiplyAdd(g, search.weights, rest, -1);
      search.left = linalg::length(comm, rest.entries());
      if (!(search.left <= accuracy * search.unit)) unbalanced.append(rest);
    }
  } while (unbalanced.columns() > 0 && magnitudes_.columns() < most && extend(unbalanced));
}

ContactSolution ContactSolver::solution(const Search& search, double accuracy) const {
  const PetscInt n = impedance_.nodes(), length = impedance_.length(),
                 known = search.weights.rows();
  const DenseMatrix t = linalg::product(magnitudes_.columnRange(0, known), search.weights);
  DenseMatrix effects(length, 1, search.contactCase.given);
  linalg::multiplyAdd(responses_.columnRange(0, known), search.weights, effects);
  addDirect(*search.block, t, effects);
  const DenseMatrix freed = release(*search.block, effects);
  ContactSolution result;
  const auto& local = search.block->local;
  // No reaction balances forces on a rigid-body mode.
  double largest[2] = {0, 0};  // of the forces on free unknowns, and of the given ones
  for (const PetscInt i : local) largest[0] = std::max(largest[0], std::abs(effects(n + i, 0)));
  for (const double force : search.contactCase.given)
    largest[1] = std::max(largest[1], std::abs(force));
  mpi::reduce<double>(impedance_.comm(), largest, MPI_MAX);
  result.found = std::isfinite(search.left) &&
                 search.left <= std::max(accuracy, accepted) * search.unit &&
                 largest[0] <= balancedForces * largest[1];
  result.causes.assign(length, 0.0);
  std::ranges::copy(t.entries(), result.causes.begin());
  for (std::size_t i = 0; i < local.size(); ++i)
    result.causes[n + local[i]] = freed(place_.at(first_ + local[i]), 0);
  result.effects.assign(effects.entries().begin(), effects.entries().end());
  return result;
}

/// Returns the first case of each group of cases with stiffnesses in memory together, followed by
/// the number of cases.
std::vector<std::size_t> ContactSolver::groups(std::span<const ContactCase> cases) const {
  std::vector<double> orders;
  for (const auto& one : cases) orders.push_back(std::ranges::count(one.conditions.free, 1));
  mpi::reduce<double>(impedance_.comm(), orders, MPI_SUM);
  const double most = mostBytes(impedance_.comm());
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
  const MPI_Comm comm = impedance_.comm();
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
      searches.push_back({cases[k], blockOf(cases[k].conditions), DenseMatrix(n, 1)});
    linalg::onOwners(comm, mpi::size(comm), [&](std::size_t) {
      for (Search& search : searches) search.block->factorise();
    });
    for (Search& search : searches) {
      const auto& [conditions, given, frictionUnit] = search.contactCase;
      DenseMatrix effects(length, 1, given);
      release(*search.block, effects);
      for (PetscInt i = 0; i < n; ++i)
        search.wanted(i, 0) = conditions.coefficient[i] * effects(i, 0);
      search.left = linalg::length(comm, search.wanted.entries());
      search.unit = std::max(search.left, frictionUnit);
    }
    balance(searches, accuracy);
    for (const auto& search : searches) solutions.push_back(solution(search, accuracy));
  }
  return solutions;
}

ContactSolution ContactSolver::withGaps(const std::vector<double>& gaps, ContactCase one) {
  const PetscInt n = impedance_.nodes();
  std::vector<unsigned char> open(one.conditions.free.size(), 0);
  for (PetscInt i = 0; i < n; ++i) open[i] = gaps[i] != 0;
  computeColumns(open);
  DenseMatrix weights(columns_.columns(), 1), effects(impedance_.length(), 1, one.given);
  for (PetscInt i = 0; i < n; ++i)
    if (open[i]) weights(place_.at(first_ + i), 0) = gaps[i];
  mpi::reduce<double>(impedance_.comm(), {weights.data(), std::size_t(weights.size())}, MPI_SUM);
  if (!weights.empty()) linalg::multiplyAdd(columns_, weights, effects);
  std::fill_n(one.conditions.free.begin(), n, 0);
  one.given.assign(effects.entries().begin(), effects.entries().end());
  auto result = solve(one);
  std::ranges::copy(gaps, result.causes.begin() + n);
  return result;
}

}  // namespace squeal::impedance
