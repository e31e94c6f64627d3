#include "interfaces/interfaces.hpp"

#include <cmath>

#include "options/options.hpp"
#include "petsc/check.hpp"
#include "petsc/text.hpp"

namespace squeal::interfaces {
namespace {

const TextOption padOption("contact", "contact_<interface>_pad", "",
                           "surface group of the pad side of an interface");
const TextOption discOption("contact", "contact_<interface>_disc", "",
                            "surface group of the disc side; the two may be meshed apart");
const RealListOption obstacleVelocityOption("contact", "contact_<interface>_obstacle_velocity",
                                            "0,0,0", "m/s", anyReal,
                                            "instead of a disc: a rigid flat obstacle in the plane "
                                            "of the pad face, sliding at this velocity");
const RealListOption obstacleDisplacementOption(
    "contact", "contact_<interface>_obstacle_displacement", "0,0,0", "m", anyReal,
    "displacement of the rigid obstacle, which presses the pad");
const ChoiceOption roleOption("contact", "contact_<interface>_role",
                              {"sliding", "sticking", "frictionless", "tied"}, "sliding",
                              "sliding: friction along the velocity; sticking: no motion along "
                              "the surface; frictionless: no force along it; tied: glued");
const RealOption factorOption("contact", "contact_<interface>_friction_factor", 1.0, "",
                              nonNegative,
                              "times -flutter_friction: the coefficient of a sliding interface");
const TextOption gapOption("contact", "contact_<interface>_gap", "0",
                           "gap without load, m: measured (the distance of the surfaces) or a "
                           "number; negative: interference");
const ChoiceOption slaveOption("contact", "contact_<interface>_slave", {"finer", "pad", "disc"},
                               "finer",
                               "where the meshes do not match: the side whose nodes have the gaps");
const RealOption searchOption("contact", "contact_<interface>_search", 0.0, "m", nonNegative,
                              "where the meshes do not match: largest distance of faces that "
                              "touch; 0: half the size of a face");
const TextOption tieSlaveOption(
    "tie", "tie_<name>_slave", "",
    "surface group that follows the master of a tie, best the finer one");
const TextOption tieMasterOption("tie", "tie_<name>_master", "",
                                 "surface group to which the slave of a tie is glued");
const RealOption toleranceOption("tie", "tie_<name>_tolerance", 0.0, "m", nonNegative,
                                 "largest distance of faces that are glued; 0: half the size of a "
                                 "face");

mesh::GroupRequest groupOf(const TextOption& option, const std::string& name) {
  const std::string group = option.get(name);
  return {group, "-" + option.fullName(name) + " " + group};
}

/// Throws Error for options of this list whose subject lacks the option that they need.
void requireOption(const std::vector<const Option*>& options, const Option& needed) {
  for (const Option* option : options)
    for (const auto& name : option->subjects())
      if (!needed.given(name))
        throw Error("option -" + option->fullName(name) + " needs -" + needed.fullName(name));
}

Role roleOf(const std::string& interface) {
  const std::string role = roleOption.get(interface);
  return role == "sticking"       ? Role::sticking
         : role == "frictionless" ? Role::frictionless
         : role == "tied"         ? Role::tied
                                  : Role::sliding;
}

void readGap(InterfaceOptions& interface) {
  const std::string& name = interface.surfaces.name;
  const std::string text = gapOption.get(name);
  interface.gapIsMeasured = text == "measured";
  if (interface.gapIsMeasured) return;
  std::size_t used = 0;
  try {
    interface.gap = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !std::isfinite(interface.gap))
    throw Error("option -" + gapOption.fullName(name) + " " + text +
                ": must be 'measured' or a number");
}

/// Throws Error for options that mean nothing on this interface.
void rejectIdleOptions(const InterfaceOptions& interface) {
  const std::string& name = interface.surfaces.name;
  const auto reject = [&](const Option& option, const std::string& why) {
    if (option.given(name)) throw Error("option -" + option.fullName(name) + " " + why);
  };
  if (interface.onObstacle()) {
    const std::string why = "needs -" + discOption.fullName(name);
    for (const Option* option : std::vector<const Option*>{&slaveOption, &searchOption, &gapOption})
      reject(*option, why);
    if (interface.role == Role::tied || interface.role == Role::sticking)
      throw Error("option -" + roleOption.fullName(name) + " " + roleOption.get(name) + " " + why);
  }
  if (interface.role != Role::sliding)
    reject(factorOption, "needs -" + roleOption.fullName(name) + " sliding");
  if (interface.role == Role::tied)
    reject(gapOption, "means nothing on a tied interface, which has no gap");
}

}  // namespace

std::string text(Role role) {
  return role == Role::sticking       ? "sticking"
         : role == Role::frictionless ? "frictionless"
         : role == Role::tied         ? "tied"
                                      : "sliding";
}

std::string InterfaceOptions::label() const {
  return (tieSlaveOption.given(surfaces.name) && surfaces.pad.option.starts_with("-tie_")
              ? "tie '"
              : "interface '") +
         surfaces.name + "'";
}

std::vector<mesh::InterfaceRequest> readInterfaces() {
  requireOption({&discOption, &obstacleVelocityOption, &obstacleDisplacementOption, &roleOption,
                 &factorOption, &gapOption, &slaveOption, &searchOption},
                padOption);
  requireOption({&tieMasterOption, &toleranceOption}, tieSlaveOption);
  requireOption({&tieSlaveOption}, tieMasterOption);
  std::vector<mesh::InterfaceRequest> requests;
  for (const auto& name : padOption.subjects()) {
    const bool disc = discOption.given(name), obstacle = obstacleVelocityOption.given(name) ||
                                                         obstacleDisplacementOption.given(name);
    if (disc == obstacle)
      throw Error("option -" + padOption.fullName(name) + ": give either -" +
                  discOption.fullName(name) + " or -" + obstacleVelocityOption.fullName(name));
    requests.push_back(
        {name, groupOf(padOption, name), disc ? groupOf(discOption, name) : mesh::GroupRequest{}});
  }
  for (const auto& name : tieSlaveOption.subjects())
    requests.push_back({name, groupOf(tieSlaveOption, name), groupOf(tieMasterOption, name)});
  return requests;
}

std::vector<InterfaceOptions> readInterfaceOptions(int dimension) {
  std::vector<InterfaceOptions> interfaces;
  for (auto& surfaces : readInterfaces()) {
    InterfaceOptions interface;
    interface.surfaces = std::move(surfaces);
    const std::string& name = interface.surfaces.name;
    if (interface.surfaces.pad.option.starts_with("-tie_")) {
      interface.role = Role::tied;
      interface.slave = SlaveChoice::pad;
      interface.searchDistance = toleranceOption.get(name);
    } else {
      interface.role = roleOf(name);
      interface.obstacleVelocity = obstacleVelocityOption.components(name, dimension);
      interface.obstacleDisplacement = obstacleDisplacementOption.components(name, dimension);
      const std::string slave = slaveOption.get(name);
      interface.slave = slave == "pad"    ? SlaveChoice::pad
                        : slave == "disc" ? SlaveChoice::disc
                                          : SlaveChoice::finer;
      interface.searchDistance = searchOption.get(name);
      interface.frictionFactor = factorOption.get(name);
      readGap(interface);
      rejectIdleOptions(interface);
    }
    interfaces.push_back(std::move(interface));
  }
  return interfaces;
}

std::string obstacleVelocityName(const std::string& interface) {
  return "-" + obstacleVelocityOption.fullName(interface);
}

std::string searchName(const InterfaceOptions& interface) {
  const std::string& name = interface.surfaces.name;
  return "-" + (interface.surfaces.pad.option.starts_with("-tie_") ? toleranceOption.fullName(name)
                                                                   : searchOption.fullName(name));
}

std::string roleName(const std::string& interface) { return "-" + roleOption.fullName(interface); }

}  // namespace squeal::interfaces
