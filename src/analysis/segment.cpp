#include "analysis/segment.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "direct/direct.hpp"
#include "flutter/terms.hpp"
#include "linalg/symmetric_solver.hpp"
#include "options/options.hpp"
#include "pencil/pencil.hpp"
#include "petsc/text.hpp"
#include "reduction/reduced.hpp"
#include "sensitivity/sensitivity.hpp"
#include "session/stages.hpp"
#include "sweep/parameters.hpp"
#include "sweep/sweep.hpp"

namespace squeal::analysis {
namespace {

const IntegerOption modesShown("report", "report_modes", 10, 0, 100'000,
                               "number of free modes written as fields");

std::vector<OwnedVec> reportedShapes(const modes::Modes& modes, Mat trial) {
  std::vector<OwnedVec> shapes;
  const int count = std::min<std::size_t>(modesShown.get(), modes.angularFrequency.size());
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

std::string pointText(const pencil::ComplexModes& point) {
  std::string text =
      formatted("%s: %d of %zu eigenvalues unstable", sweep::parameterText(point.at).c_str(),
                point.unstableCount(), point.eigenvalues.size());
  if (point.bandTop > 0 && std::isfinite(point.bandTop))
    text += formatted(" to %.4g Hz", point.bandTop / (2 * M_PI));
  text += formatted(", worst backward error %.1e", point.worstBackwardError());
  if (point.tolerance > 0) text += formatted(", estimated error %.1e", point.worstErrorEstimate());
  return text;
}

/// Throws Error if an eigenvalue is not finite: overflow within the eigenvalue problems must not
/// become a row of the results.
void requireFiniteEigenvalues(const pencil::ComplexModes& point) {
  for (const auto& e : point.eigenvalues)
    if (!std::isfinite(e.s.real()) || !std::isfinite(e.s.imag()) || !std::isfinite(e.backwardError))
      throw Error("an eigenvalue at " + sweep::parameterText(point.at) +
                  " is not a finite number; check the magnitudes of materials and factors");
}

/// Flutter at the points of a segment, batch by batch.
class SegmentSweep {
 public:
  SegmentSweep(SegmentProblem& problem, const std::vector<double>& dampings)
      : problem_(problem), pencil_(problem.pencil()) {
    for (double damping : dampings)
      for (sweep::Parameters at : problem.steadyPoints()) {
        at.damping = damping;
        points_.push_back(at);
      }
  }

  void computeModes(ModalSegment& segment) {
    const bool direct = direct::directWanted();
    if (direct) directly_ = direct::Options::given();
    if (direct) linalg::rejectUnusedSolverOptions();
    if (direct && !sensitivity::sensitivitiesWanted()) return;
    modes::Modes modes = modes::compute(problem_.system());
    if (direct) {
      forLeftVectors_ = std::move(modes);
      return;
    }
    segment.modes = std::move(modes);
    segment.shapes = reportedShapes(segment.modes, problem_.trial());
    pencil_.add(flutter::modalDamping(segment.modes, problem_.system().m0()));
    Stage stage(pencil_.comm(), "flutter");
    reduced_ =
        std::make_unique<reduction::ReducedProblem>(pencil_, problem_.system(), segment.modes);
    stage.finish(formatted("basis of %" PetscInt_FMT " free modes", reduced_->basisSize()));
  }

  void solvePoints(ModalSegment& segment) {
    segment.points.resize(points_.size());
    for (const auto& batch : sweep::batches(points_)) {
      std::vector<reduction::PointProblem> problems;
      for (std::size_t i : batch) {
        auto terms = problem_.termsOf(i % problem_.steadyPoints().size());
        affine_ = affine_ && terms.empty();
        problems.push_back({points_[i], pencil_.with(std::move(terms))});
      }
      solveBatch(batch, problems, segment);
      for (std::size_t i = 0; i < batch.size(); ++i)
        problem_.examine(batch[i] % problem_.steadyPoints().size(), problems[i].pencil,
                         startSpace(problems[i], segment.points[batch[i]]),
                         segment.points[batch[i]]);
    }
    if (reduced_) segment.solves = reduced_->basis().solves();
  }

  /// Collective. Follows the eigenvalues over the friction and finds critical frictions, if that is
  /// wanted and there is something to follow.
  void followPoints(ModalSegment& segment) {
    if (!tracking::trackWanted()) return;
    const std::string nothing =
        reduced_ ? tracking::nothingToFollow(*reduced_, segment.points) : "-flutter_method direct";
    if (!nothing.empty()) {
      if (tracking::trackAsked()) say(pencil_.comm(), "track: nothing to follow (" + nothing + ")");
      return;
    }
    if (!affine_ && !tracking::trackAsked())  // each friction put in between costs a steady state
                                              // and terms of its own
      return say(
          pencil_.comm(),
          "track: not done where terms follow the steady state, unless -flutter_track is given");
    Stage stage(pencil_.comm(), "track");
    const auto problemAt = [&](const sweep::Parameters& at) {
      std::optional<reduction::PointProblem> problem;
      if (affine_) {
        problem.emplace(reduction::PointProblem{at, pencil_.with({})});
      } else if (auto terms = problem_.termsAt(at)) {
        problem.emplace(reduction::PointProblem{at, pencil_.with(std::move(*terms))});
      }
      return problem;
    };
    segment.followed = tracking::followSweep(
        *reduced_, segment.points, segment.modes, pencil_.comm(), {pencil_, problemAt, affine_},
        [&](const std::string& text) { stage.progress(text); });
    std::size_t branches = 0, stations = 0, criticals = 0;
    for (const auto& followed : segment.followed) {
      branches += followed.branches.count;
      stations += followed.branches.stations.size();
      criticals += followed.criticals.size();
    }
    stage.finish(
        formatted("%zu branches followed over %zu frictions, %zu critical frictions, basis of "
                  "%" PetscInt_FMT,
                  branches, stations, criticals, reduced_->basisSize()));
  }

 private:
  void solveBatch(const std::vector<std::size_t>& batch,
                  const std::vector<reduction::PointProblem>& problems, ModalSegment& segment) {
    Stage stage(pencil_.comm(), "flutter");
    std::vector<pencil::ComplexModes> solved;
    if (reduced_) solved = reduced_->solve(problems, problem_.trial());
    for (std::size_t i = 0; i < batch.size(); ++i) {
      auto& point = segment.points[batch[i]];
      point = reduced_ ? std::move(solved[i])
                       : direct::solveDirect(problems[i].pencil, problems[i].at, problem_.trial(),
                                             *directly_);
      requireFiniteEigenvalues(point);
      stage.say(pointText(point));
    }
    std::string text = formatted("%zu points", batch.size());
    if (reduced_)
      text += formatted(", basis of %" PetscInt_FMT ", %ld solves", reduced_->basisSize(),
                        reduced_->basis().solves());
    stage.finish(text);
  }

  /// Returns where the search for the left vectors of the shapes kept begins.
  sensitivity::StartSpace startSpace(const reduction::PointProblem& problem,
                                     const pencil::ComplexModes& point) const {
    if (!sensitivity::sensitivitiesWanted() || point.shapes.empty()) return {};
    if (!reduced_) return {forLeftVectors_.vectors.share(), problem_.system().m0(), {}};
    return {reduced_->basis().vectors(), problem_.system().k0(), reduced_->project(problem)};
  }

  SegmentProblem& problem_;
  pencil::Pencil pencil_;
  std::vector<sweep::Parameters> points_;
  modes::Modes forLeftVectors_;  // with the direct method, which has no modes of its own
  std::unique_ptr<reduction::ReducedProblem> reduced_;
  std::optional<direct::Options> directly_;  // without a reduced problem
  bool affine_ = true;                       // no point has terms of its own
};

}  // namespace

ModalSegment solveSegment(SegmentProblem& problem, const std::vector<double>& dampings) {
  ModalSegment segment;
  segment.unknowns = problem.system().size();
  SegmentSweep sweep(problem, dampings);
  sweep.computeModes(segment);
  sweep.solvePoints(segment);
  sweep.followPoints(segment);
  return segment;
}

}  // namespace squeal::analysis
