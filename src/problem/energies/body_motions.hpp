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
  NamedMotion motion;           ///< named by Revolution or Sections; no name in plane problems
};

/// Names the motion of each body in a mode, in three-dimensional models only. The name is that of
/// the first of these motions that has at least the given share of the kinetic energy of the body:
/// rigid motion, 0.9; motion with nodal diameters and circles of a body of revolution, 0.6; elastic
/// modes of the body by itself that have the same name, 0.6 together; rigid motion, 0.6.
class BodyMotions {
 public:
  /// Collective. Takes the owned nodes of each body, [body], and borrows the mesh during the
  /// lifetime of the object. `own` are the elastic modes of each body by itself, [body]; empty:
  /// none. A rotating body is analysed about its axis of rotation. A body at rest is analysed about
  /// the first or the last principal axis of inertia, if it is a body of revolution about that
  /// axis. The two rigid translations of a body of revolution across its axis have the same name,
  /// "along a diameter", and so have the two rotations, "about a diameter". The lumped mass of a
  /// node is the mean diagonal entry of the mass matrix there; a common factor in all masses would
  /// not change the shares.
  BodyMotions(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
              const std::vector<std::vector<PetscInt>>& nodes, std::vector<OwnModes> own = {});
  /// Returns the frequencies and names of the elastic modes, [body].
  const std::vector<std::vector<NamedMode>>& ownModes() const { return named_; }
  /// Collective. Returns the name of the motion of each body, [body], in a mode. `parts` are the
  /// real, or the real and the imaginary nodal values of the mode, this rank's rows. In plane
  /// problems all names are empty.
  std::vector<NamedMotion> names(const std::vector<const double*>& parts) const;

 private:
  struct Body {
    LumpedBody lumped;
    Point centre{};                  // of mass
    double arm = 1;                  // radius of gyration, m; rotations are in units of 1/arm
    WeightedFit rigid = {};          // by rigid motions along and about axes through the centre
    std::optional<Point> axis = {};  // direction of the axis of revolution, if any
    std::unique_ptr<Revolution> revolution = {};  // null for a bar, and without such an axis
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
