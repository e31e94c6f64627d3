// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The visible surface, which radiates sound: the boundary faces of all bodies, except faces in
/// contact, tied faces, cuts of a periodic model, and faces whose normal velocity supports hold at
/// zero.
#include "base/petsc/owned.hpp"
#include "model/contact/contact.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::sound {

using mesh::Point;

struct RadiatingSurface {
  double area = 0;  ///< m² (m in the plane), of all ranks
  /// ∫ (n·eᵢ φ_a)(n·eⱼ φ_b) dA over the surface, N×N: ∫ v_n² dA is its quadratic form in v
  OwnedMat normalMass;
  /// [owned node] unit outward normal, the mean over the faces at the node; zero off the surface
  std::vector<Point> normals;
  bool has(PetscInt node) const { return mesh::Point{} != normals[node]; }
};

/// Collective. Returns the visible surface. A face is in contact, or tied, if all its nodes belong
/// to one interface, as slaves or masters, closed or open.
RadiatingSurface radiatingSurface(const mesh::Mesh& mesh, const contact::Contact& contact);

}  // namespace squeal::sound
