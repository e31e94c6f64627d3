// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/point_groups.hpp"

#include <algorithm>
#include <cmath>

#include "base/system/mpi.hpp"
#include "model/contact/active_set.hpp"
#include "problem/terms/terms.hpp"
#include "run/analysis/cost.hpp"

namespace squeal::analysis {
namespace {

/// Divides a sweep between points with different active sets.
class Division {
 public:
  /// Collective. Borrows the brake.
  explicit Division(const SlidingBrake& brake) : brake_(brake), spectra_(spectraOnSteps()) {
    const auto& solutions = brake.states.solutions;
    for (std::size_t i = 0; i < solutions.size(); ++i)
      if (solutions[i].converged &&
          (i == 0 || !solutions[i - 1].converged || differing(i - 1, i) > 0))
        begins_.push_back(i);
  }

  /// Collective. Returns the division with the least work.
  std::vector<PointGroup> cheapest() const {
    std::vector<Choice> best(begins_.size() + 1);  // [run] the groups of all runs before it
    best.front().work = 0;
    for (std::size_t run = 0; run < begins_.size(); ++run) extend(run, best);
    std::vector<PointGroup> groups;
    for (std::size_t run = begins_.size(); run > 0; run = best[run].from)
      groups.push_back(best[run].group);
    std::ranges::reverse(groups);
    for (std::size_t k = 1; k < groups.size(); ++k) groups[k - 1].isContinued = groups[k].continues;
    return groups;
  }

 private:
  /// The last group of a division of the first runs.
  struct Choice {
    double work = INFINITY;  // of all its groups
    std::size_t from = 0;    // first run of the last group
    PointGroup group = {};
  };

  /// Collective. Returns for each point how many spectra are computed to track eigenvalues over the
  /// step to it: one at both ends of the interval of each active set.
  std::vector<double> spectraOnSteps() const {
    std::vector<double> count(brake_.states.solutions.size(), 0);
    for (const auto& event : brake_.states.path)
      if (event.point < count.size()) ++count[event.point];
    mpi::reduce<double>(brake_.comm(), count, MPI_SUM);
    for (std::size_t i = 0; i < count.size(); ++i)
      count[i] = continues(i) ? std::max(2 * count[i], 1.0) : 0;
    return count;
  }

  /// Returns true if the eigenvalues of the point before the given one are to be continued to it.
  bool continues(std::size_t point) const {
    if (point == 0) return false;
    const auto& solutions = brake_.states.solutions;
    const auto &before = solutions[point - 1], &here = solutions[point];
    return before.converged && here.converged && sweep::growsInFriction(before.at, here.at) &&
           areTracked(brake_.settings, brake_.model, here.at.friction);
  }

  contact::ActiveSet setOf(std::size_t point) const {
    return steady::activeSet(brake_.states.solutions[point]);
  }

  /// Collective. Returns the number of nodes in which the active sets of two points differ.
  PetscInt differing(std::size_t a, std::size_t b) const {
    return contact::countDifferent(brake_.comm(), setOf(a), setOf(b));
  }

  /// Returns the end of a run of points with the same active set.
  std::size_t endOf(std::size_t run) const {
    const auto& solutions = brake_.states.solutions;
    std::size_t last = begins_[run];
    const std::size_t limit = run + 1 < begins_.size() ? begins_[run + 1] : solutions.size();
    while (last < limit && solutions[last].converged) ++last;
    return last;
  }

  /// Collective. Considers all groups that begin with a run.
  void extend(std::size_t run, std::vector<Choice>& best) const {
    constexpr std::size_t mostRuns = 64;  // bounds the work on a long sweep
    const std::size_t begin = begins_[run];
    PointGroup group{.first = begin};
    group.continues = continues(begin) && differing(begin - 1, begin) <= limit();
    if (group.continues) --group.first;
    contact::ActiveSetHull hull(setOf(group.first));
    GroupSize size{.unknowns = 1.0 * brake_.model.mesh->dimension * brake_.model.mesh->totalNodes,
                   .modes = 1.0 * brake_.settings.solver.modes.value_or(modes::Settings()).count};
    const double dampings = brake_.sweep.dampings.size();
    size.activeSets = group.continues ? 1 : 0;
    size.points = dampings * size.activeSets;
    for (std::size_t next = run; next < std::min(run + mostRuns, begins_.size()); ++next) {
      const std::size_t first = begins_[next];
      if (next > run && endOf(next - 1) < first) return;  // points without a solution in between
      hull.add(setOf(first));
      size.differing = contact::countDifferent(brake_.comm(), hull.anywhere, hull.everywhere);
      if (size.differing > limit()) return;
      group.last = endOf(next);
      size.points += dampings * (group.last - first);
      ++size.activeSets;
      if (first > group.first) size.spectra += dampings * spectra_[first];
      if (const double work = best[run].work + groupWork(size); work < best[next + 1].work)
        best[next + 1] = {work, run, group};
    }
  }

  PetscInt limit() const { return brake_.mesh().released; }

  const SlidingBrake& brake_;
  std::vector<double> spectra_;      // [point]
  std::vector<std::size_t> begins_;  // [run] its first point
};

/// Returns each point with a solution as a group.
std::vector<PointGroup> singlePoints(const SlidingBrake& brake) {
  std::vector<PointGroup> groups;
  for (std::size_t i = 0; i < brake.states.solutions.size(); ++i)
    if (brake.states.solutions[i].converged) groups.push_back({.first = i, .last = i + 1});
  return groups;
}

}  // namespace

bool areTracked(const Settings& settings, const Model& model, double friction) {
  const auto& tracking = settings.solver.stability;
  const auto& reduction = settings.solver.reduction;
  if (!tracking.track || !reduction || !reduction->corrected) return false;
  return tracking.requested ||
         !terms::hasPointTerms(model.contact, friction, model.bodies.settings.prestress,
                               settings.mesh->terms);
}

bool tracksFromZero(const Settings& settings, const Model& model, const sweep::Sweep& sweep) {
  return (sweep.frictions.size() > 1 || settings.solver.stability.requested) &&
         areTracked(settings, model, sweep.frictions.back());
}

std::vector<PointGroup> groupsOf(const SlidingBrake& brake) {
  // Modal damping is that of the free modes of a point, which prestress changes.
  if (brake.settings.pencil.isModallyDamped() && brake.model.bodies.settings.prestress)
    return singlePoints(brake);
  auto groups = Division(brake).cheapest();
  mpi::broadcast(brake.comm(), groups);  // processors may differ in the rounding of the work
  return groups;
}

}  // namespace squeal::analysis
