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
#include "eigen/direct/direct.hpp"
#include "eigen/pencil/modal_damping.hpp"
#include "problem/terms/settings.hpp"
#include "regime/march/law.hpp"
#include "regime/regime/follow.hpp"
#include "regime/regime/task.hpp"

namespace squeal::regime {
namespace {

using march::Event;

/// Returns the steady sliding power.
double steadyPower(const ReducedModel& model) {
  double power = 0;
  for (const Node& node : model.nodes)
    for (int c = 0; c < 2; ++c) power -= node.shear[c] * node.velocity[c];
  return power;
}

/// Collective. Warns where steps are longer than is safe, and where friction alone damps.
void warn(const FullModel& full, const Settings& settings, std::span<const Task> tasks,
          double stable) {
  const int wanted = settings.sound.cyclesKept > 0 ? settings.sound.frames : 0;
  const MPI_Comm comm = full.contact.mesh->comm;
  double step = 0;  // the longest
  for (const Task& task : tasks) {
    if (!task.failure.empty()) continue;
    step = std::max(step, task.step);
    if (const int frames = settings.sound.framesOfPeriod(task.shortestPeriod, task.step);
        frames < wanted)
      complain(comm, formatted("warning: -regime_frames %d: a period of %.5g Hz has %d steps, and "
                               "as many frames are written",
                               wanted, 1 / task.shortestPeriod, frames));
  }
  if (settings.march.massless && step > stable)
    complain(comm, formatted("warning: -regime_step %g s exceeds %.3g s, the stable step while all "
                             "contact sticks; the motion may grow without bound",
                             step, stable));
  PetscReal size = 0;
  if (full.bodies.damping) check(MatNorm(full.bodies.damping, NORM_FROBENIUS, &size));
  if (size * full.damping == 0)
    complain(comm,
             "warning: the bodies are undamped, so that a motion that never separates or sticks "
             "grows without bound; give -material_<group>_loss_factor");
}

/// Collective. Refuses a law of friction that slips of a boundary without mass do not follow, and
/// says where one may make them alternate.
void checkLaw(MPI_Comm comm, const ReducedModel& model, std::span<const Task> tasks) {
  if (!model.law) return;
  double step = INFINITY;  // the shortest: its slips follow least
  for (const Task& task : tasks)
    if (task.failure.empty()) step = std::min(step, task.step);
  if (!std::isfinite(step)) return;
  const auto slopes = march::steadySlopes(model);
  if (const double gain = march::lawGain(model, step, slopes); !(gain < 1))
    throw Error(
        formatted("option -regime_friction: the coefficient of friction changes with the speed "
                  "%.3g times faster than slips of the massless boundary follow at the time step "
                  "%g s (-friction_law); give -regime_boundary mass",
                  gain, step));
  if (!(march::lawGain(model, 0, slopes) < 1))
    complain(comm,
             "warning: the coefficient of friction falls with the speed faster than the damping of "
             "the massless boundary holds its slips, so that the motion does not converge with "
             "-regime_step; give the materials at the contact damping, or -regime_boundary mass");
  for (const bool lowest : {true, false})
    if (!(march::lawGain(model, step, march::steepestSlopes(model, lowest)) < 1))
      complain(comm,
               "warning: near the steepest part of -friction_law slips of the massless boundary "
               "may alternate from step to step; compare with -regime_boundary mass");
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

/// What a study has in hand: the point of the sweep, its modes, and the result as far as it is.
struct Work {
  const FullModel& full;
  const Settings& settings;
  const pencil::ComplexModes& point;
  std::vector<const pencil::Shape*> shapes;
  Study& result;

  MPI_Comm comm() const { return full.contact.mesh->comm; }
  std::string name() const { return sweep::parameterText(point.at); }
  /// Returns the starts that are wanted, with the certified eigenvalue of the mode of each.
  std::vector<std::pair<std::string, Complex>> starts() const {
    std::vector<std::size_t> numbers;
    for (const auto* shape : shapes) numbers.push_back(shape->index + 1);
    std::vector<std::pair<std::string, Complex>> result;
    for (auto& start : startsOn(numbers, settings.march.starts)) {
      const std::size_t place = start == "all" ? 0 : result.size();
      result.emplace_back(std::move(start), point.eigenvalues[shapes[place]->index].s);
    }
    return result;
  }
  /// Collective. Prints a failure and keeps it.
  void fail(const std::string& what) const {
    complain(comm(), what);
    result.failures.push_back(what);
  }
  std::string nameOf(const std::string& start) const {
    return name() + (start == "all" ? ", start on all modes" : ", start on mode " + start);
  }
  /// Returns the name of a run, without its start where there is one start only.
  std::string nameOf(const Run& run) const {
    return starts().size() > 1 ? nameOf(run.start) : name();
  }
  void fail(Run& run, const std::string& why) const {
    run.failure = why;
    fail(nameOf(run.start) + ": nothing measured: " + why);
  }
};

/// Collective. Returns the unstable modes of the reduced model, and sets the error of the model.
std::vector<NumberedMode> modesOf(const Work& work, const ReducedModel& model) {
  const auto& point = work.point;
  std::vector<NumberedMode> modes;
  work.result.modelError = 0;
  for (const auto* shape : work.shapes) {
    const Complex certified = point.eigenvalues[shape->index].s;
    const std::string name =
        formatted("mode %zu (%.5g Hz)", shape->index + 1, certified.imag() / (2 * M_PI));
    NumberedMode one{shape->index + 1, {}};
    try {
      workApart(work.comm(), [&](const StopAsked& asked) {
        one.mode = march::nearestMode(model, certified, asked);
      });
    } catch (const Error& error) {
      throw Error(name + ": " + error.what() +
                  "; give more -modes_count, or a smaller -flutter_tolerance");
    }
    const double relative = std::abs(one.mode.s - certified) / std::abs(certified);
    work.result.modelError = std::max(work.result.modelError, relative);
    if (!(relative <= point.tolerance))
      throw Error(
          formatted("%s: the reduced model has this unstable eigenvalue to %.1e only, not "
                    "to the %.1e of -flutter_tolerance; give more -modes_count, or a "
                    "smaller -flutter_tolerance",
                    name.c_str(), relative, point.tolerance));
    modes.push_back(std::move(one));
  }
  return modes;
}

/// Returns the run of a task that nothing is known of but how it starts.
Run runOf(const ReducedModel& model, const Task& task) {
  Run run;
  run.start = task.start;
  run.s = task.mode.s;
  if (task.onset.event == Event::none || !(task.onset.factor > 0)) return run;
  run.onset = task.onset;
  run.onsetPosition = model.nodes[task.onset.node].position;
  run.onsetKinetic = largestKinetic(task.mode);
  run.step = task.step;
  return run;
}

/// Returns a sentence on what a run has measured.
std::string describe(const Work& work, const Run& run) {
  const Regime& regime = run.regime;
  return formatted(
      "%s: %s%s, carrier %.5g Hz (flutter %.5g Hz), friction %.4g, %.4g W (steady sliding %.4g W), "
      "open %.3g, sticking %.3g of %zu nodes, largest kinetic energy %.4g J, defect %.1e, "
      "energy %.1e",
      work.nameOf(run).c_str(), text(regime.kind), regime.settled ? "" : " (not settled)",
      regime.carrier, run.s.imag() / (2 * M_PI), regime.means.frictionCoefficient,
      regime.means.frictionPower, work.result.steadyPower, regime.means.open, regime.means.sticking,
      work.result.nodes.size(), regime.largestKinetic, regime.largestDefect, regime.imbalance);
}

/// Says what is heard of a run.
void sayHeard(const Work& work, const Run& run, Stage& stage) {
  const sound::Sound& heard = run.outside.sound;
  if (std::isfinite(heard.power))
    stage.say(formatted("%s: sound power about %.3g W (%.1f dB) from %.4g m2 of visible surface",
                        work.nameOf(run).c_str(), heard.power, heard.level, heard.area));
}

/// Collective. Warns where the march does not grow as the mode does.
void checkGrowth(const Work& work, const Run& run) {
  const double growth = run.s.real();
  if (run.start == "all") return;  // several modes grow, each by its own rate
  if (std::abs(run.regime.growth - growth) > 0.2 * growth)
    complain(work.comm(),
             formatted("warning: in the linear range the march grows by %.4g 1/s, the mode by "
                       "%.4g 1/s: the error of the step, which a shorter -regime_step makes "
                       "smaller in proportion",
                       run.regime.growth, growth));
}

/// Collective. Finds the periodic motions of a run; what fails there leaves the march as it is.
void addCycles(const Work& work, const ReducedModel& model, const Followed& followed, Run& run,
               Stage& stage) {
  const CycleSettings& settings = work.settings.cycles;
  if (!settings.wanted) return;
  run.cycles = findCycles(work.comm(), model, settings, work.point.at.friction, followed.passes,
                          run.step, stage);
  if (!run.cycles.failure.empty())
    work.fail(work.nameOf(run.start) + ": no periodic motions: " + run.cycles.failure);
}

/// Collective. Adds the runs of a point to the result. What throws Error here is a failure of the
/// whole point.
void addRuns(const Work& work, linalg::Block free) {
  const MPI_Comm comm = work.comm();
  Study& result = work.result;
  if (work.shapes.empty()) throw Error("the unstable modes are not kept; raise -flutter_shapes");
  Stage stage(comm, "regime");
  linalg::Block unstable = columnsOf(free.rows(), work.shapes);
  const Reduction reduction = reduce(work.full, std::move(free), unstable);
  const ReducedModel& model = reduction.model;
  result.modes = model.modes(), result.rows = model.rows();
  result.nodes = model.nodes, result.contactNode = reduction.contactNode;
  result.steadyPower = steadyPower(model);
  const auto modes = modesOf(work, model);
  result.stableStep = march::stableStep(model);
  std::vector<Task> tasks = tasksOn(model, work.settings.march, modes, result.stableStep);
  stage.say(formatted("%s: %d modes, %d gaps and slips; unstable eigenvalues to %.1e",
                      work.name().c_str(), result.modes, result.rows, result.modelError));
  warn(work.full, work.settings, tasks, result.stableStep);
  if (work.settings.march.massless) checkLaw(comm, model, tasks);
  const auto followed = followAll(comm, model, work.settings, tasks, stage);
  std::optional<sound::Observer> observer;
  if (std::ranges::any_of(tasks, [](const Task& task) { return task.failure.empty(); }))
    observer.emplace(work.full.contact,
                     sound::Shapes{reduction.modes, reduction.responses, reduction.contactNode},
                     work.settings.sound);
  std::string last;  // what the stage ends with
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    stopIfAsked(comm);
    result.runs.push_back(runOf(model, tasks[i]));
    Run& run = result.runs.back();
    if (!tasks[i].failure.empty()) {
      work.fail(run, tasks[i].failure);
      continue;
    }
    if (!last.empty()) stage.say(last);
    run.regime = followed[i].regime;
    run.outside = observer->of(rankOf(comm, i), followed[i].trace);
    sayHeard(work, run, stage);
    checkGrowth(work, run);
    addCycles(work, model, followed[i], run, stage);
    last = describe(work, run);
  }
  stage.finish(last.empty() ? work.name() + ": " + text(Kind::unmeasured) : last);
}

}  // namespace

void checkOptions(const Settings& settings, bool ofMesh) {
  if (!settings.followed()) return;
  checkSteps(settings.march);
  if (!ofMesh)
    throw Error(
        "option -regime_friction: matrices from files do not say what lifts off and sticks; the "
        "motion after flutter is followed for meshes");
  if (direct::directWanted())
    throw Error(
        "option -regime_friction: the motion after flutter needs the free modes and the estimates "
        "of -flutter_method reduced");
  if (pencil::modalDampingWanted())
    throw Error(
        "option -regime_friction: -flutter_modal_damping is not followed in time; give the damping "
        "to the materials");
  if (!terms::Settings::given().frictionDamping)
    throw Error(
        "option -regime_friction: in time the friction force turns with the relative velocity, so "
        "that -flutter_friction_damping must be on");
}

void requireSupported(const Settings& settings, const elasticity::Bodies& bodies,
                      const contact::Contact& contact) {
  const auto refuse = [](const std::string& why) {
    throw Error("option -regime_friction: " + why);
  };
  if (contact.totalNodes == 0) refuse("there is no contact");
  if (bodies.gyroscopic || bodies.rotationStiffness || contact.convected)
    refuse("convective terms (-motion_convective) are not followed in time; leave them out");
  if (elasticity::prestressWanted())
    refuse("the geometric stiffness of the steady stress is not followed in time; leave it out");
  if (settings.cycles.wanted && !contact.law.constant())
    refuse(
        "the derivative of a step leaves out -friction_law, so that no periodic motions are found "
        "under it; leave out -regime_cycle");
}

Study study(const FullModel& full, const Settings& settings, linalg::Block free,
            const pencil::ComplexModes& point) {
  Study result;
  const Work work{full, settings, point, unstableShapes(point), result};
  result.at = point.at;
  result.unstable = point.unstableCount();
  if (result.unstable == 0) {
    say(work.comm(), work.name() + ": no mode is unstable, and none is followed after flutter");
    return result;
  }
  if (!work.shapes.empty() && std::ssize(work.shapes) < result.unstable)
    say(work.comm(),
        formatted("%s: %zu of %d unstable modes have kept shapes (-flutter_shapes), and these "
                  "are held exactly by the reduced model of the regime",
                  work.name().c_str(), work.shapes.size(), result.unstable));
  try {
    addRuns(work, std::move(free));
  } catch (const Error& error) {
    work.fail(work.name() + ": not followed after flutter (nothing measured): " + error.what());
    const auto starts = work.starts();
    for (std::size_t i = result.runs.size(); i < starts.size(); ++i) {
      Run run;
      run.start = starts[i].first, run.s = starts[i].second, run.failure = error.what();
      result.runs.push_back(std::move(run));
    }
  }
  return result;
}

}  // namespace squeal::regime
