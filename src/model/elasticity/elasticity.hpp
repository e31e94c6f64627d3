// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Assembly of the uncoupled elastic bodies: their matrices and loads on all N nodal
/// displacements u, N = dimension × nodes. A component of a node has the row dimension·node +
/// component.
#include <optional>

#include "base/petsc/owned.hpp"
#include "model/attachments/forms.hpp"
#include "model/constraints/settings.hpp"
#include "model/elasticity/carried_masses.hpp"
#include "model/elasticity/hourglass.hpp"
#include "model/elasticity/motion.hpp"
#include "model/elasticity/settings.hpp"
#include "model/material/material.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

/// The matrices, loads and base motions of all bodies, with the settings and materials.
struct Bodies {
  OwnedMat stiffness;  ///< K, N×N, symmetric, N/m; only springs and bushings couple different
                       ///< bodies; includes grounded springs and compliant contact layers
  OwnedMat mass;       ///< M, N×N, symmetric positive semidefinite, kg; zero at nodes outside
                       ///< all cells, except for point masses
  OwnedMat damping;  ///< C, N×N, symmetric, acts on rates in the axes of the vehicle, N·s/m; null
                     ///< if none
  OwnedMat gyroscopic;  ///< G = 2∫ρ(Dφⱼ)·φᵢ at the speed factor 1 [4.10], N×N, exactly skew, N·s/m;
                        ///< null without convective terms
  OwnedMat rotationStiffness;  ///< K^R = −∫ρ(Dφⱼ)·(Dφᵢ) at the speed factor 1 [4.10], N×N, exactly
                               ///< symmetric, N/m; null if G is null
  OwnedVec load;  ///< b, N entries, in newtons: all loads, and the centrifugal forces at the speed
                  ///< factor 1
  OwnedVec centrifugal;    ///< the centrifugal part of b, N entries
  OwnedVec constantLoad;   ///< the part of b that no sweep scales, N entries; null if none
  OwnedMat linkStiffness;  ///< the part of K due to springs and bushings, N×N, N/m; null if none
  /// The part of K due to compliant contact layers, N×N, N/m; null if none.
  OwnedMat layerStiffness;
  std::vector<attachments::Form> links;  ///< springs and bushings, the same on all ranks
  OwnedMat springs;  ///< the part of K due to grounded springs, N×N, with entries between the
                     ///< components of a node, N/m; null if none
  std::vector<Motion> motions;                ///< [body], base motions
  std::vector<CarriedMass> carried;           ///< point masses that move with a body
  std::vector<material::Material> materials;  ///< [material group]
  std::vector<ExposedCell> exposed;           ///< of all ranks
  Settings settings;
};

/// Collective. Assembles the matrices and loads of all bodies. Throws Error for materials and
/// motions that do not suit the mesh, for an inverted element (the message names body and cell),
/// for convective terms on a body that does not keep its place as its matter moves, and for reduced
/// integration of cells other than hex20. The couplings connect point masses with the bodies that
/// carry them.
Bodies assemble(const mesh::Mesh& mesh, const material::Settings& materials,
                const std::vector<constraints::CouplingSettings>& couplings,
                const Settings& settings);

/// Collective. Returns the bodies after adding the stiffness of compliant contact layers, N×N, N/m,
/// which may be null.
Bodies withLayers(Bodies bodies, OwnedMat stiffness);

/// Returns true if a material of this Poisson's ratio is so nearly incompressible that linear cells
/// without incompatible modes lock: they cannot deform with a constant volume at every point of
/// their quadrature rule.
bool locks(double poisson);
/// Collective. Returns the number of linear cells without incompatible modes, [material group].
std::vector<PetscInt> linearCells(const mesh::Mesh& mesh, const Settings& settings);

/// The contribution of one material group (a body, or a section of a body) to Bodies, on all nodal
/// displacements. The members are derivatives. K, and the part of C that is proportional to K, are
/// differentiated with respect to a factor on the moduli of the group, all other quantities with
/// respect to a factor on its density.
struct MaterialPart {
  OwnedMat stiffness, mass;  ///< without grounded springs
  OwnedMat gyroscopic,
      rotationStiffness;  ///< null unless its body moves and there are convective terms
  OwnedVec centrifugal;
  OwnedVec weight;              ///< due to gravity, acceleration and spin of its body; null if none
  double massDamping = 0;       ///< α, 1/s: C = α M + …
  double stiffnessDamping = 0;  ///< β + η / (2π f), s: C = … + (β + η / (2π f)) K
};
/// Collective. Returns the contribution of the material group with this index.
MaterialPart materialPart(const mesh::Mesh& mesh, const Bodies& bodies, int group);

/// Rows of the matrices of one material group at some nodes, on all nodal displacements.
struct MaterialRows {
  OwnedMat stiffness, mass;  ///< without grounded springs; (dimension · nodes) × N
};
/// Collective. Returns the rows of these owned nodes, in their order. Only the cells at the nodes
/// are assembled.
MaterialRows materialRows(const mesh::Mesh& mesh, const Bodies& bodies, int group,
                          const std::vector<PetscInt>& nodes);

/// Collective. Returns the geometric stiffness [M.6], equal for all components,
///   K_σ,ij = ∫ ∇φᵢ·σ ∇φⱼ,   σ = D ε,
/// for the stress of the given nodal displacements and of their incompatible modes. It is N×N, N/m,
/// exactly symmetric, and has the pattern of the part of K that is due to cells. If `group` is
/// given, only this material group contributes.
OwnedMat geometricStiffness(const mesh::Mesh& mesh, const Bodies& bodies, Vec displacement,
                            std::optional<int> group = {});

/// Collective. Returns the rows of nodal vectors at some owned nodes, [node][component].
OwnedIS rowsOf(const mesh::Mesh& mesh, const std::vector<PetscInt>& nodes);
/// Collective. Returns a nodal vector of zeros, with N entries and the block size `dimension`.
OwnedVec nodalVector(const mesh::Mesh& mesh);
/// Collective. Returns the values of a nodal vector, [local node][component], including ghosts.
std::vector<double> localValues(const mesh::Mesh& mesh, Vec u);

}  // namespace squeal::elasticity
