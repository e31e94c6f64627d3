// SPDX-License-Identifier: BSD-2-Clause
#include "model/material/material.hpp"

#include <cmath>

#include "base/petsc/check.hpp"
#include "model/frame/frame.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::material {

using mesh::cross;
using mesh::length;
using mesh::unit;

namespace {

/// Returns the cylindrical axes at x: radial, tangential, and along k.
Axes cylindricalAxes(const Point& x, const Point& origin, const Point& k) {
  Point tangential = cross(k, mesh::minus(x, origin));
  if (!(length(tangential) > 0))
    tangential =
        std::abs(k[0]) < 0.9 ? cross(k, {1, 0, 0}) : cross(k, {0, 1, 0});  // on the axis: any
  const Point two = unit(tangential);
  return {cross(two, k), two, k};
}

/// Throws Error for a general law with stresses across the plane of a plane problem.
void requirePlane(const Anisotropy& given, const Hooke& turned) {
  if (given.general && !mirrorSymmetric(turned))
    throw Error("option " + given.option +
                ": the material must be symmetric about the plane of the mesh: strains in the "
                "plane must cause no shear stress across it");
}

/// Returns the law with cylindrical axes at each point. Throws Error if the axis is not normal to
/// the plane of a plane problem.
Law cylindricalLaw(const Anisotropy& given, const CylinderAxis& axis, int dimension,
                   bool planeStress) {
  const Hooke& solid = given.stiffness;
  const Point origin = axis.origin, k = axis.direction;
  if (dimension == 2 && std::hypot(k[0], k[1]) > 1e-9)
    throw Error("option " + given.axesOption + ": the axis of a plane problem must be 0,0,1");
  if (dimension == 2) requirePlane(given, solid);
  return {{}, [=](const Point& x) {
            const Hooke turned = rotated(solid, cylindricalAxes(x, origin, k));
            return dimension == 2 ? inPlane(turned, planeStress) : turned;
          }};
}

/// Replaces the name of a frame by its axes.
Anisotropy withAxes(Anisotropy given, const Settings& settings, const mesh::Mesh& mesh) {
  const auto* name = std::get_if<FrameName>(&given.axes);
  if (!name) return given;
  const auto frame = frame::named(settings.frames, name->name, given.axesOption, mesh);
  if (frame.isCylindrical()) {
    given.stiffness = rotated(given.stiffness, frame.turn());
    given.axes = CylinderAxis{frame.origin(), frame.axis()};
  } else
    given.axes = Axes{frame.axesAt({})};
  return given;
}

Law lawOf(const BodySettings& body, const Settings& settings, const mesh::Mesh& mesh) {
  const int dimension = mesh.dimension;
  const bool planeStress = settings.planeStress;
  if (!body.anisotropy) return {isotropic(body.young, body.poisson, dimension, planeStress), {}};
  const Anisotropy given = withAxes(*body.anisotropy, settings, mesh);
  if (const auto* axis = std::get_if<CylinderAxis>(&given.axes))
    return cylindricalLaw(given, *axis, dimension, planeStress);
  const Hooke turned = rotated(given.stiffness, std::get<Axes>(given.axes));
  if (dimension == 3) return {turned, {}};
  requirePlane(given, turned);
  if (!mirrorSymmetric(turned))
    throw Error("option " + given.axesOption +
                ": one axis of the material must be normal to the plane of the mesh");
  return {inPlane(turned, planeStress), {}};
}

/// Returns the axes of a material; empty if it is isotropic.
std::function<Axes(const Point&)> axesOf(const BodySettings& body, const Settings& settings,
                                         const mesh::Mesh& mesh) {
  if (!body.anisotropy) return {};
  const Anisotropy& given = *body.anisotropy;
  if (const auto* name = std::get_if<FrameName>(&given.axes)) {
    const auto frame = frame::named(settings.frames, name->name, given.axesOption, mesh);
    if (!frame.isCylindrical()) return [axes = frame.axesAt({})](const Point&) { return axes; };
    return [frame](const Point& x) {
      const Axes axes = cylindricalAxes(x, frame.origin(), frame.axis());
      return mesh::product(frame.turn(), axes);
    };
  }
  if (const auto* axis = std::get_if<CylinderAxis>(&given.axes))
    return
        [axis = *axis](const Point& x) { return cylindricalAxes(x, axis.origin, axis.direction); };
  return [axes = std::get<Axes>(given.axes)](const Point&) { return axes; };
}

double poissonRatio(const BodySettings& body, int dimension, bool planeStress) {
  if (dimension == 2 && planeStress) return 0;
  if (!body.anisotropy) return body.poisson;
  const Hooke& solid = body.anisotropy->stiffness;
  // Voigt's means over all directions: they do not depend on the axes.
  double bulk = 0, shear = 0;
  for (int i = 0; i < 3; ++i) {
    shear += solid(3 + i, 3 + i) / 5;
    for (int j = 0; j < 3; ++j) {
      bulk += solid(i, j) / 9;
      shear += (i == j ? 2 : -1) * solid(i, j) / 30;
    }
  }
  return (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear);
}

}  // namespace

std::vector<Material> materialsOf(const mesh::Mesh& mesh, const Settings& settings) {
  std::vector<Material> materials;
  for (const auto& group : mesh.materialGroups) {
    const BodySettings& body = settings.bodies.at(group.name);
    materials.push_back({.law = lawOf(body, settings, mesh),
                         .density = body.density,
                         .massDamping = body.massDamping,
                         .stiffnessDamping = body.stiffnessDamping,
                         .reducedIntegration = body.reducedIntegration,
                         .poisson = poissonRatio(body, mesh.dimension, settings.planeStress),
                         .axes = axesOf(body, settings, mesh)});
  }
  return materials;
}

}  // namespace squeal::material
