// SPDX-License-Identifier: BSD-2-Clause
#include "steady/condensed/pivots.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/petsc/check.hpp"
#include "base/system/mpi.hpp"

namespace squeal::condensed {
namespace {

using impedance::ContactCase;
using impedance::ContactSolution;

/// A slope below this fraction of its terms is round-off.
constexpr double rounding = 1e-9;
/// The largest number of pivots per contact node, and in addition. Contact problems take about one
/// pivot per node that finally opens or closes.
constexpr PetscInt mostPerNode = 4, mostBesides = 100;

/// A contact node of one of the ranks.
struct Place {
  int rank = 0;
  PetscInt node = 0;
};

/// The state on the present set as a linear function of a parameter ν that grows from 0.
struct Line {
  double value, slope;

  /// Returns the ν at which this becomes negative, or infinity; `size` is the magnitude of the
  /// terms of the slope.
  double end(double size) const {
    return slope < -rounding * size ? std::max(value, 0.0) / -slope : INFINITY;
  }
};

class Lemke {
 public:
  Lemke(impedance::ContactSolver& solver, const contact::Contact& contact,
        const ContactCase& contactCase, std::size_t n)
      : solver_(solver),
        nodes_(contact.interfaces.nodes),
        comm_(contact.mesh->comm),
        asked_(contactCase),
        rank_(mpi::rank(comm_)),
        total_(mpi::sum<PetscInt>(comm_, n)),
        open_(n, 0),
        cover_(n) {
    const PetscInt first = mpi::sumBefore<PetscInt>(comm_, n);
    // No two nodes should reach zero together, as they would in a symmetric brake under equal
    // forces. The fractional parts of the multiples of the golden ratio all differ.
    for (std::size_t i = 0; i < n; ++i) {
      const double multiple = 0.6180339887498949 * (first + i);
      cover_[i] = 1 + multiple - std::floor(multiple);
    }
  }

  bool solve(std::vector<double>& gaps) {
    if (!start()) {
      std::ranges::fill(gaps, 0);
      return true;
    }
    for (PetscInt k = 0; k < mostPerNode * total_ + mostBesides; ++k) {
      if (!findLines()) return false;
      const double last = lambda_.end(lambdaSize_);
      const auto [nu, place] = firstEnd();
      if (last <= nu && last < INFINITY) {
        for (std::size_t i = 0; i < gaps.size(); ++i)
          gaps[i] = open_[i] || (isPivot(i) && opens_) ? valueAt(i, last) : 0;
        return true;
      }
      if (!(nu < INFINITY)) return false;
      // The pivot node has left zero permanently, and the next one has reached it.
      if (rank_ == pivot_.rank && opens_) open_[pivot_.node] = 1;
      bool wasOpen = rank_ == place.rank && open_[place.node];
      mpi::broadcast(comm_, wasOpen, place.rank);
      if (rank_ == place.rank) open_[place.node] = 0;
      pivot_ = place;
      opens_ = !wasOpen;
    }
    return false;
  }

 private:
  bool isPivot(std::size_t i) const {
    return rank_ == pivot_.rank && static_cast<PetscInt>(i) == pivot_.node;
  }
  double valueAt(std::size_t i, double nu) const {
    return std::max(0.0, lines_[i].value + nu * lines_[i].slope);
  }
  /// Returns the conditions of the present set, in which the pivot node is closed.
  ContactCase onSet(std::vector<double> given) const {
    ContactCase result{asked_.conditions, std::move(given)};
    std::ranges::copy(open_, result.conditions.free.begin());
    return result;
  }
  std::vector<double> coverForces() const {
    std::vector<double> forces(asked_.given.size(), 0.0);
    for (std::size_t i = 0; i < cover_.size(); ++i) forces[cover_.size() + i] = cover_[i];
    return forces;
  }
  /// Returns the effects of a unit gap at the pivot node with all others closed, without friction.
  std::vector<double> unitGap() const {
    std::vector<double> unit(open_.size(), 0.0);
    if (rank_ == pivot_.rank) unit[pivot_.node] = 1;
    ContactCase bare{asked_.conditions, std::vector<double>(asked_.given.size(), 0.0)};
    std::ranges::fill(bare.conditions.free, 0);
    std::ranges::fill(bare.conditions.coefficient, 0);
    return solver_.withGaps(unit, bare).effects;
  }
  /// Finds the node that opens first as λ decreases. Returns false if all nodes are still closed at
  /// λ = 0.
  bool start() {
    const auto found = solver_.solve(onSet(asked_.given));
    double worst = 0;
    Place place{rank_, 0};
    const std::size_t n = open_.size();
    for (std::size_t i = 0; i < n; ++i) {
      const double needed = -found.effects[n + i] / cover_[i];
      if (nodes_[i].separates && needed > worst) worst = needed, place.node = i;
    }
    const auto [largest, where] = leastOf(-worst, place);
    pivot_ = where, opens_ = true;
    return largest < 0;
  }
  /// Collective. Computes λ, the forces and the gaps as functions of ν, the gap or the force of the
  /// pivot node. Returns false if the set has no such state.
  bool findLines() {
    std::vector<ContactCase> cases{onSet(asked_.given), onSet(coverForces())};
    std::vector<double> unit(asked_.given.size(), 0.0);
    if (opens_) cases.push_back(onSet(unit = unitGap()));
    const auto found = solver_.solve(cases);
    if (!std::ranges::all_of(found, &ContactSolution::found)) return false;
    const std::size_t n = open_.size();
    const auto margin = [&](std::size_t k, std::size_t i) {
      if (k >= found.size()) return 0.0;
      return open_[i] ? found[k].causes[n + i] : found[k].effects[n + i];
    };
    // F of the pivot node, a + λ b + ν c, is 0 while it opens and ν while it closes.
    std::array<double, 4> atPivot{};
    if (rank_ == pivot_.rank) {
      for (std::size_t k = 0; k < 3; ++k) atPivot[k] = margin(k, pivot_.node);
      atPivot[3] = opens_ ? unit[n + pivot_.node] : 1;
    }
    mpi::broadcast(comm_, atPivot, pivot_.rank);
    const auto [a, b, c, alone] = atPivot;
    if (!(b != 0)) return false;
    lambda_ = {-a / b, (opens_ ? -c : 1) / b};
    lambdaSize_ = std::abs(alone / b);
    lines_.resize(n);
    sizes_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double own = margin(2, i), covered = lambda_.slope * margin(1, i);
      lines_[i] = {margin(0, i) + lambda_.value * margin(1, i), own + covered};
      sizes_[i] = std::abs(own) + std::abs(covered);
      if (opens_) sizes_[i] += open_[i] ? 1 : std::abs(unit[n + i]);  // for a unit gap
      if (isPivot(i)) lines_[i] = {0, 1};                             // ν itself
    }
    return true;
  }
  /// Collective. Returns the first end of the forces and gaps of all nodes except the pivot node.
  std::pair<double, Place> firstEnd() const {
    double first = INFINITY;
    Place place{rank_, 0};
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (isPivot(i) || !nodes_[i].separates) continue;
      if (const double end = lines_[i].end(sizes_[i]); end < first) first = end, place.node = i;
    }
    return leastOf(first, place);
  }
  /// Collective. Returns the least value of all ranks and its place.
  std::pair<double, Place> leastOf(double value, Place place) const {
    const auto least = mpi::minLocated(comm_, value);
    mpi::broadcast(comm_, place.node, least.rank);
    place.rank = least.rank;
    return {least.value, place};
  }

  impedance::ContactSolver& solver_;
  const std::vector<contact::ContactNode>& nodes_;
  MPI_Comm comm_;
  const ContactCase& asked_;
  int rank_;
  PetscInt total_;             // contact nodes of all ranks
  contact::Mask open_;         // [contact node]
  std::vector<double> cover_;  // [contact node] d, N
  Place pivot_;                // the node with zero gap and force, one of which grows
  bool opens_ = true;          // true if the gap grows
  Line lambda_{};
  double lambdaSize_ = 0;
  std::vector<Line> lines_;    // [contact node] gap if it is open, force if it is closed
  std::vector<double> sizes_;  // [contact node] of the terms of the slope
};

}  // namespace

bool pivotGaps(impedance::ContactSolver& solver, const contact::Contact& contact,
               const ContactCase& contactCase, std::vector<double>& gaps) {
  return Lemke(solver, contact, contactCase, gaps.size()).solve(gaps);
}

}  // namespace squeal::condensed
