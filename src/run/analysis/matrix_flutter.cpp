// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/matrix_flutter.hpp"

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
#include "run/analysis/mode_components.hpp"

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
  std::vector<pencil::CriticalMode> describe(const std::vector<pencil::ComplexMotion>& motions,
                                             const modes::Modes& modes) const override {
    return analysis::describe(*system, motions, modes);
  }
  std::optional<sweep_solver::PointBetween> between(const sweep::Parameters& at,
                                                    std::size_t) override {
    return sweep_solver::PointBetween{{}, [at](const pencil::Pencil& ofPoint) {
                                        return sensitivity::parameterForms(ofPoint, at);
                                      }};
  }

 private:
  OwnedMat identity_;
  bool derives_;  // the sensitivities
};

/// Collective. Returns the symmetric part of the matrices, and prints its size.
matrices::SymmetricPart symmetricPart(MPI_Comm comm,
                                      const std::vector<matrices::NamedTerm>& named) {
  Stage stage(comm, "matrices");
  matrices::SymmetricPart symmetric = matrices::symmetricPart(named);
  std::string asymmetry;
  if (symmetric.asymmetry > 0)
    asymmetry = formatted(
        "; stiffness without friction unsymmetric by %.1e: free modes of its symmetric part",
        symmetric.asymmetry);
  stage.finish(
      formatted("%" PetscInt_FMT " unknowns%s%s", symmetric.system.size(),
                symmetric.massless > 0
                    ? formatted(", %" PetscInt_FMT " without mass", symmetric.massless).c_str()
                    : "",
                asymmetry.c_str()));
  return symmetric;
}

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

Flutter matrixFlutter(MPI_Comm comm, const Settings& settings, const sweep::Sweep& sweep,
                      const sweep_solver::Request& request, checkpoint::Checkpoint& checkpoint) {
  Flutter found;
  found.complete = completed([&] { stopIfRequested(comm); });
  if (!found.complete) return found;
  auto named = readMatrices(comm, settings, sweep);
  const matrices::SymmetricPart symmetric = symmetricPart(comm, named);
  warnOfDenseWork(comm, settings, sweep, symmetric.system.size());
  std::vector<pencil::Term> terms;
  for (auto& item : named) terms.push_back(std::move(item.term));
  const pencil::Pencil pencil(std::move(terms));
  const auto points = sweep.steadyPoints();
  if (settings.matrixExport.wanted())
    matrices::exportPencil(pencil, settings.matrixExport, sweep, points.size());
  MatrixSweep problem(symmetric.system, pencil, points, settings.solver.sensitivity.wanted);
  auto solved = sweep_solver::solveSweep(problem, request, checkpoint, "matrices");
  found.segments = std::move(solved.segments);
  for (auto& segment : found.segments) addParticipations(symmetric.system, segment);
  for (const auto& failure : solved.failures) found.addFailure(comm, "flutter: " + failure);
  found.complete = solved.complete;
  return found;
}

}  // namespace squeal::analysis
