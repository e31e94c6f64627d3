// SPDX-License-Identifier: BSD-2-Clause
#include "model/elasticity/settings.hpp"

#include <algorithm>
#include <cmath>

#include "base/options/options.hpp"
#include "base/petsc/check.hpp"

namespace squeal::elasticity {
namespace {

const ChoiceOption massOption(
    "elasticity", "elasticity_mass", {"consistent", "higher_order"}, "consistent",
    "mass matrix; higher_order: mean of the consistent and the lumped matrix, so that the "
    "frequencies of linear elements converge with fourth order");
const TextOption incompatibleOption(
    "elasticity", "elasticity_incompatible_modes", "hex8",
    "element types (quad4, hex8) that have incompatible bending modes, or none");
const FlagOption prestressOption(
    "elasticity", "elasticity_prestress", false,
    "geometric stiffness: the stress of steady sliding stiffens or softens the vibrations");
const RealListOption stiffnessOption(
    "ground", "ground_<group>_stiffness", "0,0,0", "N/m", nonNegative,
    "total stiffness along x, y, z of the springs between a group and the ground, shared equally "
    "by its nodes (per m of depth in plane problems)");
const RealListOption dampingOption(
    "ground", "ground_<group>_damping", "0,0,0", "N s/m", nonNegative,
    "total damping along x, y, z of the dashpots between a group and the ground, shared equally by "
    "its nodes (per m of depth in plane problems)");
const TextOption groundFrameOption("ground", "ground_<group>_frame", "",
                                   "name of the -frame whose axes are x, y, z of the springs and "
                                   "dashpots; default: the global axes");
const RealOption pressureOption("load", "load_<group>_pressure", 0.0, "Pa", anyReal,
                                "pressure on a surface group, positive inwards");
const FlagOption centrifugalOption("load", "load_centrifugal", true,
                                   "centrifugal forces on rotating bodies");
const RealListOption gravityOption("load", "load_gravity", "0,0,0", "m/s2", anyReal,
                                   "acceleration of gravity, on all bodies and point masses");
const RealListOption accelerationOption("load", "load_<body>_acceleration", "0,0,0", "m/s2",
                                        anyReal,
                                        "force per mass of a body, added to -load_gravity");
const RealOption spinOption(
    "load", "load_<body>_spin", 0.0, "rad/s", anyReal,
    "speed of rotation that causes centrifugal forces on a body without any -motion option");
const RealListOption spinAxisOption("load", "load_<body>_spin_axis", "0,0,1", "", anyReal,
                                    "direction of the axis of -load_<body>_spin");
const RealListOption spinOriginOption("load", "load_<body>_spin_origin", "0,0,0", "m", anyReal,
                                      "point on the axis of -load_<body>_spin");
const RealListOption velocityOption("motion", "motion_<body>_velocity", "0,0,0", "m/s", anyReal,
                                    "velocity of translation of the body's matter");
const RealOption speedOption("motion", "motion_<body>_speed", 0.0, "rad/s", anyReal,
                             "speed of rotation of the body's matter");
const RealOption rpmOption("motion", "motion_<body>_rpm", 0.0, "1/min", anyReal,
                           "speed of rotation in revolutions per minute, instead of _speed");
const RealListOption axisOption("motion", "motion_<body>_axis", "0,0,1", "", anyReal,
                                "direction of the rotation axis, right-handed");
const RealListOption originOption("motion", "motion_<body>_origin", "0,0,0", "m", anyReal,
                                  "point on the rotation axis");
const FlagOption convectiveOption("motion", "motion_convective", false,
                                  "convective terms (gyroscopic matrix and rotation stiffness) of "
                                  "moving bodies; off: approximation A, which omits these terms");

std::vector<std::string> incompatibleGiven() {
  auto names = incompatibleOption.list();
  if (names == std::vector<std::string>{"none"}) names.clear();
  for (const auto& name : names)
    if (name != "quad4" && name != "hex8")
      throw Error("option -elasticity_incompatible_modes " + incompatibleOption.get() +
                  ": must be none or a list of quad4, hex8");
  return names;
}

/// Returns ω, rad/s, from the option that gives it.
double rotationSpeed(const std::string& body) {
  const bool inRpm = rpmOption.given(body);
  if (inRpm && speedOption.given(body))
    throw Error("options " + speedOption.dashed(body) + " and " + rpmOption.dashed(body) +
                ": give the speed once");
  if (velocityOption.given(body) && (inRpm || speedOption.given(body)))
    throw Error("options " + velocityOption.dashed(body) + " and " +
                (inRpm ? rpmOption : speedOption).dashed(body) +
                ": a body translates or rotates, not both");
  return inRpm ? rpmOption.get(body) * 2 * M_PI / 60 : speedOption.get(body);
}

std::map<std::string, MotionSettings> motionsGiven() {
  std::map<std::string, MotionSettings> motions;
  for (const Option* option : std::vector<const Option*>{&velocityOption, &speedOption, &rpmOption,
                                                         &axisOption, &originOption})
    for (const auto& body : option->subjects())
      motions.try_emplace(body, MotionSettings{.option = option->dashed(body)});
  for (const Option* option : std::vector<const Option*>{&axisOption, &originOption})
    for (const auto& body : option->subjects())
      if (!speedOption.given(body) && !rpmOption.given(body))
        throw Error("option " + option->dashed(body) + " needs " + speedOption.dashed(body) +
                    " or " + rpmOption.dashed(body) + ": only a rotation has an axis");
  for (auto& [body, motion] : motions) {
    motion.moves = velocityOption.given(body) || speedOption.given(body) || rpmOption.given(body);
    motion.velocity = velocityOption.vector(body);
    motion.speed = rotationSpeed(body);
    motion.axis = axisOption.vector(body);
    motion.origin = originOption.vector(body);
    motion.axisOption = axisOption.dashed(body);
  }
  return motions;
}

/// Reads gravity, accelerations and spins.
void readBodyForces(Settings& settings) {
  settings.gravity = gravityOption.vector();
  for (const auto& body : accelerationOption.subjects())
    settings.accelerations[body] = accelerationOption.vector(body);
  for (const Option* option : std::vector<const Option*>{&spinAxisOption, &spinOriginOption})
    for (const auto& body : option->subjects())
      if (!spinOption.given(body))
        throw Error("option " + option->dashed(body) + " needs " + spinOption.dashed(body));
  for (const auto& body : spinOption.subjects()) {
    if (settings.motions.contains(body) && settings.motions.at(body).speed != 0)
      throw Error("option " + spinOption.dashed(body) + ": the body rotates, and " +
                  "-load_centrifugal gives its centrifugal forces already");
    if (velocityOption.given(body) && velocityOption.vector(body).in(3) != mesh::Point{})
      throw Error("option " + spinOption.dashed(body) + ": the body translates (" +
                  velocityOption.dashed(body) +
                  "); a spin acts on a body that does not move otherwise");
    settings.spins[body] = {.option = spinOption.dashed(body),
                            .speed = spinOption.get(body),
                            .axis = spinAxisOption.vector(body),
                            .origin = spinOriginOption.vector(body),
                            .axisOption = spinAxisOption.dashed(body)};
  }
  settings.bodyForces =
      gravityOption.given() || !settings.accelerations.empty() || !settings.spins.empty();
}

std::map<std::string, GroundSettings> groundGiven() {
  std::map<std::string, GroundSettings> ground;
  for (const auto& group : stiffnessOption.subjects()) {
    ground[group].springs = true;
    ground[group].stiffness = stiffnessOption.vector(group);
  }
  for (const auto& group : dampingOption.subjects()) {
    ground[group].dashpots = true;
    ground[group].damping = dampingOption.vector(group);
  }
  for (const auto& group : groundFrameOption.subjects()) {
    if (!ground.contains(group)) requireOption({&groundFrameOption}, stiffnessOption);
    ground[group].frame = groundFrameOption.get(group);
  }
  return ground;
}

}  // namespace

Settings Settings::given() {
  Settings settings;
  settings.mass = massOption.get() == "consistent" ? MassKind::consistent : MassKind::higherOrder;
  settings.incompatible = incompatibleGiven();
  settings.prestress = prestressOption.get();
  settings.centrifugal = centrifugalOption.get();
  settings.convective = convectiveOption.get();
  for (const auto& surface : pressureOption.subjects())
    settings.pressure[surface] = pressureOption.get(surface);
  attachments::rejectIdleHydraulic(pressureOption);
  for (const auto& [surface, pressure] : settings.pressure)
    if (!attachments::isHydraulic(surface)) settings.constantPressure.insert(surface);
  settings.motions = motionsGiven();
  readBodyForces(settings);
  settings.attachments = attachments::Settings::given();
  settings.ground = groundGiven();
  return settings;
}

bool Settings::isIncompatible(const std::string& cellType) const {
  return std::ranges::find(incompatible, cellType) != incompatible.end();
}

std::vector<std::string> movingBodies(const Settings& settings) {
  std::vector<std::string> bodies;
  for (const auto& [body, motion] : settings.motions)
    if (motion.moves) bodies.push_back(body);
  return bodies;
}

std::vector<mesh::GroupRequest> loadedSurfaces(const Settings& settings) {
  std::vector<mesh::GroupRequest> requests;
  for (const auto& [surface, pressure] : settings.pressure)
    requests.push_back({surface, pressureOption.dashed(surface)});
  return requests;
}

std::string groundFrameName(const std::string& group) { return groundFrameOption.dashed(group); }
std::string accelerationName(const std::string& body) { return accelerationOption.dashed(body); }
std::string pressureName(const std::string& surface) { return pressureOption.dashed(surface); }

std::vector<mesh::GroupRequest> groundedGroups(const Settings& settings) {
  std::vector<mesh::GroupRequest> requests;
  for (const auto& [group, ground] : settings.ground)
    requests.push_back({group, (ground.springs ? stiffnessOption : dampingOption).dashed(group)});
  return requests;
}

}  // namespace squeal::elasticity
