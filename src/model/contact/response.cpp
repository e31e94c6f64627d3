// SPDX-License-Identifier: BSD-2-Clause
#include "model/contact/response.hpp"

#include <algorithm>

#include "base/petsc/arrays.hpp"
#include "model/elasticity/assembly.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/elasticity/face.hpp"
#include "model/element/shape.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::contact {

using interfaces::assembled;
using interfaces::identity;
using interfaces::nodalMatrix;
using interfaces::outer;
using interfaces::setBlock;

namespace {

/// Returns across (1 − ττᵀ − nnᵀ) + along ττᵀ, dimension × dimension, row-major.
std::vector<double> responseBlock(const VelocityResponse& response, const Point& direction,
                                  const Point& normal, int dimension) {
  std::vector<double> block = identity(dimension, response.across);
  const auto along = outer(direction, direction, dimension, response.along - response.across),
             across = outer(normal, normal, dimension, -response.across);
  for (std::size_t k = 0; k < block.size(); ++k) block[k] += along[k] + across[k];
  return block;
}

/// Fields for the response on a face, [local node][component], including ghosts and periodic
/// images.
struct Fields {
  std::vector<double> pressure;  // p in the component of the gap, Pa
  std::vector<double> friction;  // f p in the component of the gap, without φ, Pa
  std::vector<double> slip;      // w, m/s
  std::vector<double> normal;
};

/// Extends a field from the contact nodes to all local nodes. `value` sets the components of
/// contact node i.
template <class Value>
std::vector<double> spread(const Contact& contact, Mat basis, const Value& value) {
  const auto& mesh = *contact.mesh;
  OwnedVec field = elasticity::nodalVector(mesh), moved = elasticity::nodalVector(mesh);
  {
    const WriteArray values(field);
    for (std::size_t i = 0; i < contact.interfaces.nodes.size(); ++i)
      value(i, values.begin() + mesh.dimension * contact.interfaces.nodes[i].node);
  }
  if (basis) {
    check(MatMult(basis, field, moved));
    std::swap(field, moved);
  }
  if (contact.interfaces.layerExchange) {  // to the nodes on the faces
    check(MatMult(contact.interfaces.layerExchange, field, moved));
    std::swap(field, moved);
  }
  check(MatMult(contact.periodic, field, moved));
  return elasticity::localValues(mesh, moved);
}

Fields fieldsOf(const Contact& contact, const std::vector<Slip>& slip,
                const std::vector<double>& normalForce, double friction) {
  const int dimension = contact.mesh->dimension;
  const auto ofGaps = [&](const auto& factor) {
    return spread(contact, contact.interfaces.gapBasis.matrix, [&](std::size_t i, auto at) {
      at[dimension - 1] = factor(slip[i]) * normalForce[i] / contact.interfaces.nodes[i].wholeArea;
    });
  };
  return {ofGaps([](const Slip&) { return 1.0; }),
          ofGaps([&](const Slip& state) { return state.coefficient.at(friction); }),
          spread(contact, nullptr,
                 [&](std::size_t i, auto at) {
                   for (int d = 0; d < dimension; ++d) at[d] = slip[i].speed * slip[i].direction[d];
                 }),
          spread(contact, nullptr, [&](std::size_t i, auto at) {
            for (int d = 0; d < dimension; ++d) at[d] = contact.interfaces.nodes[i].normal[d];
          })};
}

/// Returns Σ φ_i v_i of a field at a point of the rule.
Point interpolated(const double* value, std::span<const PetscInt> nodes,
                   const std::vector<double>& field, int dimension) {
  Point sum{};
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int d = 0; d < dimension; ++d) sum[d] += value[i] * field[dimension * nodes[i] + d];
  return sum;
}

/// Returns the response per area at a point of a face, dimension × dimension, row-major.
std::vector<double> blockAt(const Contact& contact, const Fields& fields, const double* value,
                            std::span<const PetscInt> nodes) {
  const int dimension = contact.mesh->dimension;
  const double pressure = interpolated(value, nodes, fields.pressure, dimension)[dimension - 1],
               friction = interpolated(value, nodes, fields.friction, dimension)[dimension - 1];
  if (!(pressure > 0)) return std::vector<double>(dimension * dimension, 0.0);
  const Point normal = mesh::unit(interpolated(value, nodes, fields.normal, dimension)),
              w = mesh::tangential(interpolated(value, nodes, fields.slip, dimension), normal);
  Slip slip;
  slip.speed = mesh::length(w);
  if (slip.speed > 0) slip.direction = mesh::scaled(w, 1 / slip.speed);
  slip.law = contact.law.value(slip.speed), slip.slope = contact.law.slope(slip.speed);
  slip.coefficient = {1, 0};  // f p contains the coefficient of the contact
  return responseBlock(velocityResponse(slip, friction, 0, dimension), slip.direction, normal,
                       dimension);
}

}  // namespace

VelocityResponse velocityResponse(const Slip& slip, double normalForce, double friction,
                                  int dimension) {
  return {slip.speed > 0 && dimension == 3 ? slip.friction(friction) * normalForce / slip.speed : 0,
          slip.frictionSlope(friction) * normalForce};
}

OwnedMat nodalResponse(const Contact& contact, const std::vector<Slip>& slip,
                       const std::vector<double>& nodalForce, double friction) {
  const int dimension = contact.mesh->dimension;
  OwnedMat response = nodalMatrix(*contact.mesh, 1);
  for (std::size_t i = 0; i < contact.interfaces.nodes.size(); ++i) {
    const auto& node = contact.interfaces.nodes[i];
    setBlock(response, dimension, node.globalNode, node.globalNode,
             responseBlock(velocityResponse(slip[i], nodalForce[i], friction, dimension),
                           slip[i].direction, node.normal, dimension));
  }
  assembled(response);
  return response;
}

OwnedMat distributedResponse(const Contact& contact, const std::vector<Slip>& slip,
                             const std::vector<double>& normalForce, double friction) {
  if (!contact.interfaces.gapBasis) return nodalResponse(contact, slip, normalForce, friction);
  const auto& mesh = *contact.mesh;
  const int dimension = mesh.dimension;
  const Fields fields = fieldsOf(contact, slip, normalForce, friction);
  elasticity::Triples triples;
  for (const auto& block : mesh.faces) {
    const auto& table = element::shapeTable(block.type);
    const int n = block.nodesPerFace, size = n * dimension;
    for (std::size_t e = 0; e < block.surface.size(); ++e) {
      const auto nodes = block.nodesOf(e);
      if (std::none_of(nodes.begin(), nodes.end(), [&](PetscInt node) {
            return contact.interfaces.hasGapOn(mesh.surfaces[block.surface[e]], node);
          }))
        continue;
      const auto area = elasticity::areaWeights(table, elasticity::pointsOf(mesh, nodes));
      std::vector<double> sums(size * size, 0.0);
      for (int q = 0; q < table.points(); ++q) {
        const double* value = table.value.data() + q * n;
        const auto at = blockAt(contact, fields, value, nodes);
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j)
            for (int c = 0; c < dimension; ++c)
              for (int d = 0; d < dimension; ++d)
                sums[(i * dimension + c) * size + j * dimension + d] +=
                    area[q] * value[i] * value[j] * at[c * dimension + d];
      }
      elasticity::append(triples, mesh, nodes, sums);
    }
  }
  const OwnedMat unfolded = toMatrix(mesh, triples, elasticity::SymmetryClass::symmetric);
  OwnedMat response;
  check(MatPtAP(unfolded, contact.periodic, MAT_INITIAL_MATRIX, PETSC_DEFAULT, response.out()));
  if (!contact.interfaces.layerExchange) return response;
  OwnedMat exchanged;
  check(MatPtAP(response, contact.interfaces.layerExchange, MAT_INITIAL_MATRIX, PETSC_DEFAULT,
                exchanged.out()));
  return exchanged;
}

}  // namespace squeal::contact
