#include "contact/coupled.hpp"

#include <algorithm>

#include "petsc/options.hpp"
#include "petsc/stages.hpp"
#include "petsc/text.hpp"

namespace squeal::contact {
namespace {

const SolverPrefix factorisation("modes", "modes_st_",
                                 "SLEPc ST, KSP and PC with the factorisation of K (MUMPS LDLt): st_type, ksp_*, pc_*, …");

}  // namespace

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
  check(MatTransposeMatMult(transformation.trial, xt, MAT_INITIAL_MATRIX, PETSC_DEFAULT, projection.matrix.out()));
  check(MatMatMult(contact.reaction, xt, MAT_INITIAL_MATRIX, PETSC_DEFAULT, projection.reaction.out()));
  PetscBool known = PETSC_FALSE, symmetric = PETSC_FALSE;
  check(MatIsSymmetricKnown(x, &known, &symmetric));
  if (known && symmetric) check(MatSetOption(projection.matrix, MAT_SYMMETRIC, PETSC_TRUE));
  return projection;
}

OwnedMat affine(Mat x0, Mat x1, double f) {
  OwnedMat sum;
  check(MatDuplicate(x0, MAT_COPY_VALUES, sum.out()));
  if (f == 0) return sum;
  // Normal forces of a contact node come from its cells, and so do its tangential rows: Sᵀ N X T stays within Tᵀ X T.
  check(MatAXPY(sum, f, x1, SUBSET_NONZERO_PATTERN));
  check(MatSetOption(sum, MAT_SYMMETRIC, PETSC_FALSE));
  return sum;
}

AssociatedSystem::AssociatedSystem(const elasticity::Bodies& bodies, const Contact& contact, std::vector<unsigned char> closed,
                                   Mat prestress)
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
  stiffness_ = project(contact, transformation_, prestress ? stressed.get() : bodies.stiffness.get());
  mass_ = project(contact, transformation_, bodies.mass);
  damping_ = project(contact, transformation_, bodies.damping);
  gyroscopic_ = project(contact, transformation_, bodies.gyroscopic);
  rotationStiffness_ = project(contact, transformation_, bodies.rotationStiffness);
}

KSP AssociatedSystem::solver() const {
  if (solver_) {
    factorise();
    return solver_;
  }
  Stage stage(PetscObjectComm(reinterpret_cast<PetscObject>(stiffness_.matrix.get())), "factor");
  check(KSPCreate(PetscObjectComm(reinterpret_cast<PetscObject>(stiffness_.matrix.get())), solver_.out()));
  check(KSPSetOptionsPrefix(solver_, factorisation.prefix.c_str()));
  check(KSPSetOperators(solver_, stiffness_.matrix, stiffness_.matrix));
  check(KSPSetType(solver_, KSPPREONLY));
  PC pc = nullptr;
  check(KSPGetPC(solver_, &pc));
  check(PCSetType(pc, PCCHOLESKY));
  check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  check(KSPSetFromOptions(solver_));
  factorise();
  stage.finish(formatted("stiffness of the closed, frictionless contact: %d unknowns", static_cast<int>(size())));
  return solver_;
}

/// Does nothing where the factorisation is at hand. (An EPS that has used the solver leaves it without.)
void AssociatedSystem::factorise() const {
  PC pc = nullptr;
  check(KSPSetOperators(solver_, stiffness_.matrix, stiffness_.matrix));
  check(KSPSetUp(solver_));
  check(KSPGetPC(solver_, &pc));
  PCFailedReason failed;
  check(PCGetFailedReason(pc, &failed));
  if (failed != PC_NOERROR)
    throw Error(
        "the stiffness matrix of the closed, frictionless contact cannot be factorised (options -modes_st_pc_*): is a body loose, "
        "or is memory short?");
}

void rejectUnusedSolverOptions() { factorisation.rejectUnused(); }

}  // namespace squeal::contact
