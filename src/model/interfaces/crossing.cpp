// SPDX-License-Identifier: BSD-2-Clause
#include "model/interfaces/crossing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/petsc/check.hpp"
#include "base/session/stages.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/elasticity/face.hpp"
#include "model/element/shape.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::interfaces {
namespace {

/// Flat facets of a round body leave a smaller fraction of |V·n|.
constexpr double facets = 0.2;
/// A smaller component along the normal counts as an inaccuracy of the mesh.
constexpr double negligible = 0.01;

/// Integrals over the faces around each node, [local node].
struct NodalIntegrals {
  std::vector<double> flux,  ///< ∫ V·n dA
      magnitude,             ///< ∫ |V·n| dA
      speed,                 ///< ∫ |V| dA
      body;                  ///< index of the body that moves plus 1; 0 on a rigid obstacle
};

/// Collective. Returns the integrals over the faces in contact of one interface.
NodalIntegrals integrals(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                         const elasticity::Bodies& bodies, const Interfaces& all, int interface) {
  const std::vector<double> zeros(mesh.localNodes(), 0.0);
  NodalIntegrals around{zeros, zeros, zeros, zeros};
  for (const auto& node : all.nodes)
    if (node.interface == interface) around.body[node.surfaceNode] = node.discBody + 1;
  exchange.largest(around.body);
  const std::string& surface = all.slaves[interface].surface;
  for (const auto& block : mesh.faces) {
    const auto& table = element::shapeTable(block.type);
    for (std::size_t e = 0; e < block.surface.size(); ++e) {
      if (mesh.surfaces[block.surface[e]] != surface) continue;
      const auto nodes = block.nodesOf(e);
      const auto touches = [&](PetscInt node) { return all.interfaceOf[node] == interface; };
      if (!std::all_of(nodes.begin(), nodes.end(), touches)) continue;
      std::vector<Point> points;
      double body = 0;
      for (PetscInt node : nodes) {
        points.push_back(mesh.coordinates[node]);
        body = std::max(body, around.body[node]);
      }
      const auto normals = elasticity::nodeNormals(table, points, block.sign[e]);
      const auto weights = elasticity::areaWeights(table, points);
      const double share =
          std::accumulate(weights.begin(), weights.end(), 0.0) / double(points.size());
      double flux = 0, magnitude = 0, speed = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Point v = body > 0 ? bodies.motions[std::lround(body) - 1].velocity(points[i])
                                 : all.obstacles[interface].velocity;
        const double across = mesh::dot(v, normals[i]);
        flux += share * across;
        magnitude += share * std::abs(across);
        speed += share * mesh::length(v);
      }
      for (PetscInt node : nodes) {
        around.flux[node] += flux;
        around.magnitude[node] += magnitude;
        around.speed[node] += speed;
      }
    }
  }
  for (auto* values : {&around.flux, &around.magnitude, &around.speed}) exchange.sum(*values);
  return around;
}

/// A surface that moves through itself.
struct Crossing {
  double mean = 0;   ///< mean |V·n| over mean |V|
  Point where{};     ///< place of the largest flux, m
  double there = 0;  ///< V·n over |V| around that place
  int body = -1;     ///< the body that moves there; -1 on a rigid obstacle
};

/// Collective. Returns the crossing of one interface, with zero as mean if there is none.
Crossing crossingOf(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                    const NodalIntegrals& around) {
  std::array<double, 3> sums{};
  double worst = 0;
  PetscInt node = -1;
  for (PetscInt i = 0; i < mesh.ownedNodes; ++i) {
    if (exchange.primary(i) != mesh.globalNode[i]) continue;
    const double flux = std::abs(around.flux[i]);
    sums[0] += flux, sums[1] += around.magnitude[i], sums[2] += around.speed[i];
    if (flux > worst) worst = flux, node = i;
  }
  mpi::reduce<double>(mesh.comm, sums, MPI_SUM);
  if (!(sums[0] > facets * sums[1] && sums[0] > negligible * sums[2])) return {};
  const int rank = mpi::maxLocated(mesh.comm, worst).rank;
  Crossing crossing;
  if (mpi::rank(mesh.comm) == rank)
    crossing = {sums[0] / sums[2], mesh.coordinates[node], worst / around.speed[node],
                int(std::lround(around.body[node])) - 1};
  mpi::broadcast(mesh.comm, crossing, rank);
  return crossing;
}

/// Returns a ratio as a percentage of two digits, or 100.
std::string percent(double ratio) {
  return formatted(ratio > 0.0995 ? "%.0f" : "%.2g", 100 * ratio);
}

std::string describe(const Crossing& crossing, const std::string& who, const std::string& label) {
  return label + ": " + who +
         formatted(
             " moves through its own contact surface: the component of its velocity along "
             "the normal is %s %% of its magnitude on average, %s %% at ",
             percent(crossing.mean).c_str(), percent(crossing.there).c_str()) +
         text(crossing.where);
}

}  // namespace

void checkCrossing(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                   const elasticity::Bodies& bodies, const Interfaces& all) {
  for (int i = 0; i < std::ssize(all.options); ++i) {
    const auto& options = all.options[i];
    if (options.role != Role::sliding) continue;
    const Crossing crossing = crossingOf(mesh, exchange, integrals(mesh, exchange, bodies, all, i));
    if (crossing.mean == 0) continue;
    if (crossing.body < 0) {
      printWarning(mesh.comm,
                   "warning: " + describe(crossing, "the rigid obstacle", options.label()) +
                       "; check " + obstacleVelocityName(options.surfaces.name));
      continue;
    }
    const std::string &name = mesh.bodies[crossing.body], option = "-motion_" + name;
    const std::string what = describe(crossing, "body '" + name + "'", options.label());
    if (bodies.settings.convective)
      throw Error("option -motion_convective: " + what +
                  "; use -motion_convective off (approximation A)");
    printWarning(mesh.comm,
                 "warning: " + what + "; check " +
                     (bodies.motions[crossing.body].speed != 0 ? option + "_origin and _axis"
                                                               : option + "_velocity"));
  }
}

}  // namespace squeal::interfaces
