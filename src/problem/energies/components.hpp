// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The components of a model, and their shares in the energies of a motion.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/petsc/owned.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "model/attachments/forms.hpp"
#include "model/contact/contact.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"
#include "model/mesh/vector.hpp"
#include "problem/energies/body_mac.hpp"
#include "problem/energies/body_motions.hpp"

namespace squeal::energies {

/// The quadratic forms uᵀ X u of the matrices X of one component.
struct Forms {
  double stiffness = 0;  ///< uᵀ K u, twice the strain energy, J for u in m
  double mass = 0;       ///< uᵀ M u
  double damping = 0;    ///< uᵀ C u
};

/// A nodal vector u and its products with the matrices of the whole model, this rank's rows;
/// borrowed.
struct NodalProducts {
  std::span<const double> u, mass;         ///< u, M u
  std::span<const double> stiffness = {};  ///< K u; if empty, the forms of K are not computed
  std::span<const double> damping = {};    ///< C u; if empty, the forms of C are not computed
};

/// The components that store or dissipate energy: bodies, springs, bushings, point masses, the
/// springs and dashpots that connect groups to the ground, and the compliant layers of interfaces.
/// Ties, couplings and equations are constraints and store no energy.
class Components {
 public:
  /// Collective. Borrows mesh, bodies and contact during the lifetime of the object. If bodies
  /// share nodes, it assembles the matrices of each body once and stores the rows of the shared
  /// nodes. `nodes` are the owned nodes of each body, [body]. `own` are the elastic modes of each
  /// body by itself, [body], by which motions are named; empty: none.
  Components(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
             const contact::Contact& contact, const std::vector<std::vector<PetscInt>>& nodes,
             std::vector<OwnModes> own = {});
  /// Returns the components, without shares: bodies in the order of the mesh, then the others.
  const std::vector<pencil::Component>& list() const { return list_; }
  /// Collective. Returns the forms of a nodal vector, [component]. Their sums over the components
  /// are the forms of the matrices in `bodies`.
  std::vector<Forms> forms(const NodalProducts& products) const;
  /// Collective. Returns the names of the motions of the bodies, [body], in a mode. `parts` are the
  /// real, or the real and the imaginary nodal values of the mode, this rank's rows.
  std::vector<NamedMotion> motions(const std::vector<const double*>& parts) const {
    return motions_->names(parts);
  }
  /// Returns the object that compares motions body by body.
  const BodyMac& bodyMac() const { return mac_; }
  /// Returns the frequencies and names of the elastic modes of each body by itself, [body].
  const std::vector<std::vector<NamedMode>>& ownModes() const { return motions_->ownModes(); }
  /// Returns the index of each interface in list(), [interface]; none for ties.
  const std::vector<std::optional<std::size_t>>& ofInterfaces() const { return ofInterface_; }

 private:
  /// Rows of the matrices of one body: those of the nodes that several bodies share.
  struct SharedRows {
    OwnedMat stiffness, mass, damping;
  };
  /// The springs and dashpots of a group at its nodes, in the order of Mesh::nodeGroups.
  struct GroundGroup {
    std::string name;
    std::vector<mesh::Matrix3> springs, dashpots;
  };
  void findBodies(const std::vector<std::vector<PetscInt>>& nodes);
  void keepSharedRows();
  void addBodies(const NodalProducts& products, Vec u, std::vector<Forms>& forms) const;
  void addShared(Vec u, std::vector<Forms>& forms) const;
  void addGround(const double* x, std::vector<Forms>& forms) const;
  void addLayers(Vec u, std::vector<Forms>& forms) const;
  void addForms(Vec u, std::vector<Forms>& forms) const;

  const mesh::Mesh& mesh_;
  const elasticity::Bodies& bodies_;
  const contact::Contact& contact_;
  BodyMac mac_;
  std::vector<pencil::Component> list_;
  std::size_t firstGround_ = 0, firstForm_ = 0;
  std::vector<std::optional<std::size_t>> ofInterface_;  // [interface] component
  std::vector<int> bodyOf_;  // [owned node] body; `none` outside cells, `several` if shared
  std::optional<BodyMotions> motions_;  // always set
  std::vector<PetscInt> sharedNodes_;   // owned nodes of several bodies
  std::vector<SharedRows> shared_;      // [body]; empty unless nodes are shared
  std::vector<GroundGroup> ground_;
  std::vector<attachments::Form> attached_;  // springs, bushings and masses
  std::vector<std::size_t> ofForm_;          // [form] component
  OwnedMat groundDashpots_, linkDamping_, pointMass_;
};

}  // namespace squeal::energies
