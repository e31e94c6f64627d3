// SPDX-License-Identifier: BSD-2-Clause
#include "steady/uniqueness/uniqueness.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "base/options/options.hpp"
#include "model/contact/loose.hpp"
#include "steady/uniqueness/compliance.hpp"

namespace squeal::uniqueness {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

Uniqueness undecided(const std::vector<double>& frictions, const std::string& reason) {
  Uniqueness result{{}, unknown};
  for (double friction : frictions)
    result.judgements.push_back({friction, unknown, "not decided", reason});
  return result;
}

Uniqueness examineDense(const Compliance& compliance, const std::vector<double>& frictions,
                        int pMatrixLimit) {
  Uniqueness result{{}, lossOfPositivity(compliance.a0, compliance.a1)};
  for (double friction : frictions)
    result.judgements.push_back(examineMatrix(compliance.at(friction), friction, pMatrixLimit));
  return result;
}

template <void (OpenContact::*product)(Vec, Vec) const>
PetscErrorCode multiply(Mat matrix, Vec v, Vec result) {
  const OpenContact* condensed = nullptr;
  PetscFunctionBegin;
  PetscCall(MatShellGetContext(matrix, &condensed));
  (condensed->*product)(v, result);
  PetscFunctionReturn(0);
}

PetscErrorCode solveA0(PC pc, Vec v, Vec solution) {
  OpenContact* condensed = nullptr;
  PetscFunctionBegin;
  PetscCall(PCShellGetContext(pc, &condensed));
  condensed->solveA0(v, solution);
  PetscFunctionReturn(0);
}

OwnedMat shell(OpenContact& condensed, PetscErrorCode (*multiply)(Mat, Vec, Vec)) {
  OwnedMat matrix;
  const PetscInt owned = condensed.ownedSize(), size = condensed.size();
  check(MatCreateShell(condensed.comm(), owned, owned, size, size, &condensed, matrix.out()));
  check(MatShellSetOperation(matrix, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
  check(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
  return matrix;
}

/// Collective. Returns the smallest μ of [M.19]
///   sym(A1) v = μ A0 v;
/// none if SLEPc does not converge. The smallest eigenvalues of sym(A(f)) itself belong to forces
/// that alternate from node to node: they are close together, scale with the mesh size and hardly
/// depend on friction. Relative to A0, the mesh hardly matters, and one number serves all
/// frictions.
std::optional<double> smallestRatio(OpenContact& condensed) {
  const OwnedMat a0 = shell(condensed, multiply<&OpenContact::multiplyA0>),
                 a1 = shell(condensed, multiply<&OpenContact::multiplySymmetricA1>);
  OwnedEPS eps;
  check(EPSCreate(condensed.comm(), eps.out()));
  check(EPSSetOptionsPrefix(eps, "steady_uniqueness_"));
  check(EPSSetOperators(eps, a1, a0));
  check(EPSSetProblemType(eps, EPS_GHEP));
  check(EPSSetWhichEigenpairs(eps, EPS_SMALLEST_REAL));
  check(EPSSetDimensions(eps, 1, std::min<PetscInt>(condensed.size(), 40), PETSC_DEFAULT));
  // An absolute test, since the eigenvalue is zero for a mirror-symmetric structure.
  check(EPSSetConvergenceTest(eps, EPS_CONV_ABS));
  check(EPSSetTolerances(eps, 1e-8, 500));
  ST st = nullptr;
  KSP ksp = nullptr;
  PC pc = nullptr;
  check(EPSGetST(eps, &st));
  check(STGetKSP(st, &ksp));
  check(KSPSetType(ksp, KSPPREONLY));
  check(KSPGetPC(ksp, &pc));
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetContext(pc, &condensed));
  check(PCShellSetApply(pc, solveA0));
  applySolverOptions([&] { return EPSSetFromOptions(eps); });
  applySolverOptions([&] { return EPSSetUp(eps); });
  rejectUnusedUniquenessOptions(false);
  check(EPSSolve(eps));
  PetscInt converged = 0;
  PetscScalar value = 0;
  check(EPSGetConverged(eps, &converged));
  if (converged == 0) return std::nullopt;
  check(EPSGetEigenvalue(eps, 0, &value, nullptr));
  return value;
}

/// Examines the problem without forming A: sym(A(f)) = A0 + f sym(A1) is positive definite below
/// the friction lossOfPositivity().
Uniqueness examineMatrixFree(OpenContact& condensed, const std::vector<double>& frictions) {
  if (condensed.hasFixedFriction())
    return undecided(frictions,
                     "with a -contact_<interface>_friction the condensed matrix must be formed; "
                     "raise -steady_uniqueness_dense");
  if (!condensed.positiveDefinite())
    return undecided(frictions,
                     "the stiffness of the open contact is not positive definite; raise "
                     "-steady_uniqueness_dense");
  const auto ratio = smallestRatio(condensed);
  if (!ratio)
    return undecided(
        frictions,
        "the decisive eigenvalue did not converge; raise -steady_uniqueness_eps_max_it or "
        "-steady_uniqueness_dense");
  Uniqueness result{{}, lossOfPositivity(*ratio)};
  for (double friction : frictions)
    if (friction < result.lostAt)
      result.judgements.push_back(
          {friction, unknown, "one solution", "the condensed matrix is positive definite"});
    else
      result.judgements.push_back(
          {friction, unknown, "not decided",
           "the condensed matrix is not positive definite; other tests need it formed, up to "
           "-steady_uniqueness_dense contact nodes"});
  return result;
}

}  // namespace

Uniqueness examine(const elasticity::Bodies& bodies, const contact::Contact& contact, double speed,
                   const std::vector<double>& frictions, const Settings& settings) {
  if (contact.interfaces.totalNodes == 0) return undecided(frictions, "there is no contact node");
  if (const auto mode = contact::rigidBodyMode(*contact.mesh, contact, bodies, {.any = false}))
    return undecided(
        frictions,
        "body '" + mode->body +
            "' is supported only by the contact, so the condensed matrix does not exist");
  OwnedMat stiffness = bodies.stiffness.share();
  if (bodies.rotationStiffness) {
    check(MatDuplicate(bodies.stiffness, MAT_COPY_VALUES, stiffness.out()));
    check(MatAXPY(stiffness, speed * speed, bodies.rotationStiffness, DIFFERENT_NONZERO_PATTERN));
    check(MatSetOption(stiffness, MAT_SYMMETRIC, PETSC_TRUE));
  }
  for (const auto& interface : contact.interfaces.options)
    if (interface.role == contact::Role::sticking)
      return undecided(
          frictions,
          "nodes of " + interface.label() +
              " are free along it when they open, which the condensed matrix does not include");
  for (const auto& interface : contact.interfaces.options)
    if (!interface.separates)
      return undecided(frictions, "nodes of " + interface.label() +
                                      " stay closed, which the condensed matrix does not include");
  OpenContact condensed(contact, stiffness, contact.slip(speed, nullptr));
  const bool dense = condensed.size() <= settings.dense;
  if (dense) rejectUnusedUniquenessOptions(true);
  if (!condensed.factorised())
    return undecided(frictions, "the stiffness matrix of the open contact cannot be factorised");
  return dense ? examineDense(condensed.dense(), frictions, settings.pMatrix)
               : examineMatrixFree(condensed, frictions);
}

}  // namespace squeal::uniqueness
