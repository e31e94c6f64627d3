// SPDX-License-Identifier: BSD-2-Clause
#include "steady/steady/nodal_forces.hpp"

namespace squeal::steady {

OwnedVec loadAt(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                const sweep::Parameters& at) {
  OwnedVec b = elasticity::nodalVector(mesh);
  check(VecAXPBYPCZ(b, at.pressure, at.speed * at.speed - at.pressure, 0, bodies.load,
                    bodies.centrifugal));
  if (bodies.constantLoad) check(VecAXPY(b, 1 - at.pressure, bodies.constantLoad));
  return b;
}

OwnedVec springForces(const mesh::Mesh& mesh, const elasticity::Bodies& bodies, double speed,
                      Vec displacement) {
  OwnedVec r = elasticity::nodalVector(mesh);
  check(MatMult(bodies.stiffness, displacement, r));
  if (bodies.rotationStiffness) {
    const OwnedVec moving = elasticity::nodalVector(mesh);
    check(MatMult(bodies.rotationStiffness, displacement, moving));
    check(VecAXPY(r, speed * speed, moving));
  }
  return r;
}

OwnedVec supportForces(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                       const sweep::Parameters& at, Vec displacement) {
  OwnedVec r = springForces(mesh, bodies, at.speed, displacement);
  check(VecAXPY(r, -1, loadAt(mesh, bodies, at)));
  return r;
}

}  // namespace squeal::steady
