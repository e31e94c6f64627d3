#include <cmath>

#include "flutter/dense.hpp"
#include "flutter/select.hpp"
#include "petsc/options.hpp"

namespace squeal::flutter {
namespace {

const ChoiceOption basisOption(
    "flutter", "reduction_basis", {"corrected", "modal"}, "corrected",
    "corrected: free modes and static corrections of the residuals in the band; modal: free modes alone");
const RealOption accuracyOption("flutter", "flutter_accuracy", 1e-9, "", positive,
                                "full-order backward error to which the eigenvalues of the band are corrected");
const RealOption bandOption("flutter", "flutter_band", 0, "Hz", nonNegative,
                            "frequency up to which eigenvalues are corrected; 0: that of mode 0.4 x -modes_count");
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

/// The dense problem is solved on rank 0 alone, so that rounding cannot make the ranks disagree on the order or number of
/// eigenvalues.
std::vector<DensePair> solveOnce(MPI_Comm comm, const DenseMatrix& mass, const DenseMatrix& damping, const DenseMatrix& stiffness,
                                 int m) {
  int rank = 0;
  check(MPI_Comm_rank(comm, &rank));
  std::vector<DensePair> pairs;
  std::string failure;
  if (rank == 0) try {
      pairs = solveQuadratic(mass, damping, stiffness, m);
    } catch (const Error& error) {
      failure = error.what();
    }
  failTogether(comm, failure);
  int count = static_cast<int>(pairs.size());
  check(MPI_Bcast(&count, 1, MPI_INT, 0, comm));
  pairs.resize(static_cast<std::size_t>(count));
  for (auto& pair : pairs) {
    pair.q.resize(static_cast<std::size_t>(m));
    check(MPI_Bcast(&pair.s, 1, MPI_C_DOUBLE_COMPLEX, 0, comm));
    check(MPI_Bcast(pair.q.data(), m, MPI_C_DOUBLE_COMPLEX, 0, comm));
  }
  return pairs;
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

/// Squared 2-norms over all ranks of the complex columns held as pairs of real ones.
std::vector<double> squaredNorms(MPI_Comm comm, const std::vector<double>& values, std::size_t rows, std::size_t count) {
  std::vector<double> sums(count, 0.0);
  for (std::size_t j = 0; j < count; ++j)
    for (std::size_t i = 2 * j * rows; i < 2 * (j + 1) * rows; ++i) sums[j] += values[i] * values[i];
  check(MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(count), MPI_DOUBLE, MPI_SUM, comm));
  return sums;
}

}  // namespace

Pencil approximationA(const contact::AssociatedSystem& system) {
  const auto& matrices = system.matrices();
  std::vector<Term> terms;
  terms.push_back({matrices.k0.share(), 0, 0, 1.0});
  terms.push_back({matrices.k1.share(), 0, 1, 1.0});
  terms.push_back({matrices.m0.share(), 2, 0, 1.0});
  terms.push_back({matrices.m1.share(), 2, 1, 1.0});
  return Pencil(std::move(terms));
}

/// Residuals P(s) V q of some pairs and their backward errors.
struct ReducedProblem::Residuals {
  std::size_t rows = 0;
  std::vector<double> residual;       // [pair][real, imaginary][local row]
  std::vector<double> backwardError;  // [pair]
};

ReducedProblem::ReducedProblem(const Pencil& pencil, const contact::AssociatedSystem& system, const modes::Modes& modes)
    : pencil_(pencil), system_(system), basis_(modes.vectors, system.matrices().m0) {
  const auto& w = modes.angularFrequency;
  modeCount_ = w.size();
  if (correctionsWanted()) bandTop_ = bandOption.get() > 0 ? 2 * M_PI * bandOption.get() : bandOfModes(w);
  for (const auto& term : pencil.terms()) images_.emplace_back(term.matrix);
  projections_.resize(images_.size());
  extend();
}

/// Images and projections of the columns that the basis has gained.
void ReducedProblem::extend() {
  const PetscInt old = projected_, size = basis_.size(), added = size - old;
  if (added == 0) return;
  const OwnedBV fresh = columnsLike(basis_.columns(), added), product = columnsLike(basis_.columns(), added);
  check(BVSetActiveColumns(basis_.columns(), old, size));
  check(BVCopy(basis_.columns(), fresh));
  check(BVSetActiveColumns(basis_.columns(), 0, size));
  const MPI_Comm comm = pencil_.comm();
  for (std::size_t t = 0; t < pencil_.terms().size(); ++t) {
    const Mat matrix = pencil_.terms()[t].matrix;
    check(BVMatMult(fresh, matrix, product));
    const ReadColumns all(basis_.columns()), image(product);
    images_[t].append(image.values(), added);
    PetscBool known = PETSC_FALSE, symmetric = PETSC_FALSE;
    check(MatIsSymmetricKnown(matrix, &known, &symmetric));
    const auto right = images_[t].transposedProduct(comm, all, 0, size, old, size);  // Vᵀ (A V_new)
    const auto below =
        known && symmetric ? DenseMatrix{} : images_[t].transposedProduct(comm, all, old, size, 0, old);  // V_newᵀ (A V_old)
    grow(projections_[t], old, size, right, below);
  }
  const ReadColumns all(basis_.columns());
  grow(gram_, old, size, transposedProduct(comm, all.values(), all.rows(), size, all.values() + old * all.rows(), added), {});
  projected_ = size;
}

/// Σ c_t Vᵀ A_t V of one power of s on the first `columns` of the basis.
std::vector<double> ReducedProblem::projected(int power, double friction, PetscInt columns) const {
  const auto m = static_cast<std::size_t>(columns), size = static_cast<std::size_t>(basis_.size());
  std::vector<double> sum;
  for (std::size_t t = 0; t < projections_.size(); ++t) {
    if (pencil_.terms()[t].power != power) continue;
    sum.resize(m * m, 0.0);
    const double c = pencil_.terms()[t].coefficient(friction);
    for (std::size_t j = 0; j < m; ++j)
      for (std::size_t i = 0; i < m; ++i) sum[j * m + i] += c * projections_[t][j * size + i];
  }
  return sum;
}

/// Collective. Eigenvalues on the first `columns` of the basis, by ascending frequency; q has the length of the whole basis.
std::vector<DensePair> ReducedProblem::dense(double friction, PetscInt columns) const {
  auto pairs = solveOnce(pencil_.comm(), projected(2, friction, columns), projected(1, friction, columns),
                         projected(0, friction, columns), static_cast<int>(columns));
  for (auto& pair : pairs) pair.q.resize(static_cast<std::size_t>(basis_.size()), 0.0);
  return pairs;
}

ReducedProblem::Residuals ReducedProblem::residuals(double friction, const std::vector<DensePair>& pairs) const {
  Residuals result;
  PetscInt rows = 0;
  check(BVGetSizes(basis_.columns(), &rows, nullptr, nullptr));
  result.rows = static_cast<std::size_t>(rows);
  result.residual.assign(2 * result.rows * pairs.size(), 0.0);
  for (std::size_t t = 0; t < images_.size(); ++t)
    images_[t].multiplyAdd(columns(pairs, pencil_.terms()[t].power, pencil_.terms()[t].coefficient(friction)), basis_.size(),
                           result.residual);
  const auto norms = squaredNorms(pencil_.comm(), result.residual, result.rows, pairs.size());
  const double scales[3] = {pencil_.norm(0, friction), pencil_.norm(1, friction), pencil_.norm(2, friction)};
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const double size = std::abs(pairs[j].s), scale = scales[0] + size * scales[1] + size * size * scales[2];
    result.backwardError.push_back(std::sqrt(norms[j]) / (scale * length(pairs[j].q)));
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

/// Adds K0⁻¹ Re r and K0⁻¹ Im r of the bad pairs to the basis, all solved for together.
void ReducedProblem::correct(const Residuals& residuals, const std::vector<std::size_t>& bad) {
  const auto count = static_cast<PetscInt>(2 * bad.size());
  const OwnedBV block = columnsLike(basis_.columns(), count);
  OwnedMat rhs, solution;
  PetscInt local = 0, global = 0;
  check(BVGetSizes(block, &local, &global, nullptr));
  check(MatCreateDense(pencil_.comm(), local, PETSC_DECIDE, global, count, nullptr, rhs.out()));
  PetscScalar* values = nullptr;
  check(MatDenseGetArrayWrite(rhs, &values));
  for (std::size_t j = 0; j < bad.size(); ++j)
    std::copy_n(residuals.residual.begin() + static_cast<std::ptrdiff_t>(2 * bad[j] * residuals.rows), 2 * residuals.rows,
                values + 2 * j * residuals.rows);
  check(MatDenseRestoreArrayWrite(rhs, &values));
  check(MatDuplicate(rhs, MAT_DO_NOT_COPY_VALUES, solution.out()));
  check(KSPMatSolve(system_.solver(), rhs, solution));
  const PetscScalar* solved = nullptr;
  check(MatDenseGetArrayRead(solution, &solved));
  check(BVGetArray(block, &values));
  std::copy_n(solved, static_cast<std::size_t>(count) * residuals.rows, values);
  check(BVRestoreArray(block, &values));
  check(MatDenseRestoreArrayRead(solution, &solved));
  solves_ += static_cast<int>(count);
  basis_.add(block, count);
  extend();
}

FrictionPoint ReducedProblem::solve(double friction, Mat trial) {
  FrictionPoint point;
  point.friction = friction;
  point.bandTop = bandTop_;
  point.accuracy = bandTop_ > 0 ? accuracyOption.get() : 0;
  const PetscInt largest = std::min(basis_.size() + static_cast<PetscInt>(growthOption.get()), system_.size());
  std::vector<DensePair> band;
  Residuals found;
  for (int round = 0;; ++round) {
    band = dense(friction, basis_.size());
    band.erase(std::find_if(band.begin(), band.end(), [&](const auto& pair) { return pair.s.imag() > bandTop_; }), band.end());
    found = residuals(friction, band);
    std::vector<std::size_t> bad;
    for (std::size_t j = 0; j < band.size(); ++j)
      if (found.backwardError[j] > point.accuracy) bad.push_back(j);
    const PetscInt before = basis_.size();
    if (bandTop_ == 0 || bad.empty() || round == roundsOption.get() || before >= largest) break;
    correct(found, bad);
    if (basis_.size() == before) break;  // the residuals are rounding
  }
  // The corrections bring eigenvalues of high frequency of their own, which mean nothing; above the band the modes speak alone.
  std::vector<DensePair> above = dense(friction, static_cast<PetscInt>(modeCount_));
  above.erase(above.begin(), above.begin() + static_cast<std::ptrdiff_t>(std::min(band.size(), above.size())));
  const Residuals rest = residuals(friction, above);
  for (std::size_t j = 0; j < band.size(); ++j) point.eigenvalues.push_back({band[j].s, found.backwardError[j], false, true});
  for (std::size_t j = 0; j < above.size(); ++j)
    point.eigenvalues.push_back({above[j].s, rest.backwardError[j], false, bandTop_ == 0});
  judge(point.eigenvalues);
  keepShapes(point, trial, [&](std::size_t index, Vec real, Vec imaginary) {
    const ReadColumns basis(basis_.columns());
    std::vector<double> shape(2 * static_cast<std::size_t>(basis.rows()), 0.0);
    multiplyAdd(basis.values(), basis.rows(), basis.columns(),
                columns({index < band.size() ? band[index] : above[index - band.size()]}, 0), shape);
    for (Vec part : {real, imaginary}) {
      PetscScalar* entries = nullptr;
      check(VecGetArray(part, &entries));
      std::copy_n(shape.begin() + (part == imaginary ? basis.rows() : 0), basis.rows(), entries);
      check(VecRestoreArray(part, &entries));
    }
  });
  return point;
}

}  // namespace squeal::flutter
