// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Names of the motions of bodies in a mode.
#include <array>
#include <memory>
#include <vector>

#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"
#include "problem/energies/revolution.hpp"

namespace squeal::energies {

/// Names what each body does in a mode: the rigid motion that has 0.9 of its kinetic energy, or the
/// diameters and circles of a body of revolution, or again a rigid motion that has 0.6. In space.
class BodyMotions {
 public:
  /// Collective. Takes the owned nodes of each body, [body], and borrows the mesh during the
  /// lifetime of the object. A body that turns is analysed about its axis, another one about the
  /// principal axis of inertia about which it looks most alike. Its motions across the axis, which
  /// come in pairs, have one name: along or about a diameter. The weight of a node is the
  /// diagonal of the mass matrix there; a common factor would change no share.
  BodyMotions(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
              const std::vector<std::vector<PetscInt>>& nodes);
  /// Collective. Returns the name of the motion of each body, [body], in the mode with these parts:
  /// real, or real and imaginary nodal values, this rank's rows. All are empty in the plane.
  std::vector<NamedMotion> names(const std::vector<const double*>& parts) const;

 private:
  struct Body {
    LumpedBody lumped;
    Point centre{};          // of mass
    double arm = 1;          // radius of gyration, m: rotations in units of 1/arm
    WeightedFit rigid = {};  // of the motions along and about x, y, z through the centre
    std::unique_ptr<Revolution> revolution = {};  // null if it is not a body of revolution
    Point axis{};                                 // of revolution
  };
  Body bodyOf(const LumpedBody& lumped, const elasticity::Motion& motion) const;
  NamedMotion revolvedName(const Body& body, const std::array<double, 6>& shares,
                           const std::array<double, 2>& axial, double total) const;
  NamedMotion rigidName(const Body& body, const std::vector<const double*>& parts) const;

  const mesh::Mesh& mesh_;
  std::vector<Body> list_;
};

}  // namespace squeal::energies
