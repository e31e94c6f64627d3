#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <cmath>

#include "flutter/dense.hpp"
#include "flutter/select.hpp"

namespace squeal::flutter {
namespace {


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
  /// result (rows × k) += X · coefficients (columns × k, column-major)
  void multiplyAdd(const std::vector<double>& coefficients, std::vector<double>& result) const {
    PetscBLASInt rows = rows_, inner = columns_, columns = static_cast<PetscBLASInt>(coefficients.size() / static_cast<std::size_t>(columns_));
    const PetscScalar one = 1;
    PetscBLASInt leading = std::max<PetscBLASInt>(rows, 1);
    if (rows > 0)
      BLASgemm_("N", "N", &rows, &columns, &inner, &one, values_, &leading, coefficients.data(), &inner, &one, result.data(), &leading);
  }
  PetscInt rows() const { return rows_; }
  PetscInt columns() const { return columns_; }

 private:
  BV bv_;
  PetscInt rows_ = 0, columns_ = 0;
  const PetscScalar* values_ = nullptr;
};

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

/// Real and imaginary parts of factor_j q_j as columns 2j, 2j+1.
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

ReducedProblem::ReducedProblem(const Pencil& pencil, BV basis) : pencil_(pencil), basis_(basis) {
  PetscInt m = 0;
  check(BVGetSizes(basis, nullptr, nullptr, &m));
  const auto size = static_cast<std::size_t>(m);
  for (const auto& term : pencil.terms()) {
    OwnedBV image;
    check(BVDuplicate(basis, image.out()));
    check(BVMatMult(basis, term.matrix, image));
    OwnedMat dense;
    check(MatCreateSeqDense(PETSC_COMM_SELF, m, m, nullptr, dense.out()));
    check(BVDot(image, basis, dense));  // Vᵀ A V
    const PetscScalar* values = nullptr;
    check(MatDenseGetArrayRead(dense, &values));
    projections_.emplace_back(values, values + size * size);
    check(MatDenseRestoreArrayRead(dense, &values));
    images_.push_back(std::move(image));
  }
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

FrictionPoint ReducedProblem::solve(double friction, Mat trial) const {
  FrictionPoint point;
  point.friction = friction;
  PetscInt m = 0;
  check(BVGetSizes(basis_, nullptr, nullptr, &m));
  const auto pairs = solveOnce(pencil_.comm(), projected(2, friction), projected(1, friction), projected(0, friction), static_cast<int>(m));

  // Residuals of all pairs together: Σ_t c_t (A_t V) (s^p q), and the lengths of V q.
  const ReadColumns basis(basis_);
  const auto rows = static_cast<std::size_t>(basis.rows());
  std::vector<double> residual(2 * rows * pairs.size(), 0.0), vectors(residual.size(), 0.0);
  for (std::size_t t = 0; t < images_.size(); ++t) {
    auto coefficients = columns(pairs, pencil_.terms()[t].power);
    const double c = pencil_.terms()[t].coefficient(friction);
    for (auto& entry : coefficients) entry *= c;
    ReadColumns(images_[t]).multiplyAdd(coefficients, residual);
  }
  basis.multiplyAdd(columns(pairs, 0), vectors);
  const auto residualNorms = squaredNorms(pencil_.comm(), residual, rows, pairs.size());
  const auto vectorNorms = squaredNorms(pencil_.comm(), vectors, rows, pairs.size());
  const double norms[3] = {pencil_.norm(0, friction), pencil_.norm(1, friction), pencil_.norm(2, friction)};
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const double size = std::abs(pairs[j].s), scale = norms[0] + size * norms[1] + size * size * norms[2];
    point.eigenvalues.push_back({pairs[j].s, std::sqrt(residualNorms[j] / vectorNorms[j]) / scale, false});
  }
  judge(point.eigenvalues);
  keepShapes(point, trial, [&](std::size_t index, Vec real, Vec imaginary) {
    for (Vec part : {real, imaginary}) {
      PetscScalar* values = nullptr;
      check(VecGetArray(part, &values));
      std::copy_n(vectors.begin() + static_cast<std::ptrdiff_t>((2 * index + (part == imaginary)) * rows), rows, values);
      check(VecRestoreArray(part, &values));
    }
  });
  return point;
}

}  // namespace squeal::flutter
