// SPDX-License-Identifier: BSD-2-Clause
#include "model/contact/contact.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/petsc/arrays.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/mesh/mesh.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::contact {

using interfaces::assembled;
using interfaces::nodalMatrix;
using mesh::plus;
using mesh::scaled;

namespace {

/// Returns the product of a matrix of the gap basis, or of its transpose by MatMultTranspose, with
/// values, [contact node].
std::vector<double> applied(const Contact& contact, PetscErrorCode (*multiply)(Mat, Vec, Vec),
                            Mat matrix, const std::vector<double>& values) {
  const auto& mesh = *contact.mesh;
  const auto gapAt = [&](const ContactNode& node) { return mesh.dimension * (node.node + 1) - 1; };
  const OwnedVec given = elasticity::nodalVector(mesh), result = elasticity::nodalVector(mesh);
  {
    const WriteArray entries(given);
    for (std::size_t i = 0; i < values.size(); ++i)
      entries[gapAt(contact.interfaces.nodes[i])] = values[i];
  }
  check(multiply(matrix, given, result));
  const ReadArray entries(result);
  std::vector<double> found;
  for (const auto& node : contact.interfaces.nodes) found.push_back(entries[gapAt(node)]);
  return found;
}

}  // namespace

Transformation Contact::transformation(const ActiveSet& set) const {
  return transformationOf(*mesh, interfaces, kinematics, set);
}

PetscInt Contact::gapRow(const ContactNode& node) const { return contact::gapRow(*mesh, node); }

std::vector<Slip> Contact::slip(double speed, Vec displacement) const {
  std::vector<Slip> result;
  OwnedVec carried;
  std::optional<ReadArray> values;
  if (sliding.convected && displacement) {
    carried = elasticity::nodalVector(*mesh);
    check(MatMult(sliding.convected, displacement, carried));
    values.emplace(carried);
  }
  for (const auto& node : interfaces.nodes) {
    if (node.role != Role::sliding) {
      result.push_back({{}, 0, 0, 0, {}});
      continue;
    }
    Point w = scaled(node.slip, speed * node.slipSpeed);
    if (values) {
      Point change{};
      for (int d = 0; d < mesh->dimension; ++d)
        change[d] = -speed * (*values)[mesh->dimension * node.node + d];
      w = plus(w, mesh::tangential(change, node.normal));
    }
    Slip state;
    state.speed = mesh::length(w);
    if (state.speed <= 1e-9 * speed * node.slipSpeed)
      state.speed = 0;  // the direction would be round-off
    if (state.speed > 0) state.direction = scaled(w, 1 / state.speed);
    state.law = law.value(state.speed);
    state.slope = law.slope(state.speed);
    state.coefficient = interfaces.options[node.interface].friction;
    result.push_back(state);
  }
  return result;
}

std::vector<double> Contact::nodalForce(const std::vector<double>& normalForce) const {
  return interfaces.gapBasis
             ? applied(*this, MatMultTranspose, interfaces.gapBasis.inverse, normalForce)
             : normalForce;
}

std::vector<double> Contact::nodalForce(std::vector<double> normalForce, const Mask& closed) const {
  for (std::size_t i = 0; i < normalForce.size(); ++i)
    if (!closed[i]) normalForce[i] = 0;
  return nodalForce(normalForce);
}

std::vector<double> Contact::gapCoefficients(const std::vector<double>& nodal) const {
  return interfaces.gapBasis ? applied(*this, MatMult, interfaces.gapBasis.inverse, nodal) : nodal;
}

std::vector<double> Contact::gapForce(const std::vector<double>& nodal) const {
  return interfaces.gapBasis ? applied(*this, MatMultTranspose, interfaces.gapBasis.matrix, nodal)
                             : nodal;
}

std::vector<double> Contact::nodalGap(const std::vector<double>& gap) const {
  return interfaces.gapBasis ? applied(*this, MatMult, interfaces.gapBasis.matrix, gap) : gap;
}

OwnedVec Contact::movedFromLayers(Vec forces) const {
  OwnedVec moved;
  check(VecDuplicate(forces, moved.out()));
  check(VecCopy(forces, moved));
  {
    const WriteArray values(moved);
    const PetscInt dimension = mesh->dimension;
    for (const auto& node : interfaces.nodes)
      for (PetscInt d = 0; d < dimension && node.hasLayer(); ++d)
        values[dimension * node.surfaceNode + d] +=
            std::exchange(values[dimension * node.node + d], 0.0);
  }
  return moved;
}

std::vector<int> Contact::frictionExponents() const {
  return interfaces::frictionExponents(interfaces.options);
}

bool Contact::hasSticking() const {
  return std::any_of(interfaces.options.begin(), interfaces.options.end(),
                     [](const auto& one) { return one.role == Role::sticking; });
}

bool Contact::hasFriction(double swept) const {
  return std::any_of(interfaces.options.begin(), interfaces.options.end(),
                     [&](const auto& one) { return one.friction.at(swept) > 0; });
}

OwnedMat Contact::slipRows(const Transformation& transformation, const std::vector<Slip>& slip,
                           const Mask& slides, int exponent) const {
  std::vector<double> friction;
  for (const auto& state : slip) friction.push_back(state.coefficient.part(exponent) * state.law);
  return slipRows(transformation, slip, slides, friction);
}

OwnedMat Contact::slipRowsAt(const Transformation& transformation, const std::vector<Slip>& slip,
                             const Mask& slides, double swept) const {
  std::vector<double> friction;
  for (const auto& state : slip) friction.push_back(state.friction(swept));
  return slipRows(transformation, slip, slides, friction);
}

OwnedMat Contact::slipOfJumpsAt(const std::vector<Slip>& slip, const Mask& slides,
                                double swept) const {
  std::vector<double> friction;
  for (const auto& state : slip) friction.push_back(state.friction(swept));
  return slipOfJumps(slip, slides, friction);
}

/// Returns the matrix that maps the jumps [u] to E⁻¹ a τ·[u] for factors a, [contact node].
OwnedMat Contact::slipOfJumps(const std::vector<Slip>& slip, const Mask& slides,
                              const std::vector<double>& factors) const {
  OwnedMat directions = nodalMatrix(*mesh, 1);
  for (std::size_t i = 0; i < interfaces.nodes.size(); ++i) {
    if (!slides[i] && !interfaces.gapBasis) continue;
    for (int d = 0; d < mesh->dimension; ++d)
      check(MatSetValue(directions, gapRow(interfaces.nodes[i]),
                        mesh->dimension * interfaces.nodes[i].globalNode + d,
                        factors[i] * slip[i].direction[d], INSERT_VALUES));
  }
  assembled(directions);
  if (!interfaces.gapBasis) return directions;
  OwnedMat combined;
  check(MatMatMult(interfaces.gapBasis.inverse, directions, MAT_INITIAL_MATRIX, PETSC_DEFAULT,
                   combined.out()));
  const OwnedVec isSliding = elasticity::nodalVector(*mesh);
  for (std::size_t i = 0; i < interfaces.nodes.size(); ++i)
    check(VecSetValue(isSliding, gapRow(interfaces.nodes[i]), slides[i], INSERT_VALUES));
  check(VecAssemblyBegin(isSliding));
  check(VecAssemblyEnd(isSliding));
  check(MatDiagonalScale(combined, isSliding, nullptr));
  return combined;
}

OwnedMat Contact::slipRows(const Transformation& transformation, const std::vector<Slip>& slip,
                           const Mask& slides, const std::vector<double>& factors) const {
  OwnedMat rows, result;
  check(MatMatMult(slipOfJumps(slip, slides, factors), sliding.jump, MAT_INITIAL_MATRIX,
                   PETSC_DEFAULT, rows.out()));
  check(MatMatMult(rows, transformation.trial, MAT_INITIAL_MATRIX, PETSC_DEFAULT, result.out()));
  return result;
}

}  // namespace squeal::contact
