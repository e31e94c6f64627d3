// SPDX-License-Identifier: BSD-2-Clause
#include "model/elasticity/motion.hpp"

#include <algorithm>

#include "base/petsc/check.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::elasticity {

mesh::Point Motion::velocity(const mesh::Point& x) const {
  return mesh::plus(translation, mesh::cross(axis, mesh::minus(x, origin)), speed);
}

bool Motion::moves() const { return speed != 0 || translation != mesh::Point{}; }

std::vector<Motion> motionsOf(const std::vector<std::string>& bodies, int dimension,
                              const std::map<std::string, MotionSettings>& settings) {
  for (const auto& [body, given] : settings)
    if (std::ranges::find(bodies, body) == bodies.end())
      throw Error("option " + given.option + ": '" + body +
                  "' is not a body (a group with a material)");
  std::vector<Motion> motions;
  for (const auto& body : bodies) {
    Motion& motion = motions.emplace_back();
    const auto given = settings.find(body);
    if (given == settings.end()) continue;
    const auto& [option, moves, velocity, speed, axis, origin, axisOption] = given->second;
    motion = {velocity.in(dimension), speed, axis.in(dimension), origin.in(dimension)};
    if (!(mesh::length(motion.axis) > 0))
      throw Error("option " + axisOption + ": the axis has no length");
    motion.axis = mesh::unit(motion.axis);
  }
  return motions;
}

}  // namespace squeal::elasticity
