#pragma once
/// The visible surface radiates sound: the boundary faces of all bodies that are not in contact,
/// not tied, not the cut of a periodic model, and whose normal velocity no support holds at zero.
#include "base/petsc/owned.hpp"
#include "model/contact/contact.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::sound {

using mesh::Point;

struct Surface {
  double area = 0;  ///< m² (m in the plane), of all ranks
  /// ∫ (n·eᵢ φ_a)(n·eⱼ φ_b) dA over the surface, N×N: ∫ v_n² dA is its quadratic form in v
  OwnedMat normalMass;
  /// [owned node] unit normal, outwards, the mean of the faces at the node; zero off the surface
  std::vector<Point> normals;
  bool has(PetscInt node) const { return mesh::Point{} != normals[node]; }
};

/// Collective. A face is in contact, or tied, if all of its nodes are nodes of one interface,
/// slaves or masters, whether or not they are pressed.
Surface visibleSurface(const mesh::Mesh& mesh, const contact::Contact& contact);

}  // namespace squeal::sound
