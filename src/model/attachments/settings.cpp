// SPDX-License-Identifier: BSD-2-Clause
#include "model/attachments/settings.hpp"

#include <set>

#include "base/options/options.hpp"
#include "base/system/error.hpp"

namespace squeal::attachments {
namespace {

const TextOption springFromOption("spring", "spring_<name>_from", "",
                                  "first end of a spring: a group of one node, or a reference "
                                  "node");
const TextOption springToOption(
    "spring", "spring_<name>_to", "",
    "second end of the spring, which acts along the line between its ends");
const RealOption springStiffnessOption("spring", "spring_<name>_stiffness", 0.0, "N/m", nonNegative,
                                       "stiffness of the spring along the line between its ends");
const RealOption springDampingOption("spring", "spring_<name>_damping", 0.0, "N s/m", nonNegative,
                                     "damping along the line between the ends of the spring");
const TextOption bushingFromOption("bushing", "bushing_<name>_from", "",
                                   "first end of a bushing: a reference node, or a group of one "
                                   "node");
const TextOption bushingToOption("bushing", "bushing_<name>_to", "",
                                 "second end of the bushing; default: the ground");
const RealListOption bushingStiffnessOption(
    "bushing", "bushing_<name>_stiffness", "0,0,0", "N/m", nonNegative,
    "stiffness along x, y, z and, if there are six numbers, about x, y, z (N m/rad); in plane "
    "problems along x, y and about z");
const RealListOption bushingDampingOption(
    "bushing", "bushing_<name>_damping", "0,0,0", "N s/m", nonNegative,
    "damping along x, y, z and, if there are six numbers, about x, y, z (N m s/rad); in plane "
    "problems along x, y and about z");
const TextOption bushingFrameOption(
    "bushing", "bushing_<name>_frame", "",
    "name of the -frame whose axes are x, y, z of the bushing; default: the global axes");
const RealOption massOption(
    "mass", "mass_<group>_total", std::nullopt, "kg", positive,
    "mass of a reference node, or total mass of a group, which its nodes share equally");
const RealListOption inertiaOption(
    "mass", "mass_<group>_inertia", "0,0,0,0,0,0", "kg m2", anyReal,
    "rotary inertia Jxx,Jyy,Jzz,Jxy,Jxz,Jyz of the mass of a reference node about its centre of "
    "mass, with Jxy = -sum(m x y); in plane problems one number, Jzz");
const RealListOption offsetOption("mass", "mass_<group>_offset", "0,0,0", "m", anyReal,
                                  "vector from the reference node to the centre of its mass");
const TextOption massFrameOption("mass", "mass_<group>_frame", "",
                                 "name of the -frame whose axes are x, y, z of inertia and offset; "
                                 "default: the global axes");
const RealListOption forceOption("load", "load_<group>_force", "0,0,0", "N", anyReal,
                                 "total force on a group, shared equally by its nodes, or force on "
                                 "a reference node (per m of depth in plane problems)");
const RealListOption momentOption("load", "load_<group>_moment", "0,0,0", "N m", anyReal,
                                  "moment on a reference node; in plane problems 0,0,Mz");
const TextOption forceFrameOption("load", "load_<group>_frame", "",
                                  "name of the -frame whose axes are x, y, z of force and moment; "
                                  "default: the global axes");
const FlagOption hydraulicOption("load", "load_<group>_hydraulic", true,
                                 "scaling of pressure, force and moment of this group by "
                                 "-flutter_pressure; off: they keep their values");

std::vector<SpringSettings> springsGiven() {
  requireOption({&springToOption, &springStiffnessOption, &springDampingOption}, springFromOption);
  requireOption({&springFromOption}, springToOption);
  std::vector<SpringSettings> springs;
  for (const auto& name : springFromOption.subjects()) {
    if (!springStiffnessOption.given(name) && !springDampingOption.given(name))
      throw Error("option " + springFromOption.dashed(name) + " needs " +
                  springStiffnessOption.dashed(name) + " or " + springDampingOption.dashed(name));
    springs.push_back({name, springFromOption.get(name), springToOption.get(name),
                       springStiffnessOption.get(name), springDampingOption.get(name)});
  }
  return springs;
}

std::vector<BushingSettings> bushingsGiven() {
  requireOption(
      {&bushingToOption, &bushingStiffnessOption, &bushingDampingOption, &bushingFrameOption},
      bushingFromOption);
  std::vector<BushingSettings> bushings;
  for (const auto& name : bushingFromOption.subjects()) {
    if (!bushingStiffnessOption.given(name) && !bushingDampingOption.given(name))
      throw Error("option " + bushingFromOption.dashed(name) + " needs " +
                  bushingStiffnessOption.dashed(name) + " or " + bushingDampingOption.dashed(name));
    bushings.push_back({name, bushingFromOption.get(name), bushingToOption.get(name),
                        bushingStiffnessOption.get(name), bushingDampingOption.get(name),
                        bushingFrameOption.get(name)});
  }
  return bushings;
}

std::vector<MassSettings> massesGiven() {
  requireOption({&inertiaOption, &offsetOption, &massFrameOption}, massOption);
  std::vector<MassSettings> masses;
  for (const auto& group : massOption.subjects())
    masses.push_back({group, massOption.get(group), inertiaOption.get(group),
                      offsetOption.vector(group), massFrameOption.get(group),
                      inertiaOption.given(group), offsetOption.given(group)});
  return masses;
}

std::vector<ForceSettings> forcesGiven() {
  std::set<std::string> groups;
  for (const Option* option : std::vector<const Option*>{&forceOption, &momentOption})
    for (const auto& group : option->subjects()) groups.insert(group);
  for (const auto& group : forceFrameOption.subjects())
    if (!groups.contains(group)) requireOption({&forceFrameOption}, forceOption);
  std::vector<ForceSettings> forces;
  for (const auto& group : groups)
    forces.push_back({group, forceOption.vector(group), momentOption.vector(group),
                      forceFrameOption.get(group), momentOption.given(group),
                      hydraulicOption.get(group)});
  return forces;
}

}  // namespace

Settings Settings::given() {
  return {.frames = frame::framesGiven(),
          .springs = springsGiven(),
          .bushings = bushingsGiven(),
          .masses = massesGiven(),
          .forces = forcesGiven()};
}

std::vector<mesh::GroupRequest> attachedGroups(const Settings& settings) {
  std::vector<mesh::GroupRequest> requests;
  for (const auto& spring : settings.springs) {
    requests.push_back({spring.from, springFromName(spring.name)});
    requests.push_back({spring.to, springToName(spring.name)});
  }
  for (const auto& bushing : settings.bushings) {
    requests.push_back({bushing.from, bushingFromName(bushing.name)});
    if (!bushing.to.empty()) requests.push_back({bushing.to, bushingToName(bushing.name)});
  }
  for (const auto& mass : settings.masses) requests.push_back({mass.group, massName(mass.group)});
  for (const auto& force : settings.forces)
    requests.push_back(
        {force.group, force.hasMoment ? momentName(force.group) : forceName(force.group)});
  return requests;
}

void rejectIdleHydraulic(const RealOption& pressure) {
  for (const auto& group : hydraulicOption.subjects())
    if (!forceOption.given(group) && !momentOption.given(group) && !pressure.given(group))
      throw Error("option " + hydraulicOption.dashed(group) + " needs " + pressure.dashed(group) +
                  ", " + forceOption.dashed(group) + " or " + momentOption.dashed(group));
}

bool isHydraulic(const std::string& group) { return hydraulicOption.get(group); }

std::string springFromName(const std::string& spring) { return springFromOption.dashed(spring); }
std::string springToName(const std::string& spring) { return springToOption.dashed(spring); }
std::string bushingFromName(const std::string& name) { return bushingFromOption.dashed(name); }
std::string bushingToName(const std::string& name) { return bushingToOption.dashed(name); }
std::string bushingStiffnessName(const std::string& name) {
  return bushingStiffnessOption.dashed(name);
}
std::string bushingDampingName(const std::string& name) {
  return bushingDampingOption.dashed(name);
}
std::string bushingFrameName(const std::string& name) { return bushingFrameOption.dashed(name); }
std::string massName(const std::string& group) { return massOption.dashed(group); }
std::string inertiaName(const std::string& group) { return inertiaOption.dashed(group); }
std::string massOffsetName(const std::string& group) { return offsetOption.dashed(group); }
std::string massFrameName(const std::string& group) { return massFrameOption.dashed(group); }
std::string forceName(const std::string& group) { return forceOption.dashed(group); }
std::string momentName(const std::string& group) { return momentOption.dashed(group); }
std::string forceFrameName(const std::string& group) { return forceFrameOption.dashed(group); }

}  // namespace squeal::attachments
