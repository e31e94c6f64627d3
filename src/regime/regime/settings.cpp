// SPDX-License-Identifier: BSD-2-Clause
#include "regime/regime/settings.hpp"

#include <algorithm>

#include "base/petsc/check.hpp"

namespace squeal::regime {
namespace {

const RealListOption frictionOption(
    "regime", "regime_friction", "", "", sequencesOf(nonNegative),
    "frictions at which the run computes the motion after flutter, with stick, slip and "
    "separation; they are added to those of -flutter_friction");

const RealOption timeOption(
    "regime", "regime_time", 0, "s", nonNegative,
    "maximum simulated time, at least 32 cycles of the flutter mode; 0 = automatic (the longer of "
    "400 cycles and 10 e-folding times of the mode, at most 4000 cycles)");
const RealOption stepOption(
    "regime", "regime_step", 0, "s", nonNegative,
    "time step; at least 16 steps per period of the flutter mode and at most 1e8 steps in total; 0 "
    "= automatic (a 128th of the period, at most 0.8 of the largest stable step)");
const RealOption startOption(
    "regime", "regime_start_factor", 0.5, "", Range{0, 100, true, false},
    "initial amplitude relative to the one at which the first node separates or sticks");
const ChoiceOption startsOption(
    "regime", "regime_starts", {"fastest", "each", "all"}, "fastest",
    "unstable modes from which a motion starts; fastest: only the fastest growing one; each: one "
    "motion from each mode; all: also one motion from the sum of these modes");
const ChoiceOption boundaryOption(
    "regime", "regime_boundary", {"massless", "mass"}, "massless",
    "mass of the contact degrees of freedom in the reduced model; massless: zero, with the "
    "leapfrog scheme; mass: their own mass, with the scheme of Moreau and Jean, as a check");

const FlagOption cycleOption(
    "regime", "regime_cycle", false,
    "periodic orbits (stable or unstable) and their Floquet multipliers, by shooting from the mean "
    "state of the time integration");
const IntegerOption stepsOption("regime", "regime_cycle_steps", 256, 16, 100'000,
                                "number of time steps of a periodic orbit");
const RealOption toleranceOption(
    "regime", "regime_cycle_tolerance", 1e-6, "", Range{1e-10, 1e-2},
    "relative change of displacements and velocities over a period, in the energy norm, below "
    "which a motion is periodic");
const RealListOption rangeOption(
    "regime", "regime_cycle_range", "", "", nonNegative,
    "two frictions between which the branch of periodic orbits is continued, also through folds");
const IntegerOption mostOption(
    "regime", "regime_cycle_motions", 20, 1, 10'000,
    "largest number of periodic orbits computed along the branch in each direction");

[[noreturn]] void rejectIdle(const Option& option) {
  throw Error("option -" + option.name +
              ": no motion after flutter is computed without -regime_friction");
}

/// Throws Error for unused options of periodic motions.
void rejectIdleCycleOptions(bool enabled, bool wanted) {
  for (const Option* option : std::initializer_list<const Option*>{
           &cycleOption, &stepsOption, &toleranceOption, &rangeOption, &mostOption}) {
    if (!option->given()) continue;
    if (!enabled) rejectIdle(*option);
    if (!wanted && option != &cycleOption)
      throw Error("option -" + option->name +
                  ": periodic motions are not computed without -regime_cycle");
  }
}

CycleSettings cyclesGiven(bool massless) {
  CycleSettings settings{.wanted = true};
  if (!massless)
    throw Error(
        "option -regime_cycle: periodic motions are computed only with -regime_boundary massless");
  const auto range = rangeOption.get();
  if (range.empty()) {
    if (mostOption.given())
      throw Error(
          "option -regime_cycle_motions: no branch is followed without "
          "-regime_cycle_range");
  } else if (range.size() != 2 || !(range[0] < range[1])) {
    throw Error("option -regime_cycle_range: two frictions, the smaller one first");
  } else {
    settings.range = {range[0], range[1]};
    settings.motions = mostOption.get();
  }
  settings.steps = stepsOption.get();
  settings.tolerance = toleranceOption.get();
  return settings;
}

MarchSettings marchGiven(bool massless) {
  const std::string starts = startsOption.get();
  return {.time = timeOption.get(),
          .step = stepOption.get(),
          .startFactor = startOption.get(),
          .starts = starts == "fastest" ? Starts::fastest
                    : starts == "each"  ? Starts::each
                                        : Starts::all,
          .massless = massless};
}

/// Throws Error for options of a march if there is none.
void rejectIdleMarchOptions() {
  auto idle = sound::Settings::options();
  for (const Option* option : std::initializer_list<const Option*>{
           &timeOption, &stepOption, &startOption, &startsOption, &boundaryOption})
    idle.push_back(option);
  for (const Option* option : idle)
    if (option->given()) rejectIdle(*option);
}

}  // namespace

Settings Settings::given() {
  Settings settings{.frictions = frictionOption.get()};
  std::ranges::sort(settings.frictions);
  const bool massless = boundaryOption.get() == "massless", wanted = cycleOption.get();
  rejectIdleCycleOptions(settings.enabled(), wanted);
  if (wanted) settings.cycles = cyclesGiven(massless);
  if (!settings.enabled()) {
    rejectIdleMarchOptions();
    return settings;
  }
  settings.sound = sound::Settings::given();
  settings.march = marchGiven(massless);
  return settings;
}

}  // namespace squeal::regime
