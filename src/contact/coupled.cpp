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
  // Normal forces of a contact node come from its cells, and so do its tangential rows: Sᵀ N X T
  // stays within Tᵀ X T.
  check(MatAXPY(sum, f, x1, SUBSET_NONZERO_PATTERN));
  check(MatSetOption(sum, MAT_SYMMETRIC, PETSC_FALSE));
  return sum;
}

AssociatedSystem::AssociatedSystem(const elasticity::Bodies& bodies, const Contact& contact,
                                   std::vector<unsigned char> closed, Mat prestress)
    : closed_(std::move(closed)) {
  std::vector<unsigned char> open;
  for (auto isClosed : closed_) open.push_back(!isClosed);
  openNodes_ = static_cast<PetscInt>(std::count(open.begin(), open.end(), 1));
  check(MPI_Allreduce(MPI_IN_PLACE, &openNodes_, 1, MPIU_INT, MPI_SUM, contact.mesh->comm));
  transformation_ = contact.transformation(open);
  OwnedMat stressed;
  if (prestress) {
    check(MatDuplicate(bodies.stiffness, MAT_COPY_VALUES, stressed.out()));
    check(MatAXPY(stressed, 1, prestress, SAME_NONZERO_PATTERN));
    check(MatSetOption(stressed, MAT_SYMMETRIC, PETSC_TRUE));
  }
  stiffness_ =
      project(contact, transformation_, prestress ? stressed.get() : bodies.stiffness.get());
  mass_ = project(contact, transformation_, bodies.mass);
  damping_ = project(contact, transformation_, bodies.damping);
  gyroscopic_ = project(contact, transformation_, bodies.gyroscopic);
  rotationStiffness_ = project(contact, transformation_, bodies.rotationStiffness);
  solver_ = std::make_unique<linalg::SymmetricSolver>(
      stiffness_.matrix, "stiffness of the closed, frictionless contact");
}

}  // namespace squeal::contact
