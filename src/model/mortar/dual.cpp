// SPDX-License-Identifier: BSD-2-Clause
#include "model/mortar/dual.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/lu.hpp"
#include "model/element/shape.hpp"
#include "model/mesh/vector.hpp"
#include "model/mortar/surface.hpp"

namespace squeal::mortar {

using mesh::length;
using mesh::plus;

namespace {

using linalg::DenseMatrix;

/// Dual functions are at most about 7 in magnitude on a whole face, and about 60 on a quarter of a
/// quad8. Above this bound, which thin strips exceed if their far nodes are not dropped, they are
/// not used: rows of M would be large and cancel.
constexpr double largestDual = 100;

/// Returns the functions of all nodes, or the (bi)linear ones of the corners, in terms of φ̃.
///   χ_c = φ̃_c + Σ φ̃_e / 2 over the edges at the corner + φ̃_centre / 4
/// for any α, since φ_c + α Σ φ_e and (1 − 2α) φ_e / 2 add up to φ_c + Σ φ_e / 2.
DenseMatrix baseFunctions(const FaceType& type, Multiplier multiplier) {
  const PetscInt count = multiplier == Multiplier::nodes ? type.nodes : type.corners;
  DenseMatrix functions(count, type.nodes);
  for (PetscInt p = 0; p < count; ++p) functions(p, p) = 1;
  if (multiplier == Multiplier::nodes) return functions;
  for (const auto& [node, corners] : type.edges)
    for (const int c : corners) functions(c, node) = 0.5;
  for (PetscInt i = type.corners + std::ssize(type.edges); i < type.nodes; ++i)
    for (PetscInt p = 0; p < count; ++p) functions(p, i) = 1. / count;
  return functions;
}

/// Returns the matrix of φ̃ in terms of φ.
DenseMatrix basisInShapes(const FaceType& type, std::span<const double> alpha) {
  DenseMatrix matrix(type.nodes, type.nodes);
  for (PetscInt j = 0; j < type.nodes; ++j) {
    NodeValues shape{};
    shape[j] = 1;
    const NodeValues basis = slaveBasis(type, shape, alpha);
    std::copy_n(basis.begin(), type.nodes, matrix.column(j).begin());
  }
  return matrix;
}

DenseMatrix transposed(const DenseMatrix& a) {
  DenseMatrix result(a.columns(), a.rows());
  for (PetscInt j = 0; j < a.columns(); ++j)
    for (PetscInt i = 0; i < a.rows(); ++i) result(j, i) = a(i, j);
  return result;
}

std::vector<double> product(const DenseMatrix& a, std::span<const double> x) {
  std::vector<double> y(a.rows());
  for (PetscInt j = 0; j < a.columns(); ++j)
    for (PetscInt i = 0; i < a.rows(); ++i) y[i] += a(i, j) * x[j];
  return y;
}

/// Returns true if no function, [function][coefficient of φ], is too large anywhere.
bool areSmall(const DenseMatrix& functions, const FaceType& type,
              std::span<const Reference> points) {
  return std::ranges::all_of(points, [&](const Reference& at) {
    const NodeValues shape = faceShape(type, at).value;
    return std::ranges::all_of(product(functions, shape),
                               [](double value) { return std::abs(value) <= largestDual; });
  });
}

/// Returns the dual functions in terms of φ, [pivot][node],
///   ψ = diag(d) Me⁻¹ χ,   Me_ip = ∫ χ_i φ̃_p dA,   d_p = ∫ φ̃_p dA,
/// or an empty matrix if they would be too large. `chi` are the functions χ in terms of φ, and
/// `integrals` are ∫ χ_i φ̃_j dA of all nodes j.
DenseMatrix dualFunctions(const DenseMatrix& chi, const DenseMatrix& integrals,
                          const FaceMoments& moments, const Pivots& pivots,
                          std::span<const double> covered) {
  const PetscInt n = pivots.nodes.size();
  // Columns relative to d, since the pivots of a small function would look like zero:
  //   ψ = (Me diag(d)⁻¹)⁻¹ χ
  DenseMatrix me(n, n);
  for (PetscInt p = 0; p < n; ++p)
    for (PetscInt i = 0; i < n; ++i)
      me(i, p) = integrals(i, pivots.nodes[p]) / covered[pivots.nodes[p]];
  const linalg::Lu<double> lu(std::move(me));
  if (!(lu.pivotRatio() > 0)) return {};
  DenseMatrix dual = chi;
  lu.solve(dual);
  return areSmall(dual, faceType(moments.type), moments.points) ? dual : DenseMatrix();
}

}  // namespace

Pivots pivots(const FaceType& type, Multiplier multiplier, const std::vector<bool>& dropped) {
  const DenseMatrix base = baseFunctions(type, multiplier);
  Pivots result;
  for (int i = 0; i < type.nodes; ++i)
    (i < base.rows() && !dropped[i] ? result.nodes : result.others).push_back(i);
  const PetscInt kept = result.nodes.size();
  result.functions = DenseMatrix(kept, type.nodes);
  for (PetscInt i = 0; i < type.nodes; ++i) {
    // χ_p = χ⁰_p + Σ χ⁰_x / kept over the dropped x
    double shared = 0;
    for (PetscInt x = 0; x < base.rows(); ++x)
      if (dropped[x]) shared += base(x, i) / kept;
    for (PetscInt p = 0; p < kept; ++p) result.functions(p, i) = base(result.nodes[p], i) + shared;
  }
  return result;
}

FaceTerms integrate(const FaceMoments& moments, std::span<const double> alpha,
                    const Pivots& pivots) {
  const FaceType& type = faceType(moments.type);
  const std::size_t kept = pivots.nodes.size();
  FaceTerms terms;
  terms.slave.resize(kept), terms.weight.resize(kept), terms.gap.resize(kept);
  terms.others = DenseMatrix(kept, pivots.others.size());
  terms.covered = coveredIntegrals(moments, alpha);
  const DenseMatrix basis = basisInShapes(type, alpha), basisOf = transposed(basis);
  terms.normal.resize(type.nodes);
  for (PetscInt j = 0; j < type.nodes; ++j)
    for (PetscInt i = 0; i < type.nodes; ++i)
      terms.normal[i] = plus(terms.normal[i], moments.normal[j], basis(i, j));
  if (moments.masters.empty() || kept == 0) return terms;
  const DenseMatrix chi = linalg::product(pivots.functions, basis);
  const auto againstBasis = [&](const DenseMatrix& functions) {
    return linalg::product(linalg::product(functions, moments.products), basisOf);
  };
  DenseMatrix psi = dualFunctions(chi, againstBasis(chi), moments, pivots, terms.covered);
  terms.dual = !psi.empty();
  if (!terms.dual) psi = chi;
  terms.weight = product(psi, moments.value);
  terms.gap = product(psi, moments.gap);
  if (terms.dual) {
    const DenseMatrix all = againstBasis(psi);
    for (std::size_t p = 0; p < kept; ++p) {
      terms.slave[p] = terms.covered[pivots.nodes[p]];
      for (std::size_t o = 0; o < pivots.others.size(); ++o)
        terms.others(p, o) = all(p, pivots.others[o]);
    }
  } else {
    terms.slave = terms.weight;
  }
  for (const auto& [face, values, convected] : moments.masters)
    terms.masters.push_back({face, linalg::product(psi, values),
                             convected.empty() ? DenseMatrix() : linalg::product(psi, convected)});
  return terms;
}

std::vector<double> coveredIntegrals(const FaceMoments& moments, std::span<const double> alpha) {
  NodeValues sum{};
  std::ranges::copy(moments.value, sum.begin());
  const NodeValues basis =
      slaveBasis(faceType(moments.type), sum, alpha);  // slaveBasis() is linear
  return {basis.begin(), basis.begin() + moments.value.size()};
}

std::vector<double> wholeIntegrals(const Face& slave, std::span<const double> alpha) {
  const FaceType& type = faceType(slave.type);
  const auto& table = element::shapeTable(slave.type);
  std::vector<double> sum(slave.points.size());
  for (int q = 0; q < table.points(); ++q) {
    const FaceShape shape = faceShape(type, {table.point[3 * q], table.point[3 * q + 1]});
    const double area = table.weight[q] * length(facePoint(slave, shape).normal);
    const NodeValues basis = slaveBasis(type, shape.value, alpha);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += area * basis[i];
  }
  return sum;
}

}  // namespace squeal::mortar
