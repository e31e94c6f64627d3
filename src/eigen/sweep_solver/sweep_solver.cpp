#include "eigen/sweep_solver/sweep_solver.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "algebra/factor/symmetric_solver.hpp"
#include "algebra/linalg/columns.hpp"
#include "base/session/events.hpp"
#include "base/session/stages.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"
#include "eigen/direct/direct.hpp"
#include "eigen/modes/serialization.hpp"
#include "eigen/pencil/modal_damping.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/pencil/serialization.hpp"
#include "eigen/reduction/reduced.hpp"
#include "eigen/sensitivity/sensitivity.hpp"
#include "eigen/stability/serialization.hpp"
#include "eigen/sweep/parameters.hpp"
#include "eigen/sweep/sweep.hpp"

namespace squeal::sweep_solver {
namespace {

std::vector<OwnedVec> reportedShapes(const modes::Modes& modes, Mat trial, int most) {
  std::vector<OwnedVec> shapes;
  const int count = std::min<std::size_t>(most, modes.angularFrequency.size());
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

/// Returns modes of the interior unknowns with vectors of all unknowns.
modes::Modes onAllUnknowns(const modes::Modes& interior, const subspace::Basis& basis) {
  const linalg::ReadColumns vectors(interior.vectors);
  return {interior.lambda,
          interior.angularFrequency,
          interior.relativeResidual,
          linalg::copiedColumns(basis.stiffness(), basis.prolonged(vectors.view())),
          interior.iterations,
          interior.countConfirmed,
          interior.inertiaCount,
          interior.inertiaShift,
          interior.rounding};
}

std::string pointText(const pencil::ComplexModes& point) {
  std::string text =
      formatted("%s: %d of %zu eigenvalues unstable", sweep::parameterText(point.at).c_str(),
                point.unstableCount(), point.eigenvalues.size());
  for (const auto verdict : {pencil::Verdict::undecided, pencil::Verdict::uncertified})
    if (const int count = point.count(verdict); count > 0)
      text += formatted(", %d %s", count, pencil::text(verdict));
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

/// Points that have not been solved are of no accuracy.
bool isSolved(const pencil::ComplexModes& point) { return point.accuracy > 0; }

bool hasResults(const ModalSegment& segment) {
  return std::ranges::any_of(segment.points, isSolved);
}

/// Flutter at the points of a problem, batch by batch, with one basis for all of them.
class SegmentSweep {
 public:
  SegmentSweep(SegmentProblem& problem, const Request& request, checkpoint::Checkpoint& checkpoint,
               const std::string& name)
      : problem_(problem),
        request_(request),
        pencil_(problem.pencil()),
        checkpoint_(checkpoint),
        name_(name),
        begin_(MPI_Wtime()) {
    for (auto& range : problem.ranges()) ranges_.push_back({std::move(range), pencil_.with({}), 0});
    segments_.resize(ranges_.size());
    for (double damping : request.dampings)
      for (std::size_t i = 0; i < problem.steadyPoints().size(); ++i) {
        points_.push_back(problem.steadyPoints()[i]);
        points_.back().damping = damping;
        const auto range = std::ranges::find_if(
            ranges_, [&](const auto& one) { return one.points.first <= i && i < one.points.last; });
        auto& points = segments_[range - ranges_.begin()].points;
        places_.push_back({i, std::size_t(range - ranges_.begin()), points.size()});
        points.emplace_back();
      }
    batches_ = sweep::batches(points_);
    for (const auto& batch : batches_) order_.insert(order_.end(), batch.begin(), batch.end());
    if (request.settings.direct) {  // one by one
      batches_.clear();
      for (const std::size_t i : order_) batches_.push_back({i});
    }
  }

  SolvedSegments solve() {
    if (auto finished = checkpoint_.next(name_ + "_finished")) {
      exchangeFinished(*finished);
      pointsDone(points_.size());
      return {std::move(segments_), true};
    }
    for (std::size_t k = 0; k < ranges_.size(); ++k) {
      const auto& has = ranges_[k].points.has;
      segments_[k].unknowns = problem_.system().size() + std::count(has.begin(), has.end(), 1);
      segments_[k].openNodes = ranges_[k].points.openNodes;
    }
    bool complete = true;
    try {
      solveAll();
    } catch (const Interrupted&) {
      keep();  // as it is asked to stop, all that is not yet in the checkpoint
      complete = false;
    } catch (const Error& error) {
      if (std::ranges::none_of(segments_, hasResults)) throw;
      failures_.push_back(error.what());
    }
    if (complete && std::ranges::none_of(segments_, hasResults)) throw Error(failures_.front());
    for (auto& segment : segments_) std::erase_if(segment.points, std::not_fn(isSolved));
    std::erase_if(segments_, [](const auto& segment) { return segment.points.empty(); });
    // What took long is not done again if a later segment is cut off.
    if (complete && failures_.empty() && checkpoint_.isWorth(MPI_Wtime() - begin_)) {
      checkpoint::Archive archive(pencil_.comm());
      exchangeFinished(archive);
      checkpoint_.write(name_ + "_finished", archive);
    }
    return {std::move(segments_), complete, std::move(failures_)};
  }

 private:
  /// Points with one active set.
  struct Range {
    PointRange points;
    pencil::Pencil pencil;
    int set;  // in the reduced problem
  };
  /// Where a point of the sweep stands.
  struct Place {
    std::size_t steadyPoint, range, inSegment;
  };

  void solveAll() {
    auto modes = computeModes();
    if (modes)
      pencil_.add(
          pencil::modalDamping(*modes, problem_.system().m0(), request_.settings.modalDamping));
    for (auto& range : ranges_) {
      range.pencil = pencil_.with({});
      range.pencil.add(std::move(range.points.terms));
    }
    if (modes) reduce(std::move(*modes));
    while (auto entry = checkpoint_.next(name_ + "_points")) exchangePoints(*entry);
    keep();
    stopIfAsked(pencil_.comm());
    if (ranges_.size() > 1) findModes();
    solvePoints();
    followPoints();
  }

  /// Collective. Writes to the checkpoint what has been found since the last entry, if it is time.
  void keep() {
    if (!checkpoint_.due()) return;
    if (!modesKept_) {
      checkpoint::Archive archive(pencil_.comm());
      modes::exchange(archive, freeModes(), problem_.system().k0());
      checkpoint_.write(name_ + "_modes", archive);
      modesKept_ = true;
    }
    // A compressed basis does not grow: its points are found again.
    if (reduced_ && !reduced_->grows()) return;
    checkpoint::Archive archive(pencil_.comm());
    exchangePoints(archive);
    checkpoint_.write(name_ + "_points", archive);
  }

  /// Collective. Writes the basis and the points that have been found since the last call, or adds
  /// them.
  void exchangePoints(checkpoint::Archive& archive) {
    const std::size_t before = solved_;
    archive.common(affine_, solved_, failures_);
    if (reduced_) reduced_->exchange(archive);
    bool withModes = setModesFound_ && !setModesKept_;
    archive.common(withModes);
    if (withModes) {
      for (auto& segment : segments_)
        if (!segment.points.empty())
          modes::exchange(archive, segment.modes, problem_.substructure().stiffness);
      setModesFound_ = setModesKept_ = true;
    }
    for (; exchanged_ < solved_; ++exchanged_)
      pencil::exchange(archive, pointAt(order_[exchanged_]));
    if (archive.reads()) pointsDone(solved_ - before);
  }

  /// Collective. Writes all that is reported, or sets it.
  void exchangeFinished(checkpoint::Archive& archive) {
    const Mat all = problem_.substructure().stiffness;  // of all unknowns; null: all are interior
    std::size_t count = segments_.size();
    archive.common(count);
    segments_.resize(count);
    for (auto& segment : segments_) {
      archive.common(segment.openNodes, segment.unknowns, segment.solves, segment.followed);
      modes::exchange(archive, segment.modes, all ? all : problem_.system().k0());
      std::size_t points = segment.points.size();
      archive.common(points);
      segment.points.resize(points);
      for (auto& point : segment.points) pencil::exchange(archive, point);
      if (archive.reads())
        segment.shapes = reportedShapes(segment.modes, problem_.trial(), request_.reportedModes);
    }
  }

  /// Returns the free modes of the interior unknowns.
  modes::Modes& freeModes() {
    if (!reduced_) return forLeftVectors_;
    return ranges_.size() == 1 ? segments_[0].modes : interiorModes_;
  }

  /// Collective. Returns the free modes of the interior unknowns; none with the direct method.
  std::optional<modes::Modes> computeModes() {
    const auto& settings = request_.settings;
    const bool direct = settings.direct.has_value();
    if (direct) factor::rejectUnusedSolverOptions();
    if (!settings.modes) return {};
    modes::Modes modes;
    if (auto entry = checkpoint_.next(name_ + "_modes")) {
      modes::exchange(*entry, modes, problem_.system().k0());
      modesKept_ = true;
    } else {
      modes = modes::compute(problem_.system(), *settings.modes);
    }
    if (!direct) return modes;
    forLeftVectors_ = std::move(modes);
    return {};
  }

  void reduce(modes::Modes modes) {
    Stage stage(pencil_.comm(), "flutter");
    reduced_ = std::make_unique<reduction::ReducedProblem>(
        pencil_, problem_.system(), modes, *request_.settings.reduction, problem_.substructure());
    reduced_->afterEachRound([this] {
      keep();
      stopIfAsked(pencil_.comm());
    });
    std::string text = formatted("basis of %zu free modes", modes.angularFrequency.size());
    if (ranges_.size() == 1) {
      segments_[0].shapes = reportedShapes(modes, problem_.trial(), request_.reportedModes);
      segments_[0].modes = std::move(modes);
    } else {
      for (auto& range : ranges_) range.set = reduced_->addSet(range.pencil, range.points.has);
      interiorModes_ = std::move(modes);
      text += formatted(" and %" PetscInt_FMT " constraint modes for %zu active sets",
                        reduced_->basis().boundarySize(), ranges_.size());
    }
    stage.finish(text);
  }

  /// Collective. Finds the free modes of each active set, and with them where its band ends, unless
  /// the checkpoint has them.
  void findModes() {
    for (std::size_t k = 0; k < ranges_.size(); ++k) {
      auto& segment = segments_[k];
      if (segment.points.empty()) continue;
      if (!setModesFound_) restrictModes(k);
      segment.shapes = reportedShapes(segment.modes, problem_.trial(), request_.reportedModes);
    }
    setModesFound_ = true;
  }

  void solvePoints() {
    std::size_t end = 0;
    for (const auto& batch : batches_) {
      end += batch.size();
      if (end <= solved_) continue;  // the checkpoint has them
      std::vector<reduction::PointProblem> problems;
      for (std::size_t i : batch) {
        const Range& range = ranges_[places_[i].range];
        auto terms = problem_.termsOf(places_[i].steadyPoint);
        affine_ = affine_ && terms.empty();
        problems.push_back({points_[i], range.pencil.with(std::move(terms)), range.set});
      }
      solveBatch(batch, problems);
      for (std::size_t i = 0; i < batch.size(); ++i) {
        auto& point = pointAt(batch[i]);
        if (!isSolved(point)) continue;
        problem_.examine(places_[batch[i]].steadyPoint, problems[i].pencil,
                         startSpace(problems[i], point), point);
      }
      solved_ = end;
      pointsDone(batch.size());
      keep();
      if (solved_ < points_.size()) stopIfAsked(pencil_.comm());
    }
    if (reduced_)
      for (auto& segment : segments_) segment.solves = reduced_->basis().solves();
  }

  /// Collective. Finds the free modes of one active set in the basis that all have in common.
  void restrictModes(std::size_t k) {
    Stage stage(pencil_.comm(), "modes");
    auto& segment = segments_[k];
    if (std::ranges::count(ranges_[k].points.has, 1) == 0) {
      segment.modes = onAllUnknowns(interiorModes_, reduced_->basis());
    } else {
      segment.modes = reduced_->freeModes(ranges_[k].set, pencil_);
    }
    const auto& residuals = segment.modes.relativeResidual;
    stage.finish(formatted("%zu free modes with %" PetscInt_FMT " open nodes, residuals up to %.1e",
                           residuals.size(), segment.openNodes,
                           residuals.empty() ? 0 : std::ranges::max(residuals)));
  }

  /// Returns the lines of the sweep, with the number of the segment that each begins in.
  std::vector<std::pair<stability::Line, std::size_t>> lines() const {
    std::vector<std::pair<stability::Line, std::size_t>> found;
    for (std::size_t first = 0, last = 0; first < points_.size(); first = last) {
      stability::Line line;
      line.at = points_[first];
      line.modes = &segments_[places_[first].range].modes;
      do {
        line.swept.push_back(points_[last++].friction);
      } while (last < points_.size() && sweep::growsInFriction(points_[last - 1], points_[last]));
      line.at.friction = 0;
      const std::size_t from = places_[first].steadyPoint;
      line.before = problem_.frictionBefore(from);
      for (const auto& piece : problem_.path(from, last - first)) {
        const Range& range = ranges_[piece.range];
        const auto number =
            std::count_if(ranges_.begin(), ranges_.begin() + piece.range + 1,
                          [](const auto& one) { return one.points.first < one.points.last; });
        const bool isPassed = range.points.first == range.points.last;
        line.pieces.push_back({sourceOf(range), {piece.from}, isPassed ? 0 : int(number)});
        auto& frictions = line.pieces.back().frictions;
        for (double friction : line.swept)
          if (piece.from < friction && friction < piece.to) frictions.push_back(friction);
        if (piece.to > piece.from) frictions.push_back(piece.to);
      }
      found.emplace_back(std::move(line), places_[first].range);
    }
    return found;
  }

  tracking::ProblemSource sourceOf(const Range& range) const {
    const auto problemAt = [this, &range](const sweep::Parameters& at) {
      std::optional<reduction::PointProblem> problem;
      if (affine_)
        problem.emplace(reduction::PointProblem{at, range.pencil.with({}), range.set});
      else if (auto terms = problem_.termsAt(at, range.points.first))
        problem.emplace(
            reduction::PointProblem{at, range.pencil.with(std::move(*terms)), range.set});
      return problem;
    };
    return {range.pencil, problemAt, affine_, range.set};
  }

  /// Collective. Follows the eigenvalues over the friction and finds critical frictions, if that is
  /// wanted and there is something to follow.
  void followPoints() {
    const stability::Settings& settings = request_.settings.stability;
    if (!settings.track) return;
    std::vector<stability::Line> all;
    std::vector<std::size_t> begins;
    for (auto& [line, range] : lines()) {
      if (!stability::worthFollowing(line, settings.requested)) continue;
      all.push_back(std::move(line));
      begins.push_back(range);
    }
    const std::string nothing =
        reduced_ ? stability::nothingToFollow(*reduced_, all) : "-flutter_method direct";
    if (!nothing.empty()) {
      if (settings.requested) say(pencil_.comm(), "track: nothing to follow (" + nothing + ")");
      return;
    }
    if (!affine_ && !settings.requested)  // each friction put in between costs a steady state
                                          // and terms of its own
      return say(
          pencil_.comm(),
          "track: not done where terms follow the steady state, unless -flutter_track is given");
    Stage stage(pencil_.comm(), "track");
    auto followed = stability::followSweep(*reduced_, all, settings, pencil_.comm(),
                                           [&](const std::string& text) {
                                             stage.progress(text);
                                             stopIfAsked(pencil_.comm());
                                           });
    std::size_t branches = 0, stations = 0, criticals = 0;
    for (std::size_t i = 0; i < followed.size(); ++i) {
      branches += followed[i].branches.count;
      stations += followed[i].branches.stations.size();
      criticals += followed[i].criticals.size();
      segments_[begins[i]].followed.push_back(std::move(followed[i]));
    }
    stage.finish(
        formatted("%zu branches followed over %zu frictions, %zu critical frictions, basis of "
                  "%" PetscInt_FMT,
                  branches, stations, criticals, reduced_->basisSize()));
  }

  /// Collective. Solves points together, or throws Error.
  std::vector<pencil::ComplexModes> solved(const std::vector<reduction::PointProblem>& problems) {
    std::vector<pencil::ComplexModes> points;
    if (reduced_)
      points = reduced_->solve(problems, problem_.trial());
    else
      for (const auto& problem : problems)
        points.push_back(direct::solveDirect(problem.pencil, problem.at, problem_.trial(),
                                             *request_.settings.direct));
    for (const auto& point : points) requireFiniteEigenvalues(point);
    return points;
  }

  void noteFailure(const sweep::Parameters& point, const std::string& what) {
    const std::string at = sweep::parameterText(point);
    failures_.push_back(what.find(at) == std::string::npos ? at + ": " + what : what);
  }

  /// Collective. Solves a point, or notes why it has no result.
  void solveAlone(std::size_t i, const reduction::PointProblem& problem) try {
    std::vector<reduction::PointProblem> alone;
    alone.push_back({problem.at, problem.pencil.with({}), problem.set});
    pointAt(i) = std::move(solved(alone).front());
  } catch (const Error& error) {
    noteFailure(problem.at, error.what());
  }

  /// Collective. Solves points together, or, if that fails, one by one, so that one of them does
  /// not take the others with it.
  void solveBatch(const std::vector<std::size_t>& batch,
                  const std::vector<reduction::PointProblem>& problems) {
    Stage stage(pencil_.comm(), "flutter");
    try {
      auto points = solved(problems);
      for (std::size_t i = 0; i < batch.size(); ++i) pointAt(batch[i]) = std::move(points[i]);
    } catch (const Error& error) {
      if (points_.size() == 1) throw;
      if (batch.size() == 1) {
        noteFailure(problems.front().at, error.what());
      } else {
        for (std::size_t i = 0; i < batch.size(); ++i) solveAlone(batch[i], problems[i]);
      }
    }
    for (const std::size_t i : batch)
      if (isSolved(pointAt(i))) stage.say(pointText(pointAt(i)));
    std::string text = formatted("%zu points", batch.size());
    if (reduced_)
      text += formatted(", basis of %" PetscInt_FMT ", %ld solves", reduced_->basisSize(),
                        reduced_->basis().solves());
    stage.finish(text);
  }

  pencil::ComplexModes& pointAt(std::size_t i) {
    return segments_[places_[i].range].points[places_[i].inSegment];
  }

  /// Returns where the search for the left vectors of the shapes kept begins.
  sensitivity::StartSpace startSpace(const reduction::PointProblem& problem,
                                     const pencil::ComplexModes& point) const {
    if (!request_.settings.sensitivity.wanted || point.shapes.empty()) return {};
    if (!reduced_) return {forLeftVectors_.vectors.share(), problem_.system().m0(), {}};
    return {reduced_->basis().vectors(), problem_.system().k0(), reduced_->project(problem)};
  }

  SegmentProblem& problem_;
  const Request& request_;
  pencil::Pencil pencil_;  // of all points
  std::vector<Range> ranges_;
  std::vector<sweep::Parameters> points_;
  std::vector<Place> places_;           // [point]
  std::vector<ModalSegment> segments_;  // [range]
  modes::Modes forLeftVectors_;         // with the direct method, which has no modes of its own
  modes::Modes interiorModes_;          // where several active sets share the basis
  std::unique_ptr<reduction::ReducedProblem> reduced_;
  bool affine_ = true;                 // no point has terms of its own
  std::vector<std::string> failures_;  // of points and stages
  checkpoint::Checkpoint& checkpoint_;
  std::string name_;        // of its logs
  double begin_;            // s
  bool modesKept_ = false;  // the checkpoint has the modes
  // Those of the active sets, where these share the basis:
  bool setModesFound_ = false, setModesKept_ = false;
  std::size_t solved_ = 0;                         // points that have been solved and examined
  std::size_t exchanged_ = 0;                      // those of them that the checkpoint has
  std::vector<std::vector<std::size_t>> batches_;  // of points, as they are solved
  std::vector<std::size_t> order_;                 // the same without the ends of the batches
};

}  // namespace

SolvedSegments solveSegments(SegmentProblem& problem, const Request& request,
                             checkpoint::Checkpoint& checkpoint, const std::string& name) {
  return SegmentSweep(problem, request, checkpoint, name).solve();
}

}  // namespace squeal::sweep_solver
