// SPDX-License-Identifier: BSD-2-Clause
#include "model/elasticity/element.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <algorithm>
#include <cmath>

#include "model/elasticity/jacobian.hpp"

namespace squeal::elasticity {
namespace {

/// Writes into column block `i` of B (row-major, `columns` wide) the strains of ∂φ/∂x = g.
void strainColumns(double* b, int columns, int i, const Point& g, int dimension) {
  const auto at = [&](int row, int component) -> double& {
    return b[row * columns + i * dimension + component];
  };
  if (dimension == 2) {
    at(0, 0) = g[0], at(1, 1) = g[1], at(2, 0) = g[1], at(2, 1) = g[0];
    return;
  }
  at(0, 0) = g[0], at(1, 1) = g[1], at(2, 2) = g[2];
  at(3, 0) = g[1], at(3, 1) = g[0];
  at(4, 1) = g[2], at(4, 2) = g[1];
  at(5, 0) = g[2], at(5, 2) = g[0];
}

/// Returns the amplitudes of the trailing `inner` unknowns per unit of each other unknown,
///   −Kii⁻¹ Kio,
/// [other][inner], from a symmetric row-major matrix of size `all`.
std::vector<double> innerResponse(const std::vector<double>& k, int all, int inner) {
  const int outer = all - inner;
  std::vector<double> kii(inner * inner), response(inner * outer);
  for (int a = 0; a < inner; ++a) {  // column-major
    for (int b = 0; b < inner; ++b) kii[b * inner + a] = k[(outer + a) * all + outer + b];
    for (int b = 0; b < outer; ++b) response[b * inner + a] = -k[(outer + a) * all + b];
  }
  PetscBLASInt n = inner, m = outer, info = 0;
  LAPACKpotrf_("L", &n, kii.data(), &n, &info);
  LAPACKpotrs_("L", &n, &m, kii.data(), &n, response.data(), &n, &info);
  return response;
}

/// Returns the Schur complement of the trailing `inner` rows of a symmetric row-major matrix of
/// size `all`.
std::vector<double> condensed(const std::vector<double>& k, int all, int inner) {
  const int outer = all - inner;
  const auto response = innerResponse(k, all, inner);
  std::vector<double> result(outer * outer);
  for (int a = 0; a < outer; ++a)
    for (int b = 0; b < outer; ++b) {
      double sum = k[a * all + b];
      for (int c = 0; c < inner; ++c) sum += k[(outer + c) * all + a] * response[b * inner + c];
      result[a * outer + b] = sum;
    }
  return result;
}

/// The matrix B of strains at the quadrature points from nodal displacements and bubble amplitudes.
struct StrainMatrix {
  int points = 0, rows = 0, columns = 0;  ///< rows per point
  std::vector<double> b;                  ///< [point][row][column]
  std::vector<double> volume;             ///< [point] weight times det J
  std::vector<Point> position;            ///< [point]
  const double* at(int q) const { return b.data() + q * rows * columns; }
};

StrainMatrix strainMatrix(const ShapeTable& table, const std::vector<Point>& nodes,
                          bool incompatible) {
  const int dimension = table.dimension, bubbles = incompatible ? dimension : 0;
  StrainMatrix strain{
      table.points(), dimension == 2 ? 3 : 6, (table.nodes + bubbles) * dimension, {}, {}, {}};
  strain.b.assign(strain.points * strain.rows * strain.columns, 0.0);
  Matrix3 centre{};
  double centreDet = 0;
  if (incompatible) {
    const Matrix3 j = jacobian(table.centreGradient.data(), nodes, dimension);
    centreDet = positiveDeterminant(j);
    centre = inverse(j, centreDet);
  }
  for (int q = 0; q < strain.points; ++q) {
    const double* gradient = table.gradient.data() + 3 * q * table.nodes;
    const Matrix3 j = jacobian(gradient, nodes, dimension);
    const double det = positiveDeterminant(j);
    const Matrix3 inv = inverse(j, det);
    double* bq = strain.b.data() + q * strain.rows * strain.columns;
    Point x{};
    for (int i = 0; i < table.nodes; ++i) {
      strainColumns(bq, strain.columns, i,
                    mapped(inv, {gradient[3 * i], gradient[3 * i + 1], gradient[3 * i + 2]}),
                    dimension);
      for (std::size_t d = 0; d < 3; ++d) x[d] += table.value[q * table.nodes + i] * nodes[i][d];
    }
    for (int m = 0; m < bubbles; ++m) {
      // ∇(1 − ξ_m²) with the Jacobian of the centre, scaled by j0/j: its mean vanishes, so constant
      // stress does no work on it.
      Point reference{};
      reference[m] = -2 * table.point[3 * q + m] * centreDet / det;
      strainColumns(bq, strain.columns, table.nodes + m, mapped(centre, reference), dimension);
    }
    strain.volume.push_back(table.weight[q] * det);
    strain.position.push_back(x);
  }
  return strain;
}

/// Returns K = ∫ Bᵀ D B, with the rows and columns of the bubbles.
std::vector<double> fullStiffness(const StrainMatrix& strain, const Law& law) {
  std::vector<double> db(strain.b.size(), 0.0);
  Hooke storage;
  for (int q = 0; q < strain.points; ++q) {
    const Hooke& hooke = law.at(strain.position[q], storage);
    double* dbq = db.data() + q * strain.rows * strain.columns;
    for (int r = 0; r < strain.rows; ++r)
      for (int s = 0; s < strain.rows; ++s) {
        const double d = strain.volume[q] * hooke(r, s);
        if (d != 0)
          for (int c = 0; c < strain.columns; ++c)
            dbq[r * strain.columns + c] += d * strain.at(q)[s * strain.columns + c];
      }
  }
  // Row-major B is column-major Bᵀ: K = Bᵀ (D B) over all points in one product.
  std::vector<double> k(strain.columns * strain.columns);
  PetscBLASInt n = strain.columns, depth = strain.rows * strain.points;
  const PetscScalar one = 1, zero = 0;
  BLASgemm_("N", "T", &n, &n, &depth, &one, strain.b.data(), &n, db.data(), &n, &zero, k.data(),
            &n);
  return k;
}

/// Returns the stress σ = D B u at one point; in the plane its in-plane components.
Matrix3 stressAt(const StrainMatrix& strain, int q, const Hooke& hooke,
                 const std::vector<double>& displacement) {
  std::vector<double> epsilon(strain.rows, 0.0), sigma(epsilon.size(), 0.0);
  for (int r = 0; r < strain.rows; ++r)
    for (int c = 0; c < strain.columns; ++c)
      epsilon[r] += strain.at(q)[r * strain.columns + c] * displacement[c];
  for (int r = 0; r < strain.rows; ++r)
    for (int s = 0; s < strain.rows; ++s) sigma[r] += hooke(r, s) * epsilon[s];
  if (strain.rows == 3) return {{{sigma[0], sigma[2], 0}, {sigma[2], sigma[1], 0}, {0, 0, 0}}};
  return {{{sigma[0], sigma[3], sigma[5]},
           {sigma[3], sigma[1], sigma[4]},
           {sigma[5], sigma[4], sigma[2]}}};
}

/// Returns det J at the points of the rule.
std::vector<double> determinants(const ShapeTable& table, const std::vector<Point>& nodes) {
  std::vector<double> all;
  for (int q = 0; q < table.points(); ++q)
    all.push_back(
        determinant(jacobian(table.gradient.data() + 3 * q * table.nodes, nodes, table.dimension)));
  return all;
}

}  // namespace

bool folded(const ShapeTable& table, const std::vector<Point>& nodes) {
  const auto all = determinants(table, nodes);
  return std::any_of(all.begin(), all.end(), [](double det) { return !(det > 0); });
}

const ShapeTable& gradientTable(const ShapeTable& table, const std::vector<Point>& nodes) {
  return folded(table, nodes) ? stiffnessTable(table.type) : table;
}

bool foldedAnywhere(int type, const std::vector<Point>& nodes) {
  return folded(stiffnessTable(type), nodes) || folded(shapeTable(type), nodes);
}

double jacobianRatio(int type, const std::vector<Point>& nodes) {
  auto all = determinants(stiffnessTable(type), nodes);
  const auto strict = determinants(shapeTable(type), nodes);
  all.insert(all.end(), strict.begin(), strict.end());
  const auto [least, greatest] = std::minmax_element(all.begin(), all.end());
  return *least / std::max(std::abs(*least), std::abs(*greatest));
}

std::vector<Point> straightened(int type, const std::vector<Point>& nodes) {
  const ShapeTable& table = shapeTable(type);
  std::vector<Point> straight = nodes;
  for (int i = table.corners; i < table.nodes; ++i) {
    straight[i] = {};
    for (int c = 0; c < table.corners; ++c)
      for (std::size_t d = 0; d < 3; ++d)
        straight[i][d] += table.cornerValue[i * table.corners + c] * nodes[c][d];
  }
  return straight;
}

std::vector<double> stiffness(const ShapeTable& table, const std::vector<Point>& nodes,
                              const Law& law, bool incompatible) {
  const StrainMatrix strain = strainMatrix(table, nodes, incompatible);
  auto k = fullStiffness(strain, law);
  return incompatible ? condensed(k, strain.columns, table.dimension * table.dimension) : k;
}

std::vector<double> geometricStiffness(const ShapeTable& table, const std::vector<Point>& nodes,
                                       const Law& law, bool incompatible,
                                       std::vector<double> displacement) {
  const StrainMatrix strain = strainMatrix(table, nodes, incompatible);
  const int dimension = table.dimension, n = table.nodes;
  if (incompatible) {
    const int inner = dimension * dimension, outer = displacement.size();
    const auto response = innerResponse(fullStiffness(strain, law), strain.columns, inner);
    displacement.resize(outer + inner);
    for (int b = 0; b < outer; ++b)
      for (int a = 0; a < inner; ++a)
        displacement[outer + a] += response[b * inner + a] * displacement[b];
  }
  std::vector<double> k(n * n, 0.0);
  Hooke storage;
  for (int q = 0; q < strain.points; ++q) {
    const Matrix3 stress = stressAt(strain, q, law.at(strain.position[q], storage), displacement);
    // The normal strains of node i are its ∂φ/∂x_d.
    const auto gradient = [&](int i, int d) {
      return strain.at(q)[d * strain.columns + i * dimension + d];
    };
    for (int i = 0; i < n; ++i)
      for (int d = 0; d < dimension; ++d) {
        double flux = 0;
        for (int c = 0; c < dimension; ++c) flux += gradient(i, c) * stress[c][d];
        for (int j = 0; j < n; ++j) k[i * n + j] += strain.volume[q] * flux * gradient(j, d);
      }
  }
  return k;
}

}  // namespace squeal::elasticity
