// SPDX-License-Identifier: BSD-2-Clause
#include "steady/impedance/contact_solver.hpp"

#include <algorithm>
#include <functional>

#include "algebra/linalg/rows.hpp"
#include "base/system/mpi.hpp"
#include "steady/impedance/contact_search.hpp"

namespace squeal::impedance {

using linalg::DenseMatrix;

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
