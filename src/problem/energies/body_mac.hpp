// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The modal assurance criterion (MAC), body by body.
#include <span>
#include <vector>

#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::energies {

/// Compares a motion u with a real motion φ, for each body b, by
///   MAC_b = |φᵀ D_b u|² / (φᵀ D_b φ · uᴴ D_b u),
/// where the lumped masses D_b are the diagonal of the mass matrix at the nodes of the body; a
/// common factor cancels.
class BodyMac {
 public:
  /// Collective. Takes the owned nodes of each body, [body], and borrows the mesh during the
  /// lifetime of the object.
  BodyMac(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
          std::vector<std::vector<PetscInt>> nodes);
  /// Collective. Returns the MAC of a motion with each of the real `motions`, [motion][body]; 0 for
  /// a body that does not move. `parts` are the real and the imaginary nodal values of the motion.
  /// All values are this rank's rows.
  std::vector<std::vector<double>> of(const std::vector<const double*>& parts,
                                      const std::vector<std::span<const double>>& motions) const;

 private:
  const mesh::Mesh& mesh_;
  std::vector<std::vector<PetscInt>> nodes_;  // [body]
  std::vector<double> mass_;                  // [owned displacement]
};

}  // namespace squeal::energies
