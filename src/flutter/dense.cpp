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

struct Generalized {
  std::vector<Complex> value;
  std::vector<std::vector<Complex>> vector;
};

/// LAPACK's real storage of conjugate pairs as complex numbers.
Generalized unpacked(const std::vector<double>& real, const std::vector<double>& imaginary, const std::vector<double>& beta,
                     const std::vector<double>& vectors) {
  Generalized result;
  const std::size_t n = real.size();
  for (std::size_t j = 0; j < n; ++j) {
    if (beta[j] == 0) throw Error("the reduced mass matrix is singular: an eigenvalue is infinite");
    const bool pair = imaginary[j] != 0;
    std::vector<Complex> x(n);
    for (std::size_t i = 0; i < n; ++i) x[i] = {vectors[j * n + i], pair ? vectors[(j + 1) * n + i] : 0.0};
    result.value.push_back(Complex(real[j], imaginary[j]) / beta[j]);
    result.vector.push_back(x);
    if (!pair) continue;
    for (auto& entry : x) entry = std::conj(entry);
    result.value.push_back(std::conj(result.value.back()));
    result.vector.push_back(x);
    ++j;
  }
  return result;
}

/// All eigenvalues and right eigenvectors of A x = μ B x.
Generalized generalized(DenseMatrix a, DenseMatrix b, int size) {
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
Generalized standard(DenseMatrix a, int size) {
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

std::vector<DensePair> linearInSquare(const DenseMatrix& mass, const DenseMatrix& stiffness, int m) {
  // K q = μ M q with μ = −s²; both roots ±s are eigenvalues, one of them (two, if real) has Im s ≥ 0. In an M0-orthonormal basis M
  // is the identity but for friction: M⁻¹ K is formed safely, and QR takes a third of the time of QZ. Where M is far from that, QZ
  // it is.
  DenseMatrix factor = mass, product = stiffness;
  PetscBLASInt n = m, info = 0;
  std::vector<PetscBLASInt> pivots(static_cast<std::size_t>(m));
  LAPACKgesv_(&n, &n, factor.data(), &n, pivots.data(), product.data(), &n, &info);
  double smallest = INFINITY, largest = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(m); ++i) {
    const double pivot = std::abs(factor[i * static_cast<std::size_t>(m) + i]);
    smallest = std::min(smallest, pivot), largest = std::max(largest, pivot);
  }
  const Generalized solved = info == 0 && smallest > 1e-4 * largest ? standard(product, m) : generalized(stiffness, mass, m);
  std::vector<DensePair> pairs;
  for (std::size_t j = 0; j < solved.value.size(); ++j) {
    const Complex mu = solved.value[j];
    Complex s = mu.imag() == 0 && mu.real() >= 0 ? Complex(0, std::sqrt(mu.real())) : std::sqrt(-mu);
    if (s.imag() < 0) s = -s;
    pairs.push_back({s, solved.vector[j]});
    if (s.imag() == 0) pairs.push_back({-s, solved.vector[j]});
  }
  return pairs;
}

std::vector<DensePair> companion(const DenseMatrix& mass, const DenseMatrix& damping, const DenseMatrix& stiffness, int size) {
  const auto m = static_cast<std::size_t>(size);
  const auto norm = [](const DenseMatrix& x) { return std::sqrt(std::inner_product(x.begin(), x.end(), x.begin(), 0.0)); };
  const double unit = std::sqrt(norm(stiffness) / norm(mass));  // s = unit ŝ (Fan, Lin and Van Dooren 2004)
  // [0 I; −K −Z] (q, ŝq) = ŝ [I 0; 0 M] (q, ŝq), K and Z scaled
  DenseMatrix a(4 * m * m, 0.0), b(4 * m * m, 0.0);
  for (std::size_t j = 0; j < m; ++j) {
    a[(m + j) * 2 * m + j] = 1;
    b[j * 2 * m + j] = 1;
    for (std::size_t i = 0; i < m; ++i) {
      a[j * 2 * m + m + i] = -stiffness[j * m + i] / (unit * unit);
      a[(m + j) * 2 * m + m + i] = -damping[j * m + i] / unit;
      b[(m + j) * 2 * m + m + i] = mass[j * m + i];
    }
  }
  const Generalized solved = generalized(a, b, 2 * size);
  std::vector<DensePair> pairs;
  for (std::size_t j = 0; j < solved.value.size(); ++j)
    if (solved.value[j].imag() >= 0)
      pairs.push_back({unit * solved.value[j], {solved.vector[j].begin(), solved.vector[j].begin() + size}});
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

}  // namespace squeal::flutter
