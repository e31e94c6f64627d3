// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/matrix_route.hpp"

#include <algorithm>

#include "base/options/options.hpp"
#include "base/session/stages.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"
#include "eigen/sensitivity/derive.hpp"
#include "eigen/sensitivity/settings.hpp"
#include "eigen/sweep_solver/sweep_solver.hpp"
#include "problem/matrices/associated.hpp"
#include "problem/matrices/write.hpp"
#include "run/analysis/checks.hpp"

namespace squeal::analysis {
namespace {

/// The problem of matrices from files, for all points of the sweep.
class MatrixSweep : public sweep_solver::SweepProblem {
 public:
  /// Collective. Borrows the system, shares the terms of the pencil, and takes the points.
  MatrixSweep(const factor::AssociatedSystem& matrices, const pencil::Pencil& terms,
              std::vector<sweep::Parameters> points, bool derives)
      : derives_(derives) {
    PetscInt local = 0;
    check(MatGetLocalSize(matrices.k0(), &local, nullptr));
    check(MatCreateConstantDiagonal(matrices.comm(), local, local, PETSC_DETERMINE, PETSC_DETERMINE,
                                    1, identity_.out()));
    system = &matrices;
    trial = identity_;
    ranges.push_back({.first = 0, .last = points.size()});
    pencil = terms.with({});
    steadyPoints = std::move(points);
  }
  void examine(std::size_t, const pencil::Pencil& ofPoint, const sensitivity::StartSpace& start,
               pencil::ComplexModes& point) override {
    if (derives_) sensitivity::deriveParameters(point, ofPoint, start, *system);
  }

 private:
  OwnedMat identity_;
  bool derives_;  // the sensitivities
};

}  // namespace

std::vector<matrices::NamedTerm> readMatrices(MPI_Comm comm, const Settings& settings,
                                              const sweep::Sweep& sweep) {
  Stage stage(comm, "matrices");
  auto named = matrices::readTerms(comm, settings.matrices);
  rejectIdleFactors(named, settings.pencil, sweep);
  requireFiniteSweep(named, sweep);
  std::vector<std::string> files;
  for (const auto& item : named)
    files.push_back(resolvedOptions().at("matrices_" + item.name + "_file"));
  stage.finish(formatted("%zu matrices: %s", named.size(), joined(files).c_str()));
  return named;
}

void solveMatrices(Analysis& analysis) {
  auto named = readMatrices(analysis.comm, analysis.settings, analysis.sweep);
  Stage stage(analysis.comm, "matrices");
  const matrices::SymmetricPart symmetric = matrices::symmetricPart(named);
  stage.finish(formatted(
      "%" PetscInt_FMT " unknowns%s", symmetric.system.size(),
      symmetric.asymmetry > 0
          ? formatted("; stiffness without friction unsymmetric by %.1e: free modes of its "
                      "symmetric part",
                      symmetric.asymmetry)
                .c_str()
          : ""));
  warnOfDenseWork(analysis.comm, analysis.settings, analysis.sweep, symmetric.system.size());
  std::vector<pencil::Term> terms;
  for (auto& item : named) terms.push_back(std::move(item.term));
  const pencil::Pencil pencil(std::move(terms));
  const auto points = analysis.sweep.steadyPoints();
  if (const auto& settings = analysis.settings.matrixExport; settings.wanted())
    matrices::exportPencil(pencil, settings, analysis.sweep, points.size());
  MatrixSweep problem(symmetric.system, pencil, points,
                      analysis.settings.solver.sensitivity.wanted);
  auto solved =
      sweep_solver::solveSweep(problem, requestOf(analysis), analysis.checkpoint, "matrices");
  analysis.segments = std::move(solved.segments);
  for (const auto& failure : solved.failures) addFailure(analysis, "flutter: " + failure);
  if (!solved.complete) throw Interrupted();
}

}  // namespace squeal::analysis
