#include "reduction/condition.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/symmetric.hpp"

namespace squeal::reduction {
namespace {

using Complex = std::complex<double>;

constexpr double oneCluster = 1e-6;

/// yᴴ P'(s) d for one left vector and the right vector of pair b.
Complex pairing(const std::vector<Complex>& left, Complex s, const std::vector<double>& massTimes,
                const std::vector<double>& dampingTimes, std::size_t b) {
  const std::size_t m = left.size(), re = 2 * b * m, im = re + m;
  Complex sum = 0;
  for (std::size_t i = 0; i < m; ++i)
    sum += std::conj(left[i]) * (2.0 * s * Complex(massTimes[re + i], massTimes[im + i]) +
                                 Complex(dampingTimes[re + i], dampingTimes[im + i]));
  return sum;
}

/// Smallest singular value of a complex matrix given by columns, from the real matrix [Re −Im; Im
/// Re].
double smallestSingularValue(const std::vector<Complex>& g, std::size_t p) {
  if (p == 1) return std::abs(g[0]);
  const auto entry = [&](std::size_t i, std::size_t j) {
    const Complex z = g[(j % p) * p + i % p];
    return i / p == j / p ? z.real() : i < j ? -z.imag() : z.imag();
  };
  std::vector<double> gram(4 * p * p, 0.0);
  for (std::size_t j = 0; j < 2 * p; ++j)
    for (std::size_t i = 0; i < 2 * p; ++i)
      for (std::size_t k = 0; k < 2 * p; ++k) gram[j * 2 * p + i] += entry(k, i) * entry(k, j);
  return std::sqrt(std::max(0.0, linalg::symmetricEigen(gram, static_cast<int>(2 * p)).front()));
}

}  // namespace

std::vector<double> conditionNumbers(const linalg::DenseProblem& problem,
                                     const std::vector<linalg::DensePair>& pairs) {
  const auto massTimes = linalg::timesVectors(problem.mass, problem.m, pairs),
             dampingTimes = linalg::timesVectors(problem.damping, problem.m, pairs);
  std::vector<double> numbers;
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const Complex s = pairs[j].s;
    const double alone = 1 / std::abs(pairing(pairs[j].left, s, massTimes, dampingTimes, j));
    std::vector<std::size_t> cluster;
    for (std::size_t k = 0; k < pairs.size(); ++k)
      if (std::abs(pairs[k].s - s) <= oneCluster * std::abs(s)) cluster.push_back(k);
    double number = alone;
    if (cluster.size() > 1) {
      std::vector<Complex> g;
      for (auto b : cluster)
        for (auto a : cluster) g.push_back(pairing(pairs[a].left, s, massTimes, dampingTimes, b));
      // The change of the cluster is G⁻¹YᴴR: p unit vectors on either side. One pair alone says
      // nothing of it: of a multiple eigenvalue its vectors are any of many.
      number = static_cast<double>(cluster.size()) / smallestSingularValue(g, cluster.size());
    }
    number /= std::abs(s);
    numbers.push_back(std::isfinite(number) ? number : INFINITY);
  }
  return numbers;
}

}  // namespace squeal::reduction
