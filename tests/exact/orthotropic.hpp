// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// An orthotropic material with nothing special about it: its law, and waves across a layer of it.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace squeal::exact::orthotropic {

inline constexpr double e1 = 3, e2 = 1.3, e3 = 0.8, nu12 = 0.35, nu13 = 0.42, nu23 = 0.27,
                        g12 = 0.9, g13 = 0.7, g23 = 0.5;
/// In the order of the option, -material_<body>_engineering_constants.
inline constexpr const char* constants = "3,1.3,0.8,0.35,0.42,0.27,0.9,0.7,0.5";

using Matrix = std::array<std::array<double, 3>, 3>;

/// ε' = S σ' in the axes of the material, as the constants are defined.
inline Matrix strainOf(const Matrix& s) {
  Matrix e{};
  e[0][0] = s[0][0] / e1 - nu12 / e1 * s[1][1] - nu13 / e1 * s[2][2];
  e[1][1] = -nu12 / e1 * s[0][0] + s[1][1] / e2 - nu23 / e2 * s[2][2];
  e[2][2] = -nu13 / e1 * s[0][0] - nu23 / e2 * s[1][1] + s[2][2] / e3;
  e[0][1] = e[1][0] = s[0][1] / (2 * g12), e[0][2] = e[2][0] = s[0][2] / (2 * g13),
  e[1][2] = e[2][1] = s[1][2] / (2 * g23);
  return e;
}

/// σ:ε
inline double product(const Matrix& a, const Matrix& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) sum += a[i][j] * b[i][j];
  return sum;
}

/// Qᵀ ε' Q, the rows of Q being the axes of the material.
inline Matrix toMesh(const Matrix& e, const Matrix& q) {
  Matrix turned{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l) turned[i][j] += q[k][i] * e[k][l] * q[l][j];
  return turned;
}

/// Stiffness in the plane of axes 1 and 2 where nothing strains across it; D66 is g12.
struct PlaneStrain {
  double d11, d22, d12;
};

inline PlaneStrain planeStrain() {
  const double nu21 = nu12 * e2 / e1, nu31 = nu13 * e3 / e1, nu32 = nu23 * e3 / e2;
  const double delta = 1 - nu12 * nu21 - nu23 * nu32 - nu31 * nu13 - 2 * nu21 * nu32 * nu13;
  return {e1 * (1 - nu23 * nu32) / delta, e2 * (1 - nu13 * nu31) / delta,
          e1 * (nu21 + nu31 * nu23) / delta};
}

/// Motion uniform in x of a layer −1 < y < 0, clamped below, free above: ρ u_tt = Γ u_yy with Γ =
/// [D66 D26; D26 D22] in the axes of the mesh, axis 1 turned by `angle` from x, ω = (2n − 1) π/2
/// √(γ/ρ) for both eigenvalues γ of Γ. The first `count` of them, sorted.
inline std::vector<double> layerFrequencies(double angle, double density, std::size_t count) {
  const auto [d11, d22, d12] = planeStrain();
  // Jones, Mechanics of Composite Materials, turns D so, by the angle from x to axis 1.
  const double c = std::cos(angle), s = std::sin(angle);
  const double g22 =
      d11 * s * s * s * s + 2 * (d12 + 2 * g12) * s * s * c * c + d22 * c * c * c * c;
  const double g66 =
      (d11 + d22 - 2 * d12 - 2 * g12) * s * s * c * c + g12 * (s * s * s * s + c * c * c * c);
  const double g26 = (d11 - d12 - 2 * g12) * s * s * s * c + (d12 - d22 + 2 * g12) * s * c * c * c;
  const double mean = (g22 + g66) / 2, root = std::hypot((g22 - g66) / 2, g26);
  std::vector<double> list;
  for (int n = 1; n < 10; ++n)
    for (double gamma : {mean - root, mean + root})
      list.push_back((2 * n - 1) * M_PI / 2 * std::sqrt(gamma / density));
  std::sort(list.begin(), list.end());
  list.resize(count);
  return list;
}

}  // namespace squeal::exact::orthotropic
