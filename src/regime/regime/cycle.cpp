// SPDX-License-Identifier: BSD-2-Clause
#include "regime/regime/cycle.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/petsc/check.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"
#include "regime/cycles/branch.hpp"
#include "regime/march/massless.hpp"

namespace squeal::regime {
namespace {

PeriodicMotion motionOf(const cycles::ShootingResult& found) {
  PeriodicMotion motion;
  motion.friction = found.orbit.friction;
  motion.period = found.orbit.period;
  motion.converged = found.converged;
  motion.change = found.change;
  motion.measures = found.measures;
  if (!found.converged) return motion;
  motion.multipliers = found.linearisation->multipliers();
  std::erase_if(motion.multipliers.values, [](Complex m) { return std::abs(m) < 0.1; });
  return motion;
}

std::string describe(const PeriodicMotion& motion) {
  const Complex largest = motion.largestMultiplier();
  return formatted(
      "friction %.6g: periodic at %.6g Hz, %.4g W, %d nodes open and %d stick intermittently, "
      "trivial "
      "multiplier %.5f, largest of the others %.4f at %.4g Hz: %s",
      motion.friction, 1 / motion.period, motion.measures.frictionPower, motion.measures.opening,
      motion.measures.sticking, motion.trivialMultiplier().real(), std::abs(largest),
      std::abs(std::arg(largest)) / (2 * M_PI * motion.period),
      motion.stable() ? "stable" : "unstable");
}

/// Returns the bound that the steps of a period violate; empty if there is none.
std::string violatedStepBound(const march::ReducedModel& model, double period, int steps) {
  const double longest = march::longestStep(model);
  if (period / steps <= longest) return "";
  return formatted(
      "-regime_cycle_steps %d: their length, %.3g s, exceeds the stable step while all contact is "
      "open, %.3g s; give at least %.0f",
      steps, period / steps, longest, std::ceil(1.05 * period / longest));
}

/// Collective. Returns the first periodic motion found from the orbits, otherwise the last attempt;
/// its period is 0 if no march over a period succeeded. Sets the failure of the last one that
/// failed.
cycles::ShootingResult shootFrom(const cycles::Period& period,
                                 const std::vector<cycles::Orbit>& orbits,
                                 const cycles::ShootingRequest& request, std::string& failure) {
  cycles::ShootingResult found;
  for (cycles::Orbit guess : orbits) {
    try {
      // Slips that stick at the start are additional unknowns: start with as few as possible.
      guess.start = period.pass(guess, period.pass(guess).quietest).end;
      found = cycles::shoot(period, guess, request);
    } catch (const Error& error) {
      failure = std::string(error.what()) + "; increase -regime_cycle_steps";
    }
    if (found.converged) break;
  }
  return found;
}

/// Collective. Adds the motions of the branch through the first motion.
void addBranch(const cycles::Period& period, const cycles::ShootingResult& first,
               const CycleSettings& settings, const cycles::Progress& progress, Stage& stage,
               Cycles& cycles) {
  const auto& range = *settings.range;
  const cycles::ContinuationLimits limits{range[0], range[1], settings.motions, settings.tolerance};
  const auto inspect = [&](const cycles::ShootingResult& found) {
    cycles.motions.push_back(motionOf(found));
    stage.printLine(describe(cycles.motions.back()));
  };
  for (const bool upwards : {false, true}) {
    cycles.routes.push_back(
        cycles::continueBranch(period, first, upwards, limits, progress, inspect));
    const auto& route = cycles.routes.back();
    for (const double fold : route.folds)
      stage.printLine(
          formatted("the branch of periodic motions turns back at friction %.6g", fold));
    stage.printLine(formatted("towards %s friction the branch ends at %.6g: %s",
                              upwards ? "larger" : "smaller", route.end, route.reason.c_str()));
  }
}

}  // namespace

Complex PeriodicMotion::largestMultiplier() const {
  for (std::size_t i = 0; i < multipliers.values.size(); ++i)
    if (i != multipliers.trivial) return multipliers.values[i];
  return 0;
}

SectionRecord::SectionRecord(const march::ReducedModel& model, const march::LinearMode& mode)
    : section_(model, mode.q, 2 * M_PI / mode.s.imag()) {}

void SectionRecord::inspect(const march::Scheme& scheme) {
  if (const auto* massless = dynamic_cast<const march::Massless*>(&scheme))
    section_.inspect(*massless);
}

cycles::Passes SectionRecord::last(std::size_t windows) const {
  cycles::Passes result;
  for (std::size_t i = windows_.size() - std::min(windows, windows_.size()); i < windows_.size();
       ++i)
    result.add(windows_[i]);
  return result;
}

Cycles findCycles(MPI_Comm comm, const march::ReducedModel& model, const CycleSettings& settings,
                  const CycleStart& start, Stage& stage) {
  Cycles cycles;
  if (start.passes.count == 0) {
    printWarning(
        comm,
        "warning: -regime_cycle: no node separated or stuck during a full window of the march, "
        "so shooting has no starting point");
    return cycles;
  }
  const cycles::Period period(comm, model, start.friction, settings.steps);
  auto orbits = cycles::firstOrbits(start.passes, start.step, period.steps());
  for (auto& orbit : orbits) orbit.friction = start.friction;
  cycles.failure = violatedStepBound(model, orbits.front().period, settings.steps);
  if (!cycles.failure.empty()) return cycles;
  const auto progress = [&](const cycles::Iteration& now) {
    stage.progress(formatted("shooting: change over a period %.1e, %d linearisations", now.change,
                             now.derivatives));
    stopIfRequested(comm);
  };
  const cycles::ShootingResult first =
      shootFrom(period, orbits, {settings.tolerance, progress}, cycles.failure);
  if (first.orbit.period == 0) return cycles;  // no march over a period succeeded
  cycles.failure.clear();                      // it belongs to another orbit
  try {
    cycles.motions.push_back(motionOf(first));
    if (first.converged)
      stage.printLine(describe(cycles.motions.back()));
    else
      printWarning(
          comm,
          formatted(
              "warning: -regime_cycle: no periodic motion found near the march: Newton's method "
              "ends with a change of %.1e over a period, above the %.1e of -regime_cycle_tolerance",
              first.change, settings.tolerance));
    if (first.converged && settings.range)
      addBranch(period, first, settings, progress, stage, cycles);
  } catch (const Error& error) {
    cycles.failure = error.what();
  }
  return cycles;
}

}  // namespace squeal::regime
