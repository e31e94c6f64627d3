#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <cmath>

#include "flutter/dense.hpp"
#include "flutter/select.hpp"
#include "petsc/options.hpp"

namespace squeal::flutter {
namespace {

const ChoiceOption basisOption("flutter", "reduction_basis", {"corrected", "modal"}, "corrected",
                               "corrected: free modes and static corrections of the residuals in the band; modal: free modes alone");
const RealOption accuracyOption("flutter", "flutter_accuracy", 1e-9, "", positive, "full-order backward error to which the eigenvalues of the band are corrected");
const RealOption bandOption("flutter", "flutter_band", 0, "Hz", nonNegative,
                            "frequency up to which eigenvalues are corrected; 0: that of mode 0.4 x -modes_count");
const IntegerOption roundsOption("flutter", "flutter_rounds", 12, 0, "most rounds of corrections at one friction");
const IntegerOption growthOption("flutter", "flutter_growth", 1000, 0, "most vectors that corrections may add to the basis at one friction");

bool correctionsWanted() { return basisOption.get() == "corrected"; }


/// Rows of a BV on this rank for the life of the object; columns are contiguous (type svec).
class ReadColumns {
 public:
  explicit ReadColumns(BV bv) : bv_(bv) {
    check(BVGetSizes(bv, &rows_, nullptr, &columns_));
    check(BVGetArrayRead(bv, &values_));
  }
  ~ReadColumns() { BVRestoreArrayRead(bv_, &values_); }
  ReadColumns(const ReadColumns&) = delete;
  ReadColumns& operator=(const ReadColumns&) = delete;
  const PetscScalar* values() const { return values_; }
  PetscInt rows() const { return rows_; }
  PetscInt columns() const { return columns_; }

 private:
  BV bv_;
  PetscInt rows_ = 0, columns_ = 0;
  const PetscScalar* values_ = nullptr;
};

/// result (rows × k) += X (rows × columns) · coefficients (columns × k), all column-major
void multiplyAdd(const double* x, PetscInt rowCount, PetscInt columnCount, const std::vector<double>& coefficients, std::vector<double>& result) {
  PetscBLASInt rows = rowCount, inner = columnCount, columns = static_cast<PetscBLASInt>(coefficients.size() / static_cast<std::size_t>(columnCount));
  const PetscScalar one = 1;
  if (rows > 0 && columns > 0) BLASgemm_("N", "N", &rows, &columns, &inner, &one, x, &rows, coefficients.data(), &inner, &one, result.data(), &rows);
}

/// The dense problem is solved on rank 0 alone, so that rounding cannot make the ranks disagree on the order or number of eigenvalues.
std::vector<DensePair> solveOnce(MPI_Comm comm, const DenseMatrix& mass, const DenseMatrix& damping, const DenseMatrix& stiffness, int m) {
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

/// Real and imaginary parts of s_j^power q_j as columns 2j, 2j+1.
std::vector<double> columns(const std::vector<DensePair>& pairs, int power) {
  std::vector<double> matrix;
  for (const auto& pair : pairs) {
    const std::complex<double> factor = std::pow(pair.s, power);
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

/// Σ c_t A_t V of each power of s at one friction, on this rank's rows.
struct ReducedProblem::Images {
  double norm[3] = {0, 0, 0};
  std::vector<double> values[3];  // column-major, empty where there is no term
};

ReducedProblem::ReducedProblem(const Pencil& pencil, const contact::AssociatedSystem& system, const modes::Modes& modes)
    : pencil_(pencil), system_(system), basis_(modes.vectors, system.matrices().m0) {
  const auto& w = modes.angularFrequency;
  modeCount_ = w.size();
  if (correctionsWanted()) bandTop_ = bandOption.get() > 0 ? 2 * M_PI * bandOption.get() : w[std::min(w.size() - 1, w.size() * 2 / 5)];
  extend();
}

/// Images and projections of the columns that the basis has gained.
void ReducedProblem::extend() {
  const PetscInt old = projected_, size = basis_.size(), added = size - old;
  if (added == 0) return;
  images_.resize(pencil_.terms().size());
  projections_.resize(pencil_.terms().size());
  for (std::size_t t = 0; t < pencil_.terms().size(); ++t) {
    if (!images_[t]) images_[t] = columnsLike(basis_.columns(), size);
    else check(BVResize(images_[t], size, PETSC_TRUE));
    check(BVSetActiveColumns(basis_.columns(), old, size));
    check(BVSetActiveColumns(images_[t], old, size));
    check(BVMatMult(basis_.columns(), pencil_.terms()[t].matrix, images_[t]));
    check(BVSetActiveColumns(basis_.columns(), 0, size));
    check(BVSetActiveColumns(images_[t], 0, size));
    OwnedMat dense;
    check(MatCreateSeqDense(PETSC_COMM_SELF, size, size, nullptr, dense.out()));
    check(BVDot(images_[t], basis_.columns(), dense));  // Vᵀ A V
    const PetscScalar* values = nullptr;
    check(MatDenseGetArrayRead(dense, &values));
    projections_[t].assign(values, values + size * size);
    check(MatDenseRestoreArrayRead(dense, &values));
  }
  OwnedMat products;
  check(MatCreateSeqDense(PETSC_COMM_SELF, size, size, nullptr, products.out()));
  check(BVDot(basis_.columns(), basis_.columns(), products));
  const PetscScalar* values = nullptr;
  check(MatDenseGetArrayRead(products, &values));
  gram_.assign(values, values + size * size);
  check(MatDenseRestoreArrayRead(products, &values));
  projected_ = size;
}

std::vector<double> ReducedProblem::projected(int power, double friction) const {
  std::vector<double> sum;
  for (std::size_t t = 0; t < projections_.size(); ++t) {
    if (pencil_.terms()[t].power != power) continue;
    sum.resize(projections_[t].size(), 0.0);
    const double c = pencil_.terms()[t].coefficient(friction);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += c * projections_[t][i];
  }
  return sum;
}

ReducedProblem::Images ReducedProblem::images(double friction) const {
  Images result;
  for (int power = 0; power < 3; ++power) result.norm[power] = pencil_.norm(power, friction);
  for (std::size_t t = 0; t < images_.size(); ++t) {
    const Term& term = pencil_.terms()[t];
    const double c = term.coefficient(friction);
    const ReadColumns image(images_[t]);
    auto& sum = result.values[term.power];
    const std::size_t count = static_cast<std::size_t>(image.rows()) * static_cast<std::size_t>(image.columns());
    sum.resize(count, 0.0);
    if (c != 0)
      for (std::size_t i = 0; i < count; ++i) sum[i] += c * image.values()[i];
  }
  return result;
}

ReducedProblem::Residuals ReducedProblem::residuals(const Images& images, const std::vector<DensePair>& pairs) const {
  Residuals result;
  PetscInt rows = 0;
  check(BVGetSizes(basis_.columns(), &rows, nullptr, nullptr));
  result.rows = static_cast<std::size_t>(rows);
  result.residual.assign(2 * result.rows * pairs.size(), 0.0);
  for (int power = 0; power < 3; ++power)
    if (!images.values[power].empty()) multiplyAdd(images.values[power].data(), rows, basis_.size(), columns(pairs, power), result.residual);
  const auto norms = squaredNorms(pencil_.comm(), result.residual, result.rows, pairs.size());
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const double size = std::abs(pairs[j].s), scale = images.norm[0] + size * images.norm[1] + size * size * images.norm[2];
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
    std::copy_n(residuals.residual.begin() + static_cast<std::ptrdiff_t>(2 * bad[j] * residuals.rows), 2 * residuals.rows, values + 2 * j * residuals.rows);
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
  std::vector<DensePair> pairs, band;
  Images images;
  Residuals found;
  for (int round = 0;; ++round) {
    pairs = solveOnce(pencil_.comm(), projected(2, friction), projected(1, friction), projected(0, friction), static_cast<int>(basis_.size()));
    // The corrections bring eigenvalues of high frequency of their own, which mean nothing.
    pairs.resize(std::min(pairs.size(), modeCount_));
    band.assign(pairs.begin(), std::find_if(pairs.begin(), pairs.end(), [&](const auto& pair) { return pair.s.imag() > bandTop_; }));
    images = this->images(friction);
    found = residuals(images, band);
    std::vector<std::size_t> bad;
    for (std::size_t j = 0; j < band.size(); ++j)
      if (found.backwardError[j] > point.accuracy) bad.push_back(j);
    const PetscInt before = basis_.size();
    if (bandTop_ == 0 || bad.empty() || round == roundsOption.get() || before >= largest) break;
    correct(found, bad);
    if (basis_.size() == before) break;  // the residuals are rounding
  }
  const Residuals above = residuals(images, {pairs.begin() + static_cast<std::ptrdiff_t>(band.size()), pairs.end()});
  for (std::size_t j = 0; j < pairs.size(); ++j)
    point.eigenvalues.push_back({pairs[j].s, j < band.size() ? found.backwardError[j] : above.backwardError[j - band.size()], false});
  judge(point.eigenvalues);
  keepShapes(point, trial, [&](std::size_t index, Vec real, Vec imaginary) {
    const ReadColumns basis(basis_.columns());
    std::vector<double> shape(2 * static_cast<std::size_t>(basis.rows()), 0.0);
    multiplyAdd(basis.values(), basis.rows(), basis.columns(), columns({pairs[index]}, 0), shape);
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
