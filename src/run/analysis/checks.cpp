// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/checks.hpp"

#include <algorithm>

#include "base/options/options.hpp"
#include "base/petsc/finite.hpp"
#include "base/petsc/object.hpp"
#include "base/session/stages.hpp"
#include "eigen/modes/settings.hpp"
#include "eigen/pencil/settings.hpp"
#include "regime/regime/checks.hpp"

namespace squeal::analysis {

void requireFiniteSweep(const elasticity::Bodies& bodies, const contact::Contact& contact,
                        const sweep::Sweep& sweep) {
  const auto& [frictions, speeds, pressures, dampings] = sweep;
  double friction = 1;
  for (const auto& interface : contact.interfaces.options)
    friction = std::max(friction, interface.friction.at(frictions.back()));
  const double speed = std::max(1.0, speeds.back()), speed2 = speed * speed;
  const std::string swept = " times the factors of the sweep";
  requireFinite(bodies.stiffness, "the stiffness of the bodies" + swept, friction);
  requireFinite(bodies.mass, "the mass of the bodies" + swept, friction);
  requireFinite(bodies.damping, "the damping of the bodies" + swept,
                friction * std::max(1.0, dampings.back()));
  requireFinite(bodies.gyroscopic, "the gyroscopic matrix" + swept, friction * speed);
  requireFinite(bodies.rotationStiffness, "the rotation stiffness" + swept, friction * speed2);
  requireFinite(bodies.load, "the loads" + swept, std::max(pressures.back(), speed2));
  requireFinite(contact.kinematics.offset, "the displacements held" + swept,
                std::max(1.0, pressures.back()));
}

void requireFiniteSweep(const std::vector<matrices::NamedTerm>& terms, const sweep::Sweep& sweep) {
  for (const auto& [name, term] : terms)
    for (double friction : {sweep.frictions.front(), sweep.frictions.back()})
      for (double speed : {sweep.speeds.front(), sweep.speeds.back()})
        for (double damping : {sweep.dampings.front(), sweep.dampings.back()})
          requireFinite(term.matrix, "matrix '" + name + "' times its factors",
                        term.coefficient({friction, speed, 1, damping}));
}

namespace {

/// Returns true if a base motion has an effect: on contact, by convective terms or by centrifugal
/// forces.
bool anyMotion(const elasticity::Bodies& bodies, const contact::Contact& contact) {
  const auto& all = contact.interfaces;
  const bool anyContact = !std::ranges::all_of(all.options, &interfaces::InterfaceSettings::isTied);
  const auto& settings = bodies.settings;
  return std::ranges::any_of(bodies.motions,
                             [&](const auto& motion) {
                               return motion.moves() &&
                                      (anyContact || settings.convective ||
                                       (motion.speed != 0 && settings.centrifugal));
                             }) ||
         std::ranges::any_of(all.obstacles, [](const auto& obstacle) {
           return obstacle.velocity != mesh::Point{};
         });
}

}  // namespace

void rejectIdleFactors(const elasticity::Bodies& bodies, const contact::Contact& contact,
                       const pencil::Settings& pencil, const sweep::Sweep& sweep) {
  const auto given = [](const std::vector<double>& factors) {
    return factors != std::vector<double>{1};
  };
  if (given(sweep.dampings) && !bodies.damping && !pencil.isModallyDamped())
    throw Error(
        "option -flutter_damping scales the damping of bodies and joints, and there is none: give "
        "-material_<group>_rayleigh_*, "
        "-material_<group>_loss_factor, -ground_<group>_damping, -spring_<name>_damping, "
        "-bushing_<name>_damping or -flutter_modal_damping");
  if (given(sweep.speeds) && !anyMotion(bodies, contact))
    throw Error(
        "option -flutter_speed scales the motion of bodies and obstacles, and none has an effect: "
        "give -motion_<body>_velocity or _speed with contact or -motion_convective on, or "
        "-contact_<interface>_obstacle_velocity");
  if (!given(sweep.pressures)) return;
  OwnedVec pressures;
  check(VecDuplicate(bodies.load, pressures.out()));
  check(VecWAXPY(pressures, -1, bodies.centrifugal, bodies.load));
  if (bodies.constantLoad) check(VecAXPY(pressures, -1, bodies.constantLoad));
  PetscReal load = 0, displacement = 0;
  check(VecNorm(pressures, NORM_INFINITY, &load));
  check(VecNorm(contact.kinematics.offset, NORM_INFINITY, &displacement));
  if (load == 0 && displacement == 0)
    throw Error(
        "option -flutter_pressure scales hydraulic loads and held displacements, and there are "
        "none: give -load_<group>_pressure, _force or _moment, without -load_<group>_hydraulic "
        "off, -constraint_<group>_displacement or -contact_<interface>_obstacle_displacement");
}

void rejectIdleFactors(const std::vector<matrices::NamedTerm>& terms,
                       const pencil::Settings& pencil, const sweep::Sweep& sweep) {
  const auto require = [&](const std::vector<double>& values, const std::string& name,
                           auto exponent) {
    const bool isUsed =
        std::ranges::any_of(terms, [&](const auto& named) { return exponent(named.term) != 0; });
    if (isUsed || values == std::vector<double>{1}) return;
    const std::string none = "no matrix has -matrices_<name>_" + name + "_exponent";
    if (values.size() > 1) throw Error("option -flutter_" + name + ": a sweep, but " + none);
    printWarning(commOf(terms.front().term.matrix),
                 "option -flutter_" + name + " was not used: " + none);
  };
  if (sweep.frictions.size() > 1)
    require(sweep.frictions, "friction",
            [](const pencil::Term& term) { return term.frictionExponent; });
  require(sweep.speeds, "speed", [](const pencil::Term& term) { return term.speedExponent; });
  if (!pencil.isModallyDamped())
    require(sweep.dampings, "damping",
            [](const pencil::Term& term) { return term.dampingExponent; });
  if (sweep.pressures != std::vector<double>{1})
    throw Error("option -flutter_pressure: no matrix from a file depends on the pressure");
}

void checkModel(const Model& model, const Settings& settings, const sweep::Sweep& sweep) {
  requireSupports(model);
  if (settings.regime.enabled())
    regime::requireSupported(settings.regime, model.bodies, model.contact);
  requireFiniteSweep(model.bodies, model.contact, sweep);
  rejectIdleFactors(model.bodies, model.contact, settings.pencil, sweep);
  warnOfDenseWork(model.mesh->comm, settings, sweep,
                  model.mesh->dimension * model.mesh->totalNodes);
}

void warnOfDenseWork(MPI_Comm comm, const Settings& settings, const sweep::Sweep& sweep,
                     PetscInt unknowns) {
  if (settings.pencil.method == pencil::Method::direct) return;
  const int modes = std::min<PetscInt>(settings.solver.modes->count, unknowns);
  sweep::warnOfLongSweep(comm, sweep, modes);
}

}  // namespace squeal::analysis
