// SPDX-License-Identifier: BSD-2-Clause
#include "steady/condensed/path_states.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/lu.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"

namespace squeal::condensed {

using impedance::ContactSolution;
using linalg::DenseMatrix;

namespace {

/// The number of places of a part.
constexpr int placeCount = 9;
/// The largest unbalanced friction of an interpolated state as a fraction of its friction, and the
/// largest difference of its given forces from the true ones as a fraction of these.
constexpr double accurate = 3e-12;
/// The largest force on a free unknown of an interpolated state as a fraction of the given forces.
constexpr double balancedForces = 1e-9;
/// Shorter parts are not interpolated.
constexpr double shortest = 1. / 256;
/// The largest distance of an interpolated place from its part.
constexpr double beyond = 1e-6;
/// The largest number of changed unknowns of a part, and of bytes of their responses on a rank.
constexpr double mostChanged = 256, mostBytes = 4e8;
/// The smallest stiffness against a displacement of an unknown, relative to that of the closed
/// contact. A smaller one shows a body that is loose or nearly so.
constexpr double leastStiffness = 1e-8;

/// Returns Chebyshev's points of the second kind in [begin, end], ascending.
std::vector<double> placesIn(double begin, double end) {
  std::vector<double> places;
  for (int k = 0; k < placeCount; ++k)
    places.push_back(std::lerp(begin, end, (1 - std::cos(M_PI * k / (placeCount - 1))) / 2));
  places.back() = end;
  return places;
}

/// Returns the weights of the values at Chebyshev's points of the second kind in the polynomial at
/// s (Berrut and Trefethen, SIAM Review 46, 2004, equation 5.4).
std::vector<double> weightsAt(double s, const std::vector<double>& places) {
  std::vector<double> weights(places.size(), 0.0);
  double sum = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (s == places[k]) {
      std::ranges::fill(weights, 0.0);
      weights[k] = 1;
      return weights;
    }
    const double half = k == 0 || k + 1 == places.size() ? 0.5 : 1;
    sum += weights[k] = (k % 2 == 0 ? half : -half) / (s - places[k]);
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

}  // namespace

sweep::Parameters Line::at(double s) const {
  sweep::Parameters point = from;
  for (const auto value :
       {&sweep::Parameters::friction, &sweep::Parameters::speed, &sweep::Parameters::pressure})
    point.*value = std::lerp(from.*value, to.*value, s);  // exact where both are equal
  return point;
}

PathStates::PathStates(CondensedProblem& problem, const Line& line)
    : problem_(problem),
      line_(line),
      first_(mpi::sumBefore<PetscInt>(problem.comm(), std::ssize(problem.nodeOf()))) {
  const double length = problem.contact().interfaces.nodes.size() + problem.nodeOf().size(),
               bytes = 2. * sizeof(double) * placeCount * mpi::max(problem.comm(), length);
  mostChanged_ = static_cast<PetscInt>(std::min(mostChanged, mostBytes / std::max(bytes, 1.)));
}

/// Collective. Returns true if the part may serve for this set at the place s.
bool PathStates::fits(double s, const ChosenSet& set) const {
  return part_ && !part_->hasFailed && s >= part_->begin - beyond && s <= part_->end + beyond &&
         mpi::all(problem_.comm(), slideAlike(set.sticking, part_->base.sticking));
}

double PathStates::reach(double s, const contact::Mask& closed, const Sticking& sticking) {
  const ChosenSet set{line_.at(s), closed, sticking};
  if (part_ && s < part_->end && fits(s, set)) return part_->end;
  const double longest = !part_ ? 1 : part_->hasFailed ? part_->length() / 2 : 2 * part_->length();
  build(s, longest, set);
  return part_->end;
}

/// Collective. Makes a part that begins at s. It is halved until the state of its base is
/// interpolated accurately. If no node changes, the part is the rest of the line.
void PathStates::build(double s, double longest, const ChosenSet& base) {
  const auto free = problem_.caseOn(base).contactCase.conditions.free;
  part_.emplace(Part{.begin = s, .end = 1, .base = base, .free = free});
  const ContactSolution last = problem_.onSet({line_.at(1), base.closed, base.sticking});
  noteExpected(last, free);
  if (last.found && expectedOnAllRanks() == 0) return;
  for (double length = std::min(longest, 1 - s);; length /= 2) {
    const bool isLast = s + length >= 1 - shortest / 2;
    part_.emplace(Part{.begin = s, .end = isLast ? 1 : s + length, .base = base, .free = free});
    part_->current = free;
    if (length < shortest) return;
    if (computeSupports() && mpi::all(problem_.comm(), combine({})) && interpolatesBase()) {
      const Support& end = part_->supports.back();
      noteExpected({{end.causes.entries().begin(), end.causes.entries().end()},
                    {end.effects.entries().begin(), end.effects.entries().end()},
                    true},
                   free);
      if (expectedOnAllRanks() <= mostChanged_ / 2 && add({})) return;
    }
  }
}

/// Collective. Computes the states of the base at the places of the part. Returns false if there is
/// no state at some place.
bool PathStates::computeSupports() {
  std::vector<sweep::Parameters> points;
  const auto places = placesIn(part_->begin, part_->end);
  for (const double place : places) points.push_back(line_.at(place));
  auto states = problem_.respond(points, part_->base, {}, {});
  for (std::size_t k = 0; k < places.size(); ++k) {
    auto& [causes, effects, found] = states[k];
    if (!found[0]) return false;
    part_->supports.push_back({.s = places[k],
                               .causes = std::move(causes),
                               .effects = std::move(effects),
                               .given = problem_.given(points[k])});
  }
  return true;
}

/// Collective. Returns true if the interpolated states of the base are accurate in the middle and
/// at the ends of the part, between the places of its supports.
bool PathStates::interpolatesBase() {
  for (const int k : {0, placeCount / 2, placeCount - 2}) {
    const double s = (part_->supports[k].s + part_->supports[k + 1].s) / 2;
    const auto& base = part_->base;
    if (!interpolated(s, problem_.caseOn({line_.at(s), base.closed, base.sticking}))) return false;
  }
  return true;
}

PetscInt PathStates::expectedOnAllRanks() const {
  return mpi::sum<PetscInt>(problem_.comm(), std::ssize(part_->expected));
}

/// Notes the unknowns of the nodes of this rank with tension or overlap.
void PathStates::noteExpected(const ContactSolution& state,
                              const std::vector<unsigned char>& free) {
  constexpr double roundOff = 1e-9;
  const auto& nodes = problem_.contact().interfaces.nodes;
  const std::size_t n = nodes.size();
  double force = 0, gap = 0;
  for (std::size_t i = 0; i < n; ++i) {
    force = std::max(force, std::abs(state.effects[n + i]));
    gap = std::max(gap, std::abs(state.causes[n + i]));
  }
  std::vector<unsigned char> changes(n, 0);
  for (std::size_t i = 0; i < n; ++i)
    changes[i] = nodes[i].separates && (free[i] ? state.causes[n + i] < -roundOff * gap
                                                : state.effects[n + i] < -roundOff * force);
  part_->expected.clear();
  const auto& nodeOf = problem_.nodeOf();
  for (std::size_t k = 0; k < nodeOf.size(); ++k)
    if (changes[nodeOf[k]]) part_->expected.push_back(first_ + k);
}

/// Collective. Returns the accuracy of the friction of the responses to changes of these unknowns:
/// multiplied by the expected amount of the response, it is a small part of the friction of the
/// base.
std::vector<double> PathStates::frictionUnits(const std::vector<PetscInt>& unknowns) const {
  constexpr double margin = 30, least = 0.01;  // of the expected energies, and of the largest one
  const PetscInt n = std::ssize(problem_.contact().interfaces.nodes), m = std::ssize(part_->free);
  std::vector<double> energies, scales;  // roots of the expected energy, and of the stiffness
  for (const PetscInt unknown : unknowns) {
    const PetscInt k = unknown - first_;
    double energy = 0, scale = 0;
    if (k >= 0 && k < m && problem_.stiffness(k) > 0) {
      const double root = std::sqrt(problem_.stiffness(k));
      for (const Support& one : part_->supports) {
        const double value =
            part_->free[k] ? one.causes(n + k, 0) * root : one.effects(n + k, 0) / root;
        energy = std::max(energy, k < n ? -value : std::abs(value));
      }
      scale = part_->free[k] ? root : 1 / root;
    }
    energies.push_back(energy);
    scales.push_back(scale);
  }
  mpi::sumAlike(problem_.comm(), energies);
  mpi::sumAlike(problem_.comm(), scales);
  const double largest = energies.empty() ? 0 : std::ranges::max(energies);
  const auto friction = part_->supports.back().causes.column(0).first(n);
  const double unit = linalg::length(problem_.comm(), friction) / margin;
  std::vector<double> units;
  for (std::size_t k = 0; k < energies.size(); ++k) {
    const double amount = scales[k] * std::max(energies[k], least * largest);
    units.push_back(amount > 0 ? unit / amount : 0);
  }
  return units;
}

/// Collective. Computes the responses to changes of these unknowns, given on all ranks, and of the
/// expected ones, unless they are known. Returns false if they are too many, or not found.
bool PathStates::add(std::vector<PetscInt> unknowns) {
  Part& part = *part_;
  const auto isKnown = [&](PetscInt unknown) { return part.index.count(unknown) > 0; };
  const auto fits = [&] { return std::ssize(part.changed) + std::ssize(unknowns) <= mostChanged_; };
  std::erase_if(unknowns, isKnown);
  const auto needed = unknowns;
  const auto expected = concatenated(problem_.comm(), part.expected);
  unknowns.insert(unknowns.end(), expected.begin(), expected.end());
  std::ranges::sort(unknowns);
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  std::erase_if(unknowns, isKnown);
  if (!fits()) unknowns = needed;
  if (!fits()) return false;
  if (unknowns.empty()) return true;
  const auto units = frictionUnits(unknowns);
  std::vector<sweep::Parameters> points;
  for (const Support& one : part.supports) points.push_back(line_.at(one.s));
  const auto responses = problem_.respond(points, part.base, unknowns, units);
  const PetscInt n = std::ssize(problem_.contact().interfaces.nodes), m = std::ssize(part.free);
  const auto own = [&](PetscInt unknown) {
    const PetscInt k = unknown - first_;
    return k >= 0 && k < m ? k : -1;
  };
  std::vector<double> unit;
  for (const PetscInt unknown : unknowns) {
    part.index.emplace(unknown, part.changed.size());
    part.changed.push_back(unknown);
    const PetscInt k = own(unknown);
    const double root = k < 0 ? 0 : std::sqrt(std::max(problem_.stiffness(k), 0.0));
    unit.push_back(k < 0 ? 0 : part.free[k] ? 1 / root : root);
  }
  mpi::sumAlike(problem_.comm(), unit);
  part.unit.insert(part.unit.end(), unit.begin(), unit.end());
  bool found = true;
  for (std::size_t p = 0; p < points.size(); ++p) {
    Support& one = part.supports[p];
    const auto& more = responses[p];
    one.causes.append(more.causes.columnRange(1, more.causes.columns()));
    one.effects.append(more.effects.columnRange(1, more.effects.columns()));
    one.conditions = DenseMatrix(std::ssize(part.changed), one.causes.columns());
    for (PetscInt l = 0; l < one.conditions.rows(); ++l) {
      const PetscInt k = own(part.changed[l]);
      if (k < 0) continue;
      const DenseMatrix& values = part.free[k] ? one.causes : one.effects;
      for (PetscInt j = 0; j < values.columns(); ++j) one.conditions(l, j) = values(n + k, j);
    }
    mpi::sumAlike(problem_.comm(), one.conditions.entries());
    found = found && std::ranges::all_of(more.found, [](int is) { return is != 0; });
  }
  return found;
}

/// Collective. Makes the set with these free unknowns the current one. Returns false if its states
/// cannot be combined from responses.
bool PathStates::moveTo(const std::vector<unsigned char>& free) {
  Part& part = *part_;
  if (!mpi::any(problem_.comm(), free != part.current)) return true;
  std::vector<PetscInt> own;
  for (std::size_t k = 0; k < free.size(); ++k)
    if (free[k] != part.free[k]) own.push_back(first_ + k);
  const auto differing = concatenated(problem_.comm(), own);
  const auto isKnown = [&](PetscInt unknown) { return part.index.count(unknown) > 0; };
  part.current.clear();
  if (!std::ranges::all_of(differing, isKnown) && !add(differing)) {
    part.hasFailed = true;
    return false;
  }
  std::vector<std::size_t> active;
  for (const PetscInt unknown : differing) active.push_back(part.index.at(unknown));
  if (!mpi::all(problem_.comm(), combine(active))) return false;
  part.current = free;
  return true;
}

/// Computes the states at all places on the set that differs from the base in the `active` ones of
/// the changed unknowns. Returns false if a body is loose on this set, or nearly so.
bool PathStates::combine(const std::vector<std::size_t>& active) {
  const PetscInt count = std::ssize(active);
  for (Support& one : part_->supports) {
    one.stateCauses = DenseMatrix(one.causes.columnRange(0, 1));
    one.stateEffects = DenseMatrix(one.effects.columnRange(0, 1));
    if (count == 0) continue;
    // The entries have no unit. Those of an unknown that is freed are at most of the order of 1,
    // and small if it moves freely. Those of one that is held are at least of that order, and large
    // if it moved freely before.
    const auto unit = [&](PetscInt i) { return part_->unit[active[i]]; };
    DenseMatrix matrix(count, count), amounts(count, 1);
    for (PetscInt j = 0; j < count; ++j)
      for (PetscInt i = 0; i < count; ++i)
        matrix(i, j) = one.conditions(active[i], active[j] + 1) / (unit(i) * unit(j));
    for (PetscInt i = 0; i < count; ++i) {
      amounts(i, 0) = -one.conditions(active[i], 0) / unit(i);
      const double own = std::abs(matrix(i, i));
      if (!(own > leastStiffness && own < 1 / leastStiffness)) return false;
    }
    const linalg::Lu<double> factors(std::move(matrix));
    if (!(factors.pivotRatio() > leastStiffness)) return false;
    factors.solve(amounts);
    for (PetscInt i = 0; i < count; ++i) {
      const double amount = amounts(i, 0) / unit(i);
      const auto addTo = [&](DenseMatrix& state, const DenseMatrix& columns) {
        const auto column = columns.column(active[i] + 1);
        for (std::size_t k = 0; k < column.size(); ++k) state.data()[k] += amount * column[k];
      };
      addTo(one.stateCauses, one.causes);
      addTo(one.stateEffects, one.effects);
    }
  }
  return true;
}

/// Collective. Returns the state of the current set at the place s of `asked`; none if it is not
/// accurate.
std::optional<ContactSolution> PathStates::interpolated(double s, const SetCase& asked) const {
  const auto& [conditions, given, unit] = asked.contactCase;
  std::vector<double> places;
  for (const Support& one : part_->supports) places.push_back(one.s);
  const auto weights = weightsAt(s, places);
  ContactSolution state{ContactSolution{std::vector<double>(given.size(), 0.0),
                                        std::vector<double>(given.size(), 0.0), true}};
  std::vector<double> sum(given.size(), 0.0);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const Support& one = part_->supports[k];
    for (std::size_t i = 0; i < given.size(); ++i) {
      state.causes[i] += weights[k] * one.stateCauses(i, 0);
      state.effects[i] += weights[k] * one.stateEffects(i, 0);
      sum[i] += weights[k] * one.given[i];
    }
  }
  // Squares of the unbalanced friction, the friction, the wrong given forces, the given forces, the
  // forces on free unknowns.
  std::vector<double> squares(5, 0.0);
  const std::size_t n = conditions.coefficient.size();
  for (std::size_t k = 0; k < conditions.free.size(); ++k)
    if (conditions.free[k]) squares[4] += std::pow(state.effects[n + k], 2);
  for (std::size_t i = 0; i < n; ++i) {
    squares[0] += std::pow(state.causes[i] - conditions.coefficient[i] * state.effects[i], 2);
    squares[1] += std::pow(state.causes[i], 2);
  }
  for (std::size_t i = 0; i < given.size(); ++i) {
    squares[2] += std::pow(sum[i] - given[i], 2);
    squares[3] += std::pow(given[i], 2);
  }
  mpi::sumAlike(problem_.comm(), squares);
  const auto isSmall = [&](std::size_t part) {
    return squares[part] <= accurate * accurate * squares[part + 1];  // false for NaN
  };
  if (!isSmall(0) || !isSmall(2)) return {};
  if (!(squares[4] <= balancedForces * balancedForces * squares[3])) return {};
  return state;
}

ContactSolution PathStates::at(double s, const contact::Mask& closed, const Sticking& sticking) {
  const ChosenSet set{line_.at(s), closed, sticking};
  if (fits(s, set) && !part_->supports.empty()) {
    const SetCase asked = problem_.caseOn(set);
    if (moveTo(asked.contactCase.conditions.free)) {
      if (auto state = interpolated(s, asked)) {
        if (s == part_->end) noteExpected(*state, part_->current);
        return *state;
      }
      part_->hasFailed = true;
    }
  }
  ++computedSingly_;
  return problem_.onSet(set);
}

}  // namespace squeal::condensed
