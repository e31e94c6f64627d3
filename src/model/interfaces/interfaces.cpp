#include "model/interfaces/interfaces.hpp"

#include <algorithm>

#include "base/options/options.hpp"
#include "base/petsc/check.hpp"
#include "base/system/text.hpp"

namespace squeal::interfaces {
namespace {

/// The values of the options of roles and of slaves, in the order of the enumerations.
const std::vector<std::string> roleNames{"sliding", "sticking", "frictionless", "tied"},
    slaveNames{"finer", "pad", "disc"};

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
const ChoiceOption roleOption("contact", "contact_<interface>_role", roleNames, "sliding",
                              "sliding: friction along the velocity; sticking: no motion along "
                              "the surface; frictionless: no force along it; tied: glued");
const RealOption factorOption("contact", "contact_<interface>_friction_factor", 1.0, "",
                              nonNegative,
                              "times -flutter_friction: the coefficient of a sliding interface");
const RealOption frictionOption(
    "contact", "contact_<interface>_friction", 0.0, "", nonNegative,
    "coefficient of friction of a sliding interface, in place of "
    "-flutter_friction, so that no sweep changes it; of a sticking one: "
    "the limit of what holds it");
const FlagOption releaseOption("contact", "contact_<interface>_release", false,
                               "nodes of a sticking interface that exceed its -contact_<interface>"
                               "_friction slide with that friction; off: they are held and told");
const WordOrRealOption gapOption("contact", "contact_<interface>_gap", 0.0, "m", "measured",
                                 "gap without load; measured: the distance of the surfaces; "
                                 "negative: interference");
const ChoiceOption slaveOption("contact", "contact_<interface>_slave", slaveNames, "finer",
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
const FlagOption adjustOption("tie", "tie_<name>_adjust", true,
                              "on: tied nodes are first moved onto the master, so that the two "
                              "turn together without strain; off: they stay where they are");

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

/// Returns the value of an enumeration that an option gives by its name.
template <class Enumeration>
Enumeration valueOf(const ChoiceOption& option, const std::vector<std::string>& names,
                    const std::string& interface) {
  return Enumeration(std::find(names.begin(), names.end(), option.get(interface)) - names.begin());
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
    if (interface.isTied() || interface.role == Role::sticking)
      throw Error("option -" + roleOption.fullName(name) + " " + roleOption.get(name) + " " + why);
  }
  const std::string role = "needs -" + roleOption.fullName(name);
  if (interface.role != Role::sliding) reject(factorOption, role + " sliding");
  if (interface.role != Role::sliding && interface.role != Role::sticking)
    reject(frictionOption, role + " sliding or sticking");
  if (interface.role != Role::sticking) reject(releaseOption, role + " sticking");
  if (!frictionOption.given(name))
    reject(releaseOption, "needs -" + frictionOption.fullName(name) + ", the limit");
  if (frictionOption.given(name))
    reject(factorOption, "is a factor on -flutter_friction, which -" +
                             frictionOption.fullName(name) + " replaces; give one of them");
  if (interface.isTied()) reject(gapOption, "means nothing on a tied interface, which has no gap");
}

}  // namespace

std::string text(Role role) { return roleNames.at(std::size_t(role)); }

std::string InterfaceOptions::label() const {
  return (isTie() ? "tie '" : "interface '") + surfaces.name + "'";
}

std::vector<mesh::InterfaceRequest> readInterfaces() {
  requireOption(
      {&discOption, &obstacleVelocityOption, &obstacleDisplacementOption, &roleOption,
       &factorOption, &frictionOption, &releaseOption, &gapOption, &slaveOption, &searchOption},
      padOption);
  requireOption({&tieMasterOption, &toleranceOption, &adjustOption}, tieSlaveOption);
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
    if (interface.isTie()) {
      interface.role = Role::tied;
      interface.slave = SlaveChoice::pad;
      interface.searchDistance = toleranceOption.get(name);
      interface.adjust = adjustOption.get(name);
    } else {
      interface.role = valueOf<Role>(roleOption, roleNames, name);
      interface.obstacleVelocity = obstacleVelocityOption.components(name, dimension);
      interface.obstacleDisplacement = obstacleDisplacementOption.components(name, dimension);
      interface.slave = valueOf<SlaveChoice>(slaveOption, slaveNames, name);
      interface.searchDistance = searchOption.get(name);
      if (interface.role == Role::sliding)
        interface.friction = frictionOption.given(name) ? Coefficient{frictionOption.get(name), 0}
                                                        : Coefficient{0, factorOption.get(name)};
      if (interface.role == Role::sticking && frictionOption.given(name))
        interface.stickingLimit = frictionOption.get(name);
      interface.releases = releaseOption.get(name);
      const auto gap = gapOption.get(name);
      interface.gapIsMeasured = !gap;
      interface.gap = gap.value_or(0);
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
  return "-" + (interface.isTie() ? toleranceOption.fullName(name) : searchOption.fullName(name));
}

std::string searchText(const InterfaceOptions& interface) {
  return searchName(interface) + (interface.searchDistance > 0
                                      ? formatted(" %g m", interface.searchDistance)
                                      : std::string(", half the size of a face"));
}

std::string roleName(const std::string& interface) { return "-" + roleOption.fullName(interface); }

std::string adjustName(const std::string& tie) { return "-" + adjustOption.fullName(tie); }

}  // namespace squeal::interfaces
