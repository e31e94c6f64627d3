#include "flutter/dense.hpp"

#include <slepcsys.h>  // first: the next header needs it

#include <slepcblaslapack.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "petsc/check.hpp"

namespace squeal::flutter {
namespace {

using Complex = std::complex<double>;

struct EigenPair {
  Complex value;
  std::vector<Complex> vector;
};

/// LAPACK's real storage of conjugate pairs as complex numbers.
std::vector<EigenPair> unpacked(const std::vector<double>& real, const std::vector<double>& imaginary,
                                const std::vector<double>& beta, const std::vector<double>& vectors) {
  std::vector<EigenPair> pairs;
  const std::size_t n = real.size();
  for (std::size_t j = 0; j < n; ++j) {
    if (beta[j] == 0) throw Error("the reduced mass matrix is singular: an eigenvalue is infinite");
    const bool conjugates = imaginary[j] != 0;
    EigenPair pair{Complex(real[j], imaginary[j]) / beta[j], std::vector<Complex>(n)};
    for (std::size_t i = 0; i < n; ++i) pair.vector[i] = {vectors[j * n + i], conjugates ? vectors[(j + 1) * n + i] : 0.0};
    pairs.push_back(std::move(pair));
    if (!conjugates) continue;
    pairs.push_back({std::conj(pairs.back().value), pairs.back().vector});
    for (auto& entry : pairs.back().vector) entry = std::conj(entry);
    ++j;
  }
  return pairs;
}

/// All eigenvalues and right eigenvectors of A x = μ B x.
std::vector<EigenPair> generalized(DenseMatrix a, DenseMatrix b, int size) {
  const auto n = static_cast<std::size_t>(size);
  PetscBLASInt order = size, one = 1, query = -1, info = 0;
  std::vector<double> real(n), imaginary(n), beta(n), vectors(n * n), work(1);
  LAPACKggev_("N", "V", &order, a.data(), &order, b.data(), &order, real.data(), imaginary.data(), beta.data(), nullptr, &one,
              vectors.data(), &order, work.data(), &query, &info);
  PetscBLASInt length = static_cast<PetscBLASInt>(work[0]);
  work.resize(static_cast<std::size_t>(length));
  LAPACKggev_("N", "V", &order, a.data(), &order, b.data(), &order, real.data(), imaginary.data(), beta.data(), nullptr, &one,
              vectors.data(), &order, work.data(), &length, &info);
  if (info != 0) throw Error("LAPACK dggev failed on the reduced eigenproblem (info " + std::to_string(info) + ")");
  return unpacked(real, imaginary, beta, vectors);
}

/// All eigenvalues and right eigenvectors of A x = μ x.
std::vector<EigenPair> standard(DenseMatrix a, int size) {
  const auto n = static_cast<std::size_t>(size);
  PetscBLASInt order = size, one = 1, query = -1, info = 0;
  std::vector<double> real(n), imaginary(n), vectors(n * n), work(1);
  LAPACKgeev_("N", "V", &order, a.data(), &order, real.data(), imaginary.data(), nullptr, &one, vectors.data(), &order, work.data(),
              &query, &info);
  PetscBLASInt length = static_cast<PetscBLASInt>(work[0]);
  work.resize(static_cast<std::size_t>(length));
  LAPACKgeev_("N", "V", &order, a.data(), &order, real.data(), imaginary.data(), nullptr, &one, vectors.data(), &order, work.data(),
              &length, &info);
  if (info != 0) throw Error("LAPACK dgeev failed on the reduced eigenproblem (info " + std::to_string(info) + ")");
  return unpacked(real, imaginary, std::vector<double>(n, 1.0), vectors);
}

DenseMatrix sideBySide(const DenseMatrix& left, const DenseMatrix& right) {
  DenseMatrix both = left;
  both.insert(both.end(), right.begin(), right.end());
  return both;
}

/// M⁻¹ B for B of any number of columns; empty if M is far from well conditioned. In an M0-orthonormal basis M is the identity but
/// for friction: M⁻¹ is formed safely, and QR takes a small part of the time of QZ.
DenseMatrix timesInverse(DenseMatrix mass, DenseMatrix b, int m) {
  PetscBLASInt n = m, columns = static_cast<PetscBLASInt>(b.size()) / m, info = 0;
  std::vector<PetscBLASInt> pivots(static_cast<std::size_t>(m));
  LAPACKgesv_(&n, &columns, mass.data(), &n, pivots.data(), b.data(), &n, &info);
  double smallest = INFINITY, largest = 0;
  for (std::size_t i = 0; i < mass.size(); i += static_cast<std::size_t>(m) + 1) {
    smallest = std::min(smallest, std::abs(mass[i]));
    largest = std::max(largest, std::abs(mass[i]));
  }
  return info == 0 && smallest > 1e-4 * largest ? b : DenseMatrix();
}

std::vector<DensePair> linearInSquare(const DenseMatrix& mass, const DenseMatrix& stiffness, int m) {
  // K q = μ M q with μ = −s²; both roots ±s are eigenvalues, one of them (two, if real) has Im s ≥ 0.
  const DenseMatrix product = timesInverse(mass, stiffness, m);
  const auto solved = product.empty() ? generalized(stiffness, mass, m) : standard(product, m);
  std::vector<DensePair> pairs;
  for (const auto& [mu, q] : solved) {
    Complex s = mu.imag() == 0 && mu.real() >= 0 ? Complex(0, std::sqrt(mu.real())) : std::sqrt(-mu);
    if (s.imag() < 0) s = -s;
    pairs.push_back({s, q});
    if (s.imag() == 0) pairs.push_back({-s, q});
  }
  return pairs;
}

/// [I 0; 0 M].
DenseMatrix padded(const DenseMatrix& mass, std::size_t m) {
  DenseMatrix b(4 * m * m, 0.0);
  for (std::size_t j = 0; j < m; ++j) {
    b[j * 2 * m + j] = 1;
    std::copy_n(mass.begin() + static_cast<std::ptrdiff_t>(j * m), m, b.begin() + static_cast<std::ptrdiff_t>((m + j) * 2 * m + m));
  }
  return b;
}

std::vector<DensePair> companion(const DenseMatrix& mass, const DenseMatrix& damping, const DenseMatrix& stiffness, int size) {
  const auto m = static_cast<std::size_t>(size);
  const auto norm = [](const DenseMatrix& x) { return std::sqrt(std::inner_product(x.begin(), x.end(), x.begin(), 0.0)); };
  const double unit = std::sqrt(norm(stiffness) / norm(mass));  // s = unit ŝ (Fan, Lin and Van Dooren 2004)
  // [0 I; −K −Z] (q, ŝq) = ŝ [I 0; 0 M] (q, ŝq), K and Z scaled
  const DenseMatrix product = timesInverse(mass, sideBySide(stiffness, damping), size);
  const DenseMatrix lower = product.empty() ? sideBySide(stiffness, damping) : product;
  DenseMatrix a(4 * m * m, 0.0);
  for (std::size_t j = 0; j < m; ++j) {
    a[(m + j) * 2 * m + j] = 1;
    for (std::size_t i = 0; i < m; ++i) {
      a[j * 2 * m + m + i] = -lower[j * m + i] / (unit * unit);
      a[(m + j) * 2 * m + m + i] = -lower[(m + j) * m + i] / unit;
    }
  }
  std::vector<DensePair> pairs;
  for (const auto& [value, vector] : product.empty() ? generalized(a, padded(mass, m), 2 * size) : standard(a, 2 * size))
    if (value.imag() >= 0) {
      const auto half = vector.begin() + (std::abs(value) > 1 ? size : 0);  // the larger of q and ŝq
      pairs.push_back({unit * value, {half, half + size}});
    }
  return pairs;
}

}  // namespace

std::vector<DensePair> solveQuadratic(const DenseMatrix& mass, const DenseMatrix& damping, const DenseMatrix& stiffness, int m) {
  auto pairs = damping.empty() ? linearInSquare(mass, stiffness, m) : companion(mass, damping, stiffness, m);
  for (auto& pair : pairs) {
    double sum = 0;
    for (const auto& entry : pair.q) sum += std::norm(entry);
    for (auto& entry : pair.q) entry /= std::sqrt(sum);
  }
  std::sort(pairs.begin(), pairs.end(), [](const DensePair& a, const DensePair& b) {
    return a.s.imag() != b.s.imag() ? a.s.imag() < b.s.imag() : a.s.real() < b.s.real();
  });
  return pairs;
}

std::vector<DensePair> solveTogether(MPI_Comm comm, const DenseMatrix& mass, const DenseMatrix& damping,
                                     const DenseMatrix& stiffness, int m) {
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

}  // namespace squeal::flutter
