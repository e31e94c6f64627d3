#include "eigen/reduction/reduced.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

#include "algebra/linalg/columns.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/petsc/arrays.hpp"
#include "eigen/reduction/condition.hpp"
#include "eigen/reduction/pod.hpp"
#include "eigen/reduction/responses.hpp"
#include "eigen/reduction/spectrum.hpp"

namespace squeal::reduction {

using subspace::Sketch;
using subspace::SquaredNorms;
namespace {

/// Pairs with a backward error below this have nothing to correct.
constexpr double rounding = 1e-14;
/// Errors of an eigenvalue that is smaller than this part of the lowest free mode are relative to
/// that part: round-off moves a double zero by about as much.
constexpr double leastSize = 1e-8;

std::vector<const linalg::DensePair*> pointers(const std::vector<linalg::DensePair>& pairs) {
  std::vector<const linalg::DensePair*> list;
  for (const auto& pair : pairs) list.push_back(&pair);
  return list;
}

/// Returns whether each pair of an undamped problem is −s̄ and the conjugate vectors of the pair
/// before, [pair]. The errors of the two are the same.
std::vector<bool> mirrorImages(const std::vector<linalg::DensePair>& pairs, bool damped) {
  std::vector<bool> mirrored(pairs.size(), false);
  for (std::size_t j = 1; j < pairs.size() && !damped; ++j)
    mirrored[j] =
        !mirrored[j - 1] && pairs[j].s.real() != 0 && pairs[j].s == -std::conj(pairs[j - 1].s);
  return mirrored;
}

/// Returns true if all entries are zero, as where the factors of all damping terms are.
bool isZero(const linalg::DenseView& a) {
  return std::ranges::all_of(a.entries(), [](double entry) { return entry == 0; });
}

/// Returns the terms of K and M alone.
pencil::Pencil associatedOf(const pencil::Pencil& pencil) {
  std::vector<pencil::Term> terms;
  for (std::size_t t = 0; t < pencil.affineCount(); ++t)
    if (pencil.terms()[t].isAssociated()) terms.push_back(pencil.terms()[t].share());
  return pencil::Pencil(std::move(terms));
}

/// Returns the sums over the real and the imaginary part of each pair, [pair].
std::vector<double> perPair(const Coordinates& coordinates, const std::vector<double>& squares) {
  std::vector<double> sums(coordinates.pairs.size(), 0.0);
  for (std::size_t j = 0; j < sums.size(); ++j)
    for (auto c = coordinates.firstColumn[j]; c < coordinates.firstColumn[j + 1]; ++c)
      sums[j] += squares[c];
  return sums;
}

}  // namespace

/// The state of one point while the basis is corrected.
struct ReducedProblem::PointState : PointFound {
  PointState(PointFound found, const PointProblem& problem, const Set& its, ProjectedTerms own,
             bool isDamped)
      : PointFound(std::move(found)),
        point(&problem),
        set(&its),
        ownTerms(std::move(own)),
        damped(isDamped) {}
  const PointProblem* point;
  const Set* set;
  ProjectedTerms ownTerms;
  bool associated = false;  // it is the problem of the free modes
  bool damped;
};

ReducedProblem::ReducedProblem(const pencil::Pencil& pencil, const factor::AssociatedSystem& system,
                               const modes::Modes& modes, const Settings& settings,
                               Substructure substructure)
    : settings_(settings),
      band_(pencil::bandFor(modes.angularFrequency, settings.band)),
      modes_(modes.angularFrequency),
      basis_(modes, system, std::move(substructure)),
      terms_(basis_, pencil, 0, pencil.terms().size()) {
  check(MatGetSize(basis_.stiffness(), &unknowns_, nullptr));
  exchanged_ = basis_.size();
  lowestMode_ = modes.angularFrequency.front();
  highestMode_ = modes.angularFrequency.back();
  if (basis_.size() == unknowns_) {  // the whole space: there is nothing to correct
    band_.top = INFINITY;
  } else if (!settings_.corrected) {
    band_.top = 0;
  }
  addSet(pencil, std::vector<unsigned char>(basis_.boundarySize(), 0));
  if (basis_.boundarySize() > 0)
    count_.emplace(basis_, modes, associatedOf(pencil).assembled(2, {}));
}

int ReducedProblem::addSet(const pencil::Pencil& pencil, const std::vector<unsigned char>& has) {
  sets_.push_back(std::unique_ptr<Set>(
      new Set{PointSpace(basis_.boundaryStiffness(), has),
              ProjectedTerms(basis_, pencil, terms_.count(), pencil.affineCount()), band_.top,
              int(std::ranges::count_if(modes_, [&](double w) { return w <= band_.top; }))}));
  return std::ssize(sets_) - 1;
}

/// Collective. Extends the projections of all terms to the vectors that the basis has gained.
void ReducedProblem::extend(const std::vector<PointState*>& states) {
  terms_.extend();
  for (auto& set : sets_) set->terms.extend();
  for (auto* state : states) state->ownTerms.extend();
}

/// Collective. Returns the real and imaginary parts of P(s) x, or of P(s)ᴴ y, from the matrices
/// themselves, by this rank's rows; the real part alone for a pair of one column.
linalg::Block ReducedProblem::residualColumns(const PointState& state,
                                              const linalg::DensePair& pair,
                                              const linalg::ComplexVector& vector,
                                              pencil::Side side) const {
  const linalg::ComplexVector residual =
      pencil::residual(state.point->pencil, state.point->at, pair.s, vector, side);
  const bool real = Coordinates({&pair}, state.damped, state.set->space).isReal(0);
  linalg::Block result(basis_.localRows());
  for (const Vec part : {residual.real.get(), residual.imaginary.get()}) {
    if (real && result.columns() == 1) break;
    const ReadArray entries(part);
    result.append(std::span(entries.begin(), entries.end()));
  }
  basis_.clearBoundary(result);
  return result;
}

/// Returns the unit of the relative errors of an eigenvalue: |s|, unless that is all but zero.
double ReducedProblem::unitOf(Complex s) const {
  return std::max(std::abs(s), leastSize * lowestMode_);
}

/// Returns the estimate of |δs|, 1/s. In a problem in s², an error δ of s² moves s by |δ|/(2 |s|),
/// but at most by √|δ|.
double ReducedProblem::absoluteError(const PointState& state, std::size_t pair) const {
  const Complex s = state.spectrum.band[pair].s;
  const double unit = unitOf(s), relative = errorOf(state, pair) + state.rounding[pair];
  if (state.symmetry == pencil::Symmetry::none) return unit * relative;
  const double ofRoot = unit * std::sqrt(2 * relative);
  return std::abs(s) < unit ? ofRoot : std::min(unit * relative, ofRoot);
}

/// Returns true if the error is as small as asked for. Where s is zero within its error, that is
/// relative to the lowest free mode: in s itself, or in s² where the problem is one in s².
bool ReducedProblem::isExactEnough(const PointState& state, const pencil::Eigenvalue& e) const {
  if (!e.mayBeZero()) return e.errorEstimate() <= settings_.tolerance;
  const double ratio = e.error / lowestMode_;
  return (state.symmetry == pencil::Symmetry::none ? ratio : ratio * ratio) <= settings_.tolerance;
}

/// Returns the estimate of |δs|/|s| that comes from what the basis lacks.
double ReducedProblem::errorOf(const PointState& state, std::size_t pair) const {
  return rightRatio_ * state.rightError[pair] * std::min(1.0, leftRatio_ * state.leftError[pair]);
}

/// Returns the ratio of the errors of a pair to what is asked for. It is 0 where nothing can be
/// done, as about errors of rounding.
double ReducedProblem::errorRatio(const PointState& state, std::size_t pair) const {
  if (band_.top == 0 || state.backwardError[pair] < rounding) return 0;
  return std::max(state.backwardError[pair] / settings_.criteria.accuracy,
                  errorOf(state, pair) / settings_.tolerance);
}

bool ReducedProblem::isAccurate(const PointState& state) const {
  for (std::size_t j = 0; j < state.spectrum.band.size(); ++j)
    if (errorRatio(state, j) > 1) return false;
  return true;
}

PointPairs ReducedProblem::pairsOf(const PointState& state,
                                   std::vector<const linalg::DensePair*> pairs, bool damped) {
  return {{state.point->at, state.associated},
          Coordinates(std::move(pairs), damped, state.set->space)};
}

/// Not collective. Returns sketches of the residuals of one side, 2 Sketch::size × columns.
linalg::DenseMatrix ReducedProblem::residualSketch(const PointState& state, const PointPairs& pairs,
                                                   pencil::Side side) const {
  linalg::DenseMatrix sketch(2 * Sketch::size, pairs.pairs.columns);
  for (const auto* terms : {&terms_, &state.set->terms, &state.ownTerms})
    terms->addTo(pairs, side, sketch);
  return sketch;
}

/// Not collective. Fills in the errors of the pairs of a point.
void ReducedProblem::estimateErrors(PointState& state, const linalg::DenseProblem& problem) const {
  const auto& pairs = state.spectrum.band;
  const PointPairs all = pairsOf(state, pointers(pairs), state.damped);
  const auto& coordinates = all.pairs;
  const auto norms = [&](pencil::Side side) {  // raised by what a sketch may miss
    SquaredNorms squares = subspace::squaredNorms(residualSketch(state, all, side));
    for (auto* list : {&squares.euclidean, &squares.weighted}) {
      *list = perPair(coordinates, *list);
      for (auto& square : *list) square *= Sketch::safety * Sketch::safety;
    }
    return squares;
  };
  const auto right = norms(pencil::Side::right), left = norms(pencil::Side::left);
  const auto lengthsBy = [&](const linalg::DenseMatrix& sketch, const linalg::DenseMatrix& q) {
    return perPair(coordinates, subspace::squaredLengths(linalg::product(sketch, q)));
  };
  const auto x = coordinates.times(pencil::Side::right, 0, 1);
  const auto lengths = lengthsBy(basis_.sketched(), x),
             rightRigidity = lengthsBy(basis_.sketchedRigidity(), x),
             leftRigidity =
                 lengthsBy(basis_.sketchedRigidity(), coordinates.times(pencil::Side::left, 0, 1));
  const auto conditions = conditionNumbers(problem, pairs, leastSize * lowestMode_);
  state.symmetry = linalg::conservative(problem) ? pencil::Symmetry::conservative
                   : isZero(problem.damping)     ? pencil::Symmetry::even
                                                 : pencil::Symmetry::none;
  state.backwardError.clear();
  state.rightError.clear();
  state.leftError.clear();
  state.roundOff.clear();
  state.rounding.clear();
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const double size = std::abs(pairs[j].s),
                 scale = state.norms[0] + size * state.norms[1] + size * size * state.norms[2];
    // Where s and K̄ are zero, P(s) is, and has no residual.
    state.backwardError.push_back(scale > 0 ? std::sqrt(right.euclidean[j] / lengths[j]) / scale
                                            : 0);
    // Backward errors ε of the dense matrices, in norm: VᵀK̄V is of the order of 1, VᵀM̄V of the
    // lowest 1/ω²; and of the entries of K, which cancel where a stiff body moves all but rigidly.
    state.roundOff.push_back(
        PETSC_MACHINE_EPSILON *
        (1 + std::pow(size / lowestMode_, 2) + std::sqrt(rightRigidity[j] * leftRigidity[j])));
    state.rounding.push_back(conditions[j] * state.roundOff.back());
    state.rightError.push_back(conditions[j] * std::sqrt(right.weighted[j]));
    state.leftError.push_back(size < highestMode_ ? std::sqrt(left.weighted[j]) /
                                                        (1 - std::pow(size / highestMode_, 2))
                                                  : INFINITY);
  }
}

/// Returns the pairs of a point that are not good enough, each to be resolved but for `resolution`
/// of its residual, or for what is good enough: half of its square for what stays unresolved, half
/// for what the correction leaves.
ReducedProblem::CorrectionRequest ReducedProblem::requestOf(const PointState& state) const {
  const auto mirrored = mirrorImages(state.spectrum.band, state.damped);
  std::vector<const linalg::DensePair*> bad;
  std::vector<double> weights;
  for (std::size_t j = 0; j < state.spectrum.band.size(); ++j)
    if (const double tooLarge = errorRatio(state, j); tooLarge > 1 && !mirrored[j]) {
      bad.push_back(&state.spectrum.band[j]);
      weights.push_back(std::min(1.0, std::sqrt(2) * resolution * tooLarge));
    }
  return {&state, pairsOf(state, bad, state.damped), weights};
}

/// Collective. Returns directions that hold the residuals of all these pairs, of length one times
/// their weights, but for parts of length `resolution`.
linalg::Block ReducedProblem::directions(const std::vector<CorrectionRequest>& requests) const {
  linalg::DenseMatrix sketches;
  std::vector<double> factors;
  std::vector<const PointPairs*> points;
  for (const auto& request : requests) {
    const auto& pairs = request.pairs.pairs;
    const linalg::DenseMatrix sketch =
        residualSketch(*request.state, request.pairs, pencil::Side::right);
    sketches.append(sketch);
    const auto squares = perPair(pairs, subspace::squaredNorms(sketch).euclidean);
    for (std::size_t j = 0; j < squares.size(); ++j)
      factors.insert(factors.end(), pairs.firstColumn[j + 1] - pairs.firstColumn[j],
                     squares[j] > 0 ? request.weights[j] / std::sqrt(squares[j]) : 0);
    points.push_back(&request.pairs);
  }
  const auto made = [&](const linalg::DenseMatrix& combinations) {
    linalg::Block columns(basis_.localRows(), combinations.columns());
    if (combinations.empty()) return columns;
    terms_.addTo(points, combinations, columns);
    PetscInt first = 0;
    for (const auto& request : requests) {
      const PetscInt last = first + request.pairs.pairs.columns;
      const linalg::DenseMatrix some = linalg::rowRange(combinations, first, last);
      for (const auto* terms : {&request.state->set->terms, &request.state->ownTerms})
        terms->addTo({&request.pairs}, some, columns);
      first = last;
    }
    basis_.clearBoundary(columns);
    return columns;
  };
  // Fewer columns than residuals: those of several points are much alike.
  if (const auto leading = subspace::leadingCombinations(sketches, factors, 0.8 * resolution))
    return linalg::principal(basis_.comm(), made(*leading), resolution);
  // More than the sketch can tell: random combinations, until they span the residuals.
  constexpr PetscInt atOnce = 3 * Sketch::size;
  const PetscInt all = factors.size();
  linalg::Block columns(basis_.localRows());
  for (PetscInt count = 0;;) {
    const PetscInt more = all - count <= atOnce + atOnce / 2 ? all - count : atOnce;
    columns.append(made(subspace::randomCombinations(factors, count, count + more)));
    count += more;
    // A sum of `all` columns with random signs, over √count: lengths stay as they are.
    linalg::Block leading =
        linalg::principal(basis_.comm(), columns, resolution * std::sqrt(count));
    if (count == all || 5 * leading.columns() < 4 * count) return leading;
  }
}

/// Collective. Solves the dense problems of the points that are not done, and estimates errors.
void ReducedProblem::solveDense(const std::vector<PointState*>& open) {
  std::vector<linalg::DenseProblem> problems;
  for (const auto* state : open) problems.push_back(project(*state));
  std::vector<SpectrumRequest> requests;
  for (std::size_t i = 0; i < open.size(); ++i) {
    requests.push_back({&problems[i], &open[i]->spectrum, {}});
    for (std::size_t j = 0; j < open[i]->spectrum.band.size(); ++j)
      requests[i].errorRatio.push_back(errorRatio(*open[i], j));
  }
  solveSpectra(basis_.comm(), band_, requests);
  for (std::size_t i = 0; i < open.size(); ++i) estimateErrors(*open[i], problems[i]);
}

/// Collective. Looks for eigenvalues that are missing at the points, and empties the spectra where
/// it finds one. Returns these points.
std::vector<ReducedProblem::PointState*> ReducedProblem::incompleteStates(
    std::vector<PointState>& states) {
  std::vector<PointState*> asked, open;
  std::vector<linalg::DenseProblem> problems;
  for (auto& state : states)
    if (state.spectrum.improved) {
      asked.push_back(&state);
      state.ownTerms.extend();
      problems.push_back(project(state));
    }
  std::vector<SpectrumRequest> requests;
  for (std::size_t i = 0; i < asked.size(); ++i)
    requests.push_back({&problems[i], &asked[i]->spectrum, {}});
  const auto are = incomplete(basis_.comm(), band_, requests);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    asked[i]->spectrum.improved = false;
    if (!are[i]) continue;
    asked[i]->spectrum = {};
    open.push_back(asked[i]);
  }
  return open;
}

/// Collective. Returns the ratio of a residual made with the matrices, `columns`, to that made with
/// the products of the basis, in the norm of diag(K0)⁻¹; 1 at the least.
double ReducedProblem::residualRatio(const PointState& state, const linalg::DensePair& pair,
                                     const linalg::Block& columns, pencil::Side side) const {
  const PointPairs alone = pairsOf(state, {&pair}, state.damped);
  const auto sum = [](const std::vector<double>& squares) {
    return std::accumulate(squares.begin(), squares.end(), 0.0);
  };
  const double known = sum(subspace::squaredNorms(residualSketch(state, alone, side)).weighted),
               exact = sum(subspace::squaredNorms(basis_.sketch().of(columns)).weighted);
  return known > 0 ? std::max(1.0, std::sqrt(exact / known)) : 1.0;
}

/// Collective. Solves for the residuals of the pair with the largest estimate of all points so far,
/// and returns the points that are no longer good enough if that shows the estimates to be too
/// small.
std::vector<ReducedProblem::PointState*> ReducedProblem::unconfirmed(
    std::vector<PointState>& states) {
  std::vector<PointState*> open;
  PointState* worst = nullptr;
  std::size_t pair = 0;
  double largest =
      std::max(confirmed_, 1e-3 * settings_.tolerance);  // below: next to nothing, or rounding
  for (auto& state : states)
    for (std::size_t j = 0; j < state.spectrum.band.size(); ++j)
      if (const double error = errorOf(state, j); std::isfinite(error) && error > largest)
        worst = &state, pair = j, largest = error;
  if (!worst) return open;
  confirmed_ = largest;
  worst->ownTerms.extend();  // the basis may have grown since
  linalg::DensePair& known = worst->spectrum.band[pair];
  const PointSpace& space = worst->set->space;
  for (auto* vector : {&known.q, &known.left}) vector->resize(space.size(basis_.size()));
  const auto vectors = basis_.expand({space.lifted(known.q), space.lifted(known.left)});
  const linalg::Block right = residualColumns(*worst, known, vectors[0], pencil::Side::right),
                      left = residualColumns(*worst, known, vectors[1], pencil::Side::left);
  const auto ratios = basis_.energyRatios({right, left});
  measuredRatio_ = std::max(measuredRatio_,
                            ratios[0] * residualRatio(*worst, known, right, pencil::Side::right));
  rightRatio_ = std::max(rightRatio_, measuredRatio_);
  leftRatio_ =
      std::max(leftRatio_, ratios[1] * residualRatio(*worst, known, left, pencil::Side::left));
  for (auto& state : states)
    if (!isAccurate(state)) open.push_back(&state);
  return open;
}

ReducedProblem::PointState ReducedProblem::newState(const PointProblem& point,
                                                    const Norms& norms) const {
  const auto& pencil = point.pencil;
  PointFound found;
  found.norms = norms;
  return {std::move(found), point, *sets_[point.set],
          ProjectedTerms(basis_, pencil, pencil.affineCount(), pencil.terms().size()),
          pencil.hasPower(1)};
}

Norms ReducedProblem::normsOf(const PointProblem& point) {
  const auto& pencil = point.pencil;
  norms_.emplace_back(point.at, Norms{pencil.norm(0, point.at), pencil.norm(1, point.at),
                                      pencil.norm(2, point.at)});
  return norms_.back().second;
}

/// Collective. Returns the norms of the point nearest in friction that has been solved with the
/// same other parameters, since norms take many products with large matrices. If there is none,
/// they are computed.
Norms ReducedProblem::nearbyNorms(const PointProblem& point) {
  const std::pair<sweep::Parameters, Norms>* nearest = nullptr;
  for (const auto& known : norms_) {
    sweep::Parameters at = known.first;
    at.friction = point.at.friction;
    const auto distance = [&](const auto* other) {
      return std::abs(other->first.friction - point.at.friction);
    };
    if (at == point.at && (!nearest || distance(&known) < distance(nearest))) nearest = &known;
  }
  return nearest ? nearest->second : normsOf(point);
}

/// Collective. Adds to the basis the static responses to friction at this point [M.29].
void ReducedProblem::addStaticResponses(const PointProblem& point) {
  std::vector<double> inBand = modes_;
  std::erase_if(inBand, [&](double w) { return w > band_.top; });
  basis_.add(forcesOnModes(basis_, point.pencil, point.at, inBand, resolution));
  rightRatio_ = std::max(measuredRatio_, basis_.lastEnergyRatio());
}

/// Moves the pairs of a point above the band of its set out of those that are listed.
void ReducedProblem::leaveBand(PointState& state) const {
  const double top = state.set->top;
  if (top == band_.top) return;
  auto& band = state.spectrum.band;
  const std::array ofPairs{&state.backwardError, &state.rightError, &state.leftError,
                           &state.rounding};
  std::size_t kept = 0;
  for (std::size_t j = 0; j < band.size(); ++j) {
    if (std::abs(band[j].s) > top) {
      state.spectrum.guard.push_back(std::move(band[j]));
      continue;
    }
    for (auto* list : ofPairs) (*list)[kept] = (*list)[j];
    if (kept != j) band[kept] = std::move(band[j]);
    ++kept;
  }
  band.resize(kept);
  for (auto* list : ofPairs) list->resize(kept);
}

/// Collective. Turns the basis to the principal directions of all vectors found so far. The
/// constraint modes stay.
void ReducedProblem::compress() {
  const PetscInt boundary = basis_.boundarySize();
  const linalg::DenseMatrix directions = principalDirections(solved_, basis_.size() - boundary);
  if (directions.empty()) return;
  linalg::DenseMatrix all(basis_.size(), boundary + directions.columns());
  for (PetscInt j = 0; j < boundary; ++j) all(j, j) = 1;
  for (PetscInt j = 0; j < directions.columns(); ++j)
    std::ranges::copy(directions.column(j), all.column(boundary + j).begin() + boundary);
  basis_.combine(all);
  terms_.combine(all);
  for (auto& set : sets_) set->terms.combine(all);
  highestMode_ = 0;  // the modes are no longer in the basis
  for (auto& pairs : solved_)
    for (auto& pair : pairs) turn(directions, pair);
}

/// Keeps the vectors of the points, as far as they are not of constraint modes.
void ReducedProblem::keepForCompression(std::vector<PointState>& states) {
  for (auto& state : states) {
    const PetscInt own = state.set->space.own();
    for (auto& pair : state.spectrum.band)
      for (auto* vector : {&pair.q, &pair.left})
        vector->erase(vector->begin(), vector->begin() + own);
    solved_.push_back(std::move(state.spectrum.band));
  }
}

/// Keeps the pairs of the points for those who ask again, as tracking does, each on one rank.
void ReducedProblem::keepPairs(const std::vector<PointState>& states) {
  constexpr double most = 1e9;  // bytes on all ranks
  if (band_.top == 0 || !std::isfinite(band_.top)) return;
  int rank = 0, ranks = 1;
  check(MPI_Comm_rank(basis_.comm(), &rank));
  check(MPI_Comm_size(basis_.comm(), &ranks));
  for (const auto& state : states) {
    const auto& [band, guard, improved] = state.spectrum;
    knownSize_ += 2.0 * sizeof(Complex) * basis_.size() * (band.size() + guard.size());
    if (knownSize_ > most) return;
    KnownPairs known{state.point->at, state.point->set, int(known_.size()) % ranks, {}};
    if (rank == known.owner) {
      known.pairs = band;
      known.pairs.insert(known.pairs.end(), guard.begin(), guard.end());
    }
    known_.push_back(std::move(known));
  }
}

std::optional<std::vector<linalg::DensePair>> ReducedProblem::watchedPairs(
    const sweep::Parameters& at, int set) const {
  for (const auto& known : known_)
    if (known.at == at && known.set == set) {
      auto pairs = known.pairs;
      linalg::shareFrom(known.owner, basis_.comm(), pairs, linalg::Vectors::both);
      return pairs;
    }
  return {};
}

BatchInHand ReducedProblem::inHand(const std::vector<PointState>& states,
                                   const std::vector<PointState*>& open, int round,
                                   PetscInt largest) const {
  BatchInHand batch{round, largest, {}, {}};
  for (const auto& state : states) {
    batch.found.push_back(state);
    batch.open.push_back(std::ranges::find(open, &state) != open.end());
  }
  return batch;
}

/// Collective. Solves at all points and corrects the basis until they are accurate.
void ReducedProblem::correct(std::vector<PointState>& states) {
  std::vector<PointState*> open;
  int round = 0;
  PetscInt largest = std::min<PetscInt>(basis_.size() + settings_.growth, unknowns_);
  if (inHand_) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      static_cast<PointFound&>(states[i]) = std::move(inHand_->found[i]);
      if (inHand_->open[i]) open.push_back(&states[i]);
    }
    round = inHand_->round, largest = inHand_->largest;
    inHand_.reset();
  } else {
    for (auto& state : states) open.push_back(&state);
  }
  for (; !open.empty(); ++round) {
    extend(open);
    solveDense(open);
    std::erase_if(open, [&](const PointState* state) { return isAccurate(*state); });
    if (open.empty()) {
      open = unconfirmed(states);
      if (open.empty()) open = incompleteStates(states);
      continue;
    }
    if (round >= settings_.rounds || basis_.size() >= largest) break;
    std::vector<CorrectionRequest> requests;
    for (const auto* state : open) requests.push_back(requestOf(*state));
    if (basis_.add(directions(requests)) == 0) break;  // residuals are rounding
    rightRatio_ = std::max(measuredRatio_, basis_.lastEnergyRatio());
    if (afterRound_ && !states.front().associated) {
      inHand_ = inHand(states, open, round + 1, largest);
      afterRound_();
      inHand_.reset();
    }
  }
  if (open = incompleteStates(states); !open.empty()) {  // corrections have ended early
    extend(open);
    solveDense(open);
  }
}

void ReducedProblem::exchange(checkpoint::Archive& archive) {
  archive.common(lowestMode_, highestMode_, rightRatio_, leftRatio_, measuredRatio_, confirmed_,
                 responded_, knownSize_, norms_);
  for (auto& set : sets_) archive.common(set->top, set->modesInBand);
  double ratio = basis_.lastEnergyRatio();
  long solves = basis_.solves();
  archive.common(ratio, solves);
  if (archive.reads()) {
    linalg::DenseMatrix columns;
    archive.own(columns);
    basis_.restore(columns, ratio, solves);
    extend({});
  } else {
    linalg::borrow(archive.own, basis_.columns().columnRange(exchanged_, basis_.size()));
  }
  exchanged_ = basis_.size();
  std::size_t pairs = known_.size();
  archive.common(pairs);
  known_.resize(pairs);
  for (; exchangedPairs_ < pairs; ++exchangedPairs_) {
    auto& known = known_[exchangedPairs_];
    archive.common(known.at, known.set, known.owner);
    archive.own(known.pairs);
  }
  bool has = inHand_.has_value();
  archive.common(has);
  if (archive.reads()) inHand_.reset();
  if (!has) return;
  if (!inHand_) inHand_.emplace();
  archive.common(inHand_->round, inHand_->largest, inHand_->found, inHand_->open);
}

std::vector<pencil::ComplexModes> ReducedProblem::solve(const std::vector<PointProblem>& batch,
                                                        Mat trial) {
  std::vector<PointState> states;
  if (!responded_ && settings_.corrected && basis_.size() < unknowns_)
    addStaticResponses(batch.front());
  responded_ = true;
  for (const auto& point : batch)
    states.push_back(newState(point, inHand_ ? Norms{} : normsOf(point)));
  correct(states);
  for (auto& state : states) leaveBand(state);
  std::vector<pencil::ComplexModes> points;
  for (const auto& state : states) points.push_back(result(state));
  keepShapes(points, states, trial);
  if (!settings_.compressed) {
    keepPairs(states);
    return points;
  }
  keepForCompression(states);
  compress();
  return points;
}

/// Collective. Confirms the number of the modes of a set, which end at the top of the band of all
/// sets: at σ in one of the gaps above it, the modes are as many as the `values` ω² of the reduced
/// problem, which lie above those that they belong to.
void ReducedProblem::confirmCount(const std::vector<double>& values, const Set& set,
                                  modes::Modes& modes) const {
  constexpr PetscInt mostGaps = 10;
  const PetscInt inBand = std::ssize(modes.lambda);
  double shift = 0;
  for (PetscInt i = inBand; i < std::min<PetscInt>(inBand + mostGaps, std::ssize(values)); ++i) {
    const double low = i == inBand ? band_.top * band_.top : values[i - 1];
    shift = 0.5 * (low + values[i]);
    const auto below = count_->below(shift, set.space.boundary());
    modes.countConfirmed = below && *below == i;
    modes.inertiaCount = i;
    if (modes.countConfirmed) break;
  }
  modes.inertiaShift = shift;
  int confirmed = modes.countConfirmed;
  check(MPI_Bcast(&confirmed, 1, MPI_INT, 0, basis_.comm()));
  check(MPI_Bcast(&modes.inertiaCount, 1, MPI_INT, 0, basis_.comm()));
  check(MPI_Bcast(&modes.inertiaShift, 1, MPI_DOUBLE, 0, basis_.comm()));
  modes.countConfirmed = confirmed != 0;
}

/// Collective. Returns the problem of the free modes of a set, solved and corrected; `point` has
/// the terms of K and M alone.
ReducedProblem::PointState ReducedProblem::associatedState(const PointProblem& point) {
  std::vector<PointState> states;
  states.push_back(
      newState(point, {point.pencil.norm(0, point.at), 0, point.pencil.norm(2, point.at)}));
  states.front().associated = true;
  correct(states);
  return std::move(states.front());
}

/// Collective. Places the top of the band of a set by the eigenvalues ω² of its free modes.
void ReducedProblem::settleBand(std::vector<double> values, Set& set) const {
  if (band_.top == 0 || !std::isfinite(band_.top)) return;
  values.resize(std::min(values.size(), modes_.size()));
  for (double& value : values) value = std::sqrt(std::max(value, 0.0));
  set.top = std::min(band_.top, pencil::bandBelow(values, settings_.band.top));
  set.modesInBand = std::ranges::count_if(values, [&](double w) { return w <= set.top; });
  check(MPI_Bcast(&set.top, 1, MPI_DOUBLE, 0, basis_.comm()));
  check(MPI_Bcast(&set.modesInBand, 1, MPI_INT, 0, basis_.comm()));
}

modes::Modes ReducedProblem::freeModes(int set, const pencil::Pencil& pencil) {
  const pencil::Pencil associated = associatedOf(pencil);
  const PointProblem point{{}, associated.with({}), set};
  const PointState state = associatedState(point);
  std::vector<std::vector<Complex>> lifted;
  for (const auto& pair : state.spectrum.band) lifted.push_back(state.set->space.lifted(pair.q));
  linalg::Block shapes(basis_.localRows());
  for (const auto& shape : basis_.expand(lifted)) {
    const ReadArray entries(shape.real);
    shapes.append(std::span(entries.begin(), entries.end()));
  }
  linalg::Block forces[2] = {linalg::Block(shapes.rows()), linalg::Block(shapes.rows())};
  for (const auto& term : associated.terms())
    linalg::appendProduct(term.matrix, shapes, forces[term.power / 2]);
  auto& [stiffness, inertia] = forces;
  modes::Modes modes;
  const linalg::DenseMatrix masses = linalg::transposedProduct(basis_.comm(), shapes, inertia);
  for (PetscInt j = 0; j < shapes.columns(); ++j)
    for (auto* columns : {&shapes, &stiffness, &inertia})
      for (double& entry : columns->column(j)) entry /= std::sqrt(masses(j, j));
  for (auto* columns : {&stiffness, &inertia}) basis_.clearBoundary(*columns);
  for (std::size_t j = 0; j < state.spectrum.band.size(); ++j) {
    const double omega = state.spectrum.band[j].s.imag(), lambda = omega * omega;
    modes.angularFrequency.push_back(omega);
    modes.lambda.push_back(lambda);
    const double size = linalg::length(basis_.comm(), inertia.column(j));
    auto rest = stiffness.column(j);
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= lambda * inertia(i, j);
    modes.relativeResidual.push_back(linalg::length(basis_.comm(), rest) / (lambda * size));
  }
  modes.vectors = linalg::copiedColumns(basis_.stiffness(), shapes);
  linalg::DenseProblem problem = project(state);
  const auto values = linalg::symmetricEigen(problem.stiffness, problem.mass);
  settleBand(values, *sets_[set]);
  if (count_) confirmCount(values, *sets_[set], modes);
  return modes;
}

/// Collective. Returns what is known of the eigenvalues of a point.
pencil::ComplexModes ReducedProblem::result(const PointState& state) const {
  pencil::ComplexModes point;
  point.at = state.point->at;
  point.bandTop = state.set->top;
  point.freeModesInBand = state.set->modesInBand;
  point.damped = state.damped;
  point.accuracy = settings_.criteria.accuracy;
  point.tolerance = settings_.tolerance;
  for (std::size_t j = 0; j < state.spectrum.band.size(); ++j) {
    auto& e =
        point.eigenvalues.emplace_back(pencil::Eigenvalue{.s = state.spectrum.band[j].s,
                                                          .backwardError = state.backwardError[j],
                                                          .error = absoluteError(state, j)});
    e.certified = e.backwardError <= point.accuracy && isExactEnough(state, e);
  }
  pencil::judge(point, state.symmetry, settings_.criteria);
  // The shapes are made by all ranks, which must agree on the verdicts.
  static_assert(std::is_trivially_copyable_v<pencil::Eigenvalue>);
  check(MPI_Bcast(point.eigenvalues.data(), point.eigenvalues.size() * sizeof(pencil::Eigenvalue),
                  MPI_BYTE, 0, basis_.comm()));
  return point;
}

/// Collective. Keeps the shapes of all points. They are made together, since each product with the
/// basis reads the whole of it.
void ReducedProblem::keepShapes(std::vector<pencil::ComplexModes>& points,
                                const std::vector<PointState>& states, Mat trial) const {
  std::vector<std::vector<std::size_t>> wanted;
  std::vector<std::vector<Complex>> lifted;
  for (std::size_t i = 0; i < points.size(); ++i) {
    wanted.push_back(pencil::shapesWanted(points[i], settings_.criteria));
    for (std::size_t index : wanted.back())
      lifted.push_back(states[i].set->space.lifted(states[i].spectrum.band[index].q));
  }
  if (lifted.empty()) return;
  auto all = basis_.expand(lifted);
  auto next = std::make_move_iterator(all.begin());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::ptrdiff_t count = wanted[i].size();
    pencil::keepShapes(points[i], trial, wanted[i], {next, next + count});
    next += count;
  }
}

linalg::DenseProblem ReducedProblem::project(const PointProblem& point) const {
  return project(newState(point, {}));
}

linalg::DenseProblem ReducedProblem::projectOwn(const PointProblem& point) const {
  const PointState state = newState(point, {});
  linalg::DenseProblem problem;
  state.ownTerms.addTo({point.at, false}, problem);
  return state.set->space.restricted(std::move(problem));
}

linalg::DenseProblem ReducedProblem::projectOnAll(const PointProblem& point) const {
  return projectOnAll(newState(point, {}));
}

linalg::DenseProblem ReducedProblem::projectOnAll(const PointState& state) const {
  linalg::DenseProblem problem;
  for (const auto* terms : {&terms_, &state.set->terms, &state.ownTerms})
    terms->addTo({state.point->at, state.associated}, problem);
  return problem;
}

linalg::DenseProblem ReducedProblem::project(const PointState& state) const {
  return state.set->space.restricted(projectOnAll(state));
}

Improvement ReducedProblem::improve(
    const std::vector<std::pair<PointProblem, std::vector<linalg::DensePair>>>& located) {
  Improvement result;
  std::vector<PointState> states;
  states.reserve(located.size());
  std::vector<CorrectionRequest> requests;
  for (const auto& [point, pairs] : located) {
    PointState& state = states.emplace_back(newState(point, nearbyNorms(point)));
    state.spectrum.band = pairs;
    for (auto& pair : state.spectrum.band)  // they may be of a smaller basis
      for (auto* vector : {&pair.q, &pair.left})
        vector->resize(state.set->space.size(basis_.size()));
    estimateErrors(state, project(state));
    result.backwardError.push_back(
        *std::max_element(state.backwardError.begin(), state.backwardError.end()));
    result.roundOff.push_back(*std::max_element(state.roundOff.begin(), state.roundOff.end()));
    if (result.backwardError.back() < rounding) continue;
    // Both parts of a residual in units of the whole: one of them may be rounding.
    requests.push_back({&state, pairsOf(state, pointers(state.spectrum.band), true),
                        std::vector<double>(pairs.size(), 1.0)});
  }
  result.changed = basis_.add(directions(requests)) > 0;
  extend({});
  return result;
}

}  // namespace squeal::reduction
