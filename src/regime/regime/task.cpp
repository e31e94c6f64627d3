// SPDX-License-Identifier: BSD-2-Clause
#include "regime/regime/task.hpp"

#include <algorithm>
#include <cmath>

#include "base/petsc/check.hpp"
#include "base/system/text.hpp"
#include "regime/regime/record.hpp"

namespace squeal::regime {
namespace {

using march::OnsetEvent;

/// A march of the largest default time, 4000 cycles of 128 steps, takes 5e5 steps.
constexpr double mostSteps = 1e8;
/// Peaks of cycles and spectra need at least this number of steps in a period.
constexpr int fewestSteps = 16;

double frequencyOf(const Task& task) { return task.mode.s.imag() / (2 * M_PI); }

/// Returns the bound that the number of steps violates; empty if there is none.
std::string violatedStepsBound(double step, double time) {
  const double steps = time / step;
  if (steps <= mostSteps) return "";
  const std::string number =
      std::isfinite(steps) ? formatted("about %.2g", steps) : std::string("more than 1e308");
  return formatted(
      "-regime_step %g s: %s steps for %g s, more than the %.0e of a march; give a longer "
      "-regime_step or a shorter -regime_time",
      step, number.c_str(), time, mostSteps);
}

/// Returns the bound that the step or the time of a task violates; empty if there is none.
std::string violatedBound(const ReducedModel& model, const MarchSettings& settings,
                          const Task& task, double stableStep) {
  if (const auto broken = violatedStepsBound(task.step, task.time); !broken.empty())
    return broken + (settings.step > 0 || task.step > 0.01 * task.shortestPeriod / 128
                         ? ""
                         : "; the stable step of the reduced model is short; a smaller "
                           "-modes_count makes it longer");
  if (settings.massless && task.step > stableStep)
    if (const double longest = march::longestStep(model); task.step > longest)
      return formatted(
          "-regime_step %g s exceeds %.3g s, the stable step while all contact is open: 2/ω of the "
          "highest frequency of the reduced model, %.4g Hz; while all contact sticks it is %.3g s",
          task.step, longest, 1 / (M_PI * longest), stableStep);
  if (task.step * fewestSteps > task.shortestPeriod * (1 + 1e-9))
    return formatted(
        "-regime_step %g s exceeds %.3g s, 1/%d of the period of %.5g Hz, which it must resolve; "
        "the stable step while all contact sticks is %.3g s",
        task.step, task.shortestPeriod / fewestSteps, fewestSteps, 1 / task.shortestPeriod,
        stableStep);
  const double window = Recorder::windowCycles / frequencyOf(task);
  if (task.time < window * (1 - 1e-9))
    return formatted(
        "-regime_time %g s is shorter than the first window, %d cycles of %.5g Hz: give at least "
        "%.3g s",
        task.time, Recorder::windowCycles, frequencyOf(task), 1.01 * window);
  return "";
}

/// Adds a to b.
void add(std::vector<Complex>& a, const std::vector<Complex>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
}

void scale(LinearMode& mode, double factor) {
  for (auto* part : {&mode.q, &mode.z, &mode.jump, &mode.force})
    for (Complex& entry : *part) entry *= factor;
}

/// Returns a march on one mode, without step and time.
Task taskOn(const ReducedModel& model, const NumberedMode& one) {
  Task task{.start = std::to_string(one.number), .mode = one.mode};
  if (!(task.mode.s.imag() > 1e-9 * std::abs(task.mode.s))) {
    task.failure =
        "the mode grows without oscillation (divergence), and a march counts cycles; give "
        "-regime_starts each, and more -flutter_shapes, to follow flutter modes";
    return task;
  }
  task.shortestPeriod = 1 / frequencyOf(task);
  task.onset = firstEvent(model.nodes, motionAt(model, task.mode));
  if (task.onset.event == OnsetEvent::none)
    task.failure = "the mode moves no node in contact, so its growth has no bound";
  else if (!(task.onset.factor > 0))
    task.failure =
        "a sticking node is at its limit of friction in steady sliding, so the motion has no "
        "linear range to start from; raise -contact_<interface>_friction";
  else
    scale(task.mode, task.onset.factor);
  return task;
}

/// Sets step and time, and the failure if these violate a bound.
void setStepAndTime(const ReducedModel& model, const MarchSettings& settings, double stableStep,
                    Task& task) {
  const double period = 1 / frequencyOf(task);
  task.step = settings.step;
  if (task.step == 0) task.step = std::min(task.shortestPeriod / 128, 0.8 * stableStep);
  task.time = settings.time;
  if (task.time == 0)
    task.time = std::min(4000 * period, std::max(400 * period, 10 / task.mode.s.real()));
  task.failure = violatedBound(model, settings, task, stableStep);
}

/// Returns the march that starts on the sum of the modes of the feasible tasks.
Task sumOf(const std::vector<Task>& tasks) {
  Task sum;
  int count = 0;
  for (const Task& task : tasks) {
    if (!task.failure.empty()) continue;
    if (++count == 1) {
      sum = task;
      continue;
    }
    add(sum.mode.q, task.mode.q), add(sum.mode.z, task.mode.z);
    add(sum.mode.jump, task.mode.jump), add(sum.mode.force, task.mode.force);
    sum.shortestPeriod = std::min(sum.shortestPeriod, task.shortestPeriod);
  }
  if (count > 0)
    scale(sum.mode, 1.0 / count);
  else
    sum = tasks.front(), sum.failure = "none of its modes is feasible";
  sum.start = "all";
  return sum;
}

}  // namespace

void checkSteps(const MarchSettings& settings) {
  if (!(settings.step > 0) || !(settings.time > 0)) return;
  if (const auto broken = violatedStepsBound(settings.step, settings.time); !broken.empty())
    throw Error("option " + broken);
}

std::vector<std::string> startsOn(std::span<const std::size_t> numbers, Starts starts) {
  std::vector<std::string> names;
  for (const std::size_t number : numbers) names.push_back(std::to_string(number));
  if (starts == Starts::fastest && !names.empty()) names.resize(1);
  if (starts == Starts::all && names.size() > 1) names.push_back("all");
  return names;
}

std::vector<Task> tasksOn(const ReducedModel& model, const MarchSettings& settings,
                          std::span<const NumberedMode> modes, double stableStep) {
  std::vector<Task> tasks;
  for (const auto& one : modes) {
    tasks.push_back(taskOn(model, one));
    if (settings.starts == Starts::fastest) break;
  }
  if (settings.starts == Starts::all && tasks.size() > 1) tasks.push_back(sumOf(tasks));
  for (Task& task : tasks)
    if (task.failure.empty()) setStepAndTime(model, settings, stableStep, task);
  return tasks;
}

}  // namespace squeal::regime
