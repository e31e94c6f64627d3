#include "regime/regime.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "direct/direct.hpp"
#include "flutter/terms.hpp"
#include "march/law.hpp"
#include "options/options.hpp"
#include "petsc/arrays.hpp"
#include "petsc/termination.hpp"
#include "petsc/text.hpp"
#include "session/stages.hpp"

namespace squeal::regime {
namespace {

const RealListOption frictionOption(
    "regime", "regime_friction", "", "", nonNegative,
    "frictions at which the motion after flutter is followed: stick, slip and separation; added "
    "to those of -flutter_friction where they are not among them",
    true);
const RealOption timeOption("regime", "regime_time", 0, "s", nonNegative,
                            "longest time that is followed; 0: 400 cycles or 10 times the time in "
                            "which the mode grows by e, what is longer, 4000 cycles at most");
const RealOption stepOption("regime", "regime_step", 0, "s", nonNegative,
                            "time step; 0: a 128th of the period of the fastest growing mode, 0.8 "
                            "of the stable step at most");
const RealOption startOption("regime", "regime_start_factor", 0.5, "", Range{0, 100, true, false},
                             "amplitude at the start, over that at which the first node opens or "
                             "comes to rest");
const ChoiceOption startsOption("regime", "regime_starts", {"fastest", "each", "all"}, "fastest",
                                "starts of the motion: on the fastest growing unstable mode, on "
                                "each of them, or on each and on their sum");
const ChoiceOption boundaryOption(
    "regime", "regime_boundary", {"massless", "mass"}, "massless",
    "boundary of the reduced model: massless with the leapfrog rule, or with its mass by the "
    "scheme of Moreau and Jean, to check the first");

/// Returns the steady sliding power.
double steadyPower(const ReducedModel& model) {
  double power = 0;
  for (const Node& node : model.nodes)
    for (int c = 0; c < 2; ++c) power -= node.shear[c] * node.velocity[c];
  return power;
}

/// A march to be done.
struct Task {
  std::string start;
  LinearMode mode;  // scaled to its onset
  Onset onset;
};

/// Adds a to b.
void add(std::vector<Complex>& a, const std::vector<Complex>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
}

void scale(LinearMode& mode, double factor) {
  for (auto* part : {&mode.q, &mode.z, &mode.jump, &mode.force})
    for (Complex& entry : *part) entry *= factor;
}

/// Returns a run of which nothing is known but how it starts.
Run runOf(const ReducedModel& model, const Task& task) {
  Run run;
  run.start = task.start;
  run.s = task.mode.s;
  run.onset = task.onset;
  run.onsetPosition = model.nodes[task.onset.node].position;
  run.onsetKinetic = largestKinetic(task.mode);
  return run;
}

/// A march leaves these behind.
struct Followed {
  Regime regime;
  periodic::Passes passes;  // where periodic motions are wanted
  sound::Trace trace;       // on the rank that marched
};

Followed follow(const ReducedModel& model, const Task& task, double step, double time,
                Stage& stage) {
  const auto start = march::startOn(task.mode, startOption.get());
  const auto scheme = boundaryOption.get() == "mass" ? march::moreauScheme(model, start, step)
                                                     : march::masslessScheme(model, start, step);
  Recorder recorder(model, task.mode.s, step, largestKinetic(task.mode));
  sound::Latest latest(model, 2 * M_PI / task.mode.s.imag());
  std::optional<SectionRecord> section;
  if (cyclesWanted()) section.emplace(model, task.mode);
  while (scheme->state().time < time) {
    scheme->step();
    recorder.look(*scheme);
    latest.look(*scheme);
    if (section) section->look(*scheme);
    if (!recorder.windowEnded()) continue;
    if (section) section->endWindow();
    stage.progress(formatted("start on mode %s: %.1f of at most %.1f ms", task.start.c_str(),
                             1e3 * scheme->state().time, 1e3 * time));
    if (stopAsked() || (timeOption.get() == 0 && recorder.settled())) break;
  }
  Followed followed{recorder.result(*scheme),
                    {},
                    {recorder.velocities(), recorder.sampleTime(), latest.samples()}};
  if (section) followed.passes = section->last(recorder.windowsUsed());
  return followed;
}

/// Collective. Returns the regimes of the tasks, each marched by one rank, on all ranks;
/// traces are on the rank that marched.
std::vector<Followed> followAll(MPI_Comm comm, const ReducedModel& model,
                                const std::vector<Task>& tasks, double step, double time,
                                Stage& stage) {
  int rank = 0, size = 1;
  check(MPI_Comm_rank(comm, &rank));
  check(MPI_Comm_size(comm, &size));
  std::vector<Followed> all(tasks.size());
  std::string failure;
  try {
    for (std::size_t i = rank; i < tasks.size(); i += size)
      all[i] = follow(model, tasks[i], step, time, stage);
  } catch (const Error& error) {
    failure = "stage regime, -regime_step " + formatted("%g s: ", step) + error.what();
  }
  failTogether(comm, failure);
  stopIfAsked(comm);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    share(comm, i % size, all[i].regime);
    share(comm, i % size, all[i].passes);
  }
  return all;
}

/// Collective. Says where a step is longer than is safe, and where nothing but friction damps.
void warn(const FullModel& full, double step, double stable) {
  const MPI_Comm comm = full.contact.mesh->comm;
  if (boundaryOption.get() == "massless" && step > stable)
    complain(comm, formatted("warning: -regime_step %g s exceeds %.3g s, the stable step while all "
                             "contact sticks; the motion may grow without bound",
                             step, stable));
  PetscReal size = 0;
  if (full.bodies.damping) check(MatNorm(full.bodies.damping, NORM_FROBENIUS, &size));
  if (size * full.damping == 0)
    complain(comm,
             "warning: the bodies are undamped: nothing bounds what grows without touching the "
             "contact after flutter; give -material_<group>_loss_factor");
}

/// Collective. Refuses a law of friction that slips of a boundary without mass do not follow, and
/// says where one may make them alternate.
void checkLaw(MPI_Comm comm, const ReducedModel& model, double step) {
  if (!model.law || boundaryOption.get() != "massless") return;
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

}  // namespace

std::vector<double> frictionsWanted() {
  auto frictions = frictionOption.get();
  std::ranges::sort(frictions);
  return frictions;
}

void checkOptions(bool ofMesh) {
  checkCycleOptions(!frictionOption.get().empty(), boundaryOption.get() == "massless");
  if (frictionOption.get().empty()) {
    auto idle = sound::outsideOptions();
    idle.insert(idle.end(),
                {&timeOption, &stepOption, &startOption, &startsOption, &boundaryOption});
    for (const Option* option : idle)
      if (option->given())
        throw Error("option -" + option->name +
                    ": nothing is followed after flutter without -regime_friction");
    return;
  }
  sound::checkOutsideOptions();
  if (!ofMesh)
    throw Error(
        "option -regime_friction: matrices from files do not say what lifts off and sticks; the "
        "motion after flutter is followed for meshes");
  if (direct::directWanted())
    throw Error(
        "option -regime_friction: the motion after flutter needs the free modes and the estimates "
        "of -flutter_method reduced");
  if (flutter::modalDampingWanted())
    throw Error(
        "option -regime_friction: -flutter_modal_damping is not followed in time; give the damping "
        "to the materials");
  if (!flutter::frictionDampingWanted())
    throw Error(
        "option -regime_friction: in time the friction force turns with the relative velocity, so "
        "that -flutter_friction_damping must be on");
}

void requireSupported(const elasticity::Bodies& bodies, const contact::Contact& contact) {
  const auto refuse = [](const std::string& why) {
    throw Error("option -regime_friction: " + why);
  };
  if (contact.totalNodes == 0) refuse("there is no contact");
  if (bodies.gyroscopic || bodies.rotationStiffness || contact.convected)
    refuse("convective terms (-motion_convective) are not followed in time; leave them out");
  if (elasticity::prestressWanted())
    refuse("the geometric stiffness of the steady stress is not followed in time; leave it out");
  if (cyclesWanted() && !contact.law.constant())
    refuse(
        "the derivative of a step leaves out -friction_law, so that no periodic motions are found "
        "under it; leave out -regime_cycle");
}

Study study(const FullModel& full, linalg::Block free, const pencil::ComplexModes& point) {
  const MPI_Comm comm = full.contact.mesh->comm;
  Study result;
  result.at = point.at;
  result.unstable = point.unstableCount();
  if (result.unstable == 0) {
    say(comm, sweep::parameterText(point.at) +
                  ": no mode is unstable, and none is followed after flutter");
    return result;
  }
  std::vector<const pencil::Shape*> shapes;
  for (const auto& shape : point.shapes)
    if (point.eigenvalues[shape.index].unstable) shapes.push_back(&shape);
  if (shapes.empty())
    throw Error("option -regime_friction: the unstable modes are not kept; raise -flutter_shapes");
  if (std::ssize(shapes) < result.unstable)
    say(comm,
        formatted("%s: %zu of %d unstable modes have kept shapes (-flutter_shapes), and these "
                  "are held exactly by the reduced model of the regime",
                  sweep::parameterText(point.at).c_str(), shapes.size(), result.unstable));
  linalg::Block unstable(free.rows());
  for (const auto* shape : shapes)
    for (const Vec part : {shape->real.get(), shape->imaginary.get()}) {
      const ReadArray values(part);
      unstable.append(std::span(values.data(), values.size()));
    }
  Stage stage(comm, "regime");
  const Reduction reduction = reduce(full, std::move(free), unstable);
  const ReducedModel& model = reduction.model;
  result.modes = model.modes(), result.rows = model.rows();
  result.nodes = model.nodes, result.contactNode = reduction.contactNode;
  result.steadyPower = steadyPower(model);
  std::vector<Task> tasks;
  for (const auto* shape : shapes) {
    const Complex certified = point.eigenvalues[shape->index].s;
    Task task{std::to_string(shape->index + 1), march::nearestMode(model, certified), {}};
    result.modelError =
        std::max(result.modelError, std::abs(task.mode.s - certified) / std::abs(certified));
    task.onset = firstEvent(model.nodes, motionAt(model, task.mode));
    scale(task.mode, task.onset.factor);
    tasks.push_back(std::move(task));
  }
  if (result.modelError > point.tolerance)
    throw Error(
        formatted("stage regime: the reduced model has the unstable eigenvalues to %.1e "
                  "only, not to the %.1e of -flutter_tolerance",
                  result.modelError, point.tolerance));
  if (startsOption.get() == "all" && tasks.size() > 1) {
    Task sum = tasks.front();
    sum.start = "all";
    for (std::size_t i = 1; i < tasks.size(); ++i) {
      add(sum.mode.q, tasks[i].mode.q), add(sum.mode.z, tasks[i].mode.z);
      add(sum.mode.jump, tasks[i].mode.jump), add(sum.mode.force, tasks[i].mode.force);
    }
    scale(sum.mode, 1.0 / tasks.size());
    tasks.push_back(std::move(sum));
  } else if (startsOption.get() == "fastest") {
    tasks.resize(1);
  }
  const Complex s = tasks.front().mode.s;
  const double period = 2 * M_PI / s.imag();
  result.stableStep = march::stableStep(model);
  result.step = stepOption.get();
  if (result.step == 0) result.step = std::min(period / 128, 0.8 * result.stableStep);
  double time = timeOption.get();
  if (time == 0) time = std::min(4000 * period, std::max(400 * period, 10 / s.real()));
  stage.say(formatted("%s: %d modes, %d gaps and slips; unstable eigenvalues to %.1e",
                      sweep::parameterText(point.at).c_str(), result.modes, result.rows,
                      result.modelError));
  warn(full, result.step, result.stableStep);
  checkLaw(comm, model, result.step);
  auto followed = followAll(comm, model, tasks, result.step, time, stage);
  const sound::Observer observer(full.contact,
                                 {reduction.modes, reduction.responses, reduction.contactNode});
  int ranks = 1;
  check(MPI_Comm_size(comm, &ranks));
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    result.runs.push_back(runOf(model, tasks[i]));
    result.runs.back().regime = std::move(followed[i].regime);
    result.runs.back().outside = observer.of(i % ranks, followed[i].trace);
  }
  const sound::Sound& heard = result.runs.front().outside.sound;
  stage.say(formatted("%s: sound power about %.3g W (%.1f dB) from %.4g m2 of visible surface",
                      sweep::parameterText(point.at).c_str(), heard.power, heard.level,
                      heard.area));
  const Regime& regime = result.runs.front().regime;
  if (std::abs(regime.growth - s.real()) > 0.2 * s.real())
    complain(comm,
             formatted("warning: in the linear range the march grows by %.4g 1/s, the mode by "
                       "%.4g 1/s: the error of the step, which a shorter -regime_step makes "
                       "smaller in proportion",
                       regime.growth, s.real()));
  if (cyclesWanted())
    for (std::size_t i = 0; i < tasks.size(); ++i)
      result.runs[i].cycles =
          findCycles(comm, model, point.at.friction, followed[i].passes, result.step, stage);
  stage.finish(formatted(
      "%s: %s%s, carrier %.5g Hz (flutter %.5g Hz), friction %.4g, %.4g W (steady sliding %.4g W), "
      "open %.3g, sticking %.3g of %zu nodes, largest kinetic energy %.4g J, defect %.1e, "
      "energy %.1e",
      sweep::parameterText(point.at).c_str(), text(regime.kind),
      regime.settled ? "" : " (not settled)", regime.carrier, s.imag() / (2 * M_PI),
      regime.means.frictionCoefficient, regime.means.frictionPower, result.steadyPower,
      regime.means.open, regime.means.sticking, model.nodes.size(), regime.largestKinetic,
      regime.largestDefect, regime.imbalance));
  return result;
}

}  // namespace squeal::regime
