#include "model/contact/coupled.hpp"

#include <algorithm>

namespace squeal::contact {
OwnedMat Projection::friction(Mat slipRows) const {
  OwnedMat result;
  check(MatTransposeMatMult(slipRows, reaction, MAT_INITIAL_MATRIX, PETSC_DEFAULT, result.out()));
  return result;
}

Projection project(const Contact& contact, const Transformation& transformation, Mat x) {
  Projection projection;
  if (!x) return projection;
  OwnedMat xt;
  check(MatMatMult(x, transformation.trial, MAT_INITIAL_MATRIX, PETSC_DEFAULT, xt.out()));
  check(MatTransposeMatMult(transformation.trial, xt, MAT_INITIAL_MATRIX, PETSC_DEFAULT,
                            projection.matrix.out()));
  check(MatMatMult(contact.reaction, xt, MAT_INITIAL_MATRIX, PETSC_DEFAULT,
                   projection.reaction.out()));
  // PETSc keeps the workspace of a product for the next one of the same pattern.
  for (const Mat result : {projection.matrix.get(), projection.reaction.get()})
    check(MatProductClear(result));
  PetscBool known = PETSC_FALSE, symmetric = PETSC_FALSE;
  check(MatIsSymmetricKnown(x, &known, &symmetric));
  if (known && symmetric) check(MatSetOption(projection.matrix, MAT_SYMMETRIC, PETSC_TRUE));
  return projection;
}

OwnedMat Projection::tested(Mat slipRows) const {
  OwnedMat sum;
  check(MatDuplicate(matrix, MAT_COPY_VALUES, sum.out()));
  if (!slipRows) return sum;
  // The normal force of a contact node comes from its cells, and so do its tangential rows: the
  // pattern of Sᵀ N X T lies within that of Tᵀ X T.
  check(MatAXPY(sum, 1, friction(slipRows), SUBSET_NONZERO_PATTERN));
  check(MatSetOption(sum, MAT_SYMMETRIC, PETSC_FALSE));
  return sum;
}

namespace {

/// Collective. Returns the number of contact nodes that are not closed, over all ranks.
PetscInt countOpen(MPI_Comm comm, const std::vector<unsigned char>& closed) {
  PetscInt open = std::count(closed.begin(), closed.end(), 0);
  check(MPI_Allreduce(MPI_IN_PLACE, &open, 1, MPIU_INT, MPI_SUM, comm));
  return open;
}

Projections projectAll(const elasticity::Bodies& bodies, const Contact& contact,
                       const std::vector<unsigned char>& closed,
                       const std::vector<unsigned char>& released, Mat prestress) {
  std::vector<unsigned char> open;
  for (const auto isClosed : closed) open.push_back(!isClosed);
  std::vector<unsigned char> free = open;
  for (std::size_t i = 0; i < released.size(); ++i) free[i] = free[i] || released[i];
  Projections result;
  result.transformation = contact.transformation(open, free);
  OwnedMat stressed;
  if (prestress) {
    check(MatDuplicate(bodies.stiffness, MAT_COPY_VALUES, stressed.out()));
    check(MatAXPY(stressed, 1, prestress, SAME_NONZERO_PATTERN));
    check(MatSetOption(stressed, MAT_SYMMETRIC, PETSC_TRUE));
  }
  const auto projected = [&](Mat x) { return project(contact, result.transformation, x); };
  result.stiffness = projected(prestress ? stressed.get() : bodies.stiffness.get());
  result.mass = projected(bodies.mass);
  result.damping = projected(bodies.damping);
  result.gyroscopic = projected(bodies.gyroscopic);
  result.rotationStiffness = projected(bodies.rotationStiffness);
  return result;
}

}  // namespace

CoupledSystem::CoupledSystem(const elasticity::Bodies& bodies, const Contact& contact,
                             std::vector<unsigned char> closed, Mat prestress,
                             std::vector<unsigned char> released)
    : CoupledSystem(projectAll(bodies, contact, closed, released, prestress), closed, released,
                    countOpen(contact.mesh->comm, closed)) {}

CoupledSystem::CoupledSystem(Projections projections, std::vector<unsigned char> closed,
                             std::vector<unsigned char> released, PetscInt openNodes)
    : AssociatedSystem(projections.stiffness.matrix.share(), projections.mass.matrix.share(),
                       "stiffness of the closed, frictionless contact"),
      projections_(std::move(projections)),
      closed_(std::move(closed)),
      released_(std::move(released)),
      openNodes_(openNodes) {}

}  // namespace squeal::contact
