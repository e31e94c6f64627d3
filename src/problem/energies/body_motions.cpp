// SPDX-License-Identifier: BSD-2-Clause
#include "problem/energies/body_motions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "algebra/linalg/symmetric.hpp"
#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"

namespace squeal::energies {
namespace {

constexpr double surelyRigid = 0.9, clear = 0.6;  // shares of the kinetic energy

/// Returns the motions along x, y, z and about them at a point, [motion].
std::array<Point, 6> rigidMotions(const Point& fromCentre) {
  std::array<Point, 6> motions{};
  for (int d = 0; d < 3; ++d) {
    motions[d] = mesh::axis(d);
    motions[3 + d] = mesh::cross(mesh::axis(d), fromCentre);
  }
  return motions;
}

/// Collective. Returns the centre of mass of a body.
Point centreOf(const mesh::Mesh& mesh, const LumpedBody& body) {
  std::array<double, 4> sums{};
  for (std::size_t k = 0; k < body.nodes.size(); ++k) {
    const Point& x = mesh.coordinates[body.nodes[k]];
    for (std::size_t d = 0; d < 3; ++d) sums[d] += body.mass[k] * x[d];
    sums[3] += body.mass[k];
  }
  mpi::sumAlike(mesh.comm, sums);
  return {sums[0] / sums[3], sums[1] / sums[3], sums[2] / sums[3]};
}

/// Collective. Returns Σ m r rᵀ about the centre.
linalg::DenseMatrix spread(const mesh::Mesh& mesh, const LumpedBody& body, const Point& centre) {
  linalg::DenseMatrix sums(3, 3);
  for (std::size_t k = 0; k < body.nodes.size(); ++k) {
    const Point x = mesh::minus(mesh.coordinates[body.nodes[k]], centre);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) sums(i, j) += body.mass[k] * x[i] * x[j];
  }
  mpi::sumAlike(mesh.comm, {sums.data(), 9});
  return sums;
}

/// Collective. Returns the principal axes.
Principal principalOf(const mesh::Mesh& mesh, const LumpedBody& body, const Point& centre) {
  linalg::DenseMatrix vectors = spread(mesh, body, centre);
  const auto values = linalg::symmetricEigen(vectors);
  Principal found{};
  for (std::size_t k = 0; k < 3; ++k) {
    found.values[k] = values[2 - k];
    found.axes[k] = {vectors(0, 2 - k), vectors(1, 2 - k), vectors(2, 2 - k)};
  }
  return found;
}

/// Collective. Returns the axis of a body of revolution; none of another body.
std::optional<Axis> axisOf(const mesh::Mesh& mesh, const LumpedBody& body, const Point& centre,
                           const elasticity::Motion& motion) {
  std::vector<Axis> candidates;
  if (motion.speed != 0) {
    candidates.push_back({motion.origin, motion.axis});
  } else {
    const auto [values, axes] = principalOf(mesh, body, centre);
    // The two axes across are equal, so the axis is the first or the last.
    const bool longest = values[1] - values[2] < values[0] - values[1];
    for (const std::size_t k : {longest ? 0ul : 2ul, longest ? 2ul : 0ul})
      candidates.push_back({centre, axes[k]});
  }
  for (const auto& axis : candidates)
    if (isRevolved(mesh, body, axis)) return axis;
  return {};
}

}  // namespace

BodyMotions::BodyMotions(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                         const std::vector<std::vector<PetscInt>>& nodes, std::vector<OwnModes> own)
    : mesh_(mesh), named_(mesh.bodies.size()) {
  for (std::size_t body = 0; body < own.size(); ++body)
    for (const double frequency : own[body].angularFrequency)
      named_[body].push_back({frequency, {}});
  if (mesh.dimension != 3) return;
  OwnedVec diagonal;
  check(MatCreateVecs(bodies.mass, diagonal.out(), nullptr));
  check(MatGetDiagonal(bodies.mass, diagonal));
  const ReadArray values(diagonal);
  for (std::size_t body = 0; body < nodes.size(); ++body) {
    LumpedBody lumped{nodes[body], {}};
    for (const PetscInt node : nodes[body])
      lumped.mass.push_back((values[3 * node] + values[3 * node + 1] + values[3 * node + 2]) / 3);
    list_.push_back(bodyOf(lumped, bodies.motions[body]));
  }
  takeOwnModes(std::move(own));
}

/// Collective. Names the elastic modes of the bodies and keeps them with a unit lumped mass.
void BodyMotions::takeOwnModes(std::vector<OwnModes> own) {
  for (std::size_t b = 0; b < own.size(); ++b) {
    Body& body = list_[b];
    const std::size_t count = own[b].angularFrequency.size();
    if (count == 0) continue;
    std::optional<Sections> sections;
    if (!body.revolution)
      sections.emplace(mesh_, body.lumped, body.centre,
                       principalOf(mesh_, body.lumped, body.centre));
    body.own = std::move(own[b].vectors);
    std::vector<double> squares(count, 0.0), nodal(3 * mesh_.ownedNodes, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
      const auto x = body.own.column(i);
      for (std::size_t k = 0; k < body.lumped.nodes.size(); ++k)
        for (std::size_t d = 0; d < 3; ++d) {
          nodal[3 * body.lumped.nodes[k] + d] = x[3 * k + d];
          squares[i] += body.lumped.mass[k] * x[3 * k + d] * x[3 * k + d];
        }
      named_[b][i].motion =
          sections ? sections->name(nodal.data()) : body.revolution->name({nodal.data()});
    }
    mpi::sumAlike(mesh_.comm, squares);
    for (std::size_t i = 0; i < count; ++i)
      for (double& value : body.own.column(i)) value /= std::sqrt(squares[i]);
  }
}

BodyMotions::Body BodyMotions::bodyOf(const LumpedBody& lumped,
                                      const elasticity::Motion& motion) const {
  Body body{.lumped = lumped};
  body.centre = centreOf(mesh_, lumped);
  linalg::DenseMatrix gram(6, 6);
  for (std::size_t k = 0; k < lumped.nodes.size(); ++k) {
    const auto motions = rigidMotions(mesh::minus(mesh_.coordinates[lumped.nodes[k]], body.centre));
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j)
        gram(i, j) += lumped.mass[k] * mesh::dot(motions[i], motions[j]);
  }
  mpi::sumAlike(mesh_.comm, {gram.data(), 36});
  // Lengths of rotations are made those of displacements, so that small bodies keep them.
  const double arm = std::sqrt((gram(3, 3) + gram(4, 4) + gram(5, 5)) / (3 * gram(0, 0)));
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) gram(i, j) /= (i < 3 ? 1 : arm) * (j < 3 ? 1 : arm);
  body.arm = arm;
  body.rigid = WeightedFit(std::move(gram));
  if (const auto axis = axisOf(mesh_, lumped, body.centre, motion)) {
    body.axis = axis->direction;
    if (!isBar(mesh_, lumped, *axis))
      body.revolution = std::make_unique<Revolution>(mesh_, lumped, *axis);
  }
  return body;
}

/// Returns the rigid motion of a body of revolution: along or about its axis, or across. The energy
/// of the motions across is the rest, since those of the axis are orthogonal to them.
NamedMotion BodyMotions::revolvedName(const Body& body, const std::array<double, 6>& shares,
                                      const std::array<double, 2>& axial, double total) const {
  constexpr double aligned = 1 - 1e-6;
  std::string axis = "its axis";
  for (int i = 0; i < 3; ++i)
    if (std::abs((*body.axis)[i]) > aligned) axis = "xyz"[i];
  const double along = shares[0] + shares[1] + shares[2], about = shares[3] + shares[4] + shares[5];
  const std::array<std::pair<double, std::string>, 4> all{{{axial[0], "along " + axis},
                                                           {along - axial[0], "along a diameter"},
                                                           {axial[1], "about " + axis},
                                                           {about - axial[1], "about a diameter"}}};
  const auto& largest = *std::ranges::max_element(all, {}, &std::pair<double, std::string>::first);
  if (largest.first < 0.5 * (along + about)) return {"rigid", (along + about) / total};
  return {"rigid " + largest.second, (along + about) / total};
}

/// Collective. Returns the rigid motion in a motion, with its share.
NamedMotion BodyMotions::rigidName(const Body& body,
                                   const std::vector<const double*>& parts) const {
  std::array<double, 6> shares{};
  std::array<double, 2> axial{};  // of the motions along and about the axis of revolution
  double total = 0;
  for (const double* values : parts) {
    std::array<double, 7> sums{};
    for (std::size_t k = 0; k < body.lumped.nodes.size(); ++k) {
      const PetscInt node = body.lumped.nodes[k];
      const Point u{values[3 * node], values[3 * node + 1], values[3 * node + 2]};
      const auto motions = rigidMotions(mesh::minus(mesh_.coordinates[node], body.centre));
      for (std::size_t i = 0; i < 6; ++i)
        sums[i] += body.lumped.mass[k] * mesh::dot(u, motions[i]) / (i < 3 ? 1 : body.arm);
      sums[6] += body.lumped.mass[k] * mesh::dot(u, u);
    }
    mpi::sumAlike(mesh_.comm, sums);
    const std::span<const double> b(sums.data(), 6);
    const auto c = body.rigid.coefficients(b);
    for (std::size_t i = 0; i < 6; ++i) shares[i] += c[i] * b[i];
    for (std::size_t kind = 0; kind < 2; ++kind) {
      const Point x{c[3 * kind], c[3 * kind + 1], c[3 * kind + 2]},
          y{b[3 * kind], b[3 * kind + 1], b[3 * kind + 2]};
      if (body.axis) axial[kind] += mesh::dot(x, *body.axis) * mesh::dot(y, *body.axis);
    }
    total += sums[6];
  }
  if (!(total > 0)) return {};
  if (body.axis) return revolvedName(body, shares, axial, total);
  double sum = 0;
  std::size_t largest = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    sum += shares[i] / total;
    if (shares[i] > shares[largest]) largest = i;
  }
  if (shares[largest] / total < 0.5 * sum) return {"rigid", sum};
  return {std::string(largest < 3 ? "rigid along " : "rigid about ") + "xyz"[largest % 3], sum};
}

/// Collective. Returns the elastic modes of one name that have the largest share of a motion; a
/// mode without a name of its own is called by its number.
NamedMotion BodyMotions::elasticName(std::size_t b, const std::vector<const double*>& parts) const {
  const Body& body = list_[b];
  const std::size_t count = body.own.columns();
  if (count == 0) return {};
  std::vector<double> squares(count, 0.0);
  double total = 0;
  for (const double* values : parts) {
    std::vector<double> sums(count + 1, 0.0);
    for (std::size_t k = 0; k < body.lumped.nodes.size(); ++k)
      for (std::size_t d = 0; d < 3; ++d) {
        const double u = values[3 * body.lumped.nodes[k] + d], force = body.lumped.mass[k] * u;
        for (std::size_t i = 0; i < count; ++i) sums[i] += force * body.own(3 * k + d, i);
        sums[count] += force * u;
      }
    mpi::sumAlike(mesh_.comm, sums);
    for (std::size_t i = 0; i < count; ++i) squares[i] += sums[i] * sums[i];
    total += sums[count];
  }
  if (!(total > 0)) return {};
  std::map<std::string, double> shares;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string& name = named_[b][i].motion.name;
    shares[name.empty() ? formatted("elastic mode %zu", i + 1) : name] += squares[i] / total;
  }
  const auto& [name, share] =
      *std::ranges::max_element(shares, {}, [](const auto& one) { return one.second; });
  return {name, share};
}

std::vector<NamedMotion> BodyMotions::names(const std::vector<const double*>& parts) const {
  std::vector<NamedMotion> names(mesh_.bodies.size());
  for (std::size_t body = 0; body < list_.size(); ++body) {
    names[body] = rigidName(list_[body], parts);
    if (names[body].share >= surelyRigid) continue;
    NamedMotion shape;
    if (list_[body].revolution) shape = list_[body].revolution->name(parts);
    if (shape.name.empty()) shape = elasticName(body, parts);
    if (!shape.name.empty() && shape.share >= clear)
      names[body] = shape;
    else if (names[body].share < clear)
      names[body] = {};
  }
  return names;
}

}  // namespace squeal::energies
