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
/// The largest number of directions per call.
constexpr PetscInt mostDirections = 500;
/// The remainder of a direction, a unit vector, must be longer than this after orthogonalisation
/// against the space of friction magnitudes, and against its block. The next block contains the
/// directions omitted here.
constexpr double newInSpace = 1e-10, newInBlock = 0.3;

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

double ContactSolver::gapStiffness(std::size_t node) const {
  const PetscInt place = free_.placeOf(node);
  return place < 0 ? 0 : free_.columns()(impedance_.nodes() + node, place);
}

/// Releases the free unknowns until F = 0 there. Returns their values, [known column], and adds
/// their effects to `effects`.
DenseMatrix ContactSolver::release(const FreeBlock& block, DenseMatrix& effects) const {
  DenseMatrix amounts = free_.released(block, effects);
  if (!amounts.empty()) linalg::multiplyAdd(free_.columns(), amounts, effects);
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
  const DenseMatrix amounts =
      block.direct ? free_.released(block, fresh) : free_.released(block, responses_, known, all);
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
  const auto& local = search.block->unknowns.local;
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
    result.causes[n + local[i]] = freed(free_.placeOf(local[i]), 0);
  result.effects.assign(effects.entries().begin(), effects.entries().end());
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
    for (std::size_t k = begins[group]; k < begins[group + 1]; ++k) {
      const auto& conditions = cases[k].conditions;
      searches.push_back(
          {cases[k], free_.blockOf(conditions.free, conditions.direct), DenseMatrix(n, 1)});
    }
    std::vector<std::shared_ptr<FreeBlock>> blocks;
    for (const Search& search : searches) blocks.push_back(search.block);
    free_.makeReady(blocks);
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
