// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/sweep_solver.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>

#include "algebra/factor/symmetric_solver.hpp"
#include "algebra/linalg/columns.hpp"
#include "base/session/events.hpp"
#include "base/session/stages.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"
#include "eigen/pencil/modal_damping.hpp"
#include "eigen/reduction/reduced.hpp"
#include "eigen/sweep/parameters.hpp"
#include "eigen/sweep_solver/journal.hpp"
#include "eigen/sweep_solver/list_proof.hpp"
#include "eigen/sweep_solver/mode_shapes.hpp"
#include "eigen/sweep_solver/point_solution.hpp"
#include "eigen/sweep_solver/point_text.hpp"
#include "eigen/sweep_solver/set_modes.hpp"
#include "eigen/sweep_solver/sweep_lines.hpp"
#include "eigen/sweep_solver/sweep_plan.hpp"

namespace squeal::sweep_solver {
namespace {

/// The eigenvalues at the points of a problem, batch by batch, with a common basis.
class SweepSolver {
 public:
  SweepSolver(SweepProblem& problem, const Request& request, checkpoint::Checkpoint& checkpoint,
              const std::string& name)
      : problem_(problem),
        request_(request),
        pencil_(problem.pencil->with({})),
        plan_(planOf(problem, request.dampings, !request.settings.direct)),
        journal_(checkpoint, name, problem, plan_, state_) {
    state_.segments.resize(problem.ranges.size());
    for (std::size_t k = 0; k < problem.ranges.size(); ++k) sets_.push_back({pencil_.with({}), 0});
    for (const auto& place : plan_.places) state_.segments[place.range].points.emplace_back();
  }

  SolvedSweep solve() {
    if (journal_.restoreFinished()) {
      for (auto& segment : state_.segments) segment.shapes = shapesOf(segment.modes);
      return {std::move(state_.segments), true};
    }
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      const auto& has = problem_.ranges[k].has;
      state_.segments[k].unknowns = problem_.system->size() + std::count(has.begin(), has.end(), 1);
      state_.segments[k].openNodes = problem_.ranges[k].openNodes;
    }
    bool complete = true;
    std::string failure;
    try {
      solveAll();
    } catch (const Interrupted&) {
      record();  // before it stops: all results that the checkpoint lacks
      complete = false;
    } catch (const Error& error) {
      failure = error.what();
    }
    dropRepeated();
    if (complete && std::ranges::none_of(state_.segments, hasResults))
      throw Error(failure.empty() ? state_.failures.front() : failure);
    if (!failure.empty()) state_.failures.push_back(failure);
    for (auto& segment : state_.segments) std::erase_if(segment.points, std::not_fn(isSolved));
    keepTrackedLines(state_.segments);
    std::erase_if(state_.segments, [](const auto& segment) { return segment.points.empty(); });
    if (complete && state_.failures.empty()) journal_.recordFinished();
    return {std::move(state_.segments), complete, std::move(state_.failures)};
  }

 private:
  /// The points with one active set.
  struct Set {
    // Without the terms of the set if it is passed: there may be hundreds of such sets.
    pencil::Pencil pencil;
    int number;  // in the reduced problem
  };

  /// Collective. Returns the terms of all points and those of a range.
  pencil::Pencil withTermsOf(std::size_t range) const {
    pencil::Pencil all = pencil_.with({});
    if (const auto& terms = problem_.ranges[range].terms) all.add(terms());
    return all;
  }

  /// Collective. Returns the terms that all points of a range have.
  pencil::Pencil pencilOf(std::size_t range) const {
    return problem_.ranges[range].isPassed() ? withTermsOf(range) : sets_[range].pencil.with({});
  }

  void solveAll() {
    auto modes = computeModes();
    if (modes)
      pencil_.add(
          pencil::modalDamping(*modes, problem_.system->m0(), request_.settings.modalDamping));
    for (std::size_t k = 0; k < sets_.size(); ++k)
      if (!problem_.ranges[k].isPassed()) sets_[k].pencil = withTermsOf(k);
    if (modes) reduce(std::move(*modes));
    journal_.restorePoints(reduced_.get());
    record();
    stopIfRequested(pencil_.comm());
    if (sets_.size() > 1) findModes();
    solvePoints();
    trackPoints();
    provePoints();
  }

  /// Drops the points whose results belong to the preceding problem.
  void dropRepeated() {
    for (std::size_t i = 0; i < plan_.places.size(); ++i)
      if (!plan_.places[i].isOwn) pointAt(i) = {};
  }

  void record() { journal_.record(freeModes(), reduced_.get()); }

  std::vector<OwnedVec> shapesOf(const modes::Modes& modes) const {
    return reportedShapes(modes, problem_.trial, request_.reportedModes);
  }

  /// Returns the free modes of the interior unknowns.
  modes::Modes& freeModes() {
    if (!reduced_) return forLeftVectors_;
    return sets_.size() == 1 ? state_.segments[0].modes : interiorModes_;
  }

  /// Collective. Returns the free modes of the interior unknowns; none with the direct method.
  std::optional<modes::Modes> computeModes() {
    const auto& settings = request_.settings;
    if (settings.direct) factor::rejectUnusedSolverOptions();
    if (!settings.modes) return {};
    auto modes = journal_.restoredModes();
    if (!modes) modes = modes::compute(*problem_.system, *settings.modes);
    if (!settings.direct) return modes;
    forLeftVectors_ = std::move(*modes);
    leftColumns_.emplace(forLeftVectors_.vectors);
    return {};
  }

  void reduce(modes::Modes modes) {
    Stage stage(pencil_.comm(), "flutter");
    reduced_ = std::make_unique<reduction::ReducedProblem>(
        pencil_, *problem_.system, modes, *request_.settings.reduction, problem_.substructure);
    reduced_->afterEachRound([this] {
      if (isRepeating_) return;  // a resumed run may repeat other points
      record();
      stopIfRequested(pencil_.comm());
    });
    std::string text = formatted("basis of %zu free modes", modes.angularFrequency.size());
    if (sets_.size() == 1) {
      state_.segments[0].shapes = shapesOf(modes);
      state_.segments[0].modes = std::move(modes);
    } else {
      if (std::ranges::any_of(problem_.ranges, &PointRange::isPassed))
        reduced_->setFactors(problem_.releasedFriction());
      for (std::size_t k = 0; k < sets_.size(); ++k) {
        const auto& has = problem_.ranges[k].has;
        sets_[k].number = problem_.ranges[k].isPassed()
                              ? reduced_->addPassedSet([this, k] { return withTermsOf(k); }, has,
                                                       problem_.ranges[k].slidingRows)
                              : reduced_->addSet(sets_[k].pencil, has);
      }
      interiorModes_ = std::move(modes);
      text += formatted(" and %" PetscInt_FMT " constraint modes for %zu active sets",
                        reduced_->basis().boundarySize(), sets_.size());
    }
    stage.finish(text);
  }

  /// Collective. Computes the free modes of each active set, which set the top of its band, unless
  /// the checkpoint contains them.
  void findModes() {
    if (!state_.hasSetModes) {
      std::vector<int> numbers;
      for (const auto& set : sets_) numbers.push_back(set.number);
      auto modes = modesOfSets(*reduced_, pencil_, problem_, interiorModes_, numbers);
      for (std::size_t k = 0; k < modes.size(); ++k) state_.segments[k].modes = std::move(modes[k]);
    }
    for (auto& segment : state_.segments)
      if (!segment.points.empty()) segment.shapes = shapesOf(segment.modes);
    state_.hasSetModes = true;
  }

  /// Collective. Returns the problem of a point with all its terms.
  reduction::PointProblem problemOf(std::size_t i) const {
    const Set& set = sets_[plan_.places[i].range];
    return {plan_.points[i], set.pencil.with(problem_.termsOf(plan_.places[i].steadyPoint)),
            set.number};
  }

  void solvePoints() {
    std::size_t end = 0;
    for (const auto& batch : plan_.batches) {
      end += batch.size();
      if (end <= state_.solved) continue;  // the checkpoint contains them
      solveAndExamine(batch);
      pointsDone(plan_.own(state_.solved, end));
      state_.solved = end;
      record();
      if (state_.solved < plan_.points.size()) stopIfRequested(pencil_.comm());
    }
    if (reduced_)
      for (auto& segment : state_.segments) segment.solves = reduced_->basis().solves();
  }

  /// Collective. Solves points together, and examines those that have results here.
  void solveAndExamine(const std::vector<std::size_t>& batch) {
    std::vector<reduction::PointProblem> problems;
    for (std::size_t i : batch) {
      problems.push_back(problemOf(i));
      const pencil::Pencil& all = problems.back().pencil;
      state_.affine = state_.affine && all.affineCount() == all.terms().size();
    }
    solveBatch(batch, problems);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      auto& point = pointAt(batch[i]);
      if (!isSolved(point) || !plan_.places[batch[i]].isOwn) continue;
      problem_.examine(plan_.places[batch[i]].steadyPoint, problems[i].pencil,
                       startSpace(problems[i], point), point);
    }
  }

  tracking::ProblemSource sourceOf(std::size_t range) const {
    const int set = sets_[range].number;
    const auto problemAt = [this, range, set](const sweep::Parameters& at) {
      std::optional<reduction::PointProblem> problem;
      if (state_.affine)
        problem.emplace(reduction::PointProblem{at, pencilOf(range), set});
      else if (auto point = problem_.between(at, range))
        problem.emplace(
            reduction::PointProblem{at, pencilOf(range).with(std::move(point->terms)), set});
      return problem;
    };
    return {[this, range] { return pencilOf(range); }, problemAt, state_.affine, set};
  }

  /// Collective. Tracks the eigenvalues over the friction and finds critical frictions, if that is
  /// requested and possible.
  void trackPoints() {
    const stability::Settings& settings = request_.settings.stability;
    if (!settings.track) return;
    std::vector<stability::Line> all;
    std::vector<std::size_t> begins;
    const auto source = [this](std::size_t range) { return sourceOf(range); };
    for (auto& [line, range] : linesOf(problem_, plan_, state_, source)) {
      if (!stability::worthTracking(line, settings.requested)) continue;
      all.push_back(std::move(line));
      begins.push_back(range);
    }
    const std::string nothing =
        reduced_ ? stability::whyNotTracked(*reduced_, all) : "-flutter_method direct";
    if (!nothing.empty()) {
      if (settings.requested)
        printLine(pencil_.comm(), "track: nothing to track (" + nothing + ")");
      return;
    }
    if (!state_.affine && !settings.requested)  // each friction put in between costs a steady state
                                                // and terms of its own
      return printLine(pencil_.comm(),
                       "track: omitted because the terms depend on the steady state; "
                       "-flutter_track on enables it");
    auto tracked = trackedLines(problem_, *reduced_, all, request_.settings);
    for (std::size_t i = 0; i < tracked.size(); ++i)
      state_.segments[begins[i]].trackedLines.push_back(std::move(tracked[i]));
  }

  /// Collective. Proves that the lists of the points are complete, if that is wanted. Points whose
  /// lists seem to be wrong are solved once more.
  void provePoints() {
    if (!reduced_ || !request_.settings.proof.wanted) return;
    stopIfRequested(pencil_.comm());
    std::vector<std::size_t> points;
    for (std::size_t i = 0; i < plan_.points.size(); ++i)
      if (isSolved(pointAt(i)) && plan_.places[i].isOwn) points.push_back(i);
    proveListsOf(points);
    std::erase_if(points, [this](std::size_t i) {
      return !mayLackEigenvalues(pointAt(i), reduced_->band());
    });
    if (!points.empty()) correctLists(points);
    for (const std::size_t i : points)
      std::ranges::move(faultsOf(pointAt(i)), std::back_inserter(state_.failures));
  }

  /// Collective. Proves that the lists of these points are complete.
  void proveListsOf(const std::vector<std::size_t>& points) {
    std::vector<ListedPoint> listed;
    for (const std::size_t i : points)
      listed.push_back({plan_.places[i], problemOf(i), &pointAt(i)});
    proveLists(problem_, *reduced_, freeModes(), std::move(listed),
               {.settings = request_.settings.proof,
                .modes = *request_.settings.modes,
                .afterPoints = [this] { record(); }});
  }

  /// Collective. Solves these points again, in the basis that the proof has extended, and proves
  /// the new lists. All eigenvalues are then tracked again.
  void correctLists(const std::vector<std::size_t>& points) {
    printLine(pencil_.comm(),
              formatted("proof: %zu points with doubtful lists are solved again", points.size()));
    for (const auto& batch : plan_.batches) {
      const auto some = commonPoints(batch, points);
      if (some.empty()) continue;
      std::vector<pencil::ComplexModes*> modes;
      for (const std::size_t i : some) modes.push_back(&pointAt(i));
      isRepeating_ = true;
      const std::string failure = solveAgain(modes, [&] { solveAndExamine(some); });
      isRepeating_ = false;
      if (!failure.empty()) state_.failures.push_back(failure);
      stopIfRequested(pencil_.comm());
    }
    journal_.replace(points);
    proveListsOf(points);
    for (auto& segment : state_.segments) segment.trackedLines.clear();
    trackPoints();
  }

  void recordFailure(std::size_t i, const std::string& what) {
    const std::string at = sweep::parameterText(plan_.points[i]);
    std::string text = what.find(at) == std::string::npos ? at + ": " + what : what;
    if (!plan_.places[i].isOwn) text = "solved again for the continuation of branches: " + text;
    state_.failures.push_back(std::move(text));
  }

  /// Collective. Solves a point, or records the reason why it has no result.
  void solveSingle(std::size_t i, const reduction::PointProblem& problem) try {
    std::vector<reduction::PointProblem> single;
    single.push_back({problem.at, problem.pencil.with({}), problem.set});
    pointAt(i) =
        std::move(solvedPoints(reduced_.get(), single, problem_.trial, request_.settings).front());
  } catch (const Error& error) {
    recordFailure(i, error.what());
  }

  /// Collective. Solves points together or, if that fails, one by one, so a failure affects only
  /// its own point.
  void solveBatch(const std::vector<std::size_t>& batch,
                  const std::vector<reduction::PointProblem>& problems) {
    Stage stage(pencil_.comm(), "flutter");
    try {
      auto points = solvedPoints(reduced_.get(), problems, problem_.trial, request_.settings);
      for (std::size_t i = 0; i < batch.size(); ++i) pointAt(batch[i]) = std::move(points[i]);
    } catch (const Error& error) {
      if (plan_.points.size() == 1) throw;
      if (batch.size() == 1) {
        recordFailure(batch.front(), error.what());
      } else {
        for (std::size_t i = 0; i < batch.size(); ++i) solveSingle(batch[i], problems[i]);
      }
    }
    for (const std::size_t i : batch)
      if (isSolved(pointAt(i)))
        stage.printLine(pointText(pointAt(i)) +
                        (plan_.places[i].isOwn ? "" : "; again, for the continuation"));
    std::string text = formatted("%zu points", batch.size());
    if (reduced_)
      text += formatted(", basis of %" PetscInt_FMT ", %ld solves", reduced_->basisSize(),
                        reduced_->basis().solves());
    stage.finish(text);
  }

  pencil::ComplexModes& pointAt(std::size_t i) {
    return state_.segments[plan_.places[i].range].points[plan_.places[i].inRange];
  }

  /// Returns the start space of the search for the left vectors of the stored shapes.
  sensitivity::StartSpace startSpace(const reduction::PointProblem& problem,
                                     const pencil::ComplexModes& point) const {
    if (!request_.settings.sensitivity.wanted || point.shapes.empty()) return {};
    if (!reduced_) return {leftColumns_->view(), problem_.system->m0(), {}};
    return {reduced_->basis().columns(), problem_.system->k0(), reduced_->project(problem)};
  }

  SweepProblem& problem_;
  const Request& request_;
  pencil::Pencil pencil_;  // of all points
  SweepPlan plan_;
  SweepState state_;
  Journal journal_;
  std::vector<Set> sets_;        // [range]
  modes::Modes forLeftVectors_;  // for the direct method, which computes no modes itself
  std::optional<linalg::ReadColumns> leftColumns_;  // of these modes
  modes::Modes interiorModes_;                      // if several active sets share the basis
  std::unique_ptr<reduction::ReducedProblem> reduced_;
  bool isRepeating_ = false;  // points that the proof has found to be wrong
};

}  // namespace

SolvedSweep solveSweep(SweepProblem& problem, const Request& request,
                       checkpoint::Checkpoint& checkpoint, const std::string& name) {
  return SweepSolver(problem, request, checkpoint, name).solve();
}

}  // namespace squeal::sweep_solver
