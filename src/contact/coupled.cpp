#include "contact/coupled.hpp"

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
  PetscBool known = PETSC_FALSE, symmetric = PETSC_FALSE;
  check(MatIsSymmetricKnown(x, &known, &symmetric));
  if (known && symmetric) check(MatSetOption(projection.matrix, MAT_SYMMETRIC, PETSC_TRUE));
  return projection;
}

OwnedMat affine(Mat x0, Mat x1, double f) {
  OwnedMat sum;
  check(MatDuplicate(x0, MAT_COPY_VALUES, sum.out()));
  if (f == 0) return sum;
  // The normal force of a contact node comes from its cells, and so do its tangential rows: the
  // pattern of Sᵀ N X T lies within that of Tᵀ X T.
  check(MatAXPY(sum, f, x1, SUBSET_NONZERO_PATTERN));
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
                       const std::vector<unsigned char>& closed, Mat prestress) {
  std::vector<unsigned char> open;
  for (const auto isClosed : closed) open.push_back(!isClosed);
  Projections result;
  result.transformation = contact.transformation(open, open);
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
                             std::vector<unsigned char> closed, Mat prestress)
    : CoupledSystem(projectAll(bodies, contact, closed, prestress), closed,
                    countOpen(contact.mesh->comm, closed)) {}

CoupledSystem::CoupledSystem(Projections projections, std::vector<unsigned char> closed,
                             PetscInt openNodes)
    : AssociatedSystem(projections.stiffness.matrix.share(), projections.mass.matrix.share(),
                       "stiffness of the closed, frictionless contact"),
      projections_(std::move(projections)),
      closed_(std::move(closed)),
      openNodes_(openNodes) {}

}  // namespace squeal::contact
