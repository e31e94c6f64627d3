// SPDX-License-Identifier: BSD-2-Clause
#include "model/elasticity/inertia.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <algorithm>
#include <cmath>

#include "model/elasticity/element.hpp"
#include "model/elasticity/jacobian.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::elasticity {
namespace {

bool positiveDefinite(std::vector<double> matrix, std::size_t size) {
  PetscBLASInt n = size, info = 0;
  LAPACKpotrf_("L", &n, matrix.data(), &n, &info);
  return info == 0;
}

/// Returns the volume of each point of the rule. If det J changes its sign, the mass ∫ ρ φᵢ φⱼ det
/// J dξ would be indefinite: points with negative det J then get no volume, and the others share
/// the volume of the cell.
std::vector<double> massVolumes(const ShapeTable& table, const std::vector<Point>& nodes) {
  std::vector<double> volumes, determinants;
  double total = 0, positive = 0;  // by the sign of det J: rules of odd degree on tri3 and tet4
                                   // have a negative weight
  for (int q = 0; q < table.points(); ++q) {
    const double det =
        determinant(jacobian(table.gradient.data() + 3 * q * table.nodes, nodes, table.dimension));
    determinants.push_back(det);
    volumes.push_back(table.weight[q] * det);
    total += volumes.back();
    positive += det > 0 ? volumes.back() : 0;
  }
  if (!(total > 0)) throw InvertedElement{};
  if (std::all_of(determinants.begin(), determinants.end(), [](double det) { return det > 0; }))
    return volumes;
  for (std::size_t q = 0; q < volumes.size(); ++q)
    volumes[q] *= determinants[q] > 0 ? total / positive : 0;
  return volumes;
}

}  // namespace

std::vector<double> mass(const ShapeTable& table, const std::vector<Point>& nodes, double density,
                         MassKind kind) {
  const std::size_t n = table.nodes;
  const std::vector<double> volumes = massVolumes(table, nodes);
  std::vector<double> m(n * n, 0.0);
  for (std::size_t q = 0; q < volumes.size(); ++q) {
    const double factor = density * volumes[q];
    const double* value = table.value.data() + q * n;
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) m[a * n + b] += factor * value[a] * value[b];
  }
  if (folded(table, nodes) && !positiveDefinite(m, n)) throw InvertedElement{};
  if (kind == MassKind::higherOrder) {
    double total = 0, trace = 0;
    for (std::size_t a = 0; a < n; ++a) {
      trace += m[a * n + a];
      for (std::size_t b = 0; b < n; ++b) total += m[a * n + b];
    }
    std::vector<double> lumped(n);
    for (std::size_t a = 0; a < n; ++a) lumped[a] = m[a * n + a] * total / trace;
    for (auto& entry : m) entry *= 0.5;
    for (std::size_t a = 0; a < n; ++a) m[a * n + a] += 0.5 * lumped[a];
  }
  return m;
}

std::vector<double> centrifugal(const ShapeTable& table, const std::vector<Point>& nodes,
                                double density, const Motion& motion) {
  const auto& [translation, speed, axis, origin] = motion;
  const std::size_t n = table.nodes;
  std::vector<double> load(3 * n, 0.0);
  for (int q = 0; q < table.points(); ++q) {
    const double det =
        determinant(jacobian(table.gradient.data() + 3 * q * table.nodes, nodes, table.dimension));
    const double factor = density * speed * speed * table.weight[q] * det;
    const double* value = table.value.data() + q * n;
    Point r{-origin[0], -origin[1], -origin[2]};
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t d = 0; d < 3; ++d) r[d] += value[a] * nodes[a][d];
    r = mesh::tangential(r, axis);
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t d = 0; d < 3; ++d) load[3 * a + d] += factor * value[a] * r[d];
  }
  return load;
}

Convection convection(const ShapeTable& table, const std::vector<Point>& nodes,
                      const std::vector<Point>& velocity, double density) {
  const std::size_t n = table.nodes;
  Convection result{std::vector<double>(n * n, 0.0), std::vector<double>(n * n, 0.0),
                    std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
  std::vector<double> rate(n);
  for (int q = 0; q < table.points(); ++q) {
    const double* gradient = table.gradient.data() + 3 * q * table.nodes;
    const double* value = table.value.data() + q * n;
    const Matrix3 j = jacobian(gradient, nodes, table.dimension);
    const double det = positiveDeterminant(j), volume = table.weight[q] * det;
    const Matrix3 inv = inverse(j, det);
    Point v{};
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t d = 0; d < 3; ++d) v[d] += value[a] * velocity[a][d];
    for (std::size_t a = 0; a < n; ++a) {
      const Point g = mapped(inv, {gradient[3 * a], gradient[3 * a + 1], gradient[3 * a + 2]});
      rate[a] =
          v[0] * g[0] + v[1] * g[1] + v[2] * g[2];  // D φ_a; g has no z component in the plane
      result.flux[a] += volume * rate[a];
      result.fluxScale[a] += volume * std::abs(rate[a]);
    }
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) {
        result.gyroscopic[a * n + b] +=
            density * volume * (rate[b] * value[a] - rate[a] * value[b]);
        result.rotationStiffness[a * n + b] -= density * volume * rate[b] * rate[a];
      }
  }
  return result;
}

}  // namespace squeal::elasticity
