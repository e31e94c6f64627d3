// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/reduced.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "algebra/linalg/spread.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/petsc/check.hpp"
#include "base/system/process_memory.hpp"
#include "eigen/reduction/free_modes.hpp"
#include "eigen/reduction/serialization.hpp"
#include "eigen/reduction/spectrum.hpp"

namespace squeal::reduction {

ReducedProblem::ReducedProblem(const pencil::Pencil& pencil, const factor::AssociatedSystem& system,
                               const modes::Modes& modes, const Settings& settings,
                               Substructure substructure)
    : settings_(settings),
      frequencies_(modes.angularFrequency),
      basis_(pencil, system, modes, std::move(substructure)),
      band_(pencil::bandFor(modes.angularFrequency, settings.band)),
      estimator_(basis_, modes.angularFrequency, settings),
      corrector_(basis_, estimator_),
      solved_(system.comm()) {
  if (basis_.isComplete())
    band_.top = INFINITY;  // there is nothing to correct
  else if (!settings_.corrected)
    band_.top = 0;
  if (band_.top == 0) estimator_.acceptAll();
  const PetscInt boundary = basis().boundarySize();
  addSet(pencil, std::vector<unsigned char>(boundary, 0));
  if (boundary > 0) count_.emplace(basis(), modes, basis_.projectAssociated().mass);
}

int ReducedProblem::addSet(const pencil::Pencil& pencil, const std::vector<unsigned char>& has) {
  return withBand(basis_.addSet(pencil, has));
}

/// Returns the frequencies of the free modes up to a limit, rad/s.
std::vector<double> ReducedProblem::frequenciesUpTo(double top) const {
  auto frequencies = frequencies_;
  std::erase_if(frequencies, [&](double w) { return w > top; });
  return frequencies;
}

/// Gives a new set the band of the basis, and returns its index.
int ReducedProblem::withBand(int number) {
  PointSet& set = basis_.set(number);
  set.top = band_.top;
  set.modesInBand = std::ranges::count_if(frequencies_, [&](double w) { return w <= set.top; });
  return number;
}

/// Collective. Solves the dense problems of the points that are not yet accurate, and estimates
/// errors.
void ReducedProblem::solveDense(const std::vector<PointState*>& open) {
  std::vector<linalg::DenseProblem> problems;
  for (const auto* state : open) problems.push_back(basis_.project(*state));
  std::vector<SpectrumRequest> requests;
  for (std::size_t i = 0; i < open.size(); ++i) {
    PointSolution& solution = open[i]->solution;
    auto& request = requests.emplace_back(SpectrumRequest{&problems[i], &solution.spectrum, {}});
    for (std::size_t j = 0; j < solution.spectrum.band.size(); ++j)
      request.errorRatio.push_back(estimator_.errorRatio(solution, j));
  }
  solveSpectra(basis().comm(), band_, requests);
  for (std::size_t i = 0; i < open.size(); ++i) {
    estimator_.estimate(*open[i], problems[i]);
    open[i]->solvedIn = basis().size();
  }
}

/// Collective. Searches for missing eigenvalues at the points whose spectra were improved, or were
/// computed in a smaller basis. Clears the spectra of the incomplete points and returns these
/// points. In a small basis all eigenvalues of the latter are computed again; an empty list, which
/// is always accurate, too.
std::vector<PointState*> ReducedProblem::incompleteStates(std::vector<PointState>& states) {
  std::vector<PointState*> examined, open;
  std::vector<linalg::DenseProblem> problems;
  for (auto& state : states) {
    // The number of free modes is confirmed by other means.
    const bool isOutdated = state.solvedIn < basis().size() && !state.associated && band_.top > 0 &&
                            std::isfinite(band_.top);
    if (isOutdated && (basis().size() < smallestImproved || state.solution.spectrum.band.empty()))
      open.push_back(&state);
    else if (isOutdated || state.solution.spectrum.improved)
      examined.push_back(&state);
  }
  for (auto* state : open) state->solution.spectrum = {};
  for (auto* state : examined) {
    state->ownTerms.extend();
    problems.push_back(basis_.project(*state));
  }
  std::vector<SpectrumRequest> requests;
  for (std::size_t i = 0; i < examined.size(); ++i)
    requests.push_back({&problems[i], &examined[i]->solution.spectrum, {}});
  const auto are = incomplete(basis().comm(), band_, requests);
  for (std::size_t i = 0; i < examined.size(); ++i) {
    Spectrum& spectrum = examined[i]->solution.spectrum;
    spectrum.improved = false;
    examined[i]->solvedIn = basis().size();
    if (!are[i]) continue;
    spectrum = {};
    open.push_back(examined[i]);
  }
  return open;
}

/// Collective. Checks the accurate points. Returns those with underestimated errors or, if there
/// are none, those with a missing eigenvalue.
std::vector<PointState*> ReducedProblem::recheck(std::vector<PointState>& states) {
  const auto open = estimator_.unconfirmed(states);
  return open.empty() ? incompleteStates(states) : open;
}

/// Collective. Corrects the basis by the residuals of these points. Returns false if they are
/// round-off.
bool ReducedProblem::addCorrections(const std::vector<PointState*>& open) {
  std::vector<CorrectionRequest> requests;
  for (const auto* state : open) requests.push_back(corrector_.requestOf(*state));
  if (corrector_.correct(requests) == 0) return false;
  estimator_.recordCorrection();
  return true;
}

/// Collective. Calls the action of afterEachRound() before the next round, with the state of the
/// batch.
void ReducedProblem::store(const std::vector<PointState>& states,
                           const std::vector<PointState*>& open, int round, PetscInt largest) {
  if (!afterRound_ || states.front().associated) return;
  pending_.emplace(PendingBatch{.round = round, .largest = largest, .solutions = {}, .open = {}});
  for (const auto& state : states) {
    pending_->solutions.push_back(state.solution);
    pending_->open.push_back(std::ranges::find(open, &state) != open.end());
  }
  afterRound_();
  pending_.reset();
}

/// Collective. Solves at all points and corrects the basis until they are accurate.
void ReducedProblem::correct(std::vector<PointState>& states) {
  std::vector<PointState*> open;
  int round = 0;
  PetscInt largest = std::min<PetscInt>(basis().size() + settings_.growth, basis_.unknowns());
  for (auto& state : states) open.push_back(&state);
  if (pending_) {
    for (std::size_t i = 0; i < states.size(); ++i)
      states[i].solution = std::move(pending_->solutions[i]);
    std::erase_if(
        open, [&](const PointState* state) { return pending_->open[state - states.data()] == 0; });
    round = pending_->round;
    largest = pending_->largest;
    pending_.reset();
  }
  for (; !open.empty(); ++round) {
    basis_.extend(open);
    solveDense(open);
    std::erase_if(open,
                  [&](const PointState* state) { return estimator_.isAccurate(state->solution); });
    if (open.empty()) {
      open = recheck(states);
      continue;
    }
    if (round >= settings_.rounds || basis().size() >= largest) break;
    if (!addCorrections(open)) break;
    releaseFreedMemory();
    store(states, open, round + 1, largest);
  }
  if (open = incompleteStates(states); !open.empty()) {  // corrections stopped early
    basis_.extend(open);
    solveDense(open);
  }
}

void ReducedProblem::serialise(checkpoint::Archive& archive) {
  archive.common(started_);
  estimator_.serialise(archive);
  norms_.serialise(archive);
  basis_.serialise(archive);
  solved_.serialise(archive);
  bool has = pending_.has_value();
  archive.common(has);
  if (archive.reads()) pending_.reset();
  if (!has) return;
  if (!pending_) pending_.emplace();
  archive.common(pending_->round, pending_->largest, pending_->solutions, pending_->open);
}

/// Collective. Returns the unsolved points of a batch.
std::vector<PointState> ReducedProblem::statesOf(const std::vector<PointProblem>& batch) {
  std::vector<PointState> states;
  for (const auto& point : batch)
    states.push_back(basis_.state(point, pending_ ? Norms{} : norms_.compute(point)));
  return states;
}

std::vector<pencil::ComplexModes> ReducedProblem::solve(const std::vector<PointProblem>& batch,
                                                        Mat trial) {
  if (!std::exchange(started_, true) && settings_.corrected && !basis_.isComplete())
    corrector_.start(batch.front(), frequenciesUpTo(band_.top));
  std::vector<PointState> states = statesOf(batch);
  correct(states);
  for (auto& state : states)
    if (state.set->top != band_.top) state.solution.truncate(state.set->top);
  std::vector<pencil::ComplexModes> points;
  for (const auto& state : states) points.push_back(result(state));
  storeShapes(points, states, trial);
  if (settings_.compressed) {
    pod_.take(states);
    if (pod_.compress(basis_)) estimator_.dropModes();
  } else if (band_.top > 0 && std::isfinite(band_.top)) {
    solved_.store(states, basis().size());
  }
  return points;
}

/// Collective. Returns the problems of the free modes of some sets, solved and corrected together;
/// `points` have only the terms of K and M, which are the same for all.
std::vector<PointState> ReducedProblem::associatedStates(const std::vector<PointProblem>& points) {
  std::vector<PointState> states;
  if (points.empty()) return states;
  const auto& [at, pencil, set] = points.front();
  const Norms norms{pencil.norm(0, at), 0, pencil.norm(2, at)};
  for (const auto& point : points) {
    states.push_back(basis_.state(point, norms));
    states.back().associated = true;
  }
  correct(states);
  return states;
}

/// Collective. Returns all eigenvalues ω² of the problems of the free modes, [state], which are
/// distributed over the ranks.
std::vector<std::vector<double>> ReducedProblem::associatedEigenvalues(
    const std::vector<PointState>& states) const {
  const MPI_Comm comm = basis().comm();
  std::vector<std::vector<double>> values(states.size());
  linalg::onOwners(comm, states.size(), [&](std::size_t i) {
    linalg::DenseProblem problem = basis_.project(states[i]);
    values[i] = linalg::symmetricEigenvalues(std::move(problem.stiffness), std::move(problem.mass));
  });
  const int ranks = mpi::size(comm);
  for (std::size_t i = 0; i < states.size(); ++i) mpi::broadcast(comm, values[i], i % ranks);
  return values;
}

/// Collective. Sets the top of the band of a set from the eigenvalues ω² of its free modes.
void ReducedProblem::setBand(std::vector<double> values, PointSet& set) const {
  if (band_.top == 0 || !std::isfinite(band_.top)) return;
  values.resize(std::min(values.size(), frequencies_.size()));
  for (double& value : values) value = std::sqrt(std::max(value, 0.0));
  set.top = std::min(band_.top, pencil::bandBelow(values, settings_.band.top));
  set.modesInBand = std::ranges::count_if(values, [&](double w) { return w <= set.top; });
  mpi::broadcast(basis().comm(), set.top);
  mpi::broadcast(basis().comm(), set.modesInBand);
}

/// Collective. Confirms the number of free modes of each state, first by the bound that needs no
/// solve.
void ReducedProblem::confirmCounts(const std::vector<PointState>& states,
                                   const std::vector<std::vector<double>>& values,
                                   const pencil::Pencil& associated,
                                   std::vector<modes::Modes>& modes) {
  const auto isOpen = [](const modes::Modes& one) { return !one.countConfirmed; };
  while (std::ranges::any_of(modes, isOpen)) {
    for (std::size_t i = 0; i < states.size(); ++i)
      if (isOpen(modes[i]))
        confirmCount(basis().comm(), *count_,
                     {band_.top, values[i], states[i].set->space.boundary()}, modes[i]);
    if (count_->isSharp() || std::ranges::none_of(modes, isOpen)) return;
    count_->sharpen(basis_.basis(), associated.assembled(2, {}));
  }
}

std::vector<modes::Modes> ReducedProblem::freeModes(const std::vector<int>& sets,
                                                    const pencil::Pencil& pencil) {
  const pencil::Pencil associated = pencil.associated();
  std::vector<PointProblem> points;
  for (const int set : sets) points.push_back({{}, associated.with({}), set});
  const auto states = associatedStates(points);
  const auto values = associatedEigenvalues(states);
  std::vector<modes::Modes> modes;
  for (std::size_t i = 0; i < states.size(); ++i) {
    modes.push_back(reduction::freeModes(basis(), states[i], associated));
    setBand(values[i], basis_.set(sets[i]));
  }
  if (count_) confirmCounts(states, values, associated, modes);
  return modes;
}

/// Collective. Returns the eigenvalues of a point with their errors.
pencil::ComplexModes ReducedProblem::result(const PointState& state) const {
  const PointSolution& solution = state.solution;
  pencil::ComplexModes point;
  point.at = state.point->at;
  point.bandTop = state.set->top;
  point.freeModesInBand = state.set->modesInBand;
  point.damped = state.damped;
  point.accuracy = settings_.criteria.accuracy;
  point.tolerance = settings_.tolerance;
  for (std::size_t j = 0; j < solution.spectrum.band.size(); ++j) {
    auto& e = point.eigenvalues.emplace_back(
        pencil::Eigenvalue{.s = solution.spectrum.band[j].s,
                           .backwardError = solution.errors[j].backward,
                           .error = estimator_.absoluteError(solution, j)});
    e.certified = e.backwardError <= point.accuracy && estimator_.isExactEnough(solution, e);
  }
  pencil::setVerdicts(point, solution.symmetry, settings_.criteria);
  // All ranks compute the shapes together, so they must agree on the verdicts.
  mpi::broadcast(basis().comm(), point.eigenvalues);
  return point;
}

/// Collective. Stores the shapes of all points. It computes them together, since each product with
/// the basis reads the whole basis.
void ReducedProblem::storeShapes(std::vector<pencil::ComplexModes>& points,
                                 const std::vector<PointState>& states, Mat trial) const {
  std::vector<std::vector<std::size_t>> wanted;
  std::vector<std::vector<Complex>> lifted;
  for (std::size_t i = 0; i < points.size(); ++i) {
    wanted.push_back(pencil::shapesToStore(points[i], settings_.criteria));
    for (std::size_t index : wanted.back())
      lifted.push_back(states[i].set->space.lifted(states[i].solution.spectrum.band[index].q));
  }
  if (lifted.empty()) return;
  auto all = basis().expand(lifted);
  auto next = std::make_move_iterator(all.begin());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::ptrdiff_t count = wanted[i].size();
    pencil::storeShapes(points[i], trial, wanted[i], {next, next + count});
    next += count;
  }
}

linalg::DenseProblem ReducedProblem::project(const PointProblem& point) const {
  return basis_.project(basis_.state(point, {}));
}

linalg::DenseMatrix ReducedProblem::addResponses(linalg::Block forces) {
  auto energy =
      basis_.basis().addResponses(std::move(forces), basis_.projectAssociated().stiffness);
  basis_.extend({});
  return energy;
}

/// Collective. Returns the states of the points with these pairs, and sets their errors.
std::vector<PointState> ReducedProblem::measuredStates(const LocatedPairs& located,
                                                       Improvement& result) {
  std::vector<PointState> states;
  states.reserve(located.size());
  for (const auto& [point, pairs] : located) {
    basis_.load(point.set);
    PointState& state = states.emplace_back(basis_.state(point, norms_.nearby(point)));
    auto& band = state.solution.spectrum.band;
    band = pairs;
    for (auto& pair : band)  // they may belong to a smaller basis
      for (auto* vector : {&pair.q, &pair.left})
        vector->resize(state.set->space.size(basis().size()));
    estimator_.estimate(state, basis_.project(state));
    const auto& errors = state.solution.errors;
    result.backwardError.push_back(std::ranges::max(errors, {}, &PairErrors::backward).backward);
    result.roundOff.push_back(std::ranges::max(errors, {}, &PairErrors::roundOff).roundOff);
  }
  return states;
}

Improvement ReducedProblem::errorsOf(const LocatedPairs& located) {
  Improvement result;
  measuredStates(located, result);
  basis_.extend({});
  return result;
}

Improvement ReducedProblem::improve(const LocatedPairs& located) {
  Improvement result;
  auto states = measuredStates(located, result);
  std::vector<CorrectionRequest> requests;
  for (auto& state : states) {
    if (std::ranges::all_of(state.solution.errors, &PairErrors::isRoundOff)) continue;
    std::vector<const linalg::DensePair*> all;
    for (const auto& pair : state.solution.spectrum.band) all.push_back(&pair);
    // Both parts of a residual relative to the whole residual: one part may be round-off.
    requests.push_back({&state, state.pairs(all, true), std::vector<double>(all.size(), 1.0)});
  }
  result.changed = corrector_.correct(requests) > 0;
  basis_.extend({});
  return result;
}

}  // namespace squeal::reduction
