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

OwnedMat CoupledMatrices::affine(Mat x0, Mat x1, double friction) {
  OwnedMat sum;
  check(MatDuplicate(x0, MAT_COPY_VALUES, sum.out()));
  if (friction == 0) return sum;
  // E only scales and adds within the pattern of T, so X1 stays within that of X0.
  check(MatAXPY(sum, friction, x1, SUBSET_NONZERO_PATTERN));
  check(MatSetOption(sum, MAT_SYMMETRIC, PETSC_FALSE));
  return sum;
}

CoupledMatrices couple(const elasticity::Bodies& bodies, const Contact& contact, const std::vector<unsigned char>& gapFree,
                       const std::vector<unsigned char>& slides, bool withMass) {
  CoupledMatrices coupled;
  coupled.transformation = contact.transformation(gapFree, slides);
  const auto triple = [&](Mat x, OwnedMat& x0, OwnedMat& x1) {
    OwnedMat xt;
    check(MatMatMult(x, coupled.transformation.trial, MAT_INITIAL_MATRIX, PETSC_DEFAULT, xt.out()));
    check(MatTransposeMatMult(coupled.transformation.trial, xt, MAT_INITIAL_MATRIX, PETSC_DEFAULT, x0.out()));
    check(MatTransposeMatMult(coupled.transformation.friction, xt, MAT_INITIAL_MATRIX, PETSC_DEFAULT, x1.out()));
    check(MatSetOption(x0, MAT_SYMMETRIC, PETSC_TRUE));
  };
  triple(bodies.stiffness, coupled.k0, coupled.k1);
  if (withMass) triple(bodies.mass, coupled.m0, coupled.m1);
  return coupled;
}

AssociatedSystem::AssociatedSystem(const elasticity::Bodies& bodies, const Contact& contact, std::vector<unsigned char> closed)
    : closed_(std::move(closed)) {
  std::vector<unsigned char> open;
  for (auto isClosed : closed_) open.push_back(!isClosed);
  openNodes_ = static_cast<PetscInt>(std::count(open.begin(), open.end(), 1));
  check(MPI_Allreduce(MPI_IN_PLACE, &openNodes_, 1, MPIU_INT, MPI_SUM, contact.mesh->comm));
  matrices_ = couple(bodies, contact, open, closed_, true);
}

KSP AssociatedSystem::solver() const {
  if (solver_) {
    factorise();
    return solver_;
  }
  Stage stage(PetscObjectComm(reinterpret_cast<PetscObject>(matrices_.k0.get())), "factor");
  check(KSPCreate(PetscObjectComm(reinterpret_cast<PetscObject>(matrices_.k0.get())), solver_.out()));
  check(KSPSetOptionsPrefix(solver_, factorisation.prefix.c_str()));
  check(KSPSetOperators(solver_, matrices_.k0, matrices_.k0));
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
  check(KSPSetOperators(solver_, matrices_.k0, matrices_.k0));
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
