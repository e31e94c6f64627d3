#include "segment.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

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

/// The largest friction first: its corrections nearly suffice for the others.
std::vector<std::size_t> orderOf(const std::vector<Parameters>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::rotate(order.begin(),
              std::max_element(order.begin(), order.end(), [&](auto a, auto b) { return points[a].friction < points[b].friction; }),
              order.end());
  return order;
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
    reduced = std::make_unique<flutter::ReducedProblem>(pencil, problem.m0, problem.solver(), segment.modes);
  }
  segment.points.resize(dampings.size() * steadyPoints.size());
  for (std::size_t i : orderOf(steadyPoints)) {
    pencil.setPointTerms(termsAt(i));
    for (std::size_t d = 0; d < dampings.size(); ++d) {
      Parameters at = steadyPoints[i];
      at.damping = dampings[d];
      Stage stage(pencil.comm(), "flutter");
      auto& point = segment.points[d * steadyPoints.size() + i];
      point = direct ? flutter::solveDirect(pencil, at, problem.trial) : reduced->solve(at, problem.trial);
      const bool bounded = point.bandTop > 0 && std::isfinite(point.bandTop);
      stage.finish(formatted(
          "%s: %d of %d eigenvalues unstable%s, worst backward error %.1e%s", parameterText(at).c_str(), point.unstableCount(),
          point.bandCount(), bounded ? formatted(" to %.4g Hz", point.bandTop / (2 * M_PI)).c_str() : "",
          point.worstBackwardError(), direct ? "" : formatted(", basis of %d", static_cast<int>(reduced->basisSize())).c_str()));
    }
  }
  return segment;
}

}  // namespace squeal
