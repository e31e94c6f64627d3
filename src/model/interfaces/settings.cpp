// SPDX-License-Identifier: BSD-2-Clause
#include "model/interfaces/settings.hpp"

#include <algorithm>

#include "base/options/options.hpp"
#include "base/petsc/check.hpp"
#include "base/system/text.hpp"

namespace squeal::interfaces {
namespace {

/// The values of the options of roles and of slaves, in the order of the enumerations.
const std::vector<std::string> roleNames{"sliding", "sticking", "frictionless", "tied"},
    slaveNames{"finer", "pad", "disc"};

const TextOption padOption(
    "contact", "contact_<interface>_pad", "",
    "pad side of a contact interface (two surfaces that can touch): a named surface of the mesh");
const TextOption discOption(
    "contact", "contact_<interface>_disc", "",
    "disc side of an interface: a named surface; the two meshes need not match");
const RealListOption obstacleVelocityOption("contact", "contact_<interface>_obstacle_velocity",
                                            "0,0,0", "m/s", anyReal,
                                            "sliding velocity, in the plane of the pad face, of a "
                                            "rigid flat obstacle that replaces the disc");
const RealListOption obstacleDisplacementOption(
    "contact", "contact_<interface>_obstacle_displacement", "0,0,0", "m", anyReal,
    "prescribed displacement that presses the rigid obstacle against the pad");
const ChoiceOption roleOption("contact", "contact_<interface>_role", roleNames, "sliding",
                              "role of an interface; sliding: friction opposes the sliding "
                              "velocity; sticking: nodes do not slide unless they are released; "
                              "frictionless: no tangential force; tied: bonded");
const RealOption factorOption(
    "contact", "contact_<interface>_friction_factor", 1.0, "", nonNegative,
    "ratio of the coefficient of friction of a sliding interface to -flutter_friction");
const OptionalRealOption frictionOption(
    "contact", "contact_<interface>_friction", "", nonNegative,
    "on a sliding interface: fixed coefficient of friction, in place of the swept one (0: "
    "frictionless); on a sticking interface: limit of the ratio of tangential to normal force at a "
    "node; no limit if not given");
const FlagOption releaseOption(
    "contact", "contact_<interface>_release", false,
    "release of nodes of a sticking interface at which the ratio of tangential to normal force "
    "exceeds -contact_<interface>_friction; on: they slide, with this limit as their coefficient "
    "of friction; off: they stick and are reported");
const WordOrRealOption gapOption(
    "contact", "contact_<interface>_gap", 0.0, "m", "measured",
    "initial gap, without load; 'measured': the distance between the two "
    "surfaces of the mesh; negative: interference fit");
const ChoiceOption slaveOption("contact", "contact_<interface>_slave", slaveNames, "finer",
                               "slave side, whose nodes carry the gap unknowns; finer: "
                               "the side with the finer mesh, or the pad if the meshes match");
const RealOption searchOption("contact", "contact_<interface>_search", 0.0, "m", nonNegative,
                              "largest distance at which the program pairs two faces if the two "
                              "meshes do not match; 0 = automatic (for each slave face, half its "
                              "size)");
const FlagOption separationOption(
    "contact", "contact_<interface>_separation", true,
    "separation of the two sides; off: they cannot separate, and nodes without friction can carry "
    "tension; if a node with friction is under tension, the point of the sweep has no solution");
const RealOption stiffnessOption(
    "contact", "contact_<interface>_stiffness", 0.0, "N/m3", nonNegative,
    "normal stiffness of a soft layer on the face: contact pressure per unit of compression; 0 = "
    "hard contact");
const RealOption tangentialStiffnessOption(
    "contact", "contact_<interface>_stiffness_tangential", 0.0, "N/m3", nonNegative,
    "tangential stiffness of a soft layer: shear stress per unit of tangential displacement; used "
    "only on sticking interfaces, where it must be > 0 if -contact_<interface>_stiffness is > 0");
const TextOption tieSlaveOption(
    "tie", "tie_<name>_slave", "",
    "slave surface group of a tie, preferably the one with the finer mesh");
const TextOption tieMasterOption("tie", "tie_<name>_master", "",
                                 "master surface group of a tie, to which the slave is bonded");
const RealOption toleranceOption("tie", "tie_<name>_tolerance", 0.0, "m", nonNegative,
                                 "largest distance at which two faces of a tie are bonded; 0 = "
                                 "automatic (for each slave face, half its size)");
const FlagOption adjustOption(
    "tie", "tie_<name>_adjust", true,
    "displacement of the slave nodes of the mesh onto the master before the run, so that the two "
    "bodies can rotate together without strain; this changes the geometry and causes no stress");

mesh::GroupRequest groupOf(const TextOption& option, const std::string& name) {
  const std::string group = option.get(name);
  return {group, option.dashed(name) + " " + group};
}

/// Returns the value of an enumeration that an option gives by its name.
template <class Enumeration>
Enumeration valueOf(const ChoiceOption& option, const std::vector<std::string>& names,
                    const std::string& interface) {
  return Enumeration(std::find(names.begin(), names.end(), option.get(interface)) - names.begin());
}

/// Throws Error for options that have no effect on this interface.
void rejectIdleOptions(const InterfaceSettings& interface) {
  const std::string& name = interface.surfaces.name;
  const auto reject = [&](const Option& option, const std::string& why) {
    if (option.given(name)) throw Error("option " + option.dashed(name) + " " + why);
  };
  if (interface.onObstacle()) {
    const std::string why = "needs " + discOption.dashed(name);
    for (const Option* option : std::vector<const Option*>{&slaveOption, &searchOption, &gapOption})
      reject(*option, why);
    if (interface.isTied() || interface.role == Role::sticking)
      throw Error("option " + roleOption.dashed(name) + " " + roleOption.get(name) + " " + why);
  }
  const std::string role = "needs " + roleOption.dashed(name);
  if (interface.role != Role::sliding) reject(factorOption, role + " sliding");
  if (interface.role != Role::sliding && interface.role != Role::sticking)
    reject(frictionOption, role + " sliding or sticking");
  if (interface.role != Role::sticking) reject(releaseOption, role + " sticking");
  if (!frictionOption.given(name))
    reject(releaseOption, "needs " + frictionOption.dashed(name) + ", the limit");
  if (frictionOption.given(name))
    reject(factorOption, "is a factor on -flutter_friction, which " + frictionOption.dashed(name) +
                             " replaces; give one of them");
  if (interface.isTied()) reject(separationOption, "has no effect on a tied interface");
  if (!interface.separates && (interface.gapIsMeasured || interface.gap > 0))
    throw Error("option " + separationOption.dashed(name) + " off requires " +
                gapOption.dashed(name) + " to be a number <= 0: it would pull an open gap shut");
  if (interface.isTied())
    reject(stiffnessOption, "has no effect on a tied interface; model the layer as a body");
  if (interface.role != Role::sticking || interface.layerStiffness == 0)
    reject(tangentialStiffnessOption, role + " sticking and " + stiffnessOption.dashed(name));
  if (interface.role == Role::sticking && interface.layerStiffness > 0 &&
      interface.layerTangentialStiffness == 0)
    throw Error("option " + stiffnessOption.dashed(name) +
                ": a sticking interface with a soft layer also needs " +
                tangentialStiffnessOption.dashed(name));
  if (interface.isTied()) reject(gapOption, "has no effect on a tied interface, which has no gap");
}

/// Throws Error for options of an interface or a tie that lacks a surface.
void requireSurfaces() {
  requireOption({&discOption, &obstacleVelocityOption, &obstacleDisplacementOption, &roleOption,
                 &factorOption, &frictionOption, &releaseOption, &gapOption, &slaveOption,
                 &searchOption, &stiffnessOption, &tangentialStiffnessOption, &separationOption},
                padOption);
  requireOption({&tieMasterOption, &toleranceOption, &adjustOption}, tieSlaveOption);
  requireOption({&tieSlaveOption}, tieMasterOption);
}

/// Returns the surfaces of a contact interface. Throws Error unless it has either a disc or an
/// obstacle.
mesh::InterfaceRequest surfacesOf(const std::string& name) {
  const bool disc = discOption.given(name), obstacle = obstacleVelocityOption.given(name) ||
                                                       obstacleDisplacementOption.given(name);
  if (disc == obstacle)
    throw Error("option " + padOption.dashed(name) + ": give either " + discOption.dashed(name) +
                " or an obstacle (" + obstacleVelocityOption.dashed(name) + ", " +
                obstacleDisplacementOption.dashed(name) + "), not both");
  return {name, "interface '" + name + "'", groupOf(padOption, name),
          disc ? groupOf(discOption, name) : mesh::GroupRequest{}};
}

InterfaceSettings tieGiven(const std::string& name) {
  InterfaceSettings tie;
  tie.surfaces = {name, "tie '" + name + "'", groupOf(tieSlaveOption, name),
                  groupOf(tieMasterOption, name)};
  tie.role = Role::tied;
  tie.slave = SlaveChoice::pad;
  tie.searchDistance = toleranceOption.get(name);
  tie.adjust = adjustOption.get(name);
  return tie;
}

/// Reads the options of a contact interface with these surfaces.
InterfaceSettings contactGiven(mesh::InterfaceRequest surfaces) {
  InterfaceSettings interface;
  interface.surfaces = std::move(surfaces);
  const std::string& name = interface.surfaces.name;
  interface.role = valueOf<Role>(roleOption, roleNames, name);
  interface.obstacleVelocity = obstacleVelocityOption.vector(name);
  interface.obstacleDisplacement = obstacleDisplacementOption.vector(name);
  interface.slave = valueOf<SlaveChoice>(slaveOption, slaveNames, name);
  interface.searchDistance = searchOption.get(name);
  const std::optional<double> fixed = frictionOption.get(name);
  if (interface.role == Role::sliding)
    interface.friction = fixed ? Coefficient{*fixed, 0} : Coefficient{0, factorOption.get(name)};
  if (interface.role == Role::sticking) interface.stickingLimit = fixed;
  interface.releases = releaseOption.get(name);
  interface.separates = separationOption.get(name);
  interface.layerStiffness = stiffnessOption.get(name);
  interface.layerTangentialStiffness = tangentialStiffnessOption.get(name);
  const auto gap = gapOption.get(name);
  interface.gapIsMeasured = !gap;
  interface.gap = gap.value_or(0);
  rejectIdleOptions(interface);
  return interface;
}

std::vector<InterfaceSettings> interfacesGiven() {
  requireSurfaces();
  std::vector<mesh::InterfaceRequest> contacts;
  for (const auto& name : padOption.subjects()) contacts.push_back(surfacesOf(name));
  std::vector<InterfaceSettings> interfaces;
  for (auto& surfaces : contacts) interfaces.push_back(contactGiven(std::move(surfaces)));
  for (const auto& name : tieSlaveOption.subjects()) interfaces.push_back(tieGiven(name));
  return interfaces;
}

}  // namespace

Settings Settings::given() {
  Settings settings;
  settings.interfaces = interfacesGiven();
  return settings;
}

const InterfaceSettings& Settings::interface(const std::string& label) const {
  const auto found = std::ranges::find(interfaces, label, &InterfaceSettings::label);
  ensure(found != interfaces.end(), "the mesh has the interfaces of its request");
  return *found;
}

std::vector<int> frictionExponents(const std::vector<InterfaceSettings>& interfaces) {
  std::vector<int> exponents;
  for (const int exponent : {0, 1})
    if (std::ranges::any_of(interfaces,
                            [&](const auto& one) { return one.friction.part(exponent) > 0; }))
      exponents.push_back(exponent);
  return exponents;
}

std::vector<mesh::InterfaceRequest> interfaceRequests(const Settings& settings) {
  std::vector<mesh::InterfaceRequest> requests;
  for (const auto& interface : settings.interfaces) {
    auto& request = requests.emplace_back(interface.surfaces);
    request.discIsSlave = interface.slave == SlaveChoice::disc;
    if (interface.layerStiffness == 0) continue;
    request.layered.push_back(request.pad.name);
    if (interface.slave != SlaveChoice::pad && !interface.onObstacle())
      request.layered.push_back(request.disc.name);
  }
  return requests;
}

std::string text(Role role) { return roleNames.at(std::size_t(role)); }

std::string obstacleVelocityName(const std::string& interface) {
  return obstacleVelocityOption.dashed(interface);
}

std::string searchName(const InterfaceSettings& interface) {
  const std::string& name = interface.surfaces.name;
  return (interface.isTie() ? toleranceOption : searchOption).dashed(name);
}

std::string searchText(const InterfaceSettings& interface) {
  return searchName(interface) + (interface.searchDistance > 0
                                      ? formatted(" %g m", interface.searchDistance)
                                      : std::string(", half the size of a face"));
}

std::string roleName(const std::string& interface) { return roleOption.dashed(interface); }

std::string separationName(const std::string& interface) {
  return separationOption.dashed(interface);
}

std::string slaveName(const std::string& interface) { return slaveOption.dashed(interface); }

std::string stiffnessName(const std::string& interface) {
  return stiffnessOption.dashed(interface);
}

std::string adjustName(const std::string& tie) { return adjustOption.dashed(tie); }

}  // namespace squeal::interfaces
