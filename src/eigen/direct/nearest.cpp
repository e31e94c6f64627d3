// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/direct/nearest.hpp"

#include <slepcpep.h>

#include <algorithm>
#include <cmath>

#include "algebra/linalg/gathered.hpp"
#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/spread.hpp"
#include "base/options/options.hpp"
#include "base/petsc/object.hpp"
#include "base/system/text.hpp"
#include "eigen/direct/direct.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::direct {
namespace {

const SolverPrefix epsPrefix("flutter", "flutter_eps_",
                             "options of SLEPc's EPS for the direct method without damping");
const SolverPrefix pepPrefix("flutter", "flutter_pep_",
                             "options of SLEPc's PEP for the direct method with damping");
const SolverPrefix stPrefix("flutter", "flutter_st_",
                            "options of SLEPc's ST and PETSc's KSP and PC for the direct method");

using OwnedPEP = Owned<PEP, PEPDestroy>;

/// Makes the spectral transformation shift-and-invert with one LU factorisation by MUMPS.
void factoriseBy(ST st) {
  KSP ksp = nullptr;
  PC pc = nullptr;
  check(STSetType(st, STSINVERT));
  check(STGetKSP(st, &ksp));
  check(KSPSetType(ksp, KSPPREONLY));
  check(KSPGetPC(ksp, &pc));
  check(PCSetType(pc, PCLU));
  check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
}

/// Returns a pseudo-random vector that depends on `run` but not on the number of ranks.
OwnedVec startVector(Mat matrix, int run) {
  OwnedVec start;
  PetscInt first = 0, end = 0;
  check(MatCreateVecs(matrix, start.out(), nullptr));
  check(VecGetOwnershipRange(start, &first, &end));
  for (PetscInt i = first; i < end; ++i)
    check(VecSetValue(start, i, std::sin(12.9898 * (i + 1) + 78.233 * run * std::sqrt(i + 2)),
                      INSERT_VALUES));
  check(VecAssemblyBegin(start));
  check(VecAssemblyEnd(start));
  return start;
}

NearestPair emptyPair(Mat matrix, Complex s) {
  NearestPair pair{{}, s};
  check(MatCreateVecs(matrix, pair.real.out(), pair.imaginary.out()));
  return pair;
}

void normalise(NearestPair& v) {
  const double size = length(v);
  check(VecScale(v.real, 1 / size));
  check(VecScale(v.imaginary, 1 / size));
}

NearestPair copied(const NearestPair& pair) {
  return {linalg::ComplexVector::copied(pair.real, pair.imaginary), pair.s};
}

/// Removes from v its part in the span of the orthonormal `basis`, twice because of round-off, and
/// returns the 2-norm of the remainder.
double project(NearestPair& v, const std::vector<NearestPair>& basis) {
  for (int pass = 0; pass < 2; ++pass)
    for (const auto& u : basis) add(v, -dot(u, v), u);
  return length(v);
}

/// Eigenvalues within this relative distance count as one multiple eigenvalue, whose vectors may
/// mix.
constexpr double oneCluster = 1e-6;
/// A unit vector is new if its part outside the span of a cluster is longer than this. Round-off
/// and the tolerance of the solver, 1e-12, rotate that span by at most 1e-12 / oneCluster, times a
/// condition number.
constexpr double newVector = 1e-2;

bool isNew(const NearestPair& pair, const std::vector<NearestPair>& known) {
  std::vector<NearestPair> basis;
  for (const auto& other : known) {
    if (std::abs(other.s - pair.s) > oneCluster * std::abs(pair.s)) continue;
    NearestPair last = copied(other);
    if (project(last, basis) < 1e-12) continue;  // two vectors of a defective eigenvalue coincide
    normalise(last);
    basis.push_back(std::move(last));
  }
  NearestPair rest = copied(pair);
  return project(rest, basis) > newVector;
}

/// Returns the |s| up to which all eigenvalues are listed. The `wanted` ones are the nearest;
/// further converged ones may leave gaps.
double reachedBy(std::vector<double> sizes, PetscInt wanted, PetscInt all) {
  std::sort(sizes.begin(), sizes.end());
  return wanted == all ? INFINITY : sizes.at(wanted - 1);
}

void rejectUnconverged(PetscInt converged, PetscInt wanted, const sweep::Parameters& at,
                       const std::string& prefix) {
  if (converged < wanted)
    throw Error(formatted("direct method at friction %g: only %" PetscInt_FMT " of %" PetscInt_FMT
                          " eigenvalues converged; raise -%smax_it or -%sncv",
                          at.friction, converged, wanted, prefix.c_str(), prefix.c_str()));
}

/// The solver for
///   K d = μ M d,   μ = −s².
class Undamped : public NearestSolver {
 public:
  Undamped(const pencil::Pencil& pencil, const sweep::Parameters& at) : NearestSolver(pencil, at) {
    create();
  }

 private:
  void create() {
    ST st = nullptr;
    DS ds = nullptr;
    check(EPSCreate(comm(), eps_.out()));
    check(EPSSetOptionsPrefix(eps_, "flutter_"));
    check(EPSSetOperators(eps_, terms_[0], terms_[2]));
    check(EPSSetProblemType(eps_, EPS_GNHEP));
    check(EPSSetTolerances(eps_, 1e-12, 500));
    check(EPSSetWhichEigenpairs(eps_, EPS_TARGET_MAGNITUDE));
    check(EPSSetTarget(eps_, 0));
    check(EPSGetST(eps_, &st));
    factoriseBy(st);
    check(EPSGetDS(eps_, &ds));
    check(DSSetParallel(
        ds,
        DS_PARALLEL_SYNCHRONIZED));  // otherwise round-off makes the ranks disagree on convergence
    applySolverOptions([&] { return EPSSetFromOptions(eps_); });
    epsPrefix.rejectUnused();
  }

  void prepare(PetscInt count, Vec start) override {
    if (!eps_) create();
    const PetscInt wanted = std::min(count, size_);
    check(EPSSetDimensions(eps_, wanted, std::min(size_, 2 * wanted + 20), PETSC_DEFAULT));
    check(EPSSetInitialSpace(eps_, 1, &start));
    applySolverOptions([&] { return EPSSetFromOptions(eps_); });  // again: the dimensions given win
    applySolverOptions([&] { return EPSSetUp(eps_); });
    stPrefix.rejectUnused();
  }

  PetscErrorCode run() override { return EPSSolve(eps_); }

  void discard() override { eps_ = OwnedEPS(); }

  NearestPairs collected(PetscInt count) override {
    const PetscInt wanted = std::min(count, size_);
    PetscInt converged = 0;
    check(EPSGetConverged(eps_, &converged));
    rejectUnconverged(converged, wanted, at_, epsPrefix.prefix);
    NearestPairs found;
    std::vector<double> sizes;
    for (PetscInt i = 0; i < converged; ++i) {
      PetscScalar real = 0, imaginary = 0;
      check(EPSGetEigenvalue(eps_, i, &real, &imaginary));
      Complex s = imaginary == 0 && real >= 0 ? Complex(0, std::sqrt(real))
                                              : std::sqrt(-Complex(real, imaginary));
      if (s.imag() < 0) s = -s;
      NearestPair pair = emptyPair(terms_[0], s);
      check(EPSGetEigenvector(eps_, i, pair.real, pair.imaginary));
      normalise(pair);
      if (s.imag() == 0) found.pairs.push_back(copied(pair)), found.pairs.back().s = -s;
      found.pairs.push_back(std::move(pair));
      sizes.push_back(std::abs(s));
    }
    found.reached = reachedBy(sizes, wanted, size_);
    return found;
  }

  OwnedEPS eps_;
};

/// The solver for
///   (K + s Z + s² M) d = 0.
class Damped : public NearestSolver {
 public:
  Damped(const pencil::Pencil& pencil, const sweep::Parameters& at) : NearestSolver(pencil, at) {
    create();
  }

 private:
  void create() {
    Mat terms[3] = {terms_[0], terms_[1], terms_[2]};
    ST st = nullptr;
    DS ds = nullptr;
    check(PEPCreate(comm(), pep_.out()));
    check(PEPSetOptionsPrefix(pep_, "flutter_"));
    check(PEPSetOperators(pep_, 3, terms));
    check(PEPSetProblemType(pep_, PEP_GENERAL));
    check(PEPSetType(pep_, PEPTOAR));
    check(PEPSetScale(pep_, PEP_SCALE_SCALAR, PETSC_DECIDE, nullptr, nullptr, PETSC_DECIDE,
                      PETSC_DECIDE));
    check(PEPSetTolerances(pep_, 1e-12, 500));
    check(PEPSetWhichEigenpairs(pep_, PEP_TARGET_MAGNITUDE));
    check(PEPSetTarget(pep_, 0));
    check(PEPGetST(pep_, &st));
    factoriseBy(st);
    check(PEPGetDS(pep_, &ds));
    check(DSSetParallel(ds, DS_PARALLEL_SYNCHRONIZED));
    applySolverOptions([&] { return PEPSetFromOptions(pep_); });
    pepPrefix.rejectUnused();
  }

  void prepare(PetscInt count, Vec start) override {
    if (!pep_) create();
    const PetscInt wanted = 2 * std::min(count, size_);
    check(PEPSetDimensions(pep_, wanted, std::min(2 * size_, 2 * wanted + 20), PETSC_DEFAULT));
    check(PEPSetInitialSpace(pep_, 1, &start));
    applySolverOptions([&] { return PEPSetFromOptions(pep_); });  // again: the dimensions given win
    applySolverOptions([&] { return PEPSetUp(pep_); });
    stPrefix.rejectUnused();
  }

  PetscErrorCode run() override { return PEPSolve(pep_); }

  void discard() override { pep_ = OwnedPEP(); }

  NearestPairs collected(PetscInt count) override {
    const PetscInt wanted = 2 * std::min(count, size_);
    PetscInt converged = 0;
    check(PEPGetConverged(pep_, &converged));
    rejectUnconverged(converged, wanted, at_, pepPrefix.prefix);
    NearestPairs found;
    std::vector<double> sizes;
    for (PetscInt i = 0; i < converged; ++i) {
      PetscScalar real = 0, imaginary = 0;
      check(PEPGetEigenpair(pep_, i, &real, &imaginary, nullptr, nullptr));
      sizes.push_back(std::hypot(real, imaginary));
      if (imaginary < 0) continue;
      NearestPair pair = emptyPair(terms_[0], {real, imaginary});
      check(PEPGetEigenpair(pep_, i, &real, &imaginary, pair.real, pair.imaginary));
      normalise(pair);
      found.pairs.push_back(std::move(pair));
    }
    found.reached = reachedBy(sizes, wanted, 2 * size_);
    return found;
  }

  OwnedPEP pep_;
};

}  // namespace

NearestSolver::NearestSolver(const pencil::Pencil& pencil, const sweep::Parameters& at) : at_(at) {
  for (int power = 0; power <= 2; ++power) terms_[power] = pencil.assembled(power, at);
  check(MatGetSize(terms_[0], &size_, nullptr));
}

NearestPairs NearestSolver::solve(PetscInt count) {
  // If a Krylov space ends early, the ranks may disagree in SLEPc 3.18, since each decides by its
  // own round-off. LAPACK therefore solves small problems.
  constexpr PetscInt largestWhole = 1000;
  return size_ <= std::min(2 * count + 20, largestWhole) ? whole() : krylov(count);
}

/// SLEPc sorts a Schur form by swapping adjacent blocks, but LAPACK's dtrexc rejects blocks with
/// nearly equal eigenvalues. SLEPc 3.18 then fails. Another start vector changes the round-off and
/// usually gives a Schur form that can be sorted.
NearestPairs NearestSolver::krylov(PetscInt count) {
  constexpr int mostStarts = 5;  // a probability of 1 % that one fails leaves 1e-10
  std::string failure;
  for (int starts = 0; starts < mostStarts; ++starts) {
    const OwnedVec start = startVector(terms_[0], ++runs_);
    prepare(count, start);
    failure = lapackFailure();
    if (failure.empty()) return collected(count);
  }
  throw Error(
      formatted("direct method at friction %g: SLEPc fails from each of %d start vectors: "
                "%s; change -flutter_direct_count",
                at_.friction, mostStarts, failure.c_str()));
}

std::string NearestSolver::lapackFailure() {
  const CapturedError error;
  const PetscErrorCode code = run();
  if (code == 0) return "";
  if (error.message().find("LAPACK") == std::string::npos) check(code);
  discard();  // it is in an undefined state
  return error.message();
}

MPI_Comm NearestSolver::comm() const { return commOf(terms_[0].get()); }

/// Returns all eigenvalues with Im s ≥ 0, by LAPACK on rank 0.
NearestPairs NearestSolver::whole() const {
  NearestPairs found{{}, INFINITY};
  PetscInt first = 0, end = 0;
  check(MatGetOwnershipRange(terms_[0], &first, &end));
  for (const auto& [s, q, left] :
       linalg::solveTogether(comm(), {linalg::gathered(terms_[2]), linalg::gathered(terms_[1]),
                                      linalg::gathered(terms_[0])})) {
    NearestPair pair = emptyPair(terms_[0], s);
    for (PetscInt i = first; i < end; ++i) {
      check(VecSetValue(pair.real, i, q[i].real(), INSERT_VALUES));
      check(VecSetValue(pair.imaginary, i, q[i].imag(), INSERT_VALUES));
    }
    for (Vec part : {pair.real.get(), pair.imaginary.get()})
      check(VecAssemblyBegin(part)), check(VecAssemblyEnd(part));
    found.pairs.push_back(std::move(pair));
  }
  return found;
}

void rejectIdleSolverOptions(pencil::Method method) {
  for (const auto* prefix : {&epsPrefix, &pepPrefix, &stPrefix})
    if (prefix->given() && method != pencil::Method::direct)
      throw Error("options -" + prefix->prefix + "* (" + joined(prefix->names()) +
                  ") are used only by -flutter_method direct");
}

std::unique_ptr<NearestSolver> nearestSolver(const pencil::Pencil& pencil,
                                             const sweep::Parameters& at) {
  if (pencil.hasPower(1)) return std::make_unique<Damped>(pencil, at);
  return std::make_unique<Undamped>(pencil, at);
}

void addMissing(NearestSolver& solver, PetscInt count, NearestPairs& found) {
  for (std::size_t before = 0; before != found.pairs.size() && found.reached < INFINITY;) {
    before = found.pairs.size();
    NearestPairs again = solver.solve(count);
    found.reached = std::min(found.reached, again.reached);
    for (auto& pair : again.pairs)
      if (isNew(pair, found.pairs)) found.pairs.push_back(std::move(pair));
  }
}

}  // namespace squeal::direct
