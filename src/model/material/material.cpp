// SPDX-License-Identifier: BSD-2-Clause
#include "model/material/material.hpp"

#include <cmath>

#include "base/petsc/check.hpp"
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

/// Returns the law with cylindrical axes at each point. Throws Error if the axis is not normal to
/// the plane of a plane problem.
Law cylindricalLaw(const Hooke& solid, const CylinderAxis& axis, const std::string& body,
                   int dimension, bool planeStress) {
  const Point origin = axis.origin, k = axis.direction;
  if (dimension == 2 && std::hypot(k[0], k[1]) > 1e-9)
    throw Error("option " + cylindricalName(body) + ": the axis of a plane problem must be 0,0,1");
  return {{}, [=](const Point& x) {
            const Hooke turned = rotated(solid, cylindricalAxes(x, origin, k));
            return dimension == 2 ? inPlane(turned, planeStress) : turned;
          }};
}

Law lawOf(const std::string& name, const BodySettings& body, int dimension, bool planeStress) {
  if (!body.orthotropy) return {isotropic(body.young, body.poisson, dimension, planeStress), {}};
  const Hooke solid = orthotropic(body.orthotropy->constants);
  if (const auto* axis = std::get_if<CylinderAxis>(&body.orthotropy->axes))
    return cylindricalLaw(solid, *axis, name, dimension, planeStress);
  const Hooke turned = rotated(solid, std::get<Axes>(body.orthotropy->axes));
  if (dimension == 3) return {turned, {}};
  if (!mirrorSymmetric(turned))
    throw Error("option " + orientationName(name) +
                ": one axis of the material must be normal to the plane of the mesh");
  return {inPlane(turned, planeStress), {}};
}

double poissonRatio(const BodySettings& body, int dimension, bool planeStress) {
  if (dimension == 2 && planeStress) return 0;
  if (!body.orthotropy) return body.poisson;
  const Hooke solid = orthotropic(body.orthotropy->constants);
  double bulk = 0, shear = 0;
  for (int i = 0; i < 3; ++i) {
    shear += solid(3 + i, 3 + i) / 3;
    for (int j = 0; j < 3; ++j) bulk += solid(i, j) / 9;
  }
  return (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear);
}

}  // namespace

std::vector<Material> materialsOf(const mesh::Mesh& mesh, const Settings& settings) {
  std::vector<Material> materials;
  for (const auto& name : mesh.bodies) {
    const BodySettings& body = settings.bodies.at(name);
    materials.push_back({.law = lawOf(name, body, mesh.dimension, settings.planeStress),
                         .density = body.density,
                         .massDamping = body.massDamping,
                         .stiffnessDamping = body.stiffnessDamping,
                         .poisson = poissonRatio(body, mesh.dimension, settings.planeStress)});
  }
  return materials;
}

}  // namespace squeal::material
