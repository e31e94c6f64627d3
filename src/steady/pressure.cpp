#include "steady/pressure.hpp"

#include <algorithm>

#include "elasticity/face.hpp"
#include "elasticity/shape.hpp"
#include "mesh/mesh.hpp"
#include "petsc/arrays.hpp"

namespace squeal::steady {

std::vector<double> consistentPressure(const mesh::Mesh& mesh, const contact::Contact& contact,
                                       const std::vector<double>& normalForce) {
  // The scalar of a node is kept in the first component of a nodal vector, so that the periodic
  // matrix treats images as it does for u.
  const PetscInt owned = mesh.dimension * mesh.ownedNodes;
  OwnedMat faces, folded;
  check(MatCreateAIJ(mesh.comm, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE, 32, nullptr, 16,
                     nullptr, faces.out()));
  check(MatSetOption(faces, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  for (const auto& block : mesh.faces)
    for (std::size_t e = 0; e < block.surface.size(); ++e) {
      if (!contact.isPadSurface(mesh.surfaces[block.surface[e]])) continue;
      std::vector<mesh::Point> points;
      std::vector<PetscInt> rows;
      for (int i = 0; i < block.nodesPerFace; ++i) {
        const PetscInt node = block.nodesOf(e)[i];
        points.push_back(mesh.coordinates[node]);
        rows.push_back(mesh.dimension * mesh.globalNode[node]);
      }
      const auto values = elasticity::faceMass(elasticity::shapeTable(block.type), points);
      check(MatSetValues(faces, block.nodesPerFace, rows.data(), block.nodesPerFace, rows.data(),
                         values.data(), ADD_VALUES));
    }
  check(MatAssemblyBegin(faces, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(faces, MAT_FINAL_ASSEMBLY));
  check(MatPtAP(faces, contact.periodic, MAT_INITIAL_MATRIX, PETSC_DEFAULT, folded.out()));

  OwnedIS rows;
  std::vector<PetscInt> indices;
  for (const auto& node : contact.nodes) indices.push_back(mesh.dimension * node.globalNode);
  check(ISCreateGeneral(mesh.comm, indices.size(), indices.data(), PETSC_COPY_VALUES, rows.out()));
  OwnedMat mass;
  check(MatCreateSubMatrix(folded, rows, rows, MAT_INITIAL_MATRIX, mass.out()));
  OwnedVec force, pressure;
  check(MatCreateVecs(mass, force.out(), pressure.out()));
  std::copy(normalForce.begin(), normalForce.end(), WriteArray(force).begin());
  OwnedKSP solver;
  check(KSPCreate(mesh.comm, solver.out()));
  check(KSPSetOperators(solver, mass, mass));
  check(KSPSetType(solver, KSPCG));
  PC pc = nullptr;
  check(KSPGetPC(solver, &pc));
  check(PCSetType(pc, PCJACOBI));  // face mass matrices are well conditioned
  check(KSPSetTolerances(solver, 1e-12, PETSC_DEFAULT, PETSC_DEFAULT, 1000));
  check(KSPSolve(solver, force, pressure));
  const ReadArray values(pressure);
  return {values.begin(), values.end()};
}

}  // namespace squeal::steady
