// SPDX-License-Identifier: BSD-2-Clause
#include "run/audit/rotation.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "base/system/text.hpp"
#include "model/interfaces/algebra.hpp"

namespace squeal::audit {
namespace {

// A sector of a ring may have its centre of mass at some radii of its bounding sphere. A full ring
// that its mesh, its bolts or its vanes make asymmetric is off its axis by less than a fiftieth.
constexpr double far = 3, offAxis = 0.3, eccentric = 0.02;  // of the radius of the bounding sphere

std::string namesOf(const std::vector<BodyMass>& masses, const std::vector<int>& bodies) {
  std::vector<std::string> names;
  for (const int b : bodies) names.push_back("'" + masses[b].body + "'");
  return joined(names, " and ");
}

/// Returns a finding for bodies that rotate with convective terms and that couplings hold. A rigid
/// tilt θ across the axis k then has the stiffness −ω² ∫ρ (θ × (k × x))² = −ω² J/2 of K^R, with the
/// moment of inertia J about the axis of a body of revolution. In nature the stress of the rotation
/// balances it.
std::optional<Finding> tiltFinding(const Subject& model, const std::vector<int>& bodies,
                                   const BodyMass& moving, const Point& axis, double speed) {
  const auto& settings = model.bodies.settings;
  const bool rigid = std::ranges::any_of(model.couplings, [](const auto& coupling) {
    return coupling.kind == constraints::CouplingKind::rigid;
  });
  if (!settings.convective || model.couplings.empty() || (settings.prestress && !rigid)) return {};
  double axial = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) axial += axis[i] * moving.inertia[i][j] * axis[j];
  return Finding{
      Kind::rotation, Severity::note,
      formatted("the convective terms of the rotating %s act on a rigid tilt like a spring of %.4g "
                "N m/rad, as the stress of the rotation, which balances it, is not in the model%s",
                bodies.size() == 1 ? "body" : "bodies", -speed * speed * axial / 2,
                settings.prestress ? " where rigid couplings carry it" : ""),
      "compare it with the bushings that hold the body; if it counts, set -elasticity_prestress on "
      "and hold the body by distributed couplings"};
}

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
    if (const auto found = tiltFinding(model, bodies, moving, axis, speed))
      findings.push_back(*found);
    const double radius = mesh::length(mesh::minus(moving.high, moving.low)) / 2;
    const double distance =
        mesh::length(mesh::tangential(mesh::minus(moving.centre, origin), axis));
    const bool isFar = distance > far * radius;
    if (!isFar && (distance < eccentric * radius || distance > offAxis * radius)) continue;
    const std::string option = "-motion_" + masses[bodies[0]].body;
    findings.push_back(
        {Kind::rotation, isFar ? Severity::warning : Severity::note,
         formatted("the centre of mass of the rotating %s %s, %s, lies %.4g m away from the axis "
                   "through %s along %s; half of the diagonal of %s is %.4g m",
                   bodies.size() == 1 ? "body" : "bodies", namesOf(masses, bodies).c_str(),
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
