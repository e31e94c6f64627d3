#include "contact/interfaces.hpp"

#include "options/options.hpp"
#include "petsc/check.hpp"

namespace squeal::contact {
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
const ChoiceOption slaveOption("contact", "contact_<interface>_slave", {"finer", "pad", "disc"},
                               "finer",
                               "where the meshes do not match: the side whose nodes have the gaps");
const RealOption searchOption("contact", "contact_<interface>_search", 0.0, "m", nonNegative,
                              "where the meshes do not match: largest distance of faces that "
                              "touch; 0: half the size of a face");

}  // namespace

std::vector<mesh::InterfaceRequest> readInterfaces() {
  std::vector<mesh::InterfaceRequest> requests;
  for (const Option* option :
       std::vector<const Option*>{&discOption, &obstacleVelocityOption, &obstacleDisplacementOption,
                                  &slaveOption, &searchOption})
    for (const auto& name : option->subjects())
      if (!padOption.given(name))
        throw Error("option -" + option->fullName(name) + " needs -" + padOption.fullName(name));
  for (const auto& name : padOption.subjects()) {
    const bool disc = discOption.given(name), obstacle = obstacleVelocityOption.given(name) ||
                                                         obstacleDisplacementOption.given(name);
    if (disc == obstacle)
      throw Error("option -" + padOption.fullName(name) + ": give either -" +
                  discOption.fullName(name) + " or -" + obstacleVelocityOption.fullName(name));
    for (const Option* option : std::vector<const Option*>{&slaveOption, &searchOption})
      if (obstacle && option->given(name))
        throw Error("option -" + option->fullName(name) + " needs -" + discOption.fullName(name));
    const auto groupOf = [&](const TextOption& option) {
      const std::string group = option.get(name);
      return mesh::GroupRequest{group, "-" + option.fullName(name) + " " + group};
    };
    requests.push_back(
        {name, groupOf(padOption), disc ? groupOf(discOption) : mesh::GroupRequest{}});
  }
  return requests;
}

std::vector<InterfaceOptions> readInterfaceOptions(int dimension) {
  std::vector<InterfaceOptions> interfaces;
  for (auto& surfaces : readInterfaces()) {
    const std::string name = surfaces.name, slave = slaveOption.get(name);
    interfaces.push_back({std::move(surfaces), obstacleVelocityOption.components(name, dimension),
                          obstacleDisplacementOption.components(name, dimension),
                          slave == "pad"    ? SlaveChoice::pad
                          : slave == "disc" ? SlaveChoice::disc
                                            : SlaveChoice::finer,
                          searchOption.get(name)});
  }
  return interfaces;
}

std::string obstacleVelocityName(const std::string& interface) {
  return "-" + obstacleVelocityOption.fullName(interface);
}

std::string padName(const std::string& interface) { return "-" + padOption.fullName(interface); }

std::string searchName(const std::string& interface) {
  return "-" + searchOption.fullName(interface);
}

}  // namespace squeal::contact
