#include "elasticity/element.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <cmath>

namespace squeal::elasticity {
namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;

/// J[r][d] = ∂x_d/∂ξ_r; rows beyond the element's dimension are unit vectors, so that the inverse exists.
Matrix3 jacobian(const double* gradient, const std::vector<Point>& nodes, int dimension) {
  Matrix3 j{};
  for (int r = dimension; r < 3; ++r) j[static_cast<std::size_t>(r)][static_cast<std::size_t>(r)] = 1;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t r = 0; r < static_cast<std::size_t>(dimension); ++r)
      for (std::size_t d = 0; d < 3; ++d) j[r][d] += gradient[3 * i + r] * nodes[i][d];
  return j;
}

double determinant(const Matrix3& j) {
  return j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) - j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
         j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
}

Matrix3 inverse(const Matrix3& j, double det) {
  Matrix3 inv;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      const std::size_t p = (b + 1) % 3, q = (b + 2) % 3, r = (a + 1) % 3, s = (a + 2) % 3;
      inv[a][b] = (j[p][r] * j[q][s] - j[p][s] * j[q][r]) / det;
    }
  return inv;
}

double positiveDeterminant(const Matrix3& j) {
  const double det = determinant(j);
  if (!(det > 0)) throw InvertedElement{};
  return det;
}

/// Writes into column block `i` of B (row-major, `columns` wide) the strains of ∂φ/∂x = g.
void strainColumns(double* b, int columns, int i, const Point& g, int dimension) {
  const auto at = [&](int row, int component) -> double& { return b[row * columns + i * dimension + component]; };
  if (dimension == 2) {
    at(0, 0) = g[0], at(1, 1) = g[1], at(2, 0) = g[1], at(2, 1) = g[0];
    return;
  }
  at(0, 0) = g[0], at(1, 1) = g[1], at(2, 2) = g[2];
  at(3, 0) = g[1], at(3, 1) = g[0];
  at(4, 1) = g[2], at(4, 2) = g[1];
  at(5, 0) = g[2], at(5, 2) = g[0];
}

Point mapped(const Matrix3& inv, const Point& reference) {
  Point g{};
  for (std::size_t d = 0; d < 3; ++d)
    for (std::size_t r = 0; r < 3; ++r) g[d] += inv[d][r] * reference[r];
  return g;
}

/// Schur complement of the trailing `inner` rows of a symmetric row-major matrix of size `all`.
std::vector<double> condensed(const std::vector<double>& k, int all, int inner) {
  const int outer = all - inner;
  std::vector<double> kii(static_cast<std::size_t>(inner * inner)), kio(static_cast<std::size_t>(inner * outer));  // column-major
  for (int a = 0; a < inner; ++a) {
    for (int b = 0; b < inner; ++b)
      kii[static_cast<std::size_t>(b * inner + a)] = k[static_cast<std::size_t>((outer + a) * all + outer + b)];
    for (int b = 0; b < outer; ++b)
      kio[static_cast<std::size_t>(b * inner + a)] = k[static_cast<std::size_t>((outer + a) * all + b)];
  }
  std::vector<double> solved = kio, result(static_cast<std::size_t>(outer * outer));
  PetscBLASInt n = inner, m = outer, info = 0;
  LAPACKpotrf_("L", &n, kii.data(), &n, &info);
  LAPACKpotrs_("L", &n, &m, kii.data(), &n, solved.data(), &n, &info);
  for (int a = 0; a < outer; ++a)
    for (int b = 0; b < outer; ++b) {
      double sum = k[static_cast<std::size_t>(a * all + b)];
      for (int c = 0; c < inner; ++c)
        sum -= kio[static_cast<std::size_t>(a * inner + c)] * solved[static_cast<std::size_t>(b * inner + c)];
      result[static_cast<std::size_t>(a * outer + b)] = sum;
    }
  return result;
}

Point faceNormal(const double* gradient, const std::vector<Point>& nodes, int dimension) {
  Point a{}, b{0, 0, 1};  // in the plane: (dx, dy) × z = (dy, −dx)
  if (dimension == 2) b = {};
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) {
      a[d] += gradient[3 * i] * nodes[i][d];
      if (dimension == 2) b[d] += gradient[3 * i + 1] * nodes[i][d];
    }
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double norm(const Point& p) { return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]); }

}  // namespace

Hooke isotropic(double young, double poisson, int dimension, bool planeStress) {
  double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  const double mu = young / (2 * (1 + poisson));
  if (dimension == 2 && planeStress) lambda = 2 * lambda * mu / (lambda + 2 * mu);
  const int normals = dimension, size = dimension == 2 ? 3 : 6;
  Hooke hooke{size, std::vector<double>(static_cast<std::size_t>(size * size), 0.0)};
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) {
      auto& entry = hooke.matrix[static_cast<std::size_t>(i * size + j)];
      if (i < normals && j < normals)
        entry = lambda + (i == j ? 2 * mu : 0);
      else if (i == j)
        entry = mu;
    }
  return hooke;
}

std::vector<double> stiffness(const ShapeTable& table, const std::vector<Point>& nodes, const Hooke& hooke, bool incompatible) {
  const int dimension = table.dimension, bubbles = incompatible ? dimension : 0, columns = (table.nodes + bubbles) * dimension;
  const int rows = hooke.size * table.points();
  std::vector<double> b(static_cast<std::size_t>(rows * columns), 0.0), db(b.size(), 0.0);
  Matrix3 centre{};
  double centreDet = 0;
  if (incompatible) {
    const Matrix3 j = jacobian(table.centreGradient.data(), nodes, dimension);
    centreDet = positiveDeterminant(j);
    centre = inverse(j, centreDet);
  }
  for (int q = 0; q < table.points(); ++q) {
    const double* gradient = table.gradient.data() + 3 * q * table.nodes;
    const Matrix3 j = jacobian(gradient, nodes, dimension);
    const double det = positiveDeterminant(j);
    const Matrix3 inv = inverse(j, det);
    double* bq = b.data() + q * hooke.size * columns;
    for (int i = 0; i < table.nodes; ++i)
      strainColumns(bq, columns, i, mapped(inv, {gradient[3 * i], gradient[3 * i + 1], gradient[3 * i + 2]}), dimension);
    for (int m = 0; m < bubbles; ++m) {
      // ∇(1 − ξ_m²) with the Jacobian of the centre, scaled by j0/j: its mean vanishes, so constant stress does no work on it.
      Point reference{};
      reference[static_cast<std::size_t>(m)] = -2 * table.point[static_cast<std::size_t>(3 * q + m)] * centreDet / det;
      strainColumns(bq, columns, table.nodes + m, mapped(centre, reference), dimension);
    }
    const double factor = table.weight[static_cast<std::size_t>(q)] * det;
    double* dbq = db.data() + q * hooke.size * columns;
    for (int r = 0; r < hooke.size; ++r)
      for (int s = 0; s < hooke.size; ++s) {
        const double d = factor * hooke.matrix[static_cast<std::size_t>(r * hooke.size + s)];
        if (d != 0)
          for (int c = 0; c < columns; ++c) dbq[r * columns + c] += d * bq[s * columns + c];
      }
  }
  // Row-major B is column-major Bᵀ: K = Bᵀ (D B) over all points in one product.
  std::vector<double> k(static_cast<std::size_t>(columns * columns));
  PetscBLASInt n = columns, depth = rows;
  const PetscScalar one = 1, zero = 0;
  BLASgemm_("N", "T", &n, &n, &depth, &one, b.data(), &n, db.data(), &n, &zero, k.data(), &n);
  return bubbles ? condensed(k, columns, bubbles * dimension) : k;
}

std::vector<double> mass(const ShapeTable& table, const std::vector<Point>& nodes, double density, MassKind kind) {
  const auto n = static_cast<std::size_t>(table.nodes);
  std::vector<double> m(n * n, 0.0);
  for (int q = 0; q < table.points(); ++q) {
    const Matrix3 j = jacobian(table.gradient.data() + 3 * q * table.nodes, nodes, table.dimension);
    const double factor = density * table.weight[static_cast<std::size_t>(q)] * positiveDeterminant(j);
    const double* value = table.value.data() + static_cast<std::size_t>(q) * n;
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) m[a * n + b] += factor * value[a] * value[b];
  }
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

std::vector<double> centrifugal(const ShapeTable& table, const std::vector<Point>& nodes, double density, double speed,
                                const Point& axis, const Point& origin) {
  const auto n = static_cast<std::size_t>(table.nodes);
  std::vector<double> load(3 * n, 0.0);
  for (int q = 0; q < table.points(); ++q) {
    const Matrix3 j = jacobian(table.gradient.data() + 3 * q * table.nodes, nodes, table.dimension);
    const double factor = density * speed * speed * table.weight[static_cast<std::size_t>(q)] * positiveDeterminant(j);
    const double* value = table.value.data() + static_cast<std::size_t>(q) * n;
    Point r{-origin[0], -origin[1], -origin[2]};
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t d = 0; d < 3; ++d) r[d] += value[a] * nodes[a][d];
    const double along = r[0] * axis[0] + r[1] * axis[1] + r[2] * axis[2];
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t d = 0; d < 3; ++d) load[3 * a + d] += factor * value[a] * (r[d] - along * axis[d]);
  }
  return load;
}

std::vector<double> faceNormals(const ShapeTable& table, const std::vector<Point>& nodes, int sign) {
  const auto n = static_cast<std::size_t>(table.nodes);
  std::vector<double> load(3 * n, 0.0);
  for (int q = 0; q < table.points(); ++q) {
    const Point normal = faceNormal(table.gradient.data() + 3 * q * table.nodes, nodes, table.dimension);
    const double factor = sign * table.weight[static_cast<std::size_t>(q)];
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t d = 0; d < 3; ++d) load[3 * a + d] += factor * table.value[static_cast<std::size_t>(q) * n + a] * normal[d];
  }
  return load;
}

std::vector<double> faceMass(const ShapeTable& table, const std::vector<Point>& nodes) {
  const auto n = static_cast<std::size_t>(table.nodes);
  std::vector<double> m(n * n, 0.0);
  for (int q = 0; q < table.points(); ++q) {
    const double factor = table.weight[static_cast<std::size_t>(q)] *
                          norm(faceNormal(table.gradient.data() + 3 * q * table.nodes, nodes, table.dimension));
    const double* value = table.value.data() + static_cast<std::size_t>(q) * n;
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) m[a * n + b] += factor * value[a] * value[b];
  }
  return m;
}

std::vector<Point> nodeNormals(const ShapeTable& table, const std::vector<Point>& nodes, int sign) {
  std::vector<Point> normals;
  for (int i = 0; i < table.nodes; ++i) {
    Point normal = faceNormal(table.nodeGradient.data() + 3 * i * table.nodes, nodes, table.dimension);
    const double length = sign * norm(normal);
    for (auto& component : normal) component /= length;
    normals.push_back(normal);
  }
  return normals;
}

}  // namespace squeal::elasticity
