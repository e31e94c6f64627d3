// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Exact plane-strain waves exp(ikx + st) in elastic layers −∞ < x < ∞, of period Lx, k = 2πn/Lx, n
/// = 0, ±1, …
///
/// Potentials: u = ∂φ/∂x + ∂ψ/∂y, v = ∂φ/∂y − ∂ψ/∂x turn ρ s² u = div σ into φ'' = a² φ, ψ'' = b² ψ
/// across a layer, with a² = k² + ρ s²/(λ+2μ), b² = k² + ρ s²/μ. Hence
///   u = ikφ + ψ',  v = φ' − ikψ,  σ_xy = μ (2ikφ' + (b²+k²) ψ),  σ_yy = λ (a²−k²) φ + 2μ (a² φ −
///   ikψ'),
/// four functions per layer: cosh ay and (sinh ay)/a for φ, the same with b for ψ. The conditions
/// at the faces of the layers are linear in their four amplitudes; s is an eigenvalue where the
/// determinant of these conditions vanishes.
#include <array>
#include <cmath>
#include <complex>
#include <utility>

#include "eigen/pencil/complex_modes.hpp"

namespace squeal::exact {

using Complex = std::complex<double>;

/// One eigenvalue with Im s ≥ 0.
struct Eigenvalue {
  int n;          ///< wave number index
  double re, im;  ///< growth rate and angular frequency, 1/s
  Complex s() const { return {re, im}; }
};

struct Material {
  double young, poisson, density;
  constexpr double mu() const { return young / (2 * (1 + poisson)); }
  constexpr double lambda() const { return young * poisson / ((1 + poisson) * (1 - 2 * poisson)); }
  constexpr double uniaxial() const {
    return lambda() + 2 * mu();
  }  ///< stress per strain with no lateral strain, Pa
};

/// What each of the four functions contributes at one height.
struct Waves {
  std::array<Complex, 4> u, v, xy, yy;
};

inline Waves wavesAt(const Material& material, double k, Complex s, double y) {
  const Complex i(0, 1), a2 = k * k + material.density * s * s / material.uniaxial(),
                         b2 = k * k + material.density * s * s / material.mu();
  const Complex a = std::sqrt(a2), b = std::sqrt(b2);
  const std::array<Complex, 4> phi{std::cosh(a * y), std::sinh(a * y) / a, 0, 0},
      dPhi{a * std::sinh(a * y), std::cosh(a * y), 0, 0};
  const std::array<Complex, 4> psi{0, 0, std::cosh(b * y), std::sinh(b * y) / b},
      dPsi{0, 0, b * std::sinh(b * y), std::cosh(b * y)};
  Waves waves;
  for (std::size_t j = 0; j < 4; ++j) {
    waves.u[j] = i * k * phi[j] + dPsi[j];
    waves.v[j] = dPhi[j] - i * k * psi[j];
    waves.xy[j] = material.mu() * (2.0 * i * k * dPhi[j] + (b2 + k * k) * psi[j]);
    waves.yy[j] = material.lambda() * (a2 - k * k) * phi[j] +
                  2 * material.mu() * (a2 * phi[j] - i * k * dPsi[j]);
  }
  return waves;
}

template <std::size_t size>
using Matrix = std::array<std::array<Complex, size>, size>;

/// Gaussian elimination with row pivoting.
template <std::size_t size>
Complex determinant(Matrix<size> m) {
  Complex product = 1;
  for (std::size_t c = 0; c < size; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < size; ++r)
      if (std::abs(m[r][c]) > std::abs(m[pivot][c])) pivot = r;
    if (pivot != c) std::swap(m[pivot], m[c]), product = -product;
    product *= m[c][c];
    for (std::size_t r = c + 1; r < size; ++r) {
      const Complex factor = m[r][c] / m[c][c];
      for (std::size_t j = c; j < size; ++j) m[r][j] -= factor * m[c][j];
    }
  }
  return product;
}

/// The step back to a root of `function` by Newton's method: the error of s as a root, to first
/// order.
template <class Function>
Complex newtonStep(const Function& function, Complex s) {
  const double step = 1e-5;
  return 2 * step * function(s) / (function(s + step) - function(s - step));
}

}  // namespace squeal::exact
