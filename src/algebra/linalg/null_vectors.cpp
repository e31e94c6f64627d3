// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/linalg/null_vectors.hpp"

#include <array>
#include <cmath>

#include "algebra/linalg/lu.hpp"

namespace squeal::linalg {
namespace {

using Powers = std::array<const DenseMatrix*, 3>;  // [power of s] K, Z, M

/// Returns cᴴ A q; zero for an empty A.
Complex form(const std::vector<Complex>& c, const DenseMatrix& a, const std::vector<Complex>& q) {
  Complex sum = 0;
  for (PetscInt j = 0; j < a.columns(); ++j) {
    Complex column = 0;
    for (PetscInt i = 0; i < a.rows(); ++i) column += std::conj(c[i]) * a(i, j);
    sum += column * q[j];
  }
  return sum;
}

template <class Scalar>
std::vector<Scalar> solve(const Lu<Scalar>& factors, std::vector<Scalar> x, bool adjoint) {
  factors.solve(std::span(x), adjoint);
  double sum = 0;
  for (const auto& entry : x) sum += std::norm(entry);
  for (auto& entry : x) entry /= std::sqrt(sum);
  return x;
}

/// Improves q and c, given in `vectors`, by two steps of inverse iteration.
template <class Scalar>
void iterate(Dense<Scalar> sum, NullVectors& vectors) {
  const auto converted = [](const auto& from, auto& to) {
    for (std::size_t i = 0; i < from.size(); ++i)
      if constexpr (std::is_same_v<Scalar, double>)
        to[i] = std::real(from[i]);
      else
        to[i] = from[i];
  };
  Lu<Scalar> factors(std::move(sum));
  factors.raiseZeroPivots();  // s may be an eigenvalue to the last digit
  std::vector<Scalar> q(vectors.left.size()), c(q.size());
  converted(vectors.left, q);
  for (int cycle = 0; cycle < 2; ++cycle) {
    if (cycle > 0) q = c;
    q = solve(factors, std::move(q), false);
    c = solve(factors, q, true);
  }
  vectors.right.assign(q.begin(), q.end());
  vectors.left.assign(c.begin(), c.end());
}

/// Returns Σ s^p h_p.
template <class Scalar>
Dense<Scalar> sumOf(const Powers& h, Scalar s) {
  const PetscInt m = h[0]->rows();
  Dense<Scalar> sum(m, m);
  Scalar power = 1;
  for (const DenseMatrix* matrix : h) {
    for (PetscInt j = 0; j < matrix->columns(); ++j)
      for (PetscInt i = 0; i < m; ++i) sum(i, j) += power * (*matrix)(i, j);
    power *= s;
  }
  return sum;
}

}  // namespace

NullVectors nullVectors(const DenseProblem& problem, Complex s, bool simple) {
  const PetscInt m = problem.order();
  NullVectors vectors;
  for (PetscInt i = 0; i < m; ++i)
    vectors.left.emplace_back(std::sin(12.9898 * (i + 1)), std::cos(78.233 * (i + 1)));
  if (problem.damping.empty() && s.real() == 0) {  // K − |s|² M is real
    DenseMatrix sum = problem.stiffness;
    addScaled(sum, -std::norm(s), problem.mass);
    iterate(std::move(sum), vectors);
    return vectors;
  }
  const Powers h{&problem.stiffness, &problem.damping, &problem.mass};
  for (int step = 0; step < 3; ++step) {
    iterate(sumOf(h, s), vectors);
    const auto& [q, c] = vectors;
    const Complex value = form(c, *h[0], q) + s * form(c, *h[1], q) + s * s * form(c, *h[2], q),
                  slope = form(c, *h[1], q) + 2.0 * s * form(c, *h[2], q), change = -value / slope;
    if (!simple ||
        !(std::abs(change) > 1e-14 * std::abs(s) && std::abs(change) < 1e-6 * std::abs(s)))
      break;
    s += change;
  }
  return vectors;
}

}  // namespace squeal::linalg
