#pragma once
/// The elastic bodies, uncoupled: K, M and the loads on all nodal displacements u. N = dimension × nodes, row dimension·node +
/// component.
#include "elasticity/motion.hpp"
#include "mesh/mesh.hpp"
#include "petsc/owned.hpp"

namespace squeal::elasticity {

struct Bodies {
  OwnedMat stiffness;           ///< K, N×N, symmetric, block-diagonal over the bodies, N/m
  OwnedMat mass;                ///< M, N×N, symmetric positive definite, kg
  OwnedVec load;                ///< b, N: pressures and centrifugal forces, N
  std::vector<Motion> motions;  ///< [body]
};

/// Volume groups with a material, from the `-material_<group>_young` options. Error if there is none.
std::vector<std::string> materialGroups();
/// Surface groups with a `-load_<group>_pressure` option.
std::vector<std::string> loadedSurfaces();

/// Collective. Assembles K, M and b. Errors: bad or missing material, inverted element (names body and cell).
Bodies assemble(const mesh::Mesh& mesh);

/// Collective. A vector of nodal displacements, N entries, block size = dimension.
OwnedVec nodalVector(const mesh::Mesh& mesh);

}  // namespace squeal::elasticity
