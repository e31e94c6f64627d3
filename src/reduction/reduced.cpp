#include "reduction/reduced.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

#include "options/options.hpp"
#include "reduction/condition.hpp"

namespace squeal::reduction {
namespace {

const ChoiceOption basisOption(
    "flutter", "reduction_basis", {"corrected", "modal", "pod"}, "corrected",
    "corrected: free modes, static responses to friction and to residuals; pod: after each batch "
    "of points "
    "the principal directions of the vectors found so far; modal: free modes alone");
const RealOption toleranceOption(
    "flutter", "flutter_tolerance", 1e-8, "", positive,
    "estimated relative error |ds|/|s| to which the eigenvalues of the band are corrected");
const IntegerOption roundsOption("flutter", "flutter_rounds", 15, 0, 10'000,
                                 "most rounds of corrections at one batch of points");
const IntegerOption growthOption(
    "flutter", "flutter_growth", 1000, 0, 1'000'000,
    "most vectors that corrections may add to the basis at one batch of points");

bool correctionsWanted() { return basisOption.get() != "modal"; }

/// Backward errors below have nothing to correct.
constexpr double rounding = 1e-14;

std::vector<const linalg::DensePair*> pointers(const std::vector<linalg::DensePair>& pairs) {
  std::vector<const linalg::DensePair*> list;
  for (const auto& pair : pairs) list.push_back(&pair);
  return list;
}

/// For an undamped problem, pairs that are −s̄ and the conjugate vectors of the pair before: their
/// errors are the same.
std::vector<bool> mirrorImages(const std::vector<linalg::DensePair>& pairs, bool damped) {
  std::vector<bool> mirrored(pairs.size(), false);
  for (std::size_t j = 1; j < pairs.size() && !damped; ++j)
    mirrored[j] =
        !mirrored[j - 1] && pairs[j].s.real() != 0 && pairs[j].s == -std::conj(pairs[j - 1].s);
  return mirrored;
}

/// Sums over the real and imaginary parts of each pair.
std::vector<double> perPair(const Coordinates& coordinates, const std::vector<double>& squares) {
  std::vector<double> sums(coordinates.pairs.size(), 0.0);
  for (std::size_t j = 0; j < sums.size(); ++j)
    for (auto c = coordinates.firstColumn[j]; c < coordinates.firstColumn[j + 1]; ++c)
      sums[j] += squares[static_cast<std::size_t>(c)];
  return sums;
}

}  // namespace

/// A point on its way.
struct ReducedProblem::Work {
  const PointProblem* point;
  ProjectedTerms ownTerms;
  bool damped;
  Norms norms;                           // of K̄, Z̄, M̄
  std::vector<linalg::DensePair> pairs;  // of the band, with left vectors
  std::vector<double> backwardError;     // [pair]
  // |δs|/|s| is at most the product of the two, each with the norm of diag(K0)⁻¹ for that of K0⁻¹
  std::vector<double> rightError;  // [pair] of the right vector, times the condition number of s
  std::vector<double> leftError;   // [pair] of the left vector, 1 at most
  std::vector<double> rounding;    // [pair] error of the dense solve
};

ReducedProblem::ReducedProblem(const pencil::Pencil& pencil, const modes::AssociatedSystem& system,
                               const modes::Modes& modes)
    : modes_(modes.angularFrequency),
      basis_(modes, system),
      terms_(basis_, pencil, 0, pencil.terms().size()) {
  check(BVGetSizes(modes.vectors, nullptr, &unknowns_, nullptr));
  lowestMode_ = modes.angularFrequency.front();
  highestMode_ = modes.angularFrequency.back();
  if (basis_.size() == unknowns_) {  // the whole space: there is nothing to correct
    bandTop_ = INFINITY;
    return;
  }
  if (!correctionsWanted()) return;
  bandTop_ = pencil::bandBelow(modes.angularFrequency);
}

/// Brings what depends on the basis up to it.
void ReducedProblem::extend(const std::vector<Work*>& works) {
  terms_.extend();
  for (auto* work : works) work->ownTerms.extend();
}

/// The columns of a residual, without images of the basis.
linalg::Block ReducedProblem::residualColumns(const Work& work, const linalg::DensePair& pair,
                                              const linalg::ComplexVector& vector,
                                              pencil::Side side) const {
  const auto& [at, pencil] = *work.point;
  const linalg::ComplexVector residual = pencil::residual(pencil, at, pair.s, vector, side);
  const bool real = Coordinates({&pair}, work.damped).isReal(0);
  linalg::Block result(basis_.localRows());
  for (const Vec part : {residual.real.get(), residual.imaginary.get()}) {
    if (real && result.columns == 1) break;
    const PetscScalar* entries = nullptr;
    check(VecGetArrayRead(part, &entries));
    result.append(entries);
    check(VecRestoreArrayRead(part, &entries));
  }
  return result;
}

/// Estimate of |δs|/|s| by what the basis lacks.
double ReducedProblem::errorOf(const Work& work, std::size_t pair) const {
  return rightRatio_ * work.rightError[pair] * std::min(1.0, leftRatio_ * work.leftError[pair]);
}

/// By how much the errors of a pair are too large; nothing can be done about those of rounding.
double ReducedProblem::excess(const Work& work, std::size_t pair) const {
  if (bandTop_ == 0 || work.backwardError[pair] < rounding) return 0;
  return std::max(work.backwardError[pair] / pencil::accuracyAsked(),
                  errorOf(work, pair) / toleranceOption.get());
}

bool ReducedProblem::good(const Work& work) const {
  for (std::size_t j = 0; j < work.pairs.size(); ++j)
    if (excess(work, j) > 1) return false;
  return true;
}

/// Sketches of the residuals of one side.
linalg::DenseMatrix ReducedProblem::residualSketch(const Work& work, const PointPairs& pairs,
                                                   pencil::Side side) const {
  linalg::DenseMatrix sketch(
      static_cast<std::size_t>(2 * linalg::Sketch::size * pairs.pairs.columns));
  for (const auto* terms : {&terms_, &work.ownTerms}) terms->addTo(pairs, side, sketch);
  return sketch;
}

/// Errors of the pairs of a point.
void ReducedProblem::judge(Work& work, const linalg::DenseProblem& problem) const {
  const auto& pairs = work.pairs;
  const PointPairs all{work.point->at, Coordinates(pointers(pairs), work.damped)};
  const auto& coordinates = all.pairs;
  const auto norms = [&](pencil::Side side) {  // raised by what a sketch may miss
    linalg::SquaredNorms squares = linalg::squaredNorms(residualSketch(work, all, side));
    for (auto* list : {&squares.euclidean, &squares.weighted}) {
      *list = perPair(coordinates, *list);
      for (auto& square : *list) square *= linalg::Sketch::safety * linalg::Sketch::safety;
    }
    return squares;
  };
  const auto right = norms(pencil::Side::right), left = norms(pencil::Side::left);
  linalg::DenseMatrix vectors(static_cast<std::size_t>(linalg::Sketch::size * coordinates.columns));
  linalg::multiplyAdd(basis_.sketched().data(), linalg::Sketch::size, basis_.size(),
                      coordinates.times(pencil::Side::right, 0, 1), vectors);
  const auto lengths = perPair(coordinates, linalg::squaredLengths(vectors));
  const auto conditions = conditionNumbers(problem, pairs);
  work.backwardError.clear();
  work.rightError.clear();
  work.leftError.clear();
  work.rounding.clear();
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const double size = std::abs(pairs[j].s),
                 scale = work.norms[0] + size * work.norms[1] + size * size * work.norms[2];
    work.backwardError.push_back(std::sqrt(right.euclidean[j] / lengths[j]) / scale);
    // Backward errors ε of the dense matrices, in norm: VᵀK̄V is of the order of 1, VᵀM̄V of the
    // lowest 1/ω².
    work.rounding.push_back(PETSC_MACHINE_EPSILON * conditions[j] *
                            (1 + std::pow(size / lowestMode_, 2)));
    work.rightError.push_back(conditions[j] * std::sqrt(right.weighted[j]));
    work.leftError.push_back(size < highestMode_ ? std::sqrt(left.weighted[j]) /
                                                       (1 - std::pow(size / highestMode_, 2))
                                                 : INFINITY);
  }
}

/// The pairs of a point that are not good enough, each to be resolved but for `resolution` of its
/// residual, or for what is good enough: half of its square for what stays unresolved, half for
/// what the correction leaves.
ReducedProblem::Wish ReducedProblem::wishOf(const Work& work) const {
  const auto mirrored = mirrorImages(work.pairs, work.damped);
  std::vector<const linalg::DensePair*> bad;
  std::vector<double> weights;
  for (std::size_t j = 0; j < work.pairs.size(); ++j)
    if (const double tooLarge = excess(work, j); tooLarge > 1 && !mirrored[j]) {
      bad.push_back(&work.pairs[j]);
      weights.push_back(std::min(1.0, std::sqrt(2) * resolution * tooLarge));
    }
  return {&work, {work.point->at, Coordinates(bad, work.damped)}, weights};
}

/// Directions that hold the residuals of all these pairs, of length one times their weights, but
/// for parts of length `resolution`.
linalg::Block ReducedProblem::directions(const std::vector<Wish>& wishes) const {
  linalg::DenseMatrix sketches, factors;
  std::vector<const PointPairs*> points;
  for (const auto& wish : wishes) {
    const auto& pairs = wish.pairs.pairs;
    const linalg::DenseMatrix sketch = residualSketch(*wish.work, wish.pairs, pencil::Side::right);
    sketches.insert(sketches.end(), sketch.begin(), sketch.end());
    const auto squares = perPair(pairs, linalg::squaredNorms(sketch).euclidean);
    for (std::size_t j = 0; j < squares.size(); ++j)
      factors.insert(factors.end(),
                     static_cast<std::size_t>(pairs.firstColumn[j + 1] - pairs.firstColumn[j]),
                     squares[j] > 0 ? wish.weights[j] / std::sqrt(squares[j]) : 0);
    points.push_back(&wish.pairs);
  }
  if (factors.empty()) return linalg::Block(basis_.localRows());
  // Fewer columns than residuals: those of several points are much alike.
  const linalg::DenseMatrix combinations =
      linalg::leadingCombinations(sketches, factors, 0.8 * resolution);
  const std::size_t all = factors.size(), count = combinations.size() / all;
  if (count == 0) return linalg::Block(basis_.localRows());
  linalg::Block columns(basis_.localRows(), static_cast<PetscInt>(count));
  terms_.addTo(points, combinations, columns);
  std::size_t first = 0;
  for (const auto& wish : wishes) {
    const auto own = static_cast<std::size_t>(wish.pairs.pairs.columns);
    wish.work->ownTerms.addTo({&wish.pairs}, linalg::rowsOf(combinations, all, first, own),
                              columns);
    first += own;
  }
  return linalg::principal(basis_.comm(), columns, resolution);
}

/// Dense problems of the points that are not done, and their errors.
void ReducedProblem::solveDense(const std::vector<Work*>& open) {
  std::vector<linalg::DenseProblem> problems;
  for (const auto* work : open) problems.push_back(project(*work));
  auto solved = linalg::solveSpread(basis_.comm(), problems, linalg::Vectors::both,
                                    [&](auto s) { return bandTop_ == 0 || inBand(s); });
  for (std::size_t i = 0; i < open.size(); ++i) {
    open[i]->pairs = std::move(solved[i]);
    judge(*open[i], problems[i]);
  }
}

/// By how much a residual made with the matrices exceeds that made with the images of the basis.
double ReducedProblem::drift(const Work& work, const linalg::DensePair& pair,
                             const linalg::Block& columns, pencil::Side side) const {
  const PointPairs alone{work.point->at, Coordinates({&pair}, work.damped)};
  const auto sum = [](const std::vector<double>& squares) {
    return std::accumulate(squares.begin(), squares.end(), 0.0);
  };
  const double known = sum(linalg::squaredNorms(residualSketch(work, alone, side)).weighted),
               exact = sum(
                   linalg::squaredNorms(basis_.sketch().of(columns.values.data(), columns.columns))
                       .weighted);
  return std::max(1.0, std::sqrt(exact / known));
}

/// Solves for the residuals of the pair with the largest estimate of all points so far. If that
/// shows the estimates to be too small, those that are no longer good enough are left to do.
std::vector<ReducedProblem::Work*> ReducedProblem::unconfirmed(std::vector<Work>& works) {
  std::vector<Work*> open;
  Work* worst = nullptr;
  std::size_t pair = 0;
  double largest =
      std::max(confirmed_, 1e-3 * toleranceOption.get());  // below: next to nothing, or rounding
  for (auto& work : works)
    for (std::size_t j = 0; j < work.pairs.size(); ++j)
      if (const double error = errorOf(work, j); std::isfinite(error) && error > largest)
        worst = &work, pair = j, largest = error;
  if (!worst) return open;
  confirmed_ = largest;
  worst->ownTerms.extend();  // the basis may have grown since
  linalg::DensePair& known = worst->pairs[pair];
  for (auto* vector : {&known.q, &known.left})
    vector->resize(static_cast<std::size_t>(basis_.size()));
  const auto vectors = basis_.expand({&known.q, &known.left});
  const linalg::Block right = residualColumns(*worst, known, vectors[0], pencil::Side::right),
                      left = residualColumns(*worst, known, vectors[1], pencil::Side::left);
  const auto ratios = basis_.energyRatios({right, left});
  measuredRatio_ =
      std::max(measuredRatio_, ratios[0] * drift(*worst, known, right, pencil::Side::right));
  rightRatio_ = std::max(rightRatio_, measuredRatio_);
  leftRatio_ = std::max(leftRatio_, ratios[1] * drift(*worst, known, left, pencil::Side::left));
  for (auto& work : works)
    if (!good(work)) open.push_back(&work);
  return open;
}

ReducedProblem::Work ReducedProblem::begun(const PointProblem& point, const Norms& norms) const {
  const auto& pencil = point.pencil;
  return {&point,
          ProjectedTerms(basis_, pencil, pencil.affineCount(), pencil.terms().size()),
          pencil.hasPower(1),
          norms,
          {},
          {},
          {},
          {},
          {}};
}

ReducedProblem::Norms ReducedProblem::normsOf(const PointProblem& point) {
  const auto& pencil = point.pencil;
  norms_.emplace_back(point.at, Norms{pencil.norm(0, point.at), pencil.norm(1, point.at),
                                      pencil.norm(2, point.at)});
  return norms_.back().second;
}

/// Those of the point solved that is nearest in friction: they take many products with large
/// matrices.
ReducedProblem::Norms ReducedProblem::nearbyNorms(const PointProblem& point) {
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

std::vector<pencil::FrictionPoint> ReducedProblem::solve(const std::vector<PointProblem>& batch,
                                                         Mat trial) {
  std::vector<Work> works;
  std::vector<Work*> open;
  if (!responded_ && correctionsWanted() && basis_.size() < unknowns_)
    addStaticResponses(batch.front());
  responded_ = true;
  for (const auto& point : batch) works.push_back(begun(point, normsOf(point)));
  for (auto& work : works) open.push_back(&work);
  const PetscInt largest =
      std::min(basis_.size() + static_cast<PetscInt>(growthOption.get()), unknowns_);
  for (int round = 0; !open.empty(); ++round) {
    extend(open);
    solveDense(open);
    std::erase_if(open, [&](const Work* work) { return good(*work); });
    if (open.empty()) {
      open = unconfirmed(works);
      continue;
    }
    if (round >= roundsOption.get() || basis_.size() >= largest) break;
    std::vector<Wish> wishes;
    for (const auto* work : open) wishes.push_back(wishOf(*work));
    if (basis_.add(directions(wishes)) == 0) break;  // residuals are rounding
    rightRatio_ = std::max(measuredRatio_, basis_.lastEnergyRatio());
  }
  std::vector<pencil::FrictionPoint> points;
  for (const auto& work : works) points.push_back(result(work));
  keepShapes(points, works, trial);
  for (auto& work : works) solved_.push_back(std::move(work.pairs));
  if (basisOption.get() == "pod") compress();
  return points;
}

pencil::FrictionPoint ReducedProblem::result(const Work& work) const {
  pencil::FrictionPoint point;
  point.at = work.point->at;
  point.bandTop = bandTop_;
  point.freeModesInBand = static_cast<int>(
      std::count_if(modes_.begin(), modes_.end(), [&](double w) { return w <= bandTop_; }));
  point.damped = work.damped;
  point.accuracy = pencil::accuracyAsked();
  point.tolerance = toleranceOption.get();
  for (std::size_t j = 0; j < work.pairs.size(); ++j) {
    const double estimate = errorOf(work, j) + work.rounding[j];
    point.eigenvalues.push_back(
        {work.pairs[j].s, work.backwardError[j], estimate,
         work.backwardError[j] <= point.accuracy && estimate <= point.tolerance});
  }
  pencil::judge(point.eigenvalues);
  return point;
}

/// Shapes of all points, made together: each product with the basis reads the whole of it.
void ReducedProblem::keepShapes(std::vector<pencil::FrictionPoint>& points,
                                const std::vector<Work>& works, Mat trial) const {
  std::vector<std::vector<std::size_t>> wanted;
  std::vector<const std::vector<std::complex<double>>*> list;
  for (std::size_t i = 0; i < points.size(); ++i) {
    wanted.push_back(pencil::shapesWanted(points[i]));
    for (std::size_t index : wanted.back()) list.push_back(&works[i].pairs[index].q);
  }
  if (list.empty()) return;
  auto all = basis_.expand(list);
  auto next = std::make_move_iterator(all.begin());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto count = static_cast<std::ptrdiff_t>(wanted[i].size());
    pencil::keepShapes(points[i], trial, wanted[i], {next, next + count});
    next += count;
  }
}

linalg::DenseProblem ReducedProblem::project(const PointProblem& point) const {
  return project(begun(point, {}));
}

linalg::DenseProblem ReducedProblem::project(const Work& work) const {
  linalg::DenseProblem problem;
  terms_.addTo(work.point->at, problem);
  work.ownTerms.addTo(work.point->at, problem);
  return problem;
}

Improvement ReducedProblem::improve(
    const std::vector<std::pair<PointProblem, std::vector<linalg::DensePair>>>& located) {
  Improvement result;
  std::vector<Work> works;
  works.reserve(located.size());
  std::vector<Wish> wishes;
  for (const auto& [point, pairs] : located) {
    Work& work = works.emplace_back(begun(point, nearbyNorms(point)));
    work.pairs = pairs;
    for (auto& pair : work.pairs)  // they may be of a smaller basis
      for (auto* vector : {&pair.q, &pair.left})
        vector->resize(static_cast<std::size_t>(basis_.size()));
    judge(work, project(work));
    result.backwardError.push_back(
        *std::max_element(work.backwardError.begin(), work.backwardError.end()));
    if (result.backwardError.back() < rounding) continue;
    // Both parts of a residual in units of the whole: one of them may be rounding.
    wishes.push_back({&work,
                      {point.at, Coordinates(pointers(work.pairs), true)},
                      std::vector<double>(pairs.size(), 1.0)});
  }
  result.changed = basis_.add(directions(wishes)) > 0;
  terms_.extend();
  return result;
}

pencil::WatchedBand ReducedProblem::band() const { return {bandTop_, 1.3, pencil::bandDamping()}; }

bool ReducedProblem::inBand(std::complex<double> s) const {
  return std::abs(s) <= bandTop_ && -s.real() <= pencil::bandDamping() * std::abs(s);
}

}  // namespace squeal::reduction
