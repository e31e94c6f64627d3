#include "flutter/reduced.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "flutter/condition.hpp"
#include "flutter/select.hpp"
#include "petsc/options.hpp"
#include "petsc/symmetric.hpp"

namespace squeal::flutter {
namespace {

const ChoiceOption basisOption(
    "flutter", "reduction_basis", {"corrected", "modal", "pod"}, "corrected",
    "corrected: free modes, static responses to friction and to residuals; pod: after each batch of points "
    "the principal directions of the vectors found so far; modal: free modes alone");
const RealOption toleranceOption("flutter", "flutter_tolerance", 1e-8, "", positive,
                                 "estimated relative error |ds|/|s| to which the eigenvalues of the band are corrected");
const RealOption bandOption("flutter", "flutter_band", 0, "Hz", nonNegative,
                            "frequency up to which eigenvalues are corrected and listed; 0: that of mode 0.55 x -modes_count");
const RealOption bandDampingOption("flutter", "flutter_band_damping", 0.5, "", positive,
                                   "eigenvalues of a larger damping ratio, which die away within a cycle, are not listed");
const IntegerOption roundsOption("flutter", "flutter_rounds", 15, 0, "most rounds of corrections at one batch of points");
const IntegerOption growthOption("flutter", "flutter_growth", 1000, 0,
                                 "most vectors that corrections may add to the basis at one batch of points");

/// Between two free modes, a little more than half up the list, that are not a double one: no eigenvalue sits on the edge for rounding
/// to decide.
double bandOfModes(const std::vector<double>& w) {
  std::size_t k = w.size() * 11 / 20;
  while (k + 1 < w.size() && w[k + 1] < (1 + 1e-4) * w[k]) ++k;
  return k + 1 < w.size() ? 0.5 * (w[k] + w[k + 1]) : w.back();
}

bool correctionsWanted() { return basisOption.get() != "modal"; }

/// What a direction of the residuals leaves unresolved of them, as a part of their size: a round gains a decade, and what it need not
/// resolve it need not solve for.
constexpr double resolution = 0.03;
/// Backward errors below have nothing to correct.
constexpr double rounding = 1e-14;

std::vector<const DensePair*> pointers(const std::vector<DensePair>& pairs) {
  std::vector<const DensePair*> list;
  for (const auto& pair : pairs) list.push_back(&pair);
  return list;
}

/// Orthogonal combinations of columns that hold them but for parts of length `small`.
Block principal(MPI_Comm comm, const Block& columns, double small) {
  if (columns.columns == 0) return columns;
  DenseMatrix combinations = transposedProduct(comm, columns, columns);
  const auto sizes = symmetricEigen(combinations, static_cast<int>(columns.columns));
  const auto n = static_cast<std::size_t>(columns.columns);
  std::size_t first = 0;
  while (first < n && !(sizes[first] > small * small)) ++first;
  combinations.erase(combinations.begin(), combinations.begin() + static_cast<std::ptrdiff_t>(first * n));
  Block kept(columns.rows, static_cast<PetscInt>(n - first));
  multiplyAdd(columns.values.data(), columns.rows, columns.columns, combinations, kept.values);
  return kept;
}

/// Orthonormal vectors that hold the columns (m high) but for parts of length `small`.
DenseMatrix principalDirections(DenseMatrix columns, int rows, double small) {
  PetscBLASInt m = rows, n = static_cast<PetscBLASInt>(columns.size()) / m, few = std::min(m, n), one = 1, query = -1, info = 0;
  std::vector<double> sizes(static_cast<std::size_t>(few)), left(static_cast<std::size_t>(m * few)), work(1);
  const auto call = [&](PetscBLASInt length) {
    LAPACKgesvd_("S", "N", &m, &n, columns.data(), &m, sizes.data(), left.data(), &m, nullptr, &one, work.data(), &length, &info);
  };
  call(query);
  work.resize(static_cast<std::size_t>(work[0]));
  call(static_cast<PetscBLASInt>(work.size()));
  if (info != 0) throw Error("LAPACK dgesvd failed on the vectors of -reduction_basis pod (info " + std::to_string(info) + ")");
  const auto kept = std::count_if(sizes.begin(), sizes.end(), [&](double size) { return size > small; });
  left.resize(static_cast<std::size_t>(m * kept));
  return left;
}

/// Coordinates of the same vector in a basis V · directions.
std::vector<std::complex<double>> turned(const DenseMatrix& directions, std::size_t m, const std::vector<std::complex<double>>& q) {
  std::vector<std::complex<double>> result(directions.size() / m);
  for (std::size_t j = 0; j < result.size(); ++j)
    for (std::size_t i = 0; i < q.size(); ++i) result[j] += directions[j * m + i] * q[i];
  return result;
}

/// For an undamped problem, pairs that are −s̄ and the conjugate vectors of the pair before: their errors are the same.
std::vector<bool> mirrorImages(const std::vector<DensePair>& pairs, bool damped) {
  std::vector<bool> mirrored(pairs.size(), false);
  for (std::size_t j = 1; j < pairs.size() && !damped; ++j)
    mirrored[j] = !mirrored[j - 1] && pairs[j].s.real() != 0 && pairs[j].s == -std::conj(pairs[j - 1].s);
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

/// The columns that have a length, of unit length.
Block unitColumns(const Block& columns, const std::vector<double>& squares) {
  Block units(columns.rows);
  for (PetscInt j = 0; j < columns.columns; ++j)
    if (const double square = squares[static_cast<std::size_t>(j)]; square > 0)
      units.append(columns.column(j), 1 / std::sqrt(square));
  return units;
}

void append(Block& block, const Block& other) {
  for (PetscInt j = 0; j < other.columns; ++j) block.append(other.column(j));
}

}  // namespace

/// A point on its way.
struct ReducedProblem::Work {
  const PointProblem* point;
  ProjectedTerms ownTerms;
  std::array<double, 3> norms;        // of K̄, Z̄, M̄
  std::vector<DensePair> pairs;       // of the band, with left vectors
  std::vector<double> backwardError;  // [pair]
  // |δs|/|s| is at most the product of the two, each with the norm of diag(K0)⁻¹ for that of K0⁻¹
  std::vector<double> rightError;  // [pair] of the right vector, times the condition number of s
  std::vector<double> leftError;   // [pair] of the left vector, 1 at most
  Block wanted;                    // what the basis lacks; no columns: the point is done
};

ReducedProblem::ReducedProblem(const Pencil& pencil, Mat stiffness, KSP solver, const modes::Modes& modes)
    : basis_(modes, stiffness, solver), terms_(basis_, pencil, 0, pencil.terms().size()) {
  check(BVGetSizes(modes.vectors, nullptr, &unknowns_, nullptr));
  highestMode_ = modes.angularFrequency.back();
  if (!correctionsWanted()) return;
  bandTop_ = bandOption.get() > 0 ? 2 * M_PI * bandOption.get() : bandOfModes(modes.angularFrequency);
  addStaticResponses(pencil, modes);
}

/// K0⁻¹ k φ_i and K0⁻¹ kᵀφ_i for the friction forces k on the free modes of the band at their own frequencies: the change of the right and
/// left vectors with friction, to first order in it and to lowest order in the frequency.
void ReducedProblem::addStaticResponses(const Pencil& pencil, const modes::Modes& modes) {
  std::vector<DensePair> free;
  for (std::size_t i = 0; i < modes.angularFrequency.size() && modes.angularFrequency[i] <= bandTop_; ++i) {
    free.push_back(
        {{0, modes.angularFrequency[i]}, std::vector<std::complex<double>>(static_cast<std::size_t>(basis_.size())), {}});
    free.back().q[i] = 1;
  }
  for (const Side side : {Side::right, Side::left}) {
    std::vector<Term> friction;
    for (const auto& term : pencil.terms()) {
      if (term.frictionExponent == 0) continue;
      friction.push_back(term.share());
      if (side == Side::left) check(MatTranspose(term.matrix, MAT_INITIAL_MATRIX, friction.back().matrix.out()));
    }
    if (friction.empty()) return;
    for (auto& pair : free) pair.q.resize(static_cast<std::size_t>(basis_.size()));
    const Pencil forces(std::move(friction));
    const Coordinates pairs(pointers(free), forces.hasPower(1));
    Block responses(basis_.localRows(), pairs.columns);
    ProjectedTerms(basis_, forces, 0, forces.terms().size()).addTo({1, 1, 1, 1}, pairs, responses);
    const auto squares = squaredNorms(basis_.sketch().of(responses.values.data(), responses.columns)).euclidean;
    basis_.add(principal(basis_.comm(), unitColumns(responses, squares), resolution));
    if (side == Side::right) rightRatio_ = basis_.lastEnergyRatio();
  }
  terms_.extend();
}

/// Brings what depends on the basis up to it.
void ReducedProblem::extend(const std::vector<Work*>& works) {
  terms_.extend();
  for (auto* work : works) work->ownTerms.extend();
}

/// Columns of the residuals P(s) V q.
Block ReducedProblem::residuals(const Work& work, const Coordinates& coordinates) const {
  Block result(basis_.localRows(), coordinates.columns);
  terms_.addTo(work.point->at, coordinates, result);
  work.ownTerms.addTo(work.point->at, coordinates, result);
  return result;
}

/// The residual P(s)ᴴ V y of one pair, real and imaginary part.
Block ReducedProblem::leftResidual(const Work& work, const DensePair& pair) const {
  Block result(basis_.localRows());
  OwnedVec real, imaginary, sum[2], part;
  check(MatCreateVecs(work.point->pencil.terms()[0].matrix, real.out(), nullptr));
  for (auto* vec : {&imaginary, &sum[0], &sum[1], &part}) check(VecDuplicate(real, vec->out()));
  expand(pair.left, real, imaginary);
  check(VecZeroEntries(sum[0]));
  check(VecZeroEntries(sum[1]));
  for (const auto& term : work.point->pencil.terms()) {
    const std::complex<double> c = term.coefficient(work.point->at) * std::pow(std::conj(pair.s), term.power);
    for (const bool second : {false, true}) {
      const std::complex<double> factor = second ? c * std::complex<double>(0, 1) : c;
      check(MatMultTranspose(term.matrix, second ? imaginary : real, part));
      check(VecAXPY(sum[0], factor.real(), part));
      check(VecAXPY(sum[1], factor.imag(), part));
    }
  }
  for (const auto& vec : sum) {
    const PetscScalar* entries = nullptr;
    check(VecGetArrayRead(vec, &entries));
    result.append(entries);
    check(VecRestoreArrayRead(vec, &entries));
  }
  return result;
}

/// Estimate of |δs|/|s|.
double ReducedProblem::errorOf(const Work& work, std::size_t pair) const {
  return rightRatio_ * work.rightError[pair] * std::min(1.0, leftRatio_ * work.leftError[pair]);
}

/// By how much the errors of a pair are too large; nothing can be done about those of rounding.
double ReducedProblem::excess(const Work& work, std::size_t pair) const {
  if (bandTop_ == 0 || work.backwardError[pair] < rounding) return 0;
  return std::max(work.backwardError[pair] / accuracyAsked(), errorOf(work, pair) / toleranceOption.get());
}

/// Norms of the residuals of one side, raised by what their sketch may miss.
SquaredNorms ReducedProblem::residualNorms(const Work& work, const Coordinates& coordinates, Side side) const {
  DenseMatrix sketch(static_cast<std::size_t>(2 * Sketch::size * coordinates.columns));
  terms_.addTo(work.point->at, coordinates, side, sketch);
  work.ownTerms.addTo(work.point->at, coordinates, side, sketch);
  SquaredNorms norms = squaredNorms(sketch);
  for (auto* list : {&norms.euclidean, &norms.weighted}) {
    *list = perPair(coordinates, *list);
    for (auto& square : *list) square *= Sketch::safety * Sketch::safety;
  }
  return norms;
}

/// Errors of the pairs of a point.
void ReducedProblem::judge(Work& work, const DenseProblem& problem) const {
  const auto& pairs = work.pairs;
  const Coordinates coordinates(pointers(pairs), !problem.damping.empty());
  const auto right = residualNorms(work, coordinates, Side::right), left = residualNorms(work, coordinates, Side::left);
  DenseMatrix vectors(static_cast<std::size_t>(2 * Sketch::size * coordinates.columns));
  multiplyAdd(basis_.sketched().data(), 2 * Sketch::size, basis_.size(), coordinates.times(Side::right, 0, 1), vectors);
  const auto lengths = perPair(coordinates, squaredNorms(vectors).euclidean);
  const auto conditions = conditionNumbers(problem, pairs);
  work.backwardError.clear();
  work.rightError.clear();
  work.leftError.clear();
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const double size = std::abs(pairs[j].s), scale = work.norms[0] + size * work.norms[1] + size * size * work.norms[2];
    work.backwardError.push_back(std::sqrt(right.euclidean[j] / lengths[j]) / scale);
    work.rightError.push_back(conditions[j] * std::sqrt(right.weighted[j]));
    work.leftError.push_back(size < highestMode_ ? std::sqrt(left.weighted[j]) / (1 - std::pow(size / highestMode_, 2)) : INFINITY);
  }
}

/// Directions that hold the residuals of the pairs that are not good enough, each but for `resolution` of it, or for what is good
/// enough.
Block ReducedProblem::directions(const Work& work, bool damped) const {
  const auto mirrored = mirrorImages(work.pairs, damped);
  std::vector<const DensePair*> bad;
  std::vector<double> weights;
  for (std::size_t j = 0; j < work.pairs.size(); ++j)
    if (const double tooLarge = excess(work, j); tooLarge > 1 && !mirrored[j]) {
      bad.push_back(&work.pairs[j]);
      weights.push_back(std::min(1.0, 2 * resolution * tooLarge));
    }
  const Coordinates coordinates(bad, damped);
  const Block columns = residuals(work, coordinates);
  const auto squares = perPair(coordinates, squaredNorms(basis_.sketch().of(columns.values.data(), columns.columns)).euclidean);
  Block weighted(columns.rows);
  for (std::size_t j = 0; j < bad.size(); ++j)
    for (auto c = coordinates.firstColumn[j]; c < coordinates.firstColumn[j + 1]; ++c)
      weighted.append(columns.column(c), weights[j] / std::sqrt(squares[j]));
  return principal(basis_.comm(), weighted, resolution);
}

/// Dense problems of the points that are not done, and their errors.
void ReducedProblem::solveDense(const std::vector<Work*>& open) {
  std::vector<DenseProblem> problems;
  for (const auto* work : open) {
    problems.emplace_back();
    terms_.addTo(work->point->at, problems.back());
    work->ownTerms.addTo(work->point->at, problems.back());
  }
  auto solved = solveSpread(basis_.comm(), problems, Vectors::both, [&](auto s) { return bandTop_ == 0 || inBand(s); });
  for (std::size_t i = 0; i < open.size(); ++i) {
    open[i]->pairs = std::move(solved[i]);
    judge(*open[i], problems[i]);
    open[i]->wanted = directions(*open[i], !problems[i].damping.empty());
  }
}

/// Solves for the worst residuals of all points. If that shows the estimates to be too small, those that are no longer good enough are
/// left to do.
std::vector<ReducedProblem::Work*> ReducedProblem::unconfirmed(std::vector<Work>& works) {
  Block worst(basis_.localRows()), worstLeft(basis_.localRows());
  for (auto& work : works) {
    std::size_t j = 0;
    for (std::size_t k = 0; k < work.pairs.size(); ++k)
      if (errorOf(work, k) > errorOf(work, j)) j = k;
    if (work.pairs.empty() || errorOf(work, j) < 1e-3 * toleranceOption.get()) continue;  // next to nothing, or rounding
    work.ownTerms.extend();                                                               // the basis may have grown since
    work.pairs[j].q.resize(static_cast<std::size_t>(basis_.size()));
    work.pairs[j].left.resize(static_cast<std::size_t>(basis_.size()));
    append(worst, residuals(work, Coordinates({&work.pairs[j]}, true)));
    append(worstLeft, leftResidual(work, work.pairs[j]));
  }
  rightRatio_ = std::max(rightRatio_, basis_.energyRatio(worst));
  leftRatio_ = std::max(leftRatio_, basis_.energyRatio(worstLeft));
  std::vector<Work*> open;
  for (auto& work : works) {
    double largest = 0;
    for (std::size_t j = 0; j < work.pairs.size(); ++j) largest = std::max(largest, excess(work, j));
    if (largest > 1) open.push_back(&work);
  }
  return open;
}

std::vector<FrictionPoint> ReducedProblem::solve(const std::vector<PointProblem>& batch, Mat trial) {
  std::vector<Work> works;
  std::vector<Work*> open;
  for (const auto& point : batch) {
    const auto& pencil = point.pencil;
    works.push_back({&point,
                     ProjectedTerms(basis_, pencil, pencil.affineCount(), pencil.terms().size()),
                     {pencil.norm(0, point.at), pencil.norm(1, point.at), pencil.norm(2, point.at)},
                     {},
                     {},
                     {},
                     {},
                     Block(0)});
  }
  for (auto& work : works) open.push_back(&work);
  const PetscInt largest = std::min(basis_.size() + static_cast<PetscInt>(growthOption.get()), unknowns_);
  for (int round = 0; !open.empty(); ++round) {
    extend(open);
    solveDense(open);
    std::erase_if(open, [](const Work* work) { return work->wanted.columns == 0; });
    if (open.empty()) {
      open = unconfirmed(works);
      continue;
    }
    if (round >= roundsOption.get() || basis_.size() >= largest) break;
    Block wanted(basis_.localRows());
    for (const auto* work : open) append(wanted, work->wanted);
    if (basis_.add(open.size() > 1 ? principal(basis_.comm(), wanted, resolution) : wanted) == 0) break;  // residuals are rounding
    rightRatio_ = basis_.lastEnergyRatio();
  }
  std::vector<FrictionPoint> points;
  for (auto& work : works) points.push_back(result(work, trial));
  if (basisOption.get() == "pod") compress();
  return points;
}

FrictionPoint ReducedProblem::result(Work& work, Mat trial) {
  FrictionPoint point;
  point.at = work.point->at;
  point.bandTop = bandTop_;
  point.accuracy = accuracyAsked();
  point.tolerance = toleranceOption.get();
  for (std::size_t j = 0; j < work.pairs.size(); ++j) {
    const double estimate = errorOf(work, j);
    point.eigenvalues.push_back(
        {work.pairs[j].s, work.backwardError[j], estimate, work.backwardError[j] <= point.accuracy && estimate <= point.tolerance});
  }
  flutter::judge(point.eigenvalues);
  keepShapes(point, trial, [&](std::size_t index, Vec real, Vec imaginary) { expand(work.pairs[index].q, real, imaginary); });
  point.solvedIndex = solved_.size();
  solved_.push_back(std::move(work.pairs));
  return point;
}

DenseProblem ReducedProblem::project(const PointProblem& point) const {
  DenseProblem problem;
  terms_.addTo(point.at, problem);
  ProjectedTerms(basis_, point.pencil, point.pencil.affineCount(), point.pencil.terms().size()).addTo(point.at, problem);
  return problem;
}

Improvement ReducedProblem::improve(const std::vector<std::pair<PointProblem, std::vector<DensePair>>>& located) {
  Improvement result;
  Block wanted(basis_.localRows());
  for (const auto& [point, pairs] : located) {
    const auto& pencil = point.pencil;
    Work work{&point,
              ProjectedTerms(basis_, pencil, pencil.affineCount(), pencil.terms().size()),
              {pencil.norm(0, point.at), pencil.norm(1, point.at), pencil.norm(2, point.at)},
              pairs,
              {},
              {},
              {},
              Block(0)};
    judge(work, project(point));
    result.backwardError.push_back(*std::max_element(work.backwardError.begin(), work.backwardError.end()));
    if (result.backwardError.back() < rounding) continue;
    // Both parts of a residual in units of the whole: one of them may be rounding.
    const Coordinates coordinates(pointers(pairs), true);
    const Block columns = residuals(work, coordinates);
    const auto squares = perPair(coordinates, squaredNorms(basis_.sketch().of(columns.values.data(), columns.columns)).euclidean);
    for (std::size_t j = 0; j < pairs.size(); ++j)
      for (auto c = coordinates.firstColumn[j]; c < coordinates.firstColumn[j + 1]; ++c)
        wanted.append(columns.column(c), 1 / std::sqrt(squares[j]));
  }
  result.changed = wanted.columns > 0 && basis_.add(principal(basis_.comm(), wanted, resolution)) > 0;
  terms_.extend();
  return result;
}

WatchedBand ReducedProblem::band() const { return {bandTop_, 1.3, bandDampingOption.get()}; }

bool ReducedProblem::inBand(std::complex<double> s) const {
  return std::abs(s) <= bandTop_ && -s.real() <= bandDampingOption.get() * std::abs(s);
}

/// Turns the basis to the principal directions of all vectors found so far.
void ReducedProblem::compress() {
  constexpr double left = 1e-9;  // of a unit vector; what is lost, corrections bring back
  const PetscInt old = basis_.size();
  const auto m = static_cast<std::size_t>(old);
  DenseMatrix vectors;
  for (const auto& pairs : solved_)
    for (const auto& pair : pairs)
      for (const bool imaginary : {false, true}) {
        for (std::size_t i = 0; i < m; ++i) {
          const std::complex<double> entry = i < pair.q.size() ? pair.q[i] : 0;
          vectors.push_back(imaginary ? entry.imag() : entry.real());
        }
      }
  const DenseMatrix directions = principalDirections(vectors, static_cast<int>(old), left);
  const auto count = static_cast<PetscInt>(directions.size() / m);
  basis_.combine(directions, count);
  terms_.combine(directions);
  highestMode_ = 0;  // the modes are no longer in the basis
  for (auto& pairs : solved_)
    for (auto& pair : pairs) {
      pair.q = turned(directions, m, pair.q);
      pair.left = turned(directions, m, pair.left);
    }
}

/// V q.
void ReducedProblem::expand(const std::vector<std::complex<double>>& q, Vec real, Vec imaginary) const {
  const ReadColumns v(basis_.columns());
  std::vector<double> coordinates(2 * static_cast<std::size_t>(v.columns()), 0.0),
      shape(2 * static_cast<std::size_t>(v.rows()), 0.0);
  for (std::size_t i = 0; i < q.size(); ++i) {
    coordinates[i] = q[i].real();
    coordinates[static_cast<std::size_t>(v.columns()) + i] = q[i].imag();
  }
  multiplyAdd(v.values(), v.rows(), v.columns(), coordinates, shape);
  for (Vec part : {real, imaginary}) {
    PetscScalar* entries = nullptr;
    check(VecGetArray(part, &entries));
    std::copy_n(shape.begin() + (part == imaginary ? v.rows() : 0), v.rows(), entries);
    check(VecRestoreArray(part, &entries));
  }
}

}  // namespace squeal::flutter
