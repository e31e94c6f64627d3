// SPDX-License-Identifier: BSD-2-Clause
#include "model/material/hooke.hpp"

#include <algorithm>
#include <cmath>

#include "base/system/text.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::material {

using mesh::Matrix3;

namespace {

Hooke zeroLaw(int size) { return {size, std::vector<double>(size * size, 0.0)}; }

double& entry(Hooke& hooke, int i, int j) { return hooke.matrix[i * hooke.size + j]; }

/// Returns the compliance of the normal components, 1/Pa.
Matrix3 normalCompliance(const EngineeringConstants& c) {
  return {{{1 / c.e1, -c.nu12 / c.e1, -c.nu13 / c.e1},
           {-c.nu12 / c.e1, 1 / c.e2, -c.nu23 / c.e2},
           {-c.nu13 / c.e1, -c.nu23 / c.e2, 1 / c.e3}}};
}

/// The two indices of the tensor component of each row: xx, yy, zz, xy, yz, zx.
constexpr std::size_t first[] = {0, 1, 2, 0, 1, 2}, second[] = {0, 1, 2, 1, 2, 0};

/// The rows of a law in the order of its constants: 11, 22, 33, 12, 13, 23.
constexpr int rowOf[] = {0, 1, 2, 3, 5, 4};
constexpr const char* rowName[] = {"11", "22", "33", "12", "13", "23"};

}  // namespace

Hooke isotropic(double young, double poisson, int dimension, bool planeStress) {
  double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  const double mu = young / (2 * (1 + poisson));
  if (dimension == 2 && planeStress) lambda = 2 * lambda * mu / (lambda + 2 * mu);
  const int normals = dimension;
  Hooke hooke = zeroLaw(dimension == 2 ? 3 : 6);
  for (int i = 0; i < hooke.size; ++i)
    for (int j = 0; j < hooke.size; ++j) {
      if (i < normals && j < normals)
        entry(hooke, i, j) = lambda + (i == j ? 2 * mu : 0);
      else if (i == j)
        entry(hooke, i, j) = mu;
    }
  return hooke;
}

std::string violatedRule(const EngineeringConstants& c) {
  if (!(std::min({c.e1, c.e2, c.e3, c.g12, c.g13, c.g23}) > 0)) return "all moduli must be > 0";
  if (!(std::abs(c.nu12) < std::sqrt(c.e1 / c.e2))) return "|nu12| must be < sqrt(E1/E2)";
  if (!(std::abs(c.nu13) < std::sqrt(c.e1 / c.e3))) return "|nu13| must be < sqrt(E1/E3)";
  if (!(std::abs(c.nu23) < std::sqrt(c.e2 / c.e3))) return "|nu23| must be < sqrt(E2/E3)";
  const double rest = mesh::determinant(normalCompliance(c)) * c.e1 * c.e2 * c.e3;
  if (!(rest > 0))
    return formatted(
        "1 - nu12 nu21 - nu23 nu32 - nu31 nu13 - 2 nu21 nu32 nu13 must be > 0, it is %.3g (nu_ji = "
        "nu_ij Ej/Ei)",
        rest);
  return "";
}

Hooke orthotropic(const EngineeringConstants& c) {
  const Matrix3 compliance = normalCompliance(c),
                normal = mesh::inverse(compliance, mesh::determinant(compliance));
  Hooke hooke = zeroLaw(6);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) entry(hooke, i, j) = normal[i][j];
  entry(hooke, 3, 3) = c.g12, entry(hooke, 4, 4) = c.g23, entry(hooke, 5, 5) = c.g13;
  return hooke;
}

Hooke anisotropic(std::span<const double> constants) {
  Hooke hooke = zeroLaw(6);
  std::size_t next = 0;
  for (int column = 0; column < 6; ++column)
    for (int row = 0; row <= column; ++row) {
      const bool zero = constants.size() == 9 && column > 2 && row != column;
      const int i = rowOf[row], j = rowOf[column];
      entry(hooke, i, j) = entry(hooke, j, i) = zero ? 0 : constants[next++];
    }
  return hooke;
}

std::string violatedRule(const Hooke& solid) {
  // Cholesky's factorisation of D: the square of a pivot is the ratio of two leading minors.
  double factor[6][6];
  for (int i = 0; i < 6; ++i) {
    const double diagonal = solid(rowOf[i], rowOf[i]);
    if (!(diagonal > 0)) return formatted("D%s%s must be > 0", rowName[i], rowName[i]);
    for (int j = 0; j <= i; ++j) {
      double rest = solid(rowOf[i], rowOf[j]);
      for (int k = 0; k < j; ++k) rest -= factor[i][k] * factor[j][k];
      if (j < i)
        factor[i][j] = rest / factor[j][j];
      else if (rest > 1e-12 * diagonal)
        factor[i][i] = std::sqrt(rest);
      else
        return formatted(
            "the determinant of the first %d rows and columns (of 11, 22, 33, 12, 13, 23) must be "
            "> 0",
            i + 1);
    }
  }
  return "";
}

Hooke rotated(const Hooke& hooke, const Axes& axes) {
  //   ε' = T ε,   ε'_ij = Q_ik Q_jl ε_kl with engineering shear strains;   equal work: D = Tᵀ D' T
  double t[6][6];
  for (std::size_t r = 0; r < 6; ++r)
    for (std::size_t c = 0; c < 6; ++c) {
      const std::size_t i = first[r], j = second[r], k = first[c], l = second[c];
      const double both = (axes[i][k] * axes[j][l] + axes[i][l] * axes[j][k]) / 2;
      t[r][c] = r < 3 ? both : 2 * both;
    }
  Hooke turned = zeroLaw(6);
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b)
      for (int r = 0; r < 6; ++r)
        for (int s = 0; s < 6; ++s) entry(turned, a, b) += t[r][a] * hooke(r, s) * t[s][b];
  return turned;
}

bool mirrorSymmetric(const Hooke& solid) {
  double largest = 0, across = 0;
  for (double x : solid.matrix) largest = std::max(largest, std::abs(x));
  for (int i : {0, 1, 2, 3})
    for (int j : {4, 5}) across = std::max(across, std::abs(solid(i, j)));
  return across <= 1e-9 * largest;  // axes are given with a limited number of digits
}

Hooke inPlane(const Hooke& solid, bool planeStress) {
  const int kept[] = {0, 1, 3};
  Hooke plane = zeroLaw(3);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      entry(plane, i, j) = solid(kept[i], kept[j]);
      if (planeStress) entry(plane, i, j) -= solid(kept[i], 2) * solid(2, kept[j]) / solid(2, 2);
    }
  return plane;
}

}  // namespace squeal::material
