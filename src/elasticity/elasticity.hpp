#pragma once
/// The elastic bodies, uncoupled: their matrices and the loads on all nodal displacements u. N =
/// dimension × nodes, row dimension·node + component.
#include <optional>

#include "elasticity/motion.hpp"
#include "mesh/mesh.hpp"
#include "petsc/owned.hpp"

namespace squeal::elasticity {

struct Bodies {
  OwnedMat stiffness;  ///< K, N×N, symmetric, block-diagonal over the bodies, grounded springs
                       ///< included, N/m
  OwnedMat mass;       ///< M, N×N, symmetric positive definite, kg
  OwnedMat
      damping;  ///< C, N×N, symmetric, of rates in the axes at rest, N·s/m; empty if there is none
  OwnedMat gyroscopic;  ///< G = 2∫ρ(Dφⱼ)·φᵢ at the base motions, N×N, exactly skew, N·s/m; empty
                        ///< without convective terms
  OwnedMat rotationStiffness;  ///< K^R = −∫ρ(Dφⱼ)·(Dφᵢ) at the base motions, exactly symmetric,
                               ///< N/m; empty as G
  OwnedVec load;                ///< b, N: pressures, and centrifugal forces at the base motions, N
  OwnedVec centrifugal;         ///< the centrifugal part of b, N
  OwnedVec springs;             ///< N: stiffness of grounded springs, N/m; empty if there are none
  std::vector<Motion> motions;  ///< [body], base motions
};

/// Volume groups with a material, from the options that give an elastic law
/// (`-material_<group>_young`, …). Error if there is none.
std::vector<mesh::GroupRequest> materialGroups();
/// Which options give a material, for messages: "give -…".
std::string howToGiveMaterials();
/// Surface groups with a `-load_<group>_pressure` option.
std::vector<mesh::GroupRequest> loadedSurfaces();

/// Groups with a `-ground_<group>_*` option.
std::vector<mesh::GroupRequest> groundedGroups();

/// Collective. Errors: bad or missing material, inverted element (names body and cell), convective
/// terms on a body that does not keep its place as its matter moves.
Bodies assemble(const mesh::Mesh& mesh);

/// What one body contributes to the matrices of Bodies, on all nodal displacements: the derivatives
/// with respect to factors on its moduli (K, and the stiffness damping K/s) and on its density (the
/// others).
struct BodyPart {
  OwnedMat stiffness, mass;  ///< without grounded springs
  OwnedMat gyroscopic,
      rotationStiffness;  ///< empty unless the body moves and there are convective terms
  OwnedVec centrifugal;
  double massDamping = 0;       ///< α, 1/s: C = α M + …
  double stiffnessDamping = 0;  ///< β + η / (2π f), s: C = … + (β + η / 2πf) K
};
/// Collective. Of the body with this index.
BodyPart bodyPart(const mesh::Mesh& mesh, int body);

/// `-elasticity_prestress`: the geometric stiffness of steady sliding joins K.
bool prestressWanted();
/// Collective. `body` alone, if given. K_σ,ij = ∫ ∇φᵢ·σ∇φⱼ on each component, σ = D ε of the nodal
/// displacements given (of their incompatible modes, too): N×N, exactly symmetric, with the pattern
/// of K, N/m.
OwnedMat geometricStiffness(const mesh::Mesh& mesh, Vec displacement, std::optional<int> body = {});

/// Collective. A vector of nodal displacements, N entries, block size = dimension.
OwnedVec nodalVector(const mesh::Mesh& mesh);

}  // namespace squeal::elasticity
