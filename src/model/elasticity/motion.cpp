#include "model/elasticity/motion.hpp"

#include <cmath>
#include <set>

#include "base/options/options.hpp"
#include "base/petsc/check.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::elasticity {
namespace {

const RealListOption velocityOption("motion", "motion_<body>_velocity", "0,0,0", "m/s", anyReal,
                                    "the body's matter translates with this velocity");
const RealOption speedOption("motion", "motion_<body>_speed", 0.0, "rad/s", anyReal,
                             "the body's matter rotates at this speed");
const RealOption rpmOption("motion", "motion_<body>_rpm", 0.0, "1/min", anyReal,
                           "the same in revolutions per minute");
const RealListOption axisOption("motion", "motion_<body>_axis", "0,0,1", "", anyReal,
                                "axis of the rotation, right-handed");
const RealListOption originOption("motion", "motion_<body>_origin", "0,0,0", "m", anyReal,
                                  "a point of the axis");
const FlagOption convectiveOption("motion", "motion_convective", false,
                                  "on: the matter of moving bodies carries its displacement along "
                                  "(gyroscopic and rotation stiffness "
                                  "terms); off: approximation A");

/// Returns ω, rad/s, from the option that gives it.
double rotationSpeed(const std::string& body) {
  const bool inRpm = rpmOption.given(body);
  if (inRpm && speedOption.given(body))
    throw Error("options -" + speedOption.fullName(body) + " and -" + rpmOption.fullName(body) +
                ": give the speed once");
  if (velocityOption.given(body) && (inRpm || speedOption.given(body)))
    throw Error("options -" + velocityOption.fullName(body) + " and -" +
                (inRpm ? rpmOption : speedOption).fullName(body) +
                ": a body translates or rotates, not both");
  return inRpm ? rpmOption.get(body) * 2 * M_PI / 60 : speedOption.get(body);
}

}  // namespace

mesh::Point Motion::velocity(const mesh::Point& x) const {
  return mesh::plus(translation, mesh::cross(axis, mesh::minus(x, origin)), speed);
}

bool Motion::moves() const { return speed != 0 || translation != mesh::Point{}; }

bool convectiveTerms() { return convectiveOption.get(); }

std::vector<std::string> movingBodies() {
  std::set<std::string> bodies;
  for (const Option* option : std::vector<const Option*>{&velocityOption, &speedOption, &rpmOption})
    for (const auto& body : option->subjects()) bodies.insert(body);
  return {bodies.begin(), bodies.end()};
}

std::vector<Motion> readMotions(const std::vector<std::string>& bodies, int dimension) {
  const std::set<std::string> known(bodies.begin(), bodies.end());
  for (const Option* option : std::vector<const Option*>{&velocityOption, &speedOption, &rpmOption,
                                                         &axisOption, &originOption})
    for (const auto& body : option->subjects())
      if (!known.count(body))
        throw Error("option -" + option->fullName(body) + ": '" + body +
                    "' is not a body (a group with a material)");
  std::vector<Motion> motions;
  for (const auto& body : bodies) {
    Motion motion{velocityOption.components(body, dimension), rotationSpeed(body),
                  axisOption.components(body, dimension), originOption.components(body, dimension)};
    if (!(mesh::length(motion.axis) > 0))
      throw Error("option -" + axisOption.fullName(body) + ": the axis has no length");
    motion.axis = mesh::unit(motion.axis);
    motions.push_back(motion);
  }
  return motions;
}

}  // namespace squeal::elasticity
