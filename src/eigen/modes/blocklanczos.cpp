// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/modes/blocklanczos.hpp"

#include <slepc/private/epsimpl.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

#include "algebra/factor/symmetric_solver.hpp"
#include "base/petsc/object.hpp"
#include "eigen/modes/rational_lanczos.hpp"

namespace squeal::modes {
namespace {

/// Fraction of the wanted eigenvalues below the second pole; measured to need the fewest solves.
constexpr double partBelowPole = 0.88;
/// The second pole is placed once the basis has this many vectors per wanted eigenvalue: its Ritz
/// values then determine the pole.
constexpr double vectorsBeforePole = 0.6;
/// After this many vectors a further pole, amid the unconverged eigenvalues, replaces the second
/// one.
constexpr PetscInt vectorsOfPole = 300;
/// With fewer eigenvalues than this, a second pole costs more than it saves.
constexpr PetscInt fewestForPole = 40;

/// The private part of an EPS of this type.
struct Solver {
  PetscInt blockSize = 8;
  PetscBool secondPole = PETSC_TRUE;
  BlockLanczosResult facts;
  std::exception_ptr failure;  // it must not pass through the C code of SLEPc
};

Solver& solverOf(EPS eps) { return *static_cast<Solver*>(eps->data); }

/// Returns the solves with K − σ0 M by the KSP of the spectral transformation.
Pole firstPole(EPS eps) {
  KSP ksp = nullptr;
  check(STGetKSP(eps->st, &ksp));
  return {0, [ksp](Mat b, Mat x) { check(KSPMatSolve(ksp, b, x)); }};
}

/// Returns a place for the second pole from Ritz values, or the target if these do not determine
/// one. The number of eigenvalues below λ grows like
///   N(λ) = a λ^½ + c λ^(3/2),
/// as in plates and in solids (Weyl's law); a and c are fitted to nearly converged Ritz values.
double polePosition(EPS eps, const RitzPairs& ritz) {
  constexpr double nearly = 0.1, distinct = 1.001;
  std::size_t known = 0;
  while (known < ritz.value.size() && ritz.residual[known] < nearly * ritz.value[known]) ++known;
  const std::size_t half = known / 2;
  if (half < 4) return eps->target;
  const double x = 1 / ritz.value[half - 1], y = 1 / ritz.value[known - 1];  // less the target
  if (!(y > distinct * x))
    return eps->target;  // one multiple eigenvalue: a pole would coincide with it
  // a + c λ = N(λ) / √λ at both
  const double atX = half / std::sqrt(x), atY = known / std::sqrt(y);
  const double c = std::max(0.0, (atY - atX) / (y - x)), a = std::max(0.0, atY - c * y);
  double low = y, high = y;
  const auto number = [&](double lambda) { return std::sqrt(lambda) * (a + c * lambda); };
  const double wanted = partBelowPole * eps->nev;
  while (number(high) < wanted) high *= 2;
  while (high - low > 1e-3 * high) {
    const double middle = 0.5 * (low + high);
    (number(middle) < wanted ? low : high) = middle;
  }
  return eps->target + high;
}

/// Returns the wanted eigenvalues that have not converged, minus the target.
std::vector<double> unconverged(EPS eps, const RitzPairs& ritz) {
  std::vector<double> rest;
  for (PetscInt i = 0; i < eps->nev; ++i)
    if (!(eps->errest[i] < eps->tol)) rest.push_back(1 / ritz.value[i]);
  return rest;
}

/// Returns a place for a further pole: the middle of the widest gap near the median of the
/// unconverged eigenvalues `rest`.
double nextPolePosition(EPS eps, const RitzPairs& ritz, const std::vector<double>& rest) {
  const double middle = rest[rest.size() / 2];
  double place = middle, widest = 0;
  for (PetscInt i = 0; i + 1 < eps->nev; ++i) {
    const double low = 1 / ritz.value[i], high = 1 / ritz.value[i + 1];
    if (std::abs(high - middle) < 0.05 * middle && high - low > widest)
      widest = high - low, place = 0.5 * (low + high);
  }
  return eps->target + place;
}

/// Collective. Factorises K − σ M at σ.
Pole poleAt(EPS eps, double sigma) {
  Mat k = nullptr, m = nullptr;
  KSP ksp = nullptr;
  check(EPSGetOperators(eps, &k, &m));
  check(STGetKSP(eps->st, &ksp));
  const std::shared_ptr<factor::MumpsFactor> made = factor::shiftedFactor(k, m, sigma, ksp);
  auto& facts = solverOf(eps).facts;
  const int below = made->inertia().negative;
  if (below <= eps->nev && below >= facts.below) {
    facts.countedTo = sigma;
    facts.below = below;
  }
  return {sigma - eps->target, [made](Mat b, Mat x) { factor::solve(*made, b, x); }};
}

/// Collective. Passes the Ritz pairs to SLEPc, which decides on convergence.
void checkConvergence(EPS eps, const RitzPairs& ritz, bool full) {
  const PetscInt count = std::min<PetscInt>(std::ssize(ritz.value), eps->ncv);
  bool all = true;
  eps->nconv = 0;
  for (PetscInt i = 0; i < count; ++i) {
    eps->eigr[i] = ritz.value[i];
    eps->eigi[i] = 0;
    check((*eps->converged)(eps, ritz.value[i], 0, ritz.residual[i], &eps->errest[i],
                            eps->convergedctx));
    all = all && eps->errest[i] < eps->tol;
    if (all) ++eps->nconv;
  }
  check(EPSMonitor(eps, eps->its, eps->nconv, eps->eigr, eps->eigi, eps->errest, count));
  check((*eps->stopping)(eps, full ? eps->its : 0, eps->max_it, eps->nconv, eps->nev, &eps->reason,
                         eps->stoppingctx));
}

void iterate(EPS eps) {
  Solver& solver = solverOf(eps);
  Mat m = nullptr;
  check(EPSGetOperators(eps, nullptr, &m));
  const PetscInt count = eps->nev, width = solver.blockSize;
  RationalLanczos lanczos(m, eps->V, width);
  const Pole first = firstPole(eps);
  std::optional<Pole> second;
  const Pole* pole = &first;
  lanczos.start(*pole);
  const PetscInt every = std::max(2 * width, count / 10);
  PetscInt next = count + count / 2;
  bool placed = !solver.secondPole || count < fewestForPole;
  PetscInt vectorsBefore = 0;  // the second pole
  while (true) {
    lanczos.expand(*pole);
    if (!placed && lanczos.size() >= vectorsBeforePole * count + width) {
      placed = true;
      if (const double sigma = polePosition(eps, lanczos.ritz()); sigma > eps->target)
        pole = &second.emplace(poleAt(eps, sigma));
      vectorsBefore = lanczos.size();
    }
    if (lanczos.size() < next && !lanczos.full()) continue;
    const RitzPairs ritz = lanczos.ritz();
    checkConvergence(eps, ritz, lanczos.full());
    solver.facts.solves = lanczos.solves();
    if (eps->reason != EPS_CONVERGED_ITERATING) {
      lanczos.finish(ritz, eps->nconv);
      return;
    }
    // The lowest unconverged eigenvalue gains most from the nearer pole.
    const std::vector<double> rest = unconverged(eps, ritz);
    if (second && lanczos.size() >= vectorsBefore + vectorsOfPole &&
        10 * std::ssize(rest) > count) {
      second.reset();  // frees its factor before the next one is made
      second.emplace(poleAt(eps, nextPolePosition(eps, ritz, rest)));
      vectorsBefore = lanczos.size();
    }
    if (second) pole = 2 / ritz.value[eps->nconv] < second->distance ? &first : &*second;
    if (lanczos.full()) {
      lanczos.restart(ritz, count + (eps->ncv - count) / 3);
      vectorsBefore = lanczos.size();
      ++solver.facts.restarts;
      ++eps->its;
    }
    next = lanczos.size() + every;
  }
}

// The functions that SLEPc calls.

PetscErrorCode setUp(EPS eps) {
  PetscFunctionBegin;
  const PetscInt width = solverOf(eps).blockSize;
  EPSCheckHermitianDefinite(eps);
  EPSCheckSinvert(eps);
  EPSCheckUnsupported(eps, EPS_FEATURE_ARBITRARY | EPS_FEATURE_REGION | EPS_FEATURE_EXTRACTION);
  EPSCheckIgnored(eps, EPS_FEATURE_BALANCE);
  PetscCheck(eps->isgeneralized, commOf(eps), PETSC_ERR_SUP,
             "This solver is for generalized problems");
  if (!eps->which) eps->which = EPS_TARGET_MAGNITUDE;
  PetscCheck(eps->which == EPS_TARGET_MAGNITUDE, commOf(eps), PETSC_ERR_SUP,
             "This solver finds the eigenvalues nearest to a target");
  if (eps->ncv == PETSC_DEFAULT)
    eps->ncv = std::min<PetscInt>(eps->n, lanczosVectors(eps->nev, width));
  PetscCheck(eps->ncv >= eps->nev + 3 * width && eps->ncv <= eps->n, commOf(eps),
             PETSC_ERR_USER_INPUT,
             "The value of ncv must be at least nev + 3 block sizes, at most the problem size");
  if (eps->mpd == PETSC_DEFAULT) eps->mpd = eps->ncv;
  if (eps->max_it == PETSC_DEFAULT) eps->max_it = 20;
  PetscCall(EPSAllocateSolution(eps, 0));
  PetscCall(EPS_SetInnerProduct(eps));
  PetscFunctionReturn(0);
}

/// SLEPc's default order serves a DS, which this type does not use.
PetscErrorCode setUpSort(EPS eps) {
  PetscFunctionBegin;
  eps->sc->comparison = SlepcCompareTargetMagnitude;
  eps->sc->comparisonctx = &eps->target;
  eps->sc->map = nullptr;
  eps->sc->mapobj = nullptr;
  PetscFunctionReturn(0);
}

PetscErrorCode solve(EPS eps) {
  PetscFunctionBegin;
  Solver& solver = solverOf(eps);
  solver.facts = {};
  solver.failure = nullptr;
  try {
    iterate(eps);
  } catch (...) {
    solver.failure = std::current_exception();
    eps->nconv = 0;
    eps->reason = EPS_DIVERGED_BREAKDOWN;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode transformBack(EPS eps) {
  PetscFunctionBegin;
  PetscCall(STBackTransform(eps->st, eps->nconv, eps->eigr, eps->eigi));
  PetscFunctionReturn(0);
}

PetscErrorCode setFromOptions(EPS eps, PetscOptionItems* PetscOptionsObject) {
  Solver& solver = solverOf(eps);
  PetscFunctionBegin;
  PetscOptionsHeadBegin(PetscOptionsObject, "EPS block Lanczos options");
  PetscCall(PetscOptionsInt("-eps_blocklanczos_blocksize",
                            "right-hand sides that are solved for together", "", solver.blockSize,
                            &solver.blockSize, nullptr));
  PetscCall(PetscOptionsBool("-eps_blocklanczos_pole",
                             "a second pole below the last wanted eigenvalue", "",
                             solver.secondPole, &solver.secondPole, nullptr));
  PetscOptionsHeadEnd();
  PetscCheck(solver.blockSize > 0, commOf(eps), PETSC_ERR_USER_INPUT,
             "-eps_blocklanczos_blocksize must be positive");
  PetscFunctionReturn(0);
}

PetscErrorCode view(EPS eps, PetscViewer viewer) {
  PetscFunctionBegin;
  const Solver& solver = solverOf(eps);
  PetscCall(PetscViewerASCIIPrintf(viewer, "  block size %" PetscInt_FMT "\n", solver.blockSize));
  if (solver.facts.countedTo > 0)
    PetscCall(PetscViewerASCIIPrintf(viewer, "  %d eigenvalues below %g, by the inertia\n",
                                     solver.facts.below, solver.facts.countedTo));
  PetscFunctionReturn(0);
}

PetscErrorCode destroy(EPS eps) {
  PetscFunctionBegin;
  delete static_cast<Solver*>(eps->data);
  eps->data = nullptr;
  PetscFunctionReturn(0);
}

PetscErrorCode create(EPS eps) {
  PetscFunctionBegin;
  eps->data = new Solver;
  eps->categ = EPS_CATEGORY_KRYLOV;
  eps->ops->setup = setUp;
  eps->ops->setupsort = setUpSort;
  eps->ops->solve = solve;
  eps->ops->backtransform = transformBack;
  eps->ops->setfromoptions = setFromOptions;
  eps->ops->view = view;
  eps->ops->destroy = destroy;
  PetscFunctionReturn(0);
}

}  // namespace

void registerBlockLanczos() {
  static bool registered = false;
  if (!registered) check(EPSRegister(blockLanczosType, create));
  registered = true;
}

void setBlockLanczos(EPS eps, PetscInt blockSize, bool secondPole) {
  solverOf(eps).blockSize = blockSize;
  solverOf(eps).secondPole = secondPole ? PETSC_TRUE : PETSC_FALSE;
}

BlockLanczosResult solveBlockLanczos(EPS eps) {
  check(EPSSolve(eps));
  const Solver& solver = solverOf(eps);
  if (solver.failure) std::rethrow_exception(solver.failure);
  return solver.facts;
}

}  // namespace squeal::modes
