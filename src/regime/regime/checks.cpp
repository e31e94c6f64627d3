// SPDX-License-Identifier: BSD-2-Clause
#include "regime/regime/checks.hpp"

#include <algorithm>
#include <cmath>

#include "base/session/stages.hpp"
#include "base/system/text.hpp"
#include "eigen/pencil/settings.hpp"
#include "problem/terms/settings.hpp"
#include "regime/march/law.hpp"

namespace squeal::regime {

void checkOptions(const Settings& settings, const pencil::Settings& pencil,
                  const terms::Settings* terms) {
  if (!settings.enabled()) return;
  checkSteps(settings.march);
  if (!terms)
    throw Error(
        "option -regime_friction: matrices from files do not define where bodies separate and "
        "stick; the motion after flutter is computed only for meshes");
  if (pencil.method == pencil::Method::direct)
    throw Error(
        "option -regime_friction: the motion after flutter needs the free modes and the estimates "
        "of -flutter_method reduced");
  if (pencil.isModallyDamped())
    throw Error(
        "option -regime_friction: the time integration does not support -flutter_modal_damping; "
        "give the materials damping");
  if (!terms->frictionDamping)
    throw Error(
        "option -regime_friction: in the time integration the friction force turns with the "
        "relative velocity, so -flutter_friction_damping must be on");
}

void requireSupported(const Settings& settings, const elasticity::Bodies& bodies,
                      const contact::Contact& contact) {
  const auto reject = [](const std::string& why) {
    throw Error("option -regime_friction: " + why);
  };
  if (contact.interfaces.totalNodes == 0) reject("there is no contact");
  if (bodies.gyroscopic || bodies.rotationStiffness || contact.sliding.convected)
    reject("the time integration does not support convective terms; remove -motion_convective");
  for (const auto& interface : contact.interfaces.options)
    if (!interface.separates)
      reject("the time integration lets all contact separate; remove " +
             interfaces::separationName(interface.surfaces.name));
  if (bodies.settings.prestress)
    reject(
        "the time integration does not support the geometric stiffness of the steady stress; "
        "remove -elasticity_prestress");
  if (settings.cycles.wanted && !contact.law.constant())
    reject(
        "the derivative of a step omits -friction_law, so periodic motions are not computed with "
        "it; remove -regime_cycle");
}

void warnAboutSteps(MPI_Comm comm, const Settings& settings, std::span<const Task> tasks,
                    double stableStep) {
  const int wanted = settings.sound.cyclesKept > 0 ? settings.sound.frames : 0;
  double step = 0;  // the longest
  for (const Task& task : tasks) {
    if (!task.failure.empty()) continue;
    step = std::max(step, task.step);
    if (const int frames = settings.sound.framesOfPeriod(task.shortestPeriod, task.step);
        frames < wanted)
      printWarning(comm, formatted("warning: -regime_frames %d: a period of %.5g Hz has %d steps, "
                                   "so only this number of frames is written",
                                   wanted, 1 / task.shortestPeriod, frames));
  }
  if (settings.march.massless && step > stableStep)
    printWarning(comm,
                 formatted("warning: -regime_step %g s exceeds %.3g s, the stable step while all "
                           "contact sticks; the motion may grow without bound",
                           step, stableStep));
}

void warnAboutDamping(const FullModel& full) {
  const MPI_Comm comm = full.contact.mesh->comm;
  PetscReal size = 0;
  if (full.bodies.damping) check(MatNorm(full.bodies.damping, NORM_FROBENIUS, &size));
  if (size * full.damping == 0)
    printWarning(comm,
                 "warning: the bodies are undamped, so a motion that never separates or sticks "
                 "grows without bound; give -material_<group>_loss_factor");
}

void checkLaw(MPI_Comm comm, const ReducedModel& model, std::span<const Task> tasks) {
  if (!model.law) return;
  double step = INFINITY;  // the shortest: the strictest condition
  for (const Task& task : tasks)
    if (task.failure.empty()) step = std::min(step, task.step);
  if (!std::isfinite(step)) return;
  const auto slopes = march::steadySlopes(model);
  if (const double gain = march::lawGain(model, step, slopes); !(gain < 1))
    throw Error(formatted(
        "option -regime_friction: the coefficient of friction changes with the speed "
        "%.3g times faster than the slips of the massless boundary can follow with the time step "
        "%g s (-friction_law); give -regime_boundary mass",
        gain, step));
  if (!(march::lawGain(model, 0, slopes) < 1))
    printWarning(
        comm,
        "warning: the coefficient of friction falls with the speed faster than the damping of the "
        "massless boundary allows, so the motion does not converge with -regime_step; give the "
        "materials at the contact damping, or use -regime_boundary mass");
  for (const bool lowest : {true, false})
    if (!(march::lawGain(model, step, march::steepestSlopes(model, lowest)) < 1))
      printWarning(
          comm,
          "warning: near the steepest part of -friction_law slips of the massless boundary "
          "may alternate from step to step; compare with -regime_boundary mass");
}

}  // namespace squeal::regime
