#include "modes/modes.hpp"

#include <algorithm>
#include <cmath>

#include "modes/blocklanczos.hpp"
#include "petsc/options.hpp"
#include "petsc/stages.hpp"
#include "petsc/text.hpp"

namespace squeal::modes {
namespace {

const IntegerOption countOption("modes", "modes_count", 200, 1, "number of free-vibration modes, the basis of the reduced problem");
const ChoiceOption solverOption(
    "modes", "modes_solver", {"auto", "block_lanczos", "eps"}, "auto",
    "block_lanczos: blocked solves with MUMPS; eps: SLEPc; auto: block_lanczos, or eps if a -modes_eps_* option is given or "
    "the problem is small");
const IntegerOption blockOption("modes", "modes_block_size", 8, 1, "right-hand sides that block_lanczos solves for together");
const RealOption toleranceOption("modes", "modes_tolerance", 1e-8, "", {0, 1e-2, true, false},
                                 "relative error of the eigenvalues of S = inverse(K) M (of eps: -modes_eps_tol)");
const FlagOption sturmOption("modes", "modes_sturm", true,
                             "confirm by the inertia of K - sigma M that no mode is missing (one more factorisation)");
const SolverPrefix solverPrefix("modes", "modes_eps_", "SLEPc EPS of the free vibrations: tol, ncv, mpd, type, …");

PetscErrorCode report(EPS, PetscInt iteration, PetscInt converged, PetscScalar*, PetscScalar*, PetscReal*, PetscInt,
                      void* context) {
  static_cast<Stage*>(context)->progress(
      formatted("restart %d: %d modes converged", static_cast<int>(iteration), static_cast<int>(converged)));
  return 0;
}

OwnedEPS solver(const contact::AssociatedSystem& system, int count, Stage& stage) {
  const Mat k = system.k0(), m = system.m0();
  OwnedEPS eps;
  check(EPSCreate(PetscObjectComm(reinterpret_cast<PetscObject>(k)), eps.out()));
  check(EPSSetOptionsPrefix(eps, "modes_"));
  check(EPSSetOperators(eps, k, m));
  check(EPSSetProblemType(eps, EPS_GHEP));
  check(EPSSetType(eps, EPSKRYLOVSCHUR));
  check(EPSSetWhichEigenpairs(eps, EPS_TARGET_MAGNITUDE));
  check(EPSSetTarget(eps, 0));
  // Half as many vectors again as modes, enlarged in portions of 100, took the fewest solves.
  const int size = static_cast<int>(system.size()),
            vectors = std::min(size, count + std::clamp(count / 2, 50, 100));  // SLEPc wants vectors <= count + portion
  check(EPSSetDimensions(eps, count, vectors, std::min(vectors, 100)));
  check(EPSSetTolerances(eps, toleranceOption.get(), PETSC_DEFAULT));
  check(EPSSetPurify(eps, PETSC_FALSE));
  check(EPSMonitorSet(eps, report, &stage, nullptr));
  ST st = nullptr;
  check(EPSGetST(eps, &st));
  check(STSetType(st, STSINVERT));
  check(STSetKSP(st, system.solver()));  // shift 0: K0 is factorised already
  check(EPSSetFromOptions(eps));
  solverPrefix.rejectUnused();
  check(EPSSetUp(eps));
  contact::rejectUnusedSolverOptions();
  return eps;
}

/// Number of eigenvalues of (K, M) below sigma: the negative pivots of an LDLᵀ factorisation of K − σ M (Sylvester).
int inertia(Mat k, Mat m, double sigma) {
  OwnedMat shifted;
  check(MatDuplicate(k, MAT_COPY_VALUES, shifted.out()));
  check(MatAXPY(shifted, -sigma, m, SUBSET_NONZERO_PATTERN));
  Mat factor = nullptr;
  check(MatGetFactor(shifted, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor));
  const OwnedMat owner(factor);
  check(MatMumpsSetIcntl(factor, 13, 1));  // ScaLAPACK on the root would hide its pivots' signs
  check(MatMumpsSetIcntl(factor, 24, 1));
  MatFactorInfo info;
  check(MatFactorInfoInitialize(&info));
  check(MatCholeskyFactorSymbolic(factor, shifted, nullptr, &info));
  check(MatCholeskyFactorNumeric(factor, shifted, &info));
  PetscInt negative = 0;
  check(MatGetInertia(factor, &negative, nullptr, nullptr));
  return static_cast<int>(negative);
}

/// A shift in the widest relative gap among the topmost modes, so that rounding cannot move an eigenvalue across it.
void confirmCount(const contact::AssociatedSystem& system, Modes& modes) {
  const auto& w = modes.angularFrequency;
  if (w.size() < 2) return;
  std::size_t below = w.size() - 1;  // number of modes below the shift
  double widest = 0;
  for (std::size_t i = w.size() - 1; i >= 1 && i + 10 >= w.size(); --i)
    if (const double gap = w[i] / w[i - 1] - 1; gap > widest) widest = gap, below = i;
  modes.inertiaShift = 0.5 * (w[below] * w[below] + w[below - 1] * w[below - 1]);
  modes.inertiaCount = inertia(system.k0(), system.m0(), modes.inertiaShift);
  modes.countConfirmed = modes.inertiaCount == static_cast<int>(below);
}

void requireConverged(int converged, int count) {
  if (converged < count)
    throw Error(formatted(
        "free vibration: only %d of %d modes converged; raise -modes_eps_max_it or -modes_eps_ncv, or loosen -modes_tolerance",
        converged, count));
}

/// Eigenvalues ascending and vectors, M-orthonormal, by SLEPc.
void solveByEps(const contact::AssociatedSystem& system, int count, Stage& stage, Modes& modes) {
  const Mat k = system.k0();
  const OwnedEPS eps = solver(system, count, stage);
  check(EPSSolve(eps));
  PetscInt converged = 0, iterations = 0;
  check(EPSGetConverged(eps, &converged));
  check(EPSGetIterationNumber(eps, &iterations));
  requireConverged(static_cast<int>(converged), count);
  OwnedVec d;
  check(MatCreateVecs(k, d.out(), nullptr));
  check(BVCreate(PetscObjectComm(reinterpret_cast<PetscObject>(k)), modes.vectors.out()));
  check(BVSetSizesFromVec(modes.vectors, d, count));
  check(BVSetType(modes.vectors, BVSVEC));
  std::vector<std::pair<double, PetscInt>> order;
  for (PetscInt i = 0; i < converged; ++i) {
    PetscScalar value = 0;
    check(EPSGetEigenvalue(eps, i, &value, nullptr));
    order.emplace_back(value, i);
  }
  std::sort(order.begin(), order.end());
  for (int i = 0; i < count; ++i) {
    check(EPSGetEigenvector(eps, order[static_cast<std::size_t>(i)].second, d, nullptr));
    check(BVInsertVec(modes.vectors, i, d));
    modes.lambda.push_back(order[static_cast<std::size_t>(i)].first);
  }
  modes.iterations = static_cast<int>(iterations);
}

void solveByLanczos(const contact::AssociatedSystem& system, int count, Stage& stage, Modes& modes) {
  auto result = blockLanczos(system.k0(), system.m0(), system.solver(), count, blockOption.get(), toleranceOption.get(), 20,
                             [&](int restarts, int converged) {
                               stage.progress(formatted("%d restarts: %d of %d modes converged", restarts, converged, count));
                             });
  requireConverged(result.converged, count);
  modes.lambda = result.lambda;
  modes.vectors = std::move(result.vectors);
  modes.iterations = result.restarts;
}

void measureResiduals(const contact::AssociatedSystem& system, Modes& modes) {
  const Mat k = system.k0(), m = system.m0();
  OwnedVec kd, md;
  check(MatCreateVecs(k, kd.out(), md.out()));
  for (std::size_t i = 0; i < modes.lambda.size(); ++i) {
    if (!(modes.lambda[i] > 0))
      throw Error(formatted("free vibration: eigenvalue %g is not positive; a body is loose or nearly so", modes.lambda[i]));
    Vec d = nullptr;
    check(BVGetColumn(modes.vectors, static_cast<PetscInt>(i), &d));
    check(MatMult(k, d, kd));
    check(MatMult(m, d, md));
    check(BVRestoreColumn(modes.vectors, static_cast<PetscInt>(i), &d));
    PetscReal scale = 0, residual = 0;
    check(VecNorm(md, NORM_2, &scale));
    check(VecAXPY(kd, -modes.lambda[i], md));
    check(VecNorm(kd, NORM_2, &residual));
    modes.angularFrequency.push_back(std::sqrt(modes.lambda[i]));
    modes.relativeResidual.push_back(residual / (modes.lambda[i] * scale));
  }
}

/// The method keeps up to lanczosVectors() vectors; it must not run out of directions.
bool lanczosWanted(int count, PetscInt size) {
  const std::string solver = solverOption.get();
  const bool fits = 2 * lanczosVectors(count, blockOption.get()) <= size;
  if (solver == "block_lanczos" && !fits)
    throw Error(formatted("option -modes_solver block_lanczos: %d modes of %d unknowns are too many for it; use eps", count,
                          static_cast<int>(size)));
  return solver == "block_lanczos" || (solver == "auto" && fits && !solverPrefix.given());
}

}  // namespace

Modes compute(const contact::AssociatedSystem& system) {
  const int count = countOption.get();
  if (count > system.size())
    throw Error(formatted("option -modes_count %d: the problem has only %d unknowns", count, static_cast<int>(system.size())));
  Stage stage(PetscObjectComm(reinterpret_cast<PetscObject>(system.k0())), "modes");
  Modes modes;
  if (lanczosWanted(count, system.size()))
    solveByLanczos(system, count, stage, modes);
  else
    solveByEps(system, count, stage, modes);
  measureResiduals(system, modes);
  if (sturmOption.get()) confirmCount(system, modes);
  stage.finish(formatted("%d modes to %.4g Hz, worst relative residual %.1e%s", count, modes.angularFrequency.back() / (2 * M_PI),
                         *std::max_element(modes.relativeResidual.begin(), modes.relativeResidual.end()),
                         !sturmOption.get()     ? ""
                         : modes.countConfirmed ? ", count confirmed by inertia"
                                                : ", COUNT NOT CONFIRMED BY INERTIA"));
  return modes;
}

}  // namespace squeal::modes
