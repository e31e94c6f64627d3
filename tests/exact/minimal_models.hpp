// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Two-degree-of-freedom models of the literature, with critical frictions in closed form.
#include <array>
#include <cmath>
#include <complex>
#include <vector>

namespace squeal::exact::minimal_models {

using Matrix2 = std::array<double, 4>;  // row by row

/// M ẍ + C ẋ + (K0 + μ K1) x = 0.
struct Matrices {
  Matrix2 mass, damping, stiffness, friction;
};

/// N. Hoffmann, M. Fischer, R. Allgaier, L. Gaul, A minimal model for studying properties of the
/// mode-coupling type instability in friction induced oscillations, Mechanics Research
/// Communications 29 (2002) 197–205. A mass m on a belt, held by springs k1, k2 at the angles α1,
/// α2 to the belt and by the contact spring k3 across it; Coulomb friction μ k3 y along the belt.
/// In (x, y):
///   K = [k11, k12 − μ k3; k12, k22],  k11 = Σ k_i cos² α_i,  k12 = Σ k_i sin α_i cos α_i,  k22 = Σ
///   k_i sin² α_i + k3.
/// With M = m I:  (k11 − λ)(k22 − λ) = k12 (k12 − μ k3), λ = −m s². The frequencies merge where the
/// discriminant vanishes,
///   (k11 − k22)²/4 + k12 (k12 − μ k3) = 0:  μ_c = (k12 + (k11 − k22)²/(4 k12)) / k3.
struct Belt {
  double m = 0.02, k1 = 1.1e4, k2 = 2.0e4, k3 = 1.3e4, alpha1 = 2.6, alpha2 = 0.5;  // rad

  double k11() const {
    return k1 * std::pow(std::cos(alpha1), 2) + k2 * std::pow(std::cos(alpha2), 2);
  }
  double k12() const {
    return k1 * std::sin(alpha1) * std::cos(alpha1) + k2 * std::sin(alpha2) * std::cos(alpha2);
  }
  double k22() const {
    return k1 * std::pow(std::sin(alpha1), 2) + k2 * std::pow(std::sin(alpha2), 2) + k3;
  }
  double discriminant(double mu) const {
    return std::pow((k11() - k22()) / 2, 2) + k12() * (k12() - mu * k3);
  }
  double critical() const { return (k12() + std::pow(k11() - k22(), 2) / (4 * k12())) / k3; }
  Matrices matrices() const {
    return {{m, 0, 0, m}, {}, {k11(), k12(), k12(), k22()}, {0, -k3, 0, 0}};
  }
  std::vector<std::complex<double>> exact(double mu) const {
    std::vector<std::complex<double>> list;
    for (const double sign : {-1.0, 1.0}) {
      const std::complex<double> s = std::sqrt(
          -((k11() + k22()) / 2 + sign * std::sqrt(std::complex<double>(discriminant(mu)))) / m);
      list.push_back(s.imag() < 0 ? -s : s);
    }
    return list;
  }
};

/// J.-J. Sinou, L. Jézéquel, Mode coupling instability in friction-induced vibrations and its
/// dependency on system parameters including damping, European Journal of Mechanics A/Solids 26
/// (2007) 106–122, in its normalised form: two modes with equal masses, coupled by a friction that
/// is proportional to the displacement of the other,
///   ẍ1 + η1 ẋ1 + ω1² x1 − μ ω0² x2 = 0,  ẍ2 + η2 ẋ2 + ω2² x2 + μ ω0² x1 = 0.
/// Characteristic polynomial s⁴ + a3 s³ + a2 s² + a1 s + a0:
///   a3 = η1 + η2, a2 = ω1² + ω2² + η1 η2, a1 = η1 ω2² + η2 ω1², a0 = ω1² ω2² + μ² ω0⁴.
/// Routh and Hurwitz: flutter begins at a1 a2 a3 = a1² + a3² a0, where s² = −a1/a3:
///   μ_c² ω0⁴ = a1 a2 / a3 − (a1 / a3)² − ω1² ω2².
struct Coupled {
  double w1 = 600, w2 = 660, w0 = 500, eta1 = 0, eta2 = 0;

  double damped() const {
    const double a3 = eta1 + eta2, a2 = w1 * w1 + w2 * w2 + eta1 * eta2,
                 a1 = eta1 * w2 * w2 + eta2 * w1 * w1;
    return std::sqrt(a1 * a2 / a3 - std::pow(a1 / a3, 2) - std::pow(w1 * w2, 2)) / (w0 * w0);
  }
  double frequency() const { return std::sqrt((eta1 * w2 * w2 + eta2 * w1 * w1) / (eta1 + eta2)); }
  double undamped() const { return std::abs(w2 * w2 - w1 * w1) / (2 * w0 * w0); }
  Matrices matrices() const {
    return {{1, 0, 0, 1}, {eta1, 0, 0, eta2}, {w1 * w1, 0, 0, w2 * w2}, {0, -w0 * w0, w0 * w0, 0}};
  }
};

}  // namespace squeal::exact::minimal_models
