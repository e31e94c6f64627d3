// SPDX-License-Identifier: BSD-2-Clause
#include "run/audit/masses.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/system/mpi.hpp"
#include "model/elasticity/assembly.hpp"
#include "model/elasticity/jacobian.hpp"

namespace squeal::audit {
namespace {

using elasticity::ShapeTable;

/// Collective. Calls visit(material group, x, volume) for each point of the quadrature rules of
/// this rank.
template <class Visit>
void forEachPoint(const mesh::Mesh& mesh, const Visit& visit) {
  elasticity::forEachCell(mesh, [&](const mesh::CellBlock& block, std::size_t e,
                                    const ShapeTable& table, const std::vector<Point>& nodes) {
    for (int q = 0; q < table.points(); ++q) {
      const double det = mesh::determinant(elasticity::jacobian(
          table.gradient.data() + 3 * q * table.nodes, nodes, table.dimension));
      Point x{};
      for (int a = 0; a < table.nodes; ++a)
        x = mesh::plus(x, nodes[a], table.value[q * table.nodes + a]);
      visit(block.material[e], x, table.weight[q] * det);
    }
  });
}

/// Collective. Fills the bounding boxes and the numbers of cells.
void measure(const mesh::Mesh& mesh, std::vector<BodyMass>& bodies) {
  std::vector<double> low(3 * bodies.size(), INFINITY), high(3 * bodies.size(), -INFINITY);
  std::vector<PetscInt> cells(bodies.size(), 0);
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      const std::size_t b = block.body[e];
      ++cells[b];
      for (const PetscInt node : block.nodesOf(e))
        for (std::size_t d = 0; d < 3; ++d) {
          low[3 * b + d] = std::min(low[3 * b + d], mesh.coordinates[node][d]);
          high[3 * b + d] = std::max(high[3 * b + d], mesh.coordinates[node][d]);
        }
    }
  mpi::reduce<double>(mesh.comm, low, MPI_MIN);
  mpi::reduce<double>(mesh.comm, high, MPI_MAX);
  mpi::reduce<PetscInt>(mesh.comm, cells, MPI_SUM);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    bodies[b].cells = cells[b];
    for (std::size_t d = 0; d < 3; ++d)
      bodies[b].low[d] = low[3 * b + d], bodies[b].high[d] = high[3 * b + d];
  }
}

/// Returns tr(S) 1 − S.
Matrix3 inertiaOf(const Matrix3& second) {
  Matrix3 inertia;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      inertia[i][j] = (i == j ? second[0][0] + second[1][1] + second[2][2] : 0) - second[i][j];
  return inertia;
}

void addOuter(Matrix3& sum, const Point& r, double factor) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) sum[i][j] += factor * r[i] * r[j];
}

/// The factor of a material group on volumes, and a scale of the body: ρ = weight · scale. A body
/// with one density has the weight 1, so that its centre is that of its volume.
struct Weights {
  std::vector<double> weight;  // [material group]
  std::vector<double> scale;   // [body], kg/m³
};

Weights weightsOf(const Subject& model) {
  const auto& groups = model.mesh.materialGroups;
  Weights weights{{}, std::vector<double>(model.mesh.bodies.size(), 0.0)};
  for (std::size_t m = 0; m < groups.size(); ++m) {
    const double density = model.bodies.materials[m].density;
    double& scale = weights.scale[groups[m].body];
    if (scale == 0) scale = density;
    weights.weight.push_back(density / scale);
  }
  return weights;
}

}  // namespace

std::vector<BodyMass> bodyMasses(const Subject& model) {
  const auto& mesh = model.mesh;
  std::vector<BodyMass> bodies;
  for (const auto& name : mesh.bodies) bodies.push_back({.body = name});
  measure(mesh, bodies);
  const std::size_t count = bodies.size();
  const Weights weights = weightsOf(model);
  std::vector<double> sums(5 * count, 0.0);  // [body] volume, and with weights volume and ∫ x
  forEachPoint(mesh, [&](int group, const Point& x, double volume) {
    double* sum = &sums[5 * mesh.materialGroups[group].body];
    const double weighted = volume * weights.weight[group];
    sum[0] += volume, sum[1] += weighted;
    for (std::size_t d = 0; d < 3; ++d) sum[2 + d] += weighted * x[d];
  });
  mpi::reduce<double>(mesh.comm, sums, MPI_SUM);
  for (std::size_t b = 0; b < count; ++b) {
    const double* sum = &sums[5 * b];
    bodies[b].volume = sum[0];
    bodies[b].mass = weights.scale[b] * sum[1];
    for (std::size_t d = 0; d < 3; ++d) bodies[b].centre[d] = sum[2 + d] / sum[1];
  }
  // About the centre of the body: a second moment about a far origin would lose digits.
  std::vector<Matrix3> second(count, Matrix3{});
  forEachPoint(mesh, [&](int group, const Point& x, double volume) {
    const int body = mesh.materialGroups[group].body;
    addOuter(second[body], mesh::minus(x, bodies[body].centre),
             volume * model.bodies.materials[group].density);
  });
  mpi::reduce<double>(mesh.comm, {second.data()->data()->data(), 9 * count}, MPI_SUM);
  for (std::size_t b = 0; b < count; ++b) bodies[b].inertia = inertiaOf(second[b]);
  return bodies;
}

BodyMass totalOf(const std::vector<BodyMass>& bodies, const std::vector<int>& which) {
  BodyMass total{.body = "total", .low = bodies[which[0]].low, .high = bodies[which[0]].high};
  for (const int b : which) {
    const auto& body = bodies[b];
    total.cells += body.cells, total.volume += body.volume, total.mass += body.mass;
    total.centre = mesh::plus(total.centre, body.centre, body.mass);
    for (std::size_t d = 0; d < 3; ++d) {
      total.low[d] = std::min(total.low[d], body.low[d]);
      total.high[d] = std::max(total.high[d], body.high[d]);
    }
  }
  total.centre = mesh::scaled(total.centre, 1 / total.mass);
  // I = Σ I_b + m_b (|d|² 1 − d dᵀ),   d = x_b − x
  Matrix3 second{};
  for (const int b : which)
    addOuter(second, mesh::minus(bodies[b].centre, total.centre), bodies[b].mass);
  total.inertia = inertiaOf(second);
  for (const int b : which)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) total.inertia[i][j] += bodies[b].inertia[i][j];
  return total;
}

BodyMass totalOf(const std::vector<BodyMass>& bodies) {
  std::vector<int> all(bodies.size());
  std::iota(all.begin(), all.end(), 0);
  return totalOf(bodies, all);
}

}  // namespace squeal::audit
