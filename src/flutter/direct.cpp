#include <algorithm>
#include <cmath>

#include "flutter/select.hpp"
#include "petsc/options.hpp"
#include "petsc/text.hpp"

namespace squeal::flutter {
namespace {

const IntegerOption countOption("flutter", "flutter_direct_count", 100, 1,
                                "number of eigenvalues nearest to zero found by the direct method");
const SolverPrefix epsPrefix("flutter", "flutter_eps_", "SLEPc EPS of the direct method");
const SolverPrefix stPrefix("flutter", "flutter_st_", "SLEPc ST, KSP and PC of the direct method");

using Complex = std::complex<double>;

OwnedEPS solver(Mat stiffness, Mat mass) {
  PetscInt size = 0;
  check(MatGetSize(stiffness, &size, nullptr));
  const PetscInt count = std::min<PetscInt>(countOption.get(), size);
  OwnedEPS eps;
  check(EPSCreate(PetscObjectComm(reinterpret_cast<PetscObject>(stiffness)), eps.out()));
  check(EPSSetOptionsPrefix(eps, "flutter_"));
  check(EPSSetOperators(eps, stiffness, mass));
  check(EPSSetProblemType(eps, EPS_GNHEP));
  check(EPSSetDimensions(eps, count, std::min(size, 2 * count + 20), PETSC_DEFAULT));
  check(EPSSetTolerances(eps, 1e-12, 500));
  check(EPSSetWhichEigenpairs(eps, EPS_TARGET_MAGNITUDE));
  check(EPSSetTarget(eps, 0));
  ST st = nullptr;
  KSP ksp = nullptr;
  PC pc = nullptr;
  check(EPSGetST(eps, &st));
  check(STSetType(st, STSINVERT));
  check(STGetKSP(st, &ksp));
  check(KSPSetType(ksp, KSPPREONLY));
  check(KSPGetPC(ksp, &pc));
  check(PCSetType(pc, PCLU));
  check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  check(EPSSetFromOptions(eps));
  epsPrefix.rejectUnused();
  check(EPSSetUp(eps));
  stPrefix.rejectUnused();
  return eps;
}

}  // namespace

void rejectIdleSolverOptions() {
  for (const auto* prefix : {&epsPrefix, &stPrefix})
    if (prefix->given() && !directWanted())
      throw Error("options -" + prefix->prefix + "* (" + joined(prefix->names()) + ") are used by -flutter_method direct alone");
}

FrictionPoint solveDirect(const Pencil& pencil, double friction, Mat trial) {
  if (pencil.hasPower(1)) throw Error("option -flutter_method direct: problems with damping need the quadratic solver");
  const OwnedMat stiffness = pencil.assembled(0, friction), mass = pencil.assembled(2, friction);
  const OwnedEPS eps = solver(stiffness, mass);  // K d = μ M d, μ = −s²
  check(EPSSolve(eps));
  PetscInt converged = 0, wanted = 0;
  check(EPSGetConverged(eps, &converged));
  check(EPSGetDimensions(eps, &wanted, nullptr, nullptr));
  if (converged < wanted)
    throw Error(formatted(
        "direct method at friction %g: only %d of %d eigenvalues converged; raise -flutter_eps_max_it or -flutter_eps_ncv",
        friction, static_cast<int>(converged), static_cast<int>(wanted)));
  FrictionPoint point;
  point.friction = friction;
  OwnedVec real, imaginary;
  check(MatCreateVecs(stiffness, real.out(), nullptr));
  check(VecDuplicate(real, imaginary.out()));
  struct Found {
    Eigenvalue eigenvalue;
    PetscInt pair;
  };
  std::vector<Found> found;
  for (PetscInt i = 0; i < converged; ++i) {
    PetscScalar re = 0, im = 0;
    check(EPSGetEigenpair(eps, i, &re, &im, real, imaginary));
    const Complex mu(re, im);
    Complex s = im == 0 && re >= 0 ? Complex(0, std::sqrt(re)) : std::sqrt(-mu);
    if (s.imag() < 0) s = -s;
    const double error = backwardError(pencil, friction, s, real, im == 0 ? nullptr : imaginary.get());
    found.push_back({{s, error, false}, i});
    if (s.imag() == 0) found.push_back({{-s, error, false}, i});
  }
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
    const Complex s = a.eigenvalue.s, t = b.eigenvalue.s;
    return s.imag() != t.imag() ? s.imag() < t.imag() : s.real() < t.real();
  });
  for (const auto& item : found) point.eigenvalues.push_back(item.eigenvalue);
  judge(point.eigenvalues);
  keepShapes(point, trial, [&](std::size_t index, Vec re, Vec im) {
    PetscScalar a = 0, b = 0;
    check(EPSGetEigenpair(eps, found[index].pair, &a, &b, re, im));
  });
  return point;
}

}  // namespace squeal::flutter
