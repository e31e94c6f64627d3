#include "segment.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "flutter/reduced.hpp"
#include "modes/benchmark.hpp"
#include "petsc/options.hpp"
#include "petsc/stages.hpp"
#include "petsc/symmetric_solver.hpp"
#include "petsc/text.hpp"

namespace squeal {
namespace {

const IntegerOption modesShown("report", "report_modes", 10, 0, "number of free modes written as fields");
const FlagOption benchmarkWanted("modes", "modes_benchmark", false,
                                 "time one factorisation and 400 solves in blocks of 32, the floor of the stage");

std::vector<OwnedVec> reportedShapes(const modes::Modes& modes, Mat trial) {
  std::vector<OwnedVec> shapes;
  const int count = std::min(modesShown.get(), static_cast<int>(modes.angularFrequency.size()));
  for (int i = 0; i < count; ++i) {
    Vec d = nullptr;
    OwnedVec u;
    PetscReal largest = 0;
    check(MatCreateVecs(trial, nullptr, u.out()));
    check(BVGetColumn(modes.vectors, i, &d));
    check(MatMult(trial, d, u));
    check(BVRestoreColumn(modes.vectors, i, &d));
    check(VecNorm(u, NORM_INFINITY, &largest));
    check(VecScale(u, 1 / largest));
    shapes.push_back(std::move(u));
  }
  return shapes;
}

std::string pointText(const flutter::FrictionPoint& point) {
  std::string text = formatted("%s: %d of %d eigenvalues unstable", parameterText(point.at).c_str(), point.unstableCount(),
                               static_cast<int>(point.eigenvalues.size()));
  if (point.bandTop > 0 && std::isfinite(point.bandTop)) text += formatted(" to %.4g Hz", point.bandTop / (2 * M_PI));
  text += formatted(", worst backward error %.1e", point.worstBackwardError());
  if (point.tolerance > 0) text += formatted(", estimated error %.1e", point.worstErrorEstimate());
  return text;
}

}  // namespace

ModalSegment solveSegment(const SegmentProblem& problem, flutter::Pencil pencil, const std::vector<Parameters>& steadyPoints,
                          const std::vector<double>& dampings,
                          const std::function<std::vector<flutter::Term>(std::size_t)>& termsAt, double& floor) {
  ModalSegment segment;
  check(MatGetSize(problem.k0, &segment.unknowns, nullptr));
  const bool direct = flutter::directWanted();
  if (direct) rejectUnusedSolverOptions();
  std::unique_ptr<flutter::ReducedProblem> reduced;
  if (!direct) {
    segment.modes = modes::compute({problem.k0, problem.m0, problem.solver()}, problem.modes);
    if (benchmarkWanted.get()) floor = modes::floorSeconds(problem.k0);
    segment.shapes = reportedShapes(segment.modes, problem.trial);
    pencil.add(flutter::modalDamping(segment.modes, problem.m0));
    Stage stage(pencil.comm(), "flutter");
    reduced = std::make_unique<flutter::ReducedProblem>(pencil, problem.k0, problem.solver(), segment.modes);
    stage.finish(formatted("basis of %d: free modes and static responses to friction", static_cast<int>(reduced->basisSize())));
  }
  std::vector<Parameters> points;
  for (double damping : dampings)
    for (Parameters at : steadyPoints) {
      at.damping = damping;
      points.push_back(at);
    }
  segment.points.resize(points.size());
  for (const auto& batch : flutter::batches(points)) {
    Stage stage(pencil.comm(), "flutter");
    std::vector<flutter::PointProblem> problems;
    for (std::size_t i : batch) problems.push_back({points[i], pencil.with(termsAt(i % steadyPoints.size()))});
    std::vector<flutter::FrictionPoint> solved;
    if (reduced) solved = reduced->solve(problems, problem.trial);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      auto& point = segment.points[batch[i]];
      point = reduced ? std::move(solved[i]) : flutter::solveDirect(problems[i].pencil, problems[i].at, problem.trial);
      stage.say(pointText(point));
    }
    stage.finish(
        formatted("%d points", static_cast<int>(batch.size())) +
        (reduced ? formatted(", basis of %d, %ld solves", static_cast<int>(reduced->basisSize()), reduced->basis().solves()) : ""));
  }
  if (reduced) segment.solves = reduced->basis().solves();
  return segment;
}

}  // namespace squeal
