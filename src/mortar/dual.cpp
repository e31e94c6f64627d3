#include "mortar/dual.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "elasticity/shape.hpp"
#include "linalg/lu.hpp"
#include "mortar/surface.hpp"
#include "mortar/vector.hpp"

namespace squeal::mortar {
namespace {

using linalg::DenseMatrix;

/// Dual functions are at most about 7 in magnitude on a whole face, and about 60 on a quarter of a
/// quad8. Above this bound, which thin strips pass whose far nodes are not dropped, they are not
/// used: rows of M would be large and cancel.
constexpr double largestDual = 100;

/// Returns the functions of all nodes, or the (bi)linear ones of the corners, in terms of φ̃.
///   χ_c = φ̃_c + Σ φ̃_e / 2 over the edges at the corner + φ̃_centre / 4
/// holds for any α, since φ_c + α Σ φ_e and (1 − 2α) φ_e / 2 sum up to φ_c + Σ φ_e / 2.
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

/// The integration points with the functions of the slave side.
class Samples {
 public:
  Samples(const Face& slave, std::span<const double> alpha, const Pivots& pivots,
          std::span<const OverlapPoint> points)
      : points_(points), basis_(slave.points.size(), points.size()) {
    const FaceType& type = faceType(slave.type);
    for (std::size_t q = 0; q < points.size(); ++q) {
      const NodeValues value = slaveBasis(type, faceShape(type, points[q].slave).value, alpha);
      std::copy_n(value.begin(), slave.points.size(), basis_.column(q).begin());
    }
    functions_ = linalg::product(pivots.functions, basis_);
  }
  std::span<const OverlapPoint> points() const { return points_; }
  const DenseMatrix& basis() const { return basis_; }          ///< φ̃, [node][point]
  const DenseMatrix& functions() const { return functions_; }  ///< χ, [pivot][point]

 private:
  std::span<const OverlapPoint> points_;
  DenseMatrix basis_, functions_;
};

/// Returns ∫ a_i b_j dA of functions that are tabulated as [function][point].
DenseMatrix integrals(const DenseMatrix& a, const DenseMatrix& b,
                      std::span<const OverlapPoint> points) {
  DenseMatrix sum(a.rows(), b.rows());
  for (std::size_t q = 0; q < points.size(); ++q)
    for (PetscInt j = 0; j < b.rows(); ++j)
      for (PetscInt i = 0; i < a.rows(); ++i) sum(i, j) += points[q].weight * a(i, q) * b(j, q);
  return sum;
}

/// Returns the dual functions at the points, [pivot][point],
///   ψ = diag(d) Me⁻¹ χ,   Me_ip = ∫ χ_i φ̃_p dA,   d_p = ∫ φ̃_p dA,
/// or an empty matrix where they would be too large.
DenseMatrix dualFunctions(const Samples& samples, const Pivots& pivots,
                          std::span<const double> covered) {
  const DenseMatrix all = integrals(samples.functions(), samples.basis(), samples.points());
  const PetscInt n = pivots.nodes.size();
  DenseMatrix me(n, n);
  for (PetscInt p = 0; p < n; ++p)
    std::ranges::copy(all.column(pivots.nodes[p]), me.column(p).begin());
  // Columns relative to d, so that the pivots of a small function do not look like zero:
  //   ψ = (Me diag(d)⁻¹)⁻¹ χ
  for (PetscInt p = 0; p < n; ++p)
    for (double& entry : me.column(p)) entry /= covered[pivots.nodes[p]];
  const linalg::Lu<double> lu(std::move(me));
  if (!(lu.pivotRatio() > 0)) return {};
  DenseMatrix dual = samples.functions();
  lu.solve(dual);
  const auto small = [](double value) { return std::abs(value) <= largestDual; };
  return std::ranges::all_of(dual.entries(), small) ? dual : DenseMatrix();
}

/// Adds the integrals of the dual functions against the master faces.
void addMasters(FaceTerms& terms, const DenseMatrix& psi, std::span<const Face* const> masters,
                std::span<const OverlapPoint> points, const Velocity& velocity) {
  std::map<std::size_t, std::size_t> place;
  for (std::size_t q = 0; q < points.size(); ++q) {
    const std::size_t index = points[q].masterFace;
    const Face& master = *masters[index];
    const PetscInt n = master.points.size();
    const auto [found, isNew] = place.try_emplace(index, terms.masters.size());
    if (isNew)
      terms.masters.push_back(
          {index, DenseMatrix(psi.rows(), n), DenseMatrix(psi.rows(), velocity ? n : 0)});
    MasterTerms& to = terms.masters[found->second];
    const FaceShape shape = faceShape(faceType(master.type), points[q].master);
    NodeValues along{};
    if (velocity) {
      const SurfacePoint at = surfacePoint(master, shape);
      along = derivativeAlong(at, shape, velocity(index, at.position));
    }
    for (PetscInt p = 0; p < psi.rows(); ++p) {
      const double factor = points[q].weight * psi(p, q);
      for (PetscInt l = 0; l < n; ++l) to.values(p, l) += factor * shape.value[l];
      for (PetscInt l = 0; l < to.convected.columns(); ++l) to.convected(p, l) += factor * along[l];
    }
  }
}

/// Sets D, W, B and G.
void setSlave(FaceTerms& terms, const DenseMatrix& psi, const Samples& samples,
              const Pivots& pivots) {
  const auto points = samples.points();
  for (std::size_t q = 0; q < points.size(); ++q)
    for (PetscInt p = 0; p < psi.rows(); ++p) {
      terms.weight[p] += points[q].weight * psi(p, q);
      terms.gap[p] += points[q].weight * psi(p, q) * points[q].gap;
    }
  if (!terms.dual) {
    terms.slave = terms.weight;
    return;
  }
  const DenseMatrix all = integrals(psi, samples.basis(), points);
  for (PetscInt p = 0; p < psi.rows(); ++p) {
    terms.slave[p] = terms.covered[pivots.nodes[p]];
    for (PetscInt o = 0; o < terms.others.columns(); ++o)
      terms.others(p, o) = all(p, pivots.others[o]);
  }
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

FaceTerms integrate(const Face& slave, std::span<const double> alpha, const Pivots& pivots,
                    std::span<const Face* const> masters, std::span<const OverlapPoint> points,
                    const Velocity& velocity) {
  const std::size_t n = slave.points.size(), kept = pivots.nodes.size();
  FaceTerms terms;
  terms.slave.resize(kept), terms.weight.resize(kept), terms.gap.resize(kept);
  terms.others = DenseMatrix(kept, pivots.others.size());
  terms.covered.resize(n), terms.normal.resize(n);
  const Samples samples(slave, alpha, pivots, points);
  for (std::size_t q = 0; q < points.size(); ++q)
    for (std::size_t i = 0; i < n; ++i) {
      const double part = points[q].weight * samples.basis()(i, q);
      terms.covered[i] += part;
      terms.normal[i] = plus(terms.normal[i], points[q].normal, part);
    }
  if (points.empty() || kept == 0) return terms;
  DenseMatrix psi = dualFunctions(samples, pivots, terms.covered);
  terms.dual = !psi.empty();
  if (!terms.dual) psi = samples.functions();
  setSlave(terms, psi, samples, pivots);
  addMasters(terms, psi, masters, points, velocity);
  return terms;
}

std::vector<double> coveredIntegrals(const Face& slave, std::span<const double> alpha,
                                     std::span<const OverlapPoint> points) {
  const FaceType& type = faceType(slave.type);
  NodeValues sum{};
  for (const auto& point : points) {
    const NodeValues value = faceShape(type, point.slave).value;
    for (std::size_t i = 0; i < slave.points.size(); ++i) sum[i] += point.weight * value[i];
  }
  const NodeValues basis = slaveBasis(type, sum, alpha);  // which is linear
  return {basis.begin(), basis.begin() + slave.points.size()};
}

std::vector<double> wholeIntegrals(const Face& slave, std::span<const double> alpha) {
  const FaceType& type = faceType(slave.type);
  const auto& table = elasticity::shapeTable(slave.type);
  std::vector<double> sum(slave.points.size());
  for (int q = 0; q < table.points(); ++q) {
    const FaceShape shape = faceShape(type, {table.point[3 * q], table.point[3 * q + 1]});
    const double area = table.weight[q] * length(surfacePoint(slave, shape).normal);
    const NodeValues basis = slaveBasis(type, shape.value, alpha);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += area * basis[i];
  }
  return sum;
}

}  // namespace squeal::mortar
