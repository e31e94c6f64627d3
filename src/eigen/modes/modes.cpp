// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/modes/modes.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/factor/symmetric_solver.hpp"
#include "algebra/linalg/block.hpp"
#include "algebra/linalg/columns.hpp"
#include "algebra/linalg/gathered.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/options/options.hpp"
#include "base/petsc/arrays.hpp"
#include "base/petsc/object.hpp"
#include "base/session/stages.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "eigen/modes/blocklanczos.hpp"

namespace squeal::modes {
namespace {

const SolverPrefix solverPrefix(
    "modes", "modes_eps_", "options of SLEPc's EPS for the free modes: tol, ncv, mpd, type, …");

PetscInt rowsOf(Mat matrix) {
  PetscInt rows = 0;
  check(MatGetSize(matrix, &rows, nullptr));
  return rows;
}

PetscErrorCode report(EPS, PetscInt iteration, PetscInt converged, PetscScalar*, PetscScalar*,
                      PetscReal*, PetscInt, void* context) {
  static_cast<Stage*>(context)->progress(formatted(
      "restart %" PetscInt_FMT ": %" PetscInt_FMT " modes converged", iteration, converged));
  return 0;
}

/// Collective. Returns a solver of SLEPc for the modes nearest to zero.
OwnedEPS solver(const factor::AssociatedSystem& system, const Settings& settings, const char* type,
                Stage& stage) {
  const Mat k = system.k0();
  OwnedEPS eps;
  registerBlockLanczos();
  check(EPSCreate(commOf(k), eps.out()));
  check(EPSSetOptionsPrefix(eps, "modes_"));
  check(EPSSetOperators(eps, k, system.m0()));
  check(EPSSetProblemType(eps, EPS_GHEP));
  check(EPSSetType(eps, type));
  check(EPSSetWhichEigenpairs(eps, EPS_TARGET_MAGNITUDE));
  check(EPSSetTarget(eps, 0));
  check(EPSSetTolerances(eps, settings.tolerance, PETSC_DEFAULT));
  check(EPSSetPurify(eps, PETSC_FALSE));
  check(EPSMonitorSet(eps, report, &stage, nullptr));
  ST st = nullptr;
  check(EPSGetST(eps, &st));
  check(STSetType(st, STSINVERT));
  check(STSetKSP(st, system.solver()));  // shift 0: K0 is factorised already
  return eps;
}

/// Collective. Reads the options of EPS and makes it ready.
void setUp(EPS eps) {
  applySolverOptions([&] { return EPSSetFromOptions(eps); });
  solverPrefix.rejectUnused();
  applySolverOptions([&] { return EPSSetUp(eps); });
  factor::rejectUnusedSolverOptions();
}

/// Returns the number of modes below the widest relative gap of the topmost ten, at most all but
/// one. Round-off cannot move an eigenvalue across this gap. If the ten are copies of one multiple
/// eigenvalue, the gap lies below it.
std::size_t modesBelowGap(const std::vector<double>& w) {
  constexpr double distinct = 1e-6;
  std::size_t below = 0;
  double widest = 0;
  for (std::size_t i = w.size() - 1; i >= 1 && (i + 10 >= w.size() || widest < distinct); --i)
    if (const double gap = w[i] / w[i - 1] - 1; gap > widest) widest = gap, below = i;
  return widest < distinct ? 0 : below;
}

/// Returns true if the number of modes below the shift equals the inertia count, and the shift lies
/// clearly between two modes.
bool countAgrees(const Modes& modes) {
  constexpr double apart = 1e-6;  // of λ
  const double shift = modes.inertiaShift;
  if (!(shift > 0) || !(shift < modes.lambda.back())) return false;
  const auto near = [&](double lambda) { return std::abs(lambda - shift) < apart * shift; };
  const auto below = [&](double lambda) { return lambda < shift; };
  return std::ranges::none_of(modes.lambda, near) &&
         std::ranges::count_if(modes.lambda, below) == modes.inertiaCount;
}

/// Collective. Counts the eigenvalues below a shift near the top, unless an existing count already
/// agrees.
void confirmCount(const factor::AssociatedSystem& system, Modes& modes) {
  modes.countConfirmed = countAgrees(modes);
  if (modes.lambda.empty() || modes.countConfirmed) return;
  const TopCount top = countAtTop(system, modes);
  modes.inertiaShift = top.shift;
  modes.inertiaCount = top.below;
  modes.countConfirmed = top.agrees;
}

void requireConverged(int converged, int count, const char* remedy) {
  if (converged < count)
    throw Error(formatted(
        "free vibration: only %d of %d modes converged; try %s, or loosen -modes_tolerance",
        converged, count, remedy));
}

/// Collective. Takes the eigenvalues, ascending, and the vectors, M-orthonormal, from a solver.
void extractModes(EPS eps, int count, Modes& modes) {
  Mat k = nullptr;
  check(EPSGetOperators(eps, &k, nullptr));
  const OwnedVec d = rightVector(k);
  check(BVCreate(commOf(k), modes.vectors.out()));
  check(BVSetSizesFromVec(modes.vectors, d, count));
  check(BVSetType(modes.vectors, BVSVEC));
  PetscInt converged = 0;
  check(EPSGetConverged(eps, &converged));
  std::vector<std::pair<double, PetscInt>> order;
  for (PetscInt i = 0; i < converged; ++i) {
    PetscScalar value = 0;
    check(EPSGetEigenvalue(eps, i, &value, nullptr));
    order.emplace_back(value, i);
  }
  std::sort(order.begin(), order.end());
  for (int i = 0; i < count; ++i) {
    check(EPSGetEigenvector(eps, order[i].second, d, nullptr));
    check(BVInsertVec(modes.vectors, i, d));
    modes.lambda.push_back(order[i].first);
  }
}

/// Collective. Finds the modes by the EPS type of -modes_eps_type. Throws Error if too few
/// converge.
void solveByEps(const factor::AssociatedSystem& system, const Settings& settings, Stage& stage,
                Modes& modes) {
  const int count = settings.count;
  const OwnedEPS eps = solver(system, settings, EPSKRYLOVSCHUR, stage);
  // A basis of 1.5 times the number of modes, enlarged in portions of 100, took the fewest solves.
  const PetscInt vectors =
      std::min<PetscInt>(rowsOf(system.k0()),
                         count + std::clamp(count / 2, 50, 100));  // SLEPc wants <= count + portion
  check(EPSSetDimensions(eps, count, vectors, std::min<PetscInt>(vectors, 100)));
  setUp(eps);
  check(EPSSolve(eps));
  PetscInt converged = 0, iterations = 0;
  check(EPSGetConverged(eps, &converged));
  check(EPSGetIterationNumber(eps, &iterations));
  requireConverged(converged, count, "a larger -modes_eps_max_it or -modes_eps_ncv");
  extractModes(eps, count, modes);
  modes.iterations = iterations;
}

/// Collective. Finds the modes by block Lanczos. Returns false if too few have converged; `modes`
/// is then unchanged. Close eigenvalues, such as those of a thin ring clamped at its hub, need a
/// larger basis, not more restarts.
bool solveByLanczos(const factor::AssociatedSystem& system, const Settings& settings, int blockSize,
                    Stage& stage, Modes& modes) {
  constexpr PetscInt restartsBeforeGrowth = 4, mostRestarts = 20;
  const int count = settings.count;
  const PetscInt size = rowsOf(system.k0());
  for (PetscInt room = lanczosVectors(count, blockSize);; room *= 2) {
    const bool largest = 4 * room > size;
    const OwnedEPS eps = solver(system, settings, blockLanczosType, stage);
    check(EPSSetDimensions(eps, count, room, PETSC_DEFAULT));
    check(EPSSetTolerances(eps, settings.tolerance, largest ? mostRestarts : restartsBeforeGrowth));
    setBlockLanczos(eps, blockSize, settings.sturm);
    setUp(eps);
    const BlockLanczosResult facts = solveBlockLanczos(eps);
    PetscInt converged = 0;
    check(EPSGetConverged(eps, &converged));
    if (converged >= count) {
      extractModes(eps, count, modes);
      modes.iterations = facts.restarts;
      modes.inertiaShift = facts.countedTo;
      modes.inertiaCount = facts.below;
      return true;
    }
    if (largest) return false;
  }
}

/// Solves
///   M d = (1/λ) K d
/// by LAPACK on rank 0, so the ranks agree. This form gives the largest 1/λ, those of the lowest
/// modes, with the highest accuracy.
void solveDense(const factor::AssociatedSystem& system, int count, Modes& modes) {
  const MPI_Comm comm = commOf(system.k0());
  const PetscInt n = rowsOf(system.k0());
  linalg::DenseMatrix all = linalg::gathered(system.m0()),
                      stiffness = linalg::gathered(system.k0()), vectors(n, count);
  onFirstRank(
      comm, "free vibration: the stiffness is not positive definite; is a body under-constrained? ",
      [&] {
        const auto inverse = linalg::symmetricEigen(all, stiffness);
        for (PetscInt j = 0; j < count; ++j) {
          const PetscInt last = n - 1 - j;
          modes.lambda.push_back(1 / inverse[last]);
          for (PetscInt i = 0; i < n; ++i) vectors(i, j) = all(i, last) / std::sqrt(inverse[last]);
        }
      });
  mpi::broadcast(comm, modes.lambda);
  mpi::broadcastEntries(comm, vectors.entries());
  PetscInt first = 0, end = 0;
  check(MatGetOwnershipRange(system.k0(), &first, &end));
  modes.vectors = linalg::copiedColumns(system.k0(), linalg::rowRange(vectors, first, end));
}

/// Collective. Computes the residuals and, by [M.26],
///   ε Σ K_jj d_j² / λ
/// the relative change of λ by round-off in K, whose entries may cancel in dᵀK d. If it is near
/// one, λ has no meaning.
void measureResiduals(const factor::AssociatedSystem& system, Modes& modes) {
  constexpr double noise = 1e-3;  // of λ: three digits are no frequency
  constexpr PetscInt atOnce = 32;
  const linalg::ReadColumns vectors(modes.vectors);
  const linalg::DenseView all = vectors.view();
  const PetscInt count = std::ssize(modes.lambda);
  OwnedVec diagonal = rightVector(system.k0());
  check(MatGetDiagonal(system.k0(), diagonal));
  const ReadArray k(diagonal);
  linalg::DenseMatrix sums(3, count);  // d·diag(K) d, ‖M d‖² and the square of the residual
  for (PetscInt begin = 0; begin < count; begin += atOnce) {
    const PetscInt end = std::min(begin + atOnce, count);
    const linalg::DenseView d = all.columnRange(begin, end);
    linalg::Block stiffness(d.rows()), inertia(d.rows());
    linalg::appendProduct(system.k0(), d, stiffness);
    linalg::appendProduct(system.m0(), d, inertia);
    for (PetscInt j = 0; j < end - begin; ++j)
      for (PetscInt i = 0; i < d.rows(); ++i) {
        const double rest = stiffness(i, j) - modes.lambda[begin + j] * inertia(i, j);
        sums(0, begin + j) += k[i] * d(i, j) * d(i, j);
        sums(1, begin + j) += inertia(i, j) * inertia(i, j);
        sums(2, begin + j) += rest * rest;
      }
  }
  mpi::reduce(system.comm(), sums.entries(), MPI_SUM);
  for (PetscInt i = 0; i < count; ++i) {
    const double lambda = modes.lambda[i];
    modes.rounding =
        std::max(modes.rounding, PETSC_MACHINE_EPSILON * sums(0, i) / std::abs(lambda));
    if (!(lambda > 0) || modes.rounding > noise)
      throw Error(formatted(
          "free vibration: eigenvalue %" PetscInt_FMT
          " (%g) is not positive within round-off: a body has a rigid-body mode, or nearly so",
          i + 1, lambda));
    modes.angularFrequency.push_back(std::sqrt(lambda));
    modes.relativeResidual.push_back(std::sqrt(sums(2, i) / sums(1, i)) / lambda);
  }
}

/// Returns true if the space has enough dimensions for the lanczosVectors() of block Lanczos.
bool lanczosFits(int count, int blockSize, PetscInt size) {
  return 2 * lanczosVectors(count, blockSize) <= size;
}

bool usesLanczos(const Settings& settings, PetscInt size) {
  const bool fits = lanczosFits(settings.count, settings.blockSize, size);
  if (settings.solver == Settings::Solver::blockLanczos && !fits)
    throw Error(formatted("option -modes_solver block_lanczos: %d modes of %" PetscInt_FMT
                          " unknowns are too many for block Lanczos; use eps",
                          settings.count, size));
  return settings.solver != Settings::Solver::eps && fits;
}

/// Returns true if most modes of a small problem are wanted, which leaves too few dimensions for
/// Krylov methods.
bool usesDense(const Settings& settings, PetscInt size) {
  return settings.solver == Settings::Solver::automatic && size <= 400 && 2 * settings.count > size;
}

/// Computes the residuals and, with -modes_sturm, counts the modes by the inertia. Returns false if
/// modes are missing.
bool examine(const factor::AssociatedSystem& system, const Settings& settings, Modes& modes) {
  measureResiduals(system, modes);
  if (!settings.sturm) return true;
  confirmCount(system, modes);
  return modes.countConfirmed;
}

/// Collective. Computes the modes by block Lanczos. A block of b vectors finds b copies of a
/// multiple eigenvalue: if some are missing, the block size is doubled. Returns false if this fails
/// or if modes are still missing.
bool computeByLanczos(const factor::AssociatedSystem& system, const Settings& settings,
                      Stage& stage, Modes& modes) {
  const PetscInt size = rowsOf(system.k0());
  for (int block = settings.blockSize; lanczosFits(settings.count, block, size); block *= 2) {
    Modes found;
    if (!solveByLanczos(system, settings, block, stage, found)) return false;
    const bool complete = examine(system, settings, found);
    modes = std::move(found);
    if (complete) return true;
    stage.progress(formatted(
        "the inertia counts more modes than block Lanczos has found with blocks of %d", block));
  }
  return false;
}

Modes computeBy(const factor::AssociatedSystem& system, const Settings& settings, Stage& stage) {
  constexpr PetscInt denseAtMost = 2000;
  const PetscInt size = rowsOf(system.k0());
  const bool chosen = settings.solver != Settings::Solver::automatic || solverPrefix.given();
  Modes modes;
  if (usesDense(settings, size)) {
    solveDense(system, settings.count, modes);
    examine(system, settings, modes);
    return modes;
  }
  if (usesLanczos(settings, size)) {
    if (computeByLanczos(system, settings, stage, modes)) return modes;
    if (chosen) {
      requireConverged(modes.lambda.size(), settings.count,
                       "-modes_solver eps or another -modes_block_size");
      return modes;
    }
  }
  modes = {};
  solveByEps(system, settings, stage, modes);
  if (examine(system, settings, modes) || chosen || size > denseAtMost) return modes;
  modes = {};
  solveDense(system, settings.count, modes);
  examine(system, settings, modes);
  return modes;
}

}  // namespace

TopCount countAtTop(const factor::AssociatedSystem& system, const Modes& modes) {
  const auto& w = modes.angularFrequency;
  const int below = modesBelowGap(w);
  TopCount count;
  count.shift =
      below > 0 ? 0.5 * (w[below] * w[below] + w[below - 1] * w[below - 1]) : 0.5 * w[0] * w[0];
  count.below = factor::shiftedFactor(system.k0(), system.m0(), count.shift)->inertia().negative;
  count.agrees = count.below == below;
  return count;
}

Modes compute(const factor::AssociatedSystem& system, const Settings& given, const Label& label) {
  Settings settings = given;
  const PetscInt size = rowsOf(system.k0());
  const MPI_Comm comm = commOf(system.k0());
  // Unknowns without mass have no mode.
  const PetscInt most = settings.count <= size / 2 ? size : size - factor::zeroRows(system.m0());
  if (settings.count > most) {
    if (settings.countGiven)
      throw Error(formatted("option -modes_count %d: the problem has only %" PetscInt_FMT
                            " unknowns%s",
                            settings.count, most, most < size ? " with mass" : ""));
    settings.count = most;  // the default
  }
  Stage stage(comm, label.stage);
  Modes modes = computeBy(system, settings, stage);
  if (modes.rounding > 1e-6)
    printWarning(
        comm,
        formatted(
            "free vibration: round-off in the stiffness may change the lowest eigenvalues by %.0e "
            "of their value; is a body nearly under-constrained, or a spring very stiff?",
            modes.rounding));
  stage.finish(
      label.subject +
      formatted(
          "%d modes to %.4g Hz, worst relative residual %.1e%s", settings.count,
          modes.angularFrequency.back() / (2 * M_PI),
          *std::max_element(modes.relativeResidual.begin(), modes.relativeResidual.end()),
          !settings.sturm ? ""
          : modes.countConfirmed
              ? formatted(", the lowest %d counted exactly by inertia", modes.inertiaCount).c_str()
              : ", COUNT NOT CONFIRMED BY INERTIA"));
  return modes;
}

}  // namespace squeal::modes
