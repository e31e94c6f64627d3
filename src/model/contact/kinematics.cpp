#include "model/contact/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/petsc/arrays.hpp"
#include "base/petsc/check.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/mesh/mesh.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::contact {

using interfaces::assembled;
using interfaces::identity;
using interfaces::nodalMatrix;
using interfaces::outer;
using interfaces::setBlock;
using interfaces::setDiagonal;
using interfaces::text;
using mesh::cross;
using mesh::dot;

namespace {

/// A Frame holds the tangents t1, t2 at a contact node, with held Cartesian directions first. In a
/// plane problem only the first is used.
struct Frame {
  std::vector<Point> tangents;
  std::vector<int> heldComponent;  ///< [tangent] Cartesian component held along it, or −1
};

Frame frameOf(const ContactNode& node, const Contact& contact, int dimension) {
  const auto& constraints = contact.constraints;
  Frame frame;
  for (int d = 0; d < dimension; ++d)
    if (constraints.held[dimension * node.node + d]) {
      Point e{};
      e[d] = 1;
      if (node.role == Role::sticking)
        throw Error("option -constraint_" +
                    constraints.groups[constraints.heldBy[dimension * node.node + d]] +
                    "_clamped holds component " + "xyz"[d] + " of a node of " +
                    contact.options[node.interface].label() + " at " + text(node.position) +
                    ", which sticks to the other side; let the other side be the slave");
      if (std::abs(dot(e, node.normal)) > 1e-6)
        throw Error("option -constraint_" +
                    constraints.groups[constraints.heldBy[dimension * node.node + d]] +
                    "_clamped holds component " + "xyz"[d] + " of the contact node at " +
                    text(node.position) +
                    ", which is not tangential there; contact decides the normal component");
      frame.tangents.push_back(e);
      frame.heldComponent.push_back(d);
    }
  if (dimension == 2) {
    if (frame.tangents.empty())
      frame.tangents.push_back({-node.normal[1], node.normal[0], 0}),
          frame.heldComponent.push_back(-1);
    return frame;
  }
  if (frame.tangents.empty()) {
    // Any direction that is not along n will do.
    std::size_t least = 0;
    for (std::size_t d = 1; d < 3; ++d)
      if (std::abs(node.normal[d]) < std::abs(node.normal[least])) least = d;
    Point e{};
    e[least] = 1;
    frame.tangents.push_back(mesh::unit(cross(node.normal, e)));
    frame.heldComponent.push_back(-1);
  }
  if (frame.tangents.size() == 1)
    frame.tangents.push_back(cross(node.normal, frame.tangents[0])),
        frame.heldComponent.push_back(-1);
  return frame;
}

/// Fills the rows of the contact nodes of this level.
void setContactRows(int level, Contact& contact, Mat a, std::vector<double>& values) {
  const mesh::Mesh& mesh = *contact.mesh;
  const int dimension = mesh.dimension;
  const auto local = [&](PetscInt node, int d) { return dimension * node + d; };
  std::string failure;
  for (std::size_t k = 0; k < contact.nodes.size(); ++k) try {
      if (contact.connections[k].level != level) continue;
      const auto& node = contact.nodes[k];
      const bool sticks = node.role == Role::sticking;
      const Frame frame = frameOf(node, contact, dimension);
      std::vector<double> block(dimension * dimension);
      for (int i = 0; i < dimension; ++i) {
        for (int t = 0; t < dimension - 1; ++t) block[i * dimension + t] = frame.tangents[t][i];
        block[i * dimension + dimension - 1] = node.side * node.normal[i];
      }
      setBlock(a, dimension, node.globalNode, node.globalNode, block);
      for (const auto& [master, weight] : contact.connections[k].masters)
        setBlock(a, dimension, node.globalNode, master,
                 sticks ? identity(dimension, weight)
                        : outer(node.normal, node.normal, dimension, weight));
      const auto& options = contact.options[node.interface];
      if (options.onObstacle())
        values[local(node.node, dimension - 1)] = dot(node.normal, options.obstacleDisplacement);
      for (int t = 0; t < dimension - 1; ++t) {
        const int component = frame.heldComponent[t];
        if (component < 0) continue;
        contact.free[local(node.node, t)] = 0;
        values[local(node.node, t)] = contact.constraints.displacement[local(node.node, component)];
      }
    } catch (const Error& error) {
      failure = error.what();
    }
  failTogether(mesh.comm, failure);
}

/// Fills the rows of the tied nodes of this level.
void setTiedRows(int level, Contact& contact, Mat a, std::vector<double>& values) {
  const int dimension = contact.mesh->dimension;
  for (const auto& tied : contact.tied) {
    if (tied.connection.level != level) continue;
    const PetscInt node = tied.connection.node, global = contact.mesh->firstNode + node;
    for (const auto& [master, weight] : tied.connection.masters) {
      auto block = identity(dimension, weight);
      for (int d = 0; d < dimension; ++d)
        if (tied.apart[d]) block[d * dimension + d] = 0;
      setBlock(a, dimension, global, master, block);
    }
    for (int d = 0; d < dimension; ++d) {
      const PetscInt row = dimension * node + d;
      contact.free[row] = 0;
      if (!tied.apart[d]) continue;
      check(MatSetValue(a, dimension * global + d, dimension * global + d, 1, INSERT_VALUES));
      values[row] = contact.constraints.displacement[row];
    }
  }
}

/// Collective. Returns A_0, which fills the rows of components that follow from others.
OwnedMat combinedRows(Contact& contact, std::vector<double>& values) {
  const mesh::Mesh& mesh = *contact.mesh;
  const int dimension = mesh.dimension;
  std::vector<PetscInt> blocks(mesh.ownedNodes, 1);
  for (const auto& combined : contact.constraints.combined)
    blocks[combined.node] += combined.others.size();
  OwnedMat rows = nodalMatrix(mesh, blocks);
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    setDiagonal(rows, dimension, mesh.firstNode + node);
  for (const auto& [node, component, others, constant] : contact.constraints.combined) {
    for (const auto& [other, weight] : others)
      check(MatSetValue(rows, dimension * (mesh.firstNode + node) + component,
                        dimension * other + component, weight, INSERT_VALUES));
    contact.free[dimension * node + component] = 0;
    values[dimension * node + component] = constant;
  }
  assembled(rows);
  return rows;
}

/// Returns the level of the owned nodes, [owned node]; 0 for those that rest on no other.
std::vector<int> levelsOf(const Contact& contact) {
  std::vector<int> levels(contact.mesh->ownedNodes, 0);
  for (const auto& connection : contact.connections) levels[connection.node] = connection.level;
  for (const auto& tied : contact.tied) levels[tied.connection.node] = tied.connection.level;
  return levels;
}

}  // namespace

std::vector<PetscInt> blocksOfRows(const Contact& contact, int level) {
  std::vector<PetscInt> blocks(contact.mesh->ownedNodes, 1);
  for (const auto& connection : contact.connections)
    if (level == 0 || connection.level == level)
      blocks[connection.node] += connection.masters.size();
  for (const auto& tied : contact.tied)
    if (tied.connection.level == level)
      blocks[tied.connection.node] += tied.connection.masters.size();
  return blocks;
}

OwnedMat buildKinematics(Contact& contact, Vec held) {
  const mesh::Mesh& mesh = *contact.mesh;
  const auto& constraints = contact.constraints;
  const int dimension = mesh.dimension;
  const auto levels = levelsOf(contact);
  contact.free.assign(constraints.held.size(), 1);
  std::vector<double> values(constraints.held.size(), 0.0);
  for (PetscInt i = 0; i < dimension * mesh.ownedNodes; ++i)
    if (levels[i / dimension] == 0 && constraints.held[i])
      contact.free[i] = 0, values[i] = constraints.displacement[i];
  OwnedMat a;
  //   A = A_n … A_1 A_0, where A_i fills the rows of the slaves of level i
  if (constraints.anyCombined) a = combinedRows(contact, values);
  for (int level = 1; level <= contact.levels; ++level) {
    OwnedMat factor = nodalMatrix(mesh, blocksOfRows(contact, level));
    for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
      if (levels[node] != level) setDiagonal(factor, dimension, mesh.firstNode + node);
    setContactRows(level, contact, factor, values);
    setTiedRows(level, contact, factor, values);
    assembled(factor);
    if (!a) {
      a = std::move(factor);
      continue;
    }
    OwnedMat product;
    check(MatMatMult(factor, a, MAT_INITIAL_MATRIX, PETSC_DEFAULT, product.out()));
    a = std::move(product);
  }
  for (const auto& image : mesh.images)
    for (int d = 0; d < dimension; ++d) contact.free[dimension * image.node + d] = 0;
  std::copy(values.begin(), values.end(), WriteArray(held).begin());
  return a;
}

}  // namespace squeal::contact
