// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/completeness/damped.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "algebra/linalg/spread.hpp"
#include "base/petsc/matrix.hpp"
#include "base/system/mpi.hpp"
#include "base/system/termination.hpp"
#include "eigen/completeness/basis_products.hpp"
#include "eigen/completeness/completeness.hpp"
#include "eigen/completeness/damped_bounds.hpp"
#include "eigen/completeness/damped_products.hpp"
#include "eigen/completeness/list_judgement.hpp"
#include "eigen/proof/count.hpp"
#include "eigen/proof/enclosure.hpp"
#include "eigen/proof/reason.hpp"

namespace squeal::completeness {
namespace {

using linalg::DenseMatrix;

using Pairs = std::vector<linalg::DensePair>;

/// Returns those pairs of a point whose eigenvalues lie above the band, in the region or near it.
/// The sweep has not corrected them.
Pairs uncorrected(const Pairs& pairs, const pencil::ComplexModes& point) {
  constexpr double farthest = 1.12;
  const double top = wantedTop(point.bandTop);
  Pairs some;
  std::ranges::copy_if(pairs, std::back_inserter(some), [&](const linalg::DensePair& pair) {
    const double size = std::abs(pair.s);
    return size > point.bandTop && size < farthest * top && pair.s.real() > -proof::mostLeft * top;
  });
  return some;
}

/// Collective. Extends the basis by corrections of the pairs that the sweep has not corrected.
void addCorrections(reduction::ReducedProblem& reduced, const std::vector<DampedList>& points) {
  constexpr std::size_t atOnce = 8;  // limits the memory for the terms of the points
  std::vector<std::pair<reduction::PointProblem, Pairs>> located;
  for (const auto& point : points) {
    const auto& [at, pencil, set] = *point.problem;
    auto pairs = uncorrected(reduced.watchedPairs(at, set).value_or(Pairs()), *point.list);
    if (!pairs.empty())
      located.emplace_back(reduction::PointProblem{at, pencil.with({}), set}, std::move(pairs));
    if (located.size() == atOnce || (&point == &points.back() && !located.empty())) {
      reduced.improve(located);
      located.clear();
    }
  }
}

/// Returns P(s) q for a vector of the first coordinates.
std::vector<Complex> forcesOf(const linalg::DenseProblem& problem, const linalg::DensePair& pair) {
  std::vector<Complex> forces(problem.order());
  const auto add = [&](const DenseMatrix& matrix, Complex factor) {
    if (matrix.empty()) return;
    for (std::size_t j = 0; j < pair.q.size(); ++j) {
      const Complex weight = factor * pair.q[j];
      const auto column = matrix.column(static_cast<PetscInt>(j));
      for (std::size_t i = 0; i < forces.size(); ++i) forces[i] += weight * column[i];
    }
  };
  add(problem.stiffness, 1);
  add(problem.damping, pair.s);
  add(problem.mass, pair.s * pair.s);
  return forces;
}

/// Collective. Returns the data of a point.
DampedPoint dataOf(const reduction::ReducedProblem& reduced, const DampedSweep& sweep,
                   const CommonProducts& common, const DampedList& point) {
  const auto& at = point.problem->at;
  DampedPoint data{.problem = reduced.project(*point.problem),
                   .bodyFactors = {},
                   .normalFactors = {},
                   .speed = at.speed,
                   .friction = common.restricted(point.friction()),
                   .vectors = {},
                   .forces = {}};
  for (const auto* term : common.bodies()) data.bodyFactors.push_back(term->coefficient(at));
  for (const auto& term : sweep.factors.normal) data.normalFactors.push_back(term.coefficient(at));
  const auto pairs = reduced.watchedPairs(at, point.problem->set).value_or(Pairs());
  data.vectors = data.forces = DenseMatrix(data.problem.order());
  for (const auto& pair : pairs) appendParts(pair.q, data.vectors);
  for (const auto& pair : uncorrected(pairs, *point.list))
    appendParts(forcesOf(data.problem, pair), data.forces);
  return data;
}

/// Proves the list of a point, if the bounds suffice.
void proveList(const DampedSet& set, DampedPoint data, const Settings& settings,
               const pencil::WatchedBand& band, pencil::ComplexModes& point) {
  auto& found = *point.completeness;
  const double wanted = wantedTop(point.bandTop);
  const auto bounds = dampedBounds(set, std::move(data), wanted);
  const proof::DiagonalForm form(bounds.kept, wanted);
  std::vector<Complex> list;
  for (const auto& e : point.eigenvalues) list.push_back(e.s);
  const double top = proof::placedTop(form.eigenvalues(), wanted, within);
  const auto [region, count] =
      proof::proveDamped(form, bounds.leftOut, top, 0, list, settings.discs);
  recordCount(region, count, found);
  found.reason = proof::reason(count, remedies("-modes_count"));
  judgeList(proof::enclose(form, bounds.leftOut, region, count), region, band, point);
}

/// Collective. Proves the lists of at most as many points as there are ranks.
void proveTogether(reduction::ReducedProblem& reduced, const DampedSweep& sweep,
                   const CommonProducts& common, const DampedSet& set,
                   std::span<const DampedList> points) {
  const MPI_Comm comm = reduced.basis().comm();
  std::vector<pencil::ComplexModes*> lists;
  std::optional<DampedPoint> own;
  for (const auto& point : points) {
    const bool isOwn = mpi::rank(comm) == std::ssize(lists);
    lists.push_back(point.list);
    auto& found = point.list->completeness.emplace();
    try {
      auto data = dataOf(reduced, sweep, common, point);
      if (isOwn) own = std::move(data);
    } catch (const Error& error) {  // on all ranks
      found.reason = error.what();
    }
  }
  linalg::onOwners(comm, lists.size(), [&](std::size_t i) {
    if (!own) return;
    try {
      proveList(set, std::move(*own), sweep.settings, reduced.band(), *lists[i]);
    } catch (const Error& error) {
      auto& found = lists[i]->completeness.emplace();
      found.reason = error.what();
    }
  });
  share(comm, lists);
  if (sweep.afterPoints) sweep.afterPoints(lists);
}

}  // namespace

bool coversDamped(const reduction::PointProblem& problem, const pencil::JumpFactors& factors) {
  if (!factors.missing.empty()) return false;
  const auto& terms = problem.pencil.terms();
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const auto& term = terms[t];
    if (term.coefficient(problem.at) == 0 || term.containsFriction()) continue;
    if (t >= problem.pencil.affineCount() || !isSparse(term.matrix) ||
        (!term.isAssociated() && term.power == 2))
      return false;
  }
  return true;
}

void proveDamped(reduction::ReducedProblem& reduced, const DampedSweep& sweep,
                 const std::vector<DampedList>& points) {
  if (points.empty()) return;
  const auto associated = points.front().problem->pencil.associated();
  const auto known = knownModes(reduced, sweep.system, sweep.modes, associated);
  if (!known) {
    for (const auto& point : points) point.list->completeness.emplace().reason = unconfirmed;
    return;
  }
  addCorrections(reduced, points);
  const CommonProducts common(reduced, sweep, points, *known, associated);
  std::map<int, std::vector<DampedList>> bySet;
  for (const auto& point : points) bySet[point.problem->set].push_back(point);
  const std::size_t ranks = mpi::size(reduced.basis().comm());
  for (const auto& [number, some] : bySet) {
    DampedSet set = common.of(reduced.space(number));
    auto ofSet = reduced.projectAssociated(number);
    set.energy = std::move(ofSet.stiffness);
    set.mass = std::move(ofSet.mass);
    for (std::size_t first = 0; first < some.size(); first += ranks) {
      stopIfRequested(reduced.basis().comm());
      proveTogether(reduced, sweep, common, set,
                    std::span(some).subspan(first, std::min(ranks, some.size() - first)));
    }
  }
}

}  // namespace squeal::completeness
