#include <cmath>

#include "flutter/dense.hpp"
#include "flutter/select.hpp"
#include "petsc/options.hpp"
#include "petsc/symmetric.hpp"

namespace squeal::flutter {
namespace {

const ChoiceOption basisOption(
    "flutter", "reduction_basis", {"corrected", "modal"}, "corrected",
    "corrected: free modes and static corrections of the residuals in the band; modal: free modes alone");
const RealOption accuracyOption("flutter", "flutter_accuracy", 1e-9, "", positive,
                                "full-order backward error to which the eigenvalues of the band are corrected");
const RealOption bandOption("flutter", "flutter_band", 0, "Hz", nonNegative,
                            "frequency up to which eigenvalues are corrected; 0: that of mode 0.4 x -modes_count");
const RealOption bandDampingOption("flutter", "flutter_band_damping", 0.5, "", positive,
                                   "eigenvalues of a larger damping ratio, which die away within a cycle, are not corrected");
const IntegerOption roundsOption("flutter", "flutter_rounds", 12, 0, "most rounds of corrections at one friction");
const IntegerOption growthOption("flutter", "flutter_growth", 1000, 0,
                                 "most vectors that corrections may add to the basis at one friction");

/// Between two free modes, two fifths up the list, that are not a double one: no eigenvalue sits on the edge for rounding to decide.
double bandOfModes(const std::vector<double>& w) {
  std::size_t k = w.size() * 2 / 5;
  while (k + 1 < w.size() && w[k + 1] < (1 + 1e-4) * w[k]) ++k;
  return k + 1 < w.size() ? 0.5 * (w[k] + w[k + 1]) : w.back();
}

bool correctionsWanted() { return basisOption.get() == "corrected"; }

/// A projection of `old` columns grown to `size`: the new columns, and the new rows below the old columns (empty: by symmetry).
void grow(DenseMatrix& matrix, PetscInt old, PetscInt size, const DenseMatrix& right, const DenseMatrix& below) {
  const auto n = static_cast<std::size_t>(size), o = static_cast<std::size_t>(old), added = n - o;
  DenseMatrix grown(n * n);
  for (std::size_t j = 0; j < o; ++j) {
    std::copy_n(matrix.begin() + static_cast<std::ptrdiff_t>(j * o), o, grown.begin() + static_cast<std::ptrdiff_t>(j * n));
    for (std::size_t i = 0; i < added; ++i) grown[j * n + o + i] = below.empty() ? right[i * n + j] : below[j * added + i];
  }
  std::copy(right.begin(), right.end(), grown.begin() + static_cast<std::ptrdiff_t>(o * n));
  matrix = std::move(grown);
}

/// Real and imaginary parts of c s_j^power q_j as columns 2j, 2j+1.
std::vector<double> columns(const std::vector<DensePair>& pairs, int power, double c = 1) {
  std::vector<double> matrix;
  for (const auto& pair : pairs) {
    const std::complex<double> factor = c * std::pow(pair.s, power);
    for (const auto& entry : pair.q) matrix.push_back((factor * entry).real());
    for (const auto& entry : pair.q) matrix.push_back((factor * entry).imag());
  }
  return matrix;
}

struct Found {
  Eigenvalue eigenvalue;
  DensePair pair;
};

/// Squared 2-norms over all ranks of the complex columns held as pairs of real ones.
std::vector<double> squaredNorms(MPI_Comm comm, const std::vector<double>& values, std::size_t rows, std::size_t count) {
  std::vector<double> sums(count, 0.0);
  for (std::size_t j = 0; j < count; ++j)
    for (std::size_t i = 2 * j * rows; i < 2 * (j + 1) * rows; ++i) sums[j] += values[i] * values[i];
  check(MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(count), MPI_DOUBLE, MPI_SUM, comm));
  return sums;
}

}  // namespace

/// Residuals P(s) V q of some pairs and their backward errors.
struct ReducedProblem::Residuals {
  std::size_t rows = 0;
  std::vector<double> residual;       // [pair][real, imaginary][local row]
  std::vector<double> squaredNorm;    // [pair]
  std::vector<double> backwardError;  // [pair]
};

ReducedProblem::ReducedProblem(const Pencil& pencil, Mat mass, KSP solver, const modes::Modes& modes)
    : pencil_(pencil), solver_(solver), basis_(modes.vectors, mass) {
  const auto& w = modes.angularFrequency;
  modeCount_ = w.size();
  check(BVGetSizes(modes.vectors, nullptr, &unknowns_, nullptr));
  if (correctionsWanted()) bandTop_ = bandOption.get() > 0 ? 2 * M_PI * bandOption.get() : bandOfModes(w);
  extend();
}

/// Forgets the terms of the last point; those of this one are projected on the whole basis.
void ReducedProblem::enter() {
  while (images_.size() > pencil_.affineCount()) images_.pop_back();
  extend();
}

/// Images and projections of what the basis and the pencil have gained.
void ReducedProblem::extend() {
  const auto& terms = pencil_.terms();
  while (images_.size() < terms.size()) images_.push_back({Image(terms[images_.size()].matrix), {}, 0});
  for (std::size_t t = 0; t < terms.size(); ++t) project(terms[t].matrix, images_[t]);
  const PetscInt old = gramSize_, size = basis_.size();
  const ReadColumns all(basis_.columns());
  grow(gram_, old, size,
       transposedProduct(pencil_.comm(), all.values(), all.rows(), size, all.values() + old * all.rows(), size - old), {});
  gramSize_ = size;
}

/// Brings A V and Vᵀ A V up to the columns that the basis has.
void ReducedProblem::project(Mat matrix, ProjectedTerm& term) const {
  const PetscInt old = term.columns, size = basis_.size(), added = size - old;
  if (added == 0) return;
  const OwnedBV fresh = columnsLike(basis_.columns(), added), product = columnsLike(basis_.columns(), added);
  check(BVSetActiveColumns(basis_.columns(), old, size));
  check(BVCopy(basis_.columns(), fresh));
  check(BVSetActiveColumns(basis_.columns(), 0, size));
  check(BVMatMult(fresh, matrix, product));
  const ReadColumns all(basis_.columns()), image(product);
  term.image.append(image.values(), added);
  PetscBool known = PETSC_FALSE, symmetric = PETSC_FALSE;
  check(MatIsSymmetricKnown(matrix, &known, &symmetric));
  const auto right = term.image.transposedProduct(pencil_.comm(), all, 0, size, old, size);  // Vᵀ (A V_new)
  const auto below = known && symmetric ? DenseMatrix{}
                                        : term.image.transposedProduct(pencil_.comm(), all, old, size, 0, old);  // V_newᵀ (A V_old)
  grow(term.projection, old, size, right, below);
  term.columns = size;
}

/// Σ c_t Vᵀ A_t V of one power of s on the first `columns` of the basis.
std::vector<double> ReducedProblem::projected(int power, const Parameters& at, PetscInt columns) const {
  const auto m = static_cast<std::size_t>(columns), size = static_cast<std::size_t>(basis_.size());
  std::vector<double> sum;
  for (std::size_t t = 0; t < images_.size(); ++t) {
    if (pencil_.terms()[t].power != power) continue;
    sum.resize(m * m, 0.0);
    const double c = pencil_.terms()[t].coefficient(at);
    for (std::size_t j = 0; j < m; ++j)
      for (std::size_t i = 0; i < m; ++i) sum[j * m + i] += c * images_[t].projection[j * size + i];
  }
  return sum;
}

/// Collective. Eigenvalues on the first `columns` of the basis, by ascending frequency; q has the length of the whole basis.
std::vector<DensePair> ReducedProblem::dense(const Parameters& at, PetscInt columns) const {
  auto pairs = solveTogether(pencil_.comm(), projected(2, at, columns), projected(1, at, columns), projected(0, at, columns),
                             static_cast<int>(columns));
  for (auto& pair : pairs) pair.q.resize(static_cast<std::size_t>(basis_.size()), 0.0);
  return pairs;
}

ReducedProblem::Residuals ReducedProblem::residuals(const Parameters& at, const std::vector<DensePair>& pairs) const {
  Residuals result;
  PetscInt rows = 0;
  check(BVGetSizes(basis_.columns(), &rows, nullptr, nullptr));
  result.rows = static_cast<std::size_t>(rows);
  result.residual.assign(2 * result.rows * pairs.size(), 0.0);
  for (std::size_t t = 0; t < images_.size(); ++t)
    images_[t].image.multiplyAdd(columns(pairs, pencil_.terms()[t].power, pencil_.terms()[t].coefficient(at)), basis_.size(),
                                 result.residual);
  result.squaredNorm = squaredNorms(pencil_.comm(), result.residual, result.rows, pairs.size());
  const double scales[3] = {pencil_.norm(0, at), pencil_.norm(1, at), pencil_.norm(2, at)};
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const double size = std::abs(pairs[j].s), scale = scales[0] + size * scales[1] + size * size * scales[2];
    result.backwardError.push_back(std::sqrt(result.squaredNorm[j]) / (scale * length(pairs[j].q)));
  }
  return result;
}

/// ‖V q‖₂ from VᵀV: no cancellation, V has the columns of a basis.
double ReducedProblem::length(const std::vector<std::complex<double>>& q) const {
  const std::size_t m = q.size();
  double sum = 0;
  for (std::size_t j = 0; j < m; ++j) {
    std::complex<double> row = 0;
    for (std::size_t i = 0; i < m; ++i) row += gram_[j * m + i] * q[i];
    sum += (std::conj(q[j]) * row).real();
  }
  return std::sqrt(sum);
}

/// Directions that hold the residuals of the bad pairs, each pair taken as of size one, but for a few hundredths: a round gains a
/// decade, and what it need not resolve it need not solve for. Columns, [local row].
DenseMatrix ReducedProblem::directions(const Residuals& residuals, const std::vector<std::size_t>& bad) const {
  constexpr double resolution = 0.03;
  const std::size_t count = 2 * bad.size(), rows = residuals.rows;
  DenseMatrix block;
  block.reserve(count * rows);
  for (std::size_t j : bad)
    for (std::size_t i = 2 * j * rows; i < 2 * (j + 1) * rows; ++i)
      block.push_back(residuals.residual[i] / std::sqrt(residuals.squaredNorm[j]));
  const auto height = static_cast<PetscInt>(rows), width = static_cast<PetscInt>(count);
  auto combinations = transposedProduct(pencil_.comm(), block.data(), height, width, block.data(), width);
  const auto sizes = symmetricEigen(combinations, static_cast<int>(count));
  std::size_t first = 0;
  while (sizes[first] < resolution * resolution * sizes.back()) ++first;
  combinations.erase(combinations.begin(), combinations.begin() + static_cast<std::ptrdiff_t>(first * count));
  DenseMatrix kept((count - first) * rows, 0.0);
  multiplyAdd(block.data(), height, width, combinations, kept);
  return kept;
}

/// Adds K0⁻¹ r for the directions r of the residuals to the basis, all solved for together.
void ReducedProblem::correct(const Residuals& residuals, const std::vector<std::size_t>& bad) {
  DenseMatrix wanted = directions(residuals, bad);
  PetscInt local = 0, global = 0;
  check(BVGetSizes(basis_.columns(), &local, &global, nullptr));
  PetscInt count = local > 0 ? static_cast<PetscInt>(wanted.size()) / local : 0;
  check(MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPIU_INT, MPI_MAX, pencil_.comm()));  // a rank without rows does not know
  const OwnedBV block = columnsLike(basis_.columns(), count);
  OwnedMat rhs, solution;
  check(MatCreateDense(pencil_.comm(), local, PETSC_DECIDE, global, count, wanted.data(), rhs.out()));
  check(MatDuplicate(rhs, MAT_DO_NOT_COPY_VALUES, solution.out()));
  check(KSPMatSolve(solver_, rhs, solution));
  const PetscScalar* solved = nullptr;
  PetscScalar* values = nullptr;
  check(MatDenseGetArrayRead(solution, &solved));
  check(BVGetArray(block, &values));
  std::copy_n(solved, wanted.size(), values);
  check(BVRestoreArray(block, &values));
  check(MatDenseRestoreArrayRead(solution, &solved));
  basis_.add(block, count);
  extend();
}

FrictionPoint ReducedProblem::solve(const Parameters& at, Mat trial) {
  FrictionPoint point;
  point.at = at;
  point.bandTop = bandTop_;
  point.accuracy = bandTop_ > 0 ? accuracyOption.get() : 0;
  enter();
  const PetscInt largest = std::min(basis_.size() + static_cast<PetscInt>(growthOption.get()), unknowns_);
  std::vector<DensePair> band;
  Residuals found;
  for (int round = 0;; ++round) {
    band = dense(at, basis_.size());
    std::erase_if(band, [&](const auto& pair) { return !inBand(pair.s); });
    found = residuals(at, band);
    std::vector<std::size_t> bad;
    for (std::size_t j = 0; j < band.size(); ++j)
      if (found.backwardError[j] > point.accuracy) bad.push_back(j);
    const PetscInt before = basis_.size();
    if (bandTop_ == 0 || bad.empty() || round == roundsOption.get() || before >= largest) break;
    correct(found, bad);
    if (basis_.size() == before) break;  // the residuals are rounding
  }
  // The corrections bring eigenvalues of high frequency of their own, which mean nothing; above the band the modes speak alone.
  std::vector<DensePair> above = dense(at, static_cast<PetscInt>(modeCount_));
  std::stable_sort(above.begin(), above.end(), [&](const auto& a, const auto& b) {
    return inBand(a.s) != inBand(b.s) ? inBand(a.s) : std::abs(a.s) < std::abs(b.s);
  });
  above.erase(above.begin(), above.begin() + static_cast<std::ptrdiff_t>(std::min(band.size(), above.size())));
  const Residuals rest = residuals(at, above);
  std::vector<Found> all;
  for (std::size_t j = 0; j < band.size(); ++j) all.push_back({{band[j].s, found.backwardError[j], false, true}, band[j]});
  for (std::size_t j = 0; j < above.size(); ++j)
    all.push_back({{above[j].s, rest.backwardError[j], false, bandTop_ == 0}, above[j]});
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.pair.s.imag() < b.pair.s.imag(); });
  for (const auto& item : all) point.eigenvalues.push_back(item.eigenvalue);
  judge(point.eigenvalues);
  keepShapes(point, trial, [&](std::size_t index, Vec real, Vec imaginary) { expand(all[index].pair, real, imaginary); });
  return point;
}

DenseProblem ReducedProblem::projected(const Parameters& at) const {
  const PetscInt m = basis_.size();
  return {projected(2, at, m), projected(1, at, m), projected(0, at, m), static_cast<int>(m)};
}

Improvement ReducedProblem::improve(const std::vector<std::pair<Parameters, std::vector<DensePair>>>& located,
                                    const std::function<void(const Parameters&)>& enterTerms) {
  constexpr double rounding = 1e-14;
  Improvement result;
  Residuals all;
  std::vector<std::size_t> bad;
  for (const auto& [at, pairs] : located) {
    enterTerms(at);
    const Residuals found = residuals(at, pairs);
    result.backwardError.push_back(*std::max_element(found.backwardError.begin(), found.backwardError.end()));
    for (std::size_t j = 0; j < pairs.size(); ++j)
      if (found.backwardError[j] > rounding) bad.push_back(all.squaredNorm.size() + j);
    all.rows = found.rows;
    all.residual.insert(all.residual.end(), found.residual.begin(), found.residual.end());
    all.squaredNorm.insert(all.squaredNorm.end(), found.squaredNorm.begin(), found.squaredNorm.end());
  }
  const PetscInt before = basis_.size();
  if (!bad.empty()) correct(all, bad);
  result.changed = basis_.size() > before;
  return result;
}

WatchedBand ReducedProblem::band() const { return {bandTop_, 1.3, bandDampingOption.get()}; }

bool ReducedProblem::inBand(std::complex<double> s) const {
  return std::abs(s) <= bandTop_ && -s.real() <= bandDampingOption.get() * std::abs(s);
}

/// V q.
void ReducedProblem::expand(const DensePair& pair, Vec real, Vec imaginary) const {
  const ReadColumns basis(basis_.columns());
  std::vector<double> shape(2 * static_cast<std::size_t>(basis.rows()), 0.0);
  multiplyAdd(basis.values(), basis.rows(), basis.columns(), columns({pair}, 0), shape);
  for (Vec part : {real, imaginary}) {
    PetscScalar* entries = nullptr;
    check(VecGetArray(part, &entries));
    std::copy_n(shape.begin() + (part == imaginary ? basis.rows() : 0), basis.rows(), entries);
    check(VecRestoreArray(part, &entries));
  }
}

}  // namespace squeal::flutter
