// SPDX-License-Identifier: BSD-2-Clause
#include "regime/regime/regime.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "base/petsc/arrays.hpp"
#include "base/session/stages.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"
#include "regime/regime/checks.hpp"
#include "regime/regime/task.hpp"
#include "regime/regime/trajectory.hpp"

namespace squeal::regime {
namespace {

/// Returns the heat of friction of steady sliding, W.
double steadyPower(const ReducedModel& model) {
  double power = 0;
  for (const Node& node : model.nodes)
    for (int c = 0; c < 2; ++c) power -= node.shear[c] * node.velocity[c];
  return power;
}

/// Returns the shapes of the unstable modes of a point, the fastest growing one first.
std::vector<const pencil::Shape*> unstableShapes(const pencil::ComplexModes& point) {
  std::vector<const pencil::Shape*> shapes;
  for (const auto& shape : point.shapes)
    if (point.eigenvalues[shape.index].unstable) shapes.push_back(&shape);
  return shapes;
}

/// Returns the real and imaginary parts of the shapes as columns, this rank's rows.
linalg::Block columnsOf(PetscInt rows, std::span<const pencil::Shape* const> shapes) {
  linalg::Block columns(rows);
  for (const auto* shape : shapes)
    for (const Vec part : {shape->real.get(), shape->imaginary.get()}) {
      const ReadArray values(part);
      columns.append(std::span(values.data(), values.size()));
    }
  return columns;
}

/// The studied point of the sweep; all members are borrowed.
struct StudiedPoint {
  const FullModel& full;
  const Settings& settings;
  const pencil::ComplexModes& modes;
  std::vector<const pencil::Shape*> shapes;  // of the unstable modes

  MPI_Comm comm() const { return full.contact.mesh->comm; }
  std::string name() const { return sweep::parameterText(modes.at); }
  std::string nameOf(const std::string& start) const {
    return name() + (start == "all" ? ", start on all modes" : ", start on mode " + start);
  }
  /// Returns the name of a run, without its start if there is only one start.
  std::string nameOf(const Run& run) const {
    return starts().size() > 1 ? nameOf(run.start) : name();
  }
  /// Returns the starts, each with the certified eigenvalue of its mode.
  std::vector<std::pair<std::string, Complex>> starts() const {
    std::vector<std::size_t> numbers;
    for (const auto* shape : shapes) numbers.push_back(shape->index + 1);
    std::vector<std::pair<std::string, Complex>> result;
    for (auto& start : startsOn(numbers, settings.march.starts)) {
      const std::size_t place = start == "all" ? 0 : result.size();
      result.emplace_back(std::move(start), modes.eigenvalues[shapes[place]->index].s);
    }
    return result;
  }
};

/// Collective. Prints a failure and adds it to the study.
void fail(const StudiedPoint& point, const std::string& failure, Study& study) {
  printWarning(point.comm(), failure);
  study.failures.push_back(failure);
}

/// The unstable modes of the reduced model.
struct UnstableModes {
  std::vector<NumberedMode> modes;
  double error = 0;     // largest |δs|/|s|
  std::string failure;  // empty: none
};

/// Collective. Returns the unstable modes of the reduced model.
UnstableModes unstableModes(const StudiedPoint& point, const ReducedModel& model) {
  UnstableModes result;
  const double tolerance = point.modes.tolerance;
  for (const auto* shape : point.shapes) {
    const Complex certified = point.modes.eigenvalues[shape->index].s;
    const std::string name =
        formatted("mode %zu (%.5g Hz)", shape->index + 1, certified.imag() / (2 * M_PI));
    NumberedMode one{shape->index + 1, {}};
    try {
      workIndependently(point.comm(), [&](const StopRequested& stopRequested) {
        one.mode = march::nearestMode(model, certified, stopRequested);
      });
    } catch (const Error& error) {
      result.failure =
          name + ": " + error.what() + "; increase -modes_count or reduce -flutter_tolerance";
      return result;
    }
    const double relative = std::abs(one.mode.s - certified) / std::abs(certified);
    result.error = std::max(result.error, relative);
    if (!(relative <= tolerance)) {
      result.failure = formatted(
          "%s: the reduced model reproduces this unstable eigenvalue only to %.1e, not to the %.1e "
          "of -flutter_tolerance; increase -modes_count or reduce -flutter_tolerance",
          name.c_str(), relative, tolerance);
      return result;
    }
    result.modes.push_back(std::move(one));
  }
  return result;
}

/// Returns the run of a task before its march.
Run runOf(const ReducedModel& model, const Task& task) {
  Run run;
  run.start = task.start;
  run.s = task.mode.s;
  if (task.onset.event == march::OnsetEvent::none || !(task.onset.factor > 0)) return run;
  run.onset = task.onset;
  run.onsetPosition = model.nodes[task.onset.node].position;
  run.onsetKinetic = largestKinetic(task.mode);
  run.step = task.step;
  return run;
}

/// Returns a sentence on the results of a run.
std::string describe(const StudiedPoint& point, const Study& study, const Run& run) {
  const Regime& regime = run.regime;
  return formatted(
      "%s: %s%s, carrier %.5g Hz (flutter %.5g Hz), friction %.4g, %.4g W (steady sliding %.4g W), "
      "open %.3g, sticking %.3g of %zu nodes, largest kinetic energy %.4g J, defect %.1e, "
      "energy %.1e",
      point.nameOf(run).c_str(), text(regime.kind), regime.settled ? "" : " (not settled)",
      regime.carrier, run.s.imag() / (2 * M_PI), regime.means.frictionCoefficient,
      regime.means.frictionPower, study.steadyPower, regime.means.open, regime.means.sticking,
      study.nodes.size(), regime.largestKinetic, regime.largestDefect, regime.imbalance);
}

/// Collective. Returns the motion of the visible surface in a march, and logs its sound.
sound::VisibleSurface surfaceOf(const sound::Observer& observer, int root,
                                const Trajectory& trajectory, const std::string& name,
                                Stage& stage) {
  auto surface = observer.of(root, trajectory.trace);
  const sound::Sound& heard = surface.sound;
  if (std::isfinite(heard.power))
    stage.printLine(
        formatted("%s: sound power about %.3g W (%.1f dB) from %.4g m2 of visible surface",
                  name.c_str(), heard.power, heard.level, heard.area));
  return surface;
}

/// Collective. Warns if the growth of the march differs from that of the mode.
void checkGrowth(MPI_Comm comm, const Run& run) {
  const double growth = run.s.real();
  if (run.start == "all") return;  // several modes grow, each at its own rate
  if (std::abs(run.regime.growth - growth) > 0.2 * growth)
    printWarning(
        comm,
        formatted("warning: in the linear range the march grows by %.4g 1/s, the mode by "
                  "%.4g 1/s: the error of the time step, which is proportional to -regime_step",
                  run.regime.growth, growth));
}

/// Collective. Returns the periodic motions of a run. Their failure does not affect the march.
Cycles cyclesOf(const StudiedPoint& point, const ReducedModel& model, const Trajectory& trajectory,
                const Run& run, Stage& stage, Study& study) {
  const CycleSettings& settings = point.settings.cycles;
  if (!settings.wanted) return {};
  Cycles cycles = findCycles(point.comm(), model, settings,
                             {point.modes.at.friction, trajectory.passes, run.step}, stage);
  if (!cycles.failure.empty())
    fail(point, point.nameOf(run.start) + ": no periodic motions: " + cycles.failure, study);
  return cycles;
}

/// Collective. Returns the reduced model, and sets its data in the study.
Reduction reductionOf(const StudiedPoint& point, linalg::Block free, Study& study) {
  linalg::Block unstable = columnsOf(free.rows(), point.shapes);
  Reduction reduction = reduce(point.full, std::move(free), unstable);
  const ReducedModel& model = reduction.model;
  study.modes = model.modes(), study.rows = model.rows();
  study.nodes = model.nodes, study.contactNode = reduction.contactNode;
  study.steadyPower = steadyPower(model);
  return reduction;
}

/// Collective. Returns the marches of a point.
std::vector<Task> tasksOf(const StudiedPoint& point, const ReducedModel& model, Stage& stage,
                          Study& study) {
  const UnstableModes unstable = unstableModes(point, model);
  study.modelError = unstable.error;
  if (!unstable.failure.empty()) throw Error(unstable.failure);
  study.stableStep = march::stableStep(model);
  auto tasks = tasksOn(model, point.settings.march, unstable.modes, study.stableStep);
  stage.printLine(formatted("%s: %d modes, %d gaps and slips; unstable eigenvalues to %.1e",
                            point.name().c_str(), study.modes, study.rows, study.modelError));
  warnAboutSteps(point.comm(), point.settings, tasks, study.stableStep);
  warnAboutDamping(point.full);
  if (point.settings.march.massless) checkLaw(point.comm(), model, tasks);
  return tasks;
}

/// Collective. Adds the runs of a point to the study. An Error here means that the whole point
/// fails.
void addRuns(const StudiedPoint& point, linalg::Block free, Study& study) {
  for (const auto& resultant : point.full.solution.resultants)
    if (resultant.released > 0)
      throw Error(formatted("%" PetscInt_FMT
                            " nodes of the sticking interface '%s' slide at their limit of "
                            "friction (-contact_%s_release); a motion is computed only if all of "
                            "its closed nodes stick",
                            resultant.released, resultant.interface.c_str(),
                            resultant.interface.c_str()));
  const MPI_Comm comm = point.comm();
  if (point.shapes.empty())
    throw Error("the shapes of the unstable modes are not stored; raise -flutter_shapes");
  Stage stage(comm, "regime");
  const Reduction reduction = reductionOf(point, std::move(free), study);
  const ReducedModel& model = reduction.model;
  auto tasks = tasksOf(point, model, stage, study);
  const auto marched = trajectories(comm, model, point.settings, tasks, stage);
  std::optional<sound::Observer> observer;
  if (std::ranges::any_of(tasks, [](const Task& task) { return task.failure.empty(); }))
    observer.emplace(point.full.contact,
                     sound::Shapes{reduction.modes, reduction.responses, reduction.contactNode},
                     point.settings.sound);
  std::string last;  // the result of the stage
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    stopIfRequested(comm);
    study.runs.push_back(runOf(model, tasks[i]));
    Run& run = study.runs.back();
    run.failure = tasks[i].failure;
    if (!run.failure.empty()) {
      fail(point, point.nameOf(run.start) + ": nothing measured: " + run.failure, study);
      continue;
    }
    if (!last.empty()) stage.printLine(last);
    run.regime = marched[i].regime;
    run.surface = surfaceOf(*observer, rankOf(comm, i), marched[i], point.nameOf(run), stage);
    checkGrowth(comm, run);
    run.cycles = cyclesOf(point, model, marched[i], run, stage, study);
    last = describe(point, study, run);
  }
  stage.finish(last.empty() ? point.name() + ": " + text(Kind::unmeasured) : last);
}

}  // namespace

Study study(const FullModel& full, const Settings& settings, linalg::Block free,
            const pencil::ComplexModes& modes) {
  const StudiedPoint point{full, settings, modes, unstableShapes(modes)};
  Study result;
  result.at = modes.at;
  result.unstable = modes.unstableCount();
  if (result.unstable == 0) {
    printLine(point.comm(),
              point.name() + ": no mode is unstable, so there is no motion after flutter");
    return result;
  }
  if (!point.shapes.empty() && std::ssize(point.shapes) < result.unstable)
    printLine(point.comm(),
              formatted("%s: the shapes of %zu of %d unstable modes are stored (-flutter_shapes); "
                        "the reduced model of the regime is exact only for these",
                        point.name().c_str(), point.shapes.size(), result.unstable));
  try {
    addRuns(point, std::move(free), result);
  } catch (const Error& error) {
    fail(point, point.name() + ": not followed after flutter (nothing measured): " + error.what(),
         result);
    const auto starts = point.starts();
    for (std::size_t i = result.runs.size(); i < starts.size(); ++i) {
      Run run;
      run.start = starts[i].first, run.s = starts[i].second, run.failure = error.what();
      result.runs.push_back(std::move(run));
    }
  }
  return result;
}

}  // namespace squeal::regime
