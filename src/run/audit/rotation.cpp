// SPDX-License-Identifier: BSD-2-Clause
#include "run/audit/rotation.hpp"

#include <map>
#include <tuple>

#include "base/system/text.hpp"
#include "model/interfaces/algebra.hpp"

namespace squeal::audit {
namespace {

// A sector of a ring may have its centre of mass at some radii of its bounding sphere. A full ring
// that its mesh, its bolts or its vanes make asymmetric is off its axis by less than a fiftieth.
constexpr double far = 3, offAxis = 0.3, eccentric = 0.02;  // of the radius of the bounding sphere

}  // namespace

Findings rotationFindings(const Subject& model, const std::vector<BodyMass>& masses) {
  using Axis = std::tuple<Point, Point, double>;
  std::map<Axis, std::vector<int>> sharing;
  for (int b = 0; b < std::ssize(masses); ++b)
    if (const auto& motion = model.bodies.motions[b]; motion.speed != 0)
      sharing[{motion.origin, motion.axis, motion.speed}].push_back(b);
  Findings findings;
  for (const auto& [rotation, bodies] : sharing) {
    const auto& [origin, axis, speed] = rotation;
    const BodyMass moving = totalOf(masses, bodies);
    const double radius = mesh::length(mesh::minus(moving.high, moving.low)) / 2;
    const double distance =
        mesh::length(mesh::tangential(mesh::minus(moving.centre, origin), axis));
    const bool isFar = distance > far * radius;
    if (!isFar && (distance < eccentric * radius || distance > offAxis * radius)) continue;
    std::vector<std::string> names;
    for (const int b : bodies) names.push_back("'" + masses[b].body + "'");
    const std::string option = "-motion_" + masses[bodies[0]].body;
    findings.push_back(
        {Kind::rotation, isFar ? Severity::warning : Severity::note,
         formatted("the centre of mass of the rotating %s %s, %s, lies %.4g m away from the axis "
                   "through %s along %s; half of the diagonal of %s is %.4g m",
                   bodies.size() == 1 ? "body" : "bodies", joined(names, " and ").c_str(),
                   interfaces::text(moving.centre).c_str(), distance,
                   interfaces::text(origin).c_str(), interfaces::text(axis).c_str(),
                   bodies.size() == 1 ? "the body" : "the bodies", radius),
         "correct " + option + "_origin or " + option +
             (isFar ? "_axis; their unit is that of the mesh after -mesh_scale"
                    : "_axis, unless the body is asymmetric")});
  }
  return findings;
}

}  // namespace squeal::audit
