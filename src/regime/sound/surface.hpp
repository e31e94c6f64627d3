// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The visible surface, which radiates sound: the boundary faces of all bodies, except faces in
/// contact, tied faces, cuts of a periodic model, and faces whose supports prevent normal motion.
#include "base/petsc/owned.hpp"
#include "model/contact/contact.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::sound {

using mesh::Point;

struct RadiatingSurface {
  double area = 0;  ///< total over all ranks, m² (m in plane problems)
  /// ∫ (n·eᵢ φ_a)(n·eⱼ φ_b) dA over the surface, N×N, with N = dimension · nodes. Its quadratic
  /// form in the nodal velocities v is ∫ v_n² dA.
  OwnedMat normalMass;
  /// [owned node] unit outward normal, averaged over the faces at the node; zero if the node is not
  /// on the surface
  std::vector<Point> normals;
  bool has(PetscInt node) const { return mesh::Point{} != normals[node]; }
};

/// Collective. Returns the visible surface. A face is regarded as in contact, or tied, if all its
/// nodes belong to one interface, as slaves or masters, closed or open.
RadiatingSurface radiatingSurface(const mesh::Mesh& mesh, const contact::Contact& contact);

}  // namespace squeal::sound
