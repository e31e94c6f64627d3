// SPDX-License-Identifier: BSD-2-Clause
#include "model/contact/sliding.hpp"

#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/elasticity/face.hpp"
#include "model/element/shape.hpp"
#include "model/interfaces/algebra.hpp"

namespace squeal::contact {

using interfaces::assembled;
using interfaces::identity;
using interfaces::nodalMatrix;
using interfaces::setBlock;
using mesh::Point;

namespace {

/// Returns N: the columns of A that belong to the gaps, as rows. Forces on periodic images, on tied
/// nodes and on neighbours in the gap basis act on the nodes that determine their displacements.
OwnedMat reactionRows(const SlidingInput& input) {
  const auto& mesh = input.mesh;
  const OwnedMat gaps = nodalMatrix(mesh, 1);
  for (const auto& node : input.interfaces.nodes)
    check(MatSetValue(gaps, gapRow(mesh, node), gapRow(mesh, node), 1, INSERT_VALUES));
  assembled(gaps);
  OwnedMat columns, result;
  check(
      MatMatMult(input.kinematics.matrix, gaps, MAT_INITIAL_MATRIX, PETSC_DEFAULT, columns.out()));
  check(MatTranspose(columns, MAT_INITIAL_MATRIX, result.out()));
  return result;
}

OwnedMat jumpRows(const SlidingInput& input) {
  const auto& connections = input.interfaces.connections;
  const auto& mesh = input.mesh;
  OwnedMat jump = nodalMatrix(mesh, blocksOfRows(mesh, input.interfaces, 0));
  for (std::size_t k = 0; k < connections.size(); ++k) {
    const auto& node = input.interfaces.nodes[k];
    setBlock(jump, mesh.dimension, node.globalNode, node.globalNode,
             identity(mesh.dimension, node.side));
    for (const auto& [master, weight] : connections[k].masters)
      setBlock(jump, mesh.dimension, node.globalNode, master,
               identity(mesh.dimension, -node.side * weight));
  }
  assembled(jump);
  return jump;
}

/// Returns the matrix that gives u_D at the position of each slave node, in the rows of its node on
/// the face, if the meshes match or the slave is the disc. Images are treated like their primaries.
OwnedMat masterRows(const SlidingInput& input) {
  const auto& mesh = input.mesh;
  OwnedMat primaries = nodalMatrix(mesh, 1), result;
  for (const auto& node : input.interfaces.nodes) {
    const PetscInt own = mesh.firstNode + node.surfaceNode,
                   disc = node.side < 0 ? own : node.master;
    if (disc >= 0) setBlock(primaries, mesh.dimension, own, disc, identity(mesh.dimension, 1));
  }
  assembled(primaries);
  check(MatMatMult(input.periodic, primaries, MAT_INITIAL_MATRIX, PETSC_DEFAULT, result.out()));
  return result;
}

/// Returns the base motion of the disc at each slave surface with the u_D of masterRows(),
/// borrowed; null at the others.
std::vector<const elasticity::Motion*> discMotions(const SlidingInput& input) {
  const auto& mesh = input.mesh;
  std::vector<int> body(input.interfaces.options.size(), -1);
  for (const auto& pair : mesh.pairs) body[pair.interface] = pair.masterBody;
  for (const auto& node : input.interfaces.nodes)
    if (node.side < 0) body[node.interface] = node.discBody;
  mpi::reduce<int>(mesh.comm, body, MPI_MAX);
  std::vector<const elasticity::Motion*> motions;
  for (int index : body) motions.push_back(index < 0 ? nullptr : &input.bodies.motions[index]);
  return motions;
}

/// Returns the rows of D for slave faces with u_D at their nodes, which are faces of the disc or
/// match them node on node. It differentiates the displacement of the disc along these faces with
/// their shape functions. The derivative at a node is the mean over the surrounding faces, weighted
/// by area like the nodal forces R_N. On quadratic faces the leading errors at corners and
/// mid-sides then cancel.
OwnedMat convectedByFaces(const SlidingInput& input) {
  const auto& mesh = input.mesh;
  const int dimension = mesh.dimension;
  const auto motions = discMotions(input);
  const OwnedVec area = elasticity::nodalVector(mesh), folded = elasticity::nodalVector(mesh);
  OwnedMat sums;
  check(MatDuplicate(input.bodies.stiffness, MAT_DO_NOT_COPY_VALUES,
                     sums.out()));  // nodes of a face share a cell
  check(MatSetOption(sums, MAT_SYMMETRIC, PETSC_FALSE));
  for (const auto& block : mesh.faces) {
    const auto& table = element::shapeTable(block.type);
    for (std::size_t e = 0; e < block.surface.size(); ++e) {
      const interfaces::SlaveSide* slave =
          input.interfaces.slaveOf(mesh.surfaces[block.surface[e]]);
      const auto* motion = slave ? motions[slave - input.interfaces.slaves.data()] : nullptr;
      if (!motion) continue;
      std::vector<Point> points, velocity;
      const auto nodes = block.nodesOf(e);
      for (PetscInt node : nodes) {
        points.push_back(mesh.coordinates[node]);
        velocity.push_back(motion->velocity(points.back()));
      }
      double faceArea = 0;
      for (double entry : elasticity::faceMass(table, points)) faceArea += entry;
      const auto derivative = elasticity::faceDerivative(table, points, velocity);
      for (int i = 0; i < block.nodesPerFace; ++i) {
        const PetscInt row = dimension * mesh.globalNode[nodes[i]];
        for (int d = 0; d < dimension; ++d) {
          check(VecSetValue(area, row + d, faceArea, ADD_VALUES));
          for (int j = 0; j < block.nodesPerFace; ++j)
            check(MatSetValue(sums, row + d, dimension * mesh.globalNode[nodes[j]] + d,
                              faceArea * derivative[i * block.nodesPerFace + j], ADD_VALUES));
        }
      }
    }
  }
  assembled(sums);
  check(VecAssemblyBegin(area));
  check(VecAssemblyEnd(area));
  check(MatMultTranspose(input.periodic, area, folded));
  for (double& value : WriteArray(folded)) value = value > 0 ? 1 / value : 0;
  const OwnedMat masters = masterRows(input);
  OwnedMat atFaces, result;
  check(MatMatMult(sums, masters, MAT_INITIAL_MATRIX, PETSC_DEFAULT, atFaces.out()));
  check(MatTransposeMatMult(input.periodic, atFaces, MAT_INITIAL_MATRIX, PETSC_DEFAULT,
                            result.out()));
  check(MatDiagonalScale(result, folded, nullptr));
  if (input.interfaces.layerExchange)
    result = interfaces::product(input.interfaces.layerExchange, result);
  return result;
}

OwnedMat convectedRows(const SlidingInput& input) {
  const auto& connections = input.interfaces.connections;
  const auto& mesh = input.mesh;
  OwnedMat result = convectedByFaces(input);
  std::vector<PetscInt> blocks(mesh.ownedNodes, 1);
  bool any = false;
  for (std::size_t k = 0; k < connections.size(); ++k) {
    blocks[input.interfaces.nodes[k].node] += connections[k].convected.size();
    any = any || !connections[k].convected.empty();
  }
  if (!mpi::any(mesh.comm, any)) return result;
  const OwnedMat coupled = nodalMatrix(mesh, blocks);
  for (std::size_t k = 0; k < connections.size(); ++k)
    for (const auto& [master, weight] : connections[k].convected)
      setBlock(coupled, mesh.dimension, input.interfaces.nodes[k].globalNode, master,
               identity(mesh.dimension, weight));
  assembled(coupled);
  check(MatAXPY(result, 1, coupled, DIFFERENT_NONZERO_PATTERN));
  return result;
}

}  // namespace

Sliding slidingOf(const SlidingInput& input) {
  Sliding sliding;
  sliding.reaction = reactionRows(input);
  sliding.jump = jumpRows(input);
  if (input.bodies.settings.convective) sliding.convected = convectedRows(input);
  return sliding;
}

}  // namespace squeal::contact
