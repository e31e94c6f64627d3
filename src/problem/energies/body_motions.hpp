// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Names of the motions of bodies in a mode.
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"
#include "problem/energies/own_modes.hpp"
#include "problem/energies/revolution.hpp"
#include "problem/energies/sections.hpp"

namespace squeal::energies {

/// An elastic mode of a body by itself.
struct NamedMode {
  double angularFrequency = 0;  ///< rad/s
  NamedMotion motion;  ///< of a body of revolution, or of Sections; without a name in the plane
};

/// Names the motion of each body in a mode, only in space. The name is the first of these that
/// applies: a rigid motion with 0.9 of the kinetic energy of the body; the nodal diameters and
/// circles of a body of revolution, with 0.6; the elastic modes of the body by itself that have the
/// same name, with 0.6 together; a rigid motion with 0.6.
class BodyMotions {
 public:
  /// Collective. Takes the owned nodes of each body, [body], and borrows the mesh during the
  /// lifetime of the object. A rotating body is analysed about its axis of rotation. Another body
  /// is analysed about the principal axis of inertia about which it is closest to a body of
  /// revolution. The rigid motions of a body of revolution across its axis come in pairs, and both
  /// have one name: along or about a diameter. The weight of a node is the diagonal of the mass
  /// matrix there; a common factor would not change the shares. Takes the elastic modes of each
  /// body by itself, [body]; empty: none.
  BodyMotions(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
              const std::vector<std::vector<PetscInt>>& nodes, std::vector<OwnModes> own = {});
  /// Returns the frequencies and names of the elastic modes, [body].
  const std::vector<std::vector<NamedMode>>& ownModes() const { return named_; }
  /// Collective. Returns the name of the motion of each body, [body], in the mode with these parts:
  /// real, or real and imaginary nodal values, this rank's rows. All are empty in the plane.
  std::vector<NamedMotion> names(const std::vector<const double*>& parts) const;

 private:
  struct Body {
    LumpedBody lumped;
    Point centre{};                  // of mass
    double arm = 1;                  // radius of gyration, m: rotations in units of 1/arm
    WeightedFit rigid = {};          // of the motions along and about x, y, z through the centre
    std::optional<Point> axis = {};  // direction of that of a body of revolution
    std::unique_ptr<Revolution> revolution = {};  // null unless it is one and no bar
    linalg::DenseMatrix own = {};  // elastic modes, 3 · nodes × count, of unit lumped mass
  };
  Body bodyOf(const LumpedBody& lumped, const elasticity::Motion& motion) const;
  NamedMotion revolvedName(const Body& body, const std::array<double, 6>& shares,
                           const std::array<double, 2>& axial, double total) const;
  NamedMotion rigidName(const Body& body, const std::vector<const double*>& parts) const;
  void takeOwnModes(std::vector<OwnModes> own);
  NamedMotion elasticName(std::size_t body, const std::vector<const double*>& parts) const;

  const mesh::Mesh& mesh_;
  std::vector<Body> list_;
  std::vector<std::vector<NamedMode>> named_;  // [body]
};

}  // namespace squeal::energies
