// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// An elastic annulus a ≤ r ≤ b in plane strain, held at r = a, free at r = b, turning about its
/// axis at ω.
///
/// In vehicle axes u̇ of matter is (∂_t + D) u with D = ω ∂/∂θ of Cartesian components, so that ρ
/// (∂_t + D)² u = div σ(u). For components along e_r and e_θ,
///   u = (R(r) e_r + i T(r) e_θ) e^{inθ + st},   D u = ω (i n + k ×) u,   k × u = −i S u,   S (R,
///   T) = (T, R).
/// So with s = i Λ and λ = Λ + n ω:  K_n x = (λ − ω S)² M x, x = (R, T). This is the problem in
/// axes that turn with the matter, Coriolis and centrifugal terms included, and λ its frequency
/// there: λ² M x − 2 λ ω S M x − (K_n − ω² M) x = 0. The frequency in vehicle axes is Λ = λ − n ω:
/// the shift is that of the components along e_r and e_θ. (u_x ± i u_y = (u_r ± i u_θ) e^{±iθ} is
/// of the order n ± 1: its own shift, (n ± 1) ω, already contains the Coriolis term, S = ∓1.) All
/// n, positive and negative, and all λ: a conjugate pair ±Λ is that of n and −n, so Λ > 0 for all n
/// is every pair once. Waves with n > 0 and Λ > 0 run against the rotation.
#include <slepcsys.h>

#include <slepcblaslapack.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "exact/waves.hpp"

namespace squeal::exact::annulus {

struct Annulus {
  double young, poisson, density, inner, outer;
  double mu() const { return young / (2 * (1 + poisson)); }
  double lambda() const { return young * poisson / ((1 + poisson) * (1 - 2 * poisson)); }
};

/// Value and derivative of the Legendre polynomials P_0 … P_degree at ξ.
struct Legendre {
  std::vector<double> value, slope;
  Legendre(std::size_t degree, double xi) : value(degree + 1, 1), slope(degree + 1, 0) {
    for (std::size_t j = 1; j <= degree; ++j) {
      const auto k = static_cast<double>(j);
      value[j] = ((2 * k - 1) * xi * value[j - 1] - (k - 1) * (j > 1 ? value[j - 2] : 0)) / k;
      slope[j] = (j > 1 ? slope[j - 2] : 0) + (2 * k - 1) * value[j - 1];
    }
  }
};

/// Column-major, n×n.
struct Square {
  std::size_t n;
  std::vector<double> values = std::vector<double>(n * n, 0.0);
  double& operator()(std::size_t i, std::size_t j) { return values[j * n + i]; }
};

/// K_n and M by Galerkin's method with the functions (1 + ξ) P_j(ξ), j < `size`, for R and for T.
struct Radial {
  Square stiffness, mass;

  Radial(const Annulus& annulus, int order, std::size_t size)
      : stiffness{2 * size}, mass{2 * size} {
    const std::size_t points = size + 8;  // 1/r is not a polynomial
    const double half = (annulus.outer - annulus.inner) / 2;
    for (std::size_t q = 0; q < points; ++q) {
      double xi =
          std::cos(M_PI * (static_cast<double>(q) + 0.75) / (static_cast<double>(points) + 0.5));
      for (int newton = 0; newton < 20; ++newton) {
        const Legendre at(points, xi);
        xi -= at.value[points] / at.slope[points];
      }
      const double slope = Legendre(points, xi).slope[points];
      add(annulus, order, size, xi, half, 2 / ((1 - xi * xi) * slope * slope));
    }
  }

 private:
  /// Strains ε_rr = R', ε_θθ = (R − n T)/r, γ_rθ = i (n R/r + T' − T/r).
  void add(const Annulus& annulus, int order, std::size_t size, double xi, double half,
           double weight) {
    const double r = annulus.inner + half * (1 + xi), area = weight * half * r;
    const Legendre p(size, xi);
    struct Strain {
      double rr, tt, rt, u;
    };
    std::vector<Strain> strains(2 * size);
    for (std::size_t j = 0; j < size; ++j) {
      const double f = (1 + xi) * p.value[j], slope = (p.value[j] + (1 + xi) * p.slope[j]) / half;
      strains[j] = {slope, f / r, order * f / r, f};
      strains[size + j] = {0, -order * f / r, slope - f / r, f};
    }
    for (std::size_t j = 0; j < 2 * size; ++j)
      for (std::size_t i = 0; i < 2 * size; ++i) {
        const Strain &a = strains[i], &b = strains[j];
        stiffness(i, j) +=
            area * (annulus.lambda() * (a.rr + a.tt) * (b.rr + b.tt) +
                    annulus.mu() * (2 * a.rr * b.rr + 2 * a.tt * b.tt + a.rt * b.rt));
        if ((i < size) == (j < size)) mass(i, j) += area * annulus.density * a.u * b.u;
      }
  }
};

/// All λ of the discrete problem, ascending. With y = λ x and K' = K_n − ω² M, positive definite
/// below the critical speed, the quadratic problem is the definite one  [0 K'; K' 2ωSM] (x, y) = λ
/// [K' 0; 0 M] (x, y).
inline std::vector<double> turningFrequencies(const Annulus& annulus, int order, double omega,
                                              std::size_t size = 20) {
  Radial radial(annulus, order, size);
  const std::size_t n = 2 * size;
  Square left{2 * n}, right{2 * n};
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      const double k = radial.stiffness(i, j) - omega * omega * radial.mass(i, j);
      right(i, j) = left(i, n + j) = left(n + i, j) = k;
      right(n + i, n + j) = radial.mass(i, j);
      left(n + i, n + j) = 2 * omega * radial.mass((i + size) % n, j);
    }
  PetscBLASInt type = 1, rows = static_cast<PetscBLASInt>(2 * n), length = 10 * rows, info = 0,
               integers = 1, integer = 0;
  std::vector<double> values(2 * n), work(static_cast<std::size_t>(length));
  LAPACKsygvd_(&type, "N", "L", &rows, left.values.data(), &rows, right.values.data(), &rows,
               values.data(), work.data(), &length, &integer, &integers, &info);
  if (info != 0) values.clear();
  return values;
}

/// Frequencies Λ of waves e^{i(nθ + Λt)} in vehicle axes, 0 < Λ < top, ascending.
inline std::vector<double> vehicleFrequencies(const Annulus& annulus, int order, double omega,
                                              double top, std::size_t size = 20) {
  std::vector<double> found;
  for (double lambda : turningFrequencies(annulus, order, omega, size))
    if (const double shifted = lambda - order * omega; shifted > 0 && shifted < top)
      found.push_back(shifted);
  std::sort(found.begin(), found.end());
  return found;
}

/// Zero where λ is a frequency at rest of the order n ≥ 0. Helmholtz: R = f' + n g/r, T = n f/r +
/// g' with f and g Bessel functions of α r = λ r √(ρ/(λ_L + 2μ)) and β r = λ r √(ρ/μ); R = T = 0 at
/// a, σ_rr = σ_rθ = 0 at b.
inline double characteristic(const Annulus& annulus, int n, double lambda) {
  const double speeds[] = {
      lambda * std::sqrt(annulus.density / (annulus.lambda() + 2 * annulus.mu())),
      lambda * std::sqrt(annulus.density / annulus.mu())};
  Matrix<4> conditions{};
  for (std::size_t column = 0; column < 4; ++column) {
    const double k = speeds[column / 2];
    const auto bessel = [&](int order, double x) {
      return column % 2 ? std::cyl_neumann(order, x)
                        : std::cyl_bessel_j(static_cast<double>(order), x);
    };
    for (const double r : {annulus.inner, annulus.outer}) {
      const double h = bessel(n, k * r), first = n * h / r - k * bessel(n + 1, k * r),
                   second = -first / r - (k * k - n * n / (r * r)) * h;
      const bool shear = column >= 2;
      const double R = shear ? n * h / r : first, T = shear ? first : n * h / r;
      const double slopeR = shear ? n * first / r - n * h / (r * r) : second,
                   slopeT = shear ? second : n * first / r - n * h / (r * r);
      if (r == annulus.inner) {
        conditions[0][column] = R, conditions[1][column] = T;
      } else {
        conditions[2][column] =
            annulus.lambda() * (shear ? 0 : -k * k * h) + 2 * annulus.mu() * slopeR;
        conditions[3][column] = annulus.mu() * (n * R / r + slopeT - T / r);
      }
    }
  }
  return determinant(conditions).real();
}

}  // namespace squeal::exact::annulus
