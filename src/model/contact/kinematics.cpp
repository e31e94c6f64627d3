// SPDX-License-Identifier: BSD-2-Clause
#include "model/contact/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/petsc/arrays.hpp"
#include "base/petsc/check.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/interfaces/dependence.hpp"
#include "model/mesh/mesh.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::contact {

using interfaces::assembled;
using interfaces::ContactNode;
using interfaces::identity;
using interfaces::nodalMatrix;
using interfaces::outer;
using interfaces::Role;
using interfaces::setBlock;
using interfaces::setDiagonal;
using interfaces::text;
using mesh::cross;
using mesh::dot;

namespace {

/// The tangents t1, t2 at a contact node, held directions first. A plane problem uses
/// only the first.
struct Frame {
  std::vector<Point> tangents;
  std::vector<int> heldComponent;  ///< [tangent] component of the node's axes held along it, or −1
};

/// Returns how the contact can let a node be held along its normal, or at all if it sticks.
std::string otherSide(const ContactNode& node, const interfaces::Interfaces& all) {
  const auto& options = all.options[node.interface];
  const std::string& name = options.surfaces.name;
  if (options.onObstacle()) return "leave nodes that touch a rigid obstacle free along its normal";
  return "let the other side bear the gaps by " + interfaces::slaveName(name) +
         (node.side > 0 ? " disc" : " pad") + ", or give a soft layer, " +
         interfaces::stiffnessName(name);
}

Frame frameOf(const ContactNode& node, const interfaces::Interfaces& all, int dimension) {
  const auto& constraints = all.constraints;
  Frame frame;
  for (int d = 0; d < dimension; ++d)
    if (const PetscInt at = dimension * node.node + d; constraints.held[at]) {
      const Point e = constraints.direction(node.node, d);
      const std::string component = constraints.axes.contains(node.node)
                                        ? "the direction " + text(e)
                                        : std::string("component ") + "xyz"[d];
      if (node.role == Role::sticking)
        throw Error("option " +
                    constraints::clampedName(constraints.groups[constraints.heldBy[at]]) +
                    " holds " + component + " of a node of " + all.options[node.interface].label() +
                    " at " + text(node.position) + ", which sticks to the other side; " +
                    otherSide(node, all));
      if (std::abs(dot(e, node.normal)) > 1e-6)
        throw Error("option " +
                    constraints::clampedName(constraints.groups[constraints.heldBy[at]]) +
                    " holds " + component + " of the contact node at " + text(node.position) +
                    ", which is not tangential there; contact determines the normal component: " +
                    otherSide(node, all));
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
    frame.tangents.push_back(mesh::across(node.normal));
    frame.heldComponent.push_back(-1);
  }
  if (frame.tangents.size() == 1)
    frame.tangents.push_back(cross(node.normal, frame.tangents[0])),
        frame.heldComponent.push_back(-1);
  return frame;
}

/// A = A_n … A_1 Q A_0, where A_i fills the rows of the nodes of level i that follow others, Q
/// turns the axes of nodes with supports in other directions, and A_0 fills the rows of components
/// that depend on others by equations.
class Factors {
 public:
  Factors(const mesh::Mesh& mesh, const interfaces::Interfaces& all);
  /// Collective. Returns A before periodicity and with gaps at the nodes.
  OwnedMat product();
  /// Collective. Returns the values of the components of z that are not unknowns, N entries.
  OwnedVec held() const;
  const std::vector<unsigned char>& free() const { return free_; }

 private:
  void setContactRow(std::size_t k, Mat a);
  void setContactRows(int level, Mat a);
  OwnedMat dependentRows() const;
  PetscInt row(PetscInt node, int d) const { return dimension_ * node + d; }

  const mesh::Mesh& mesh_;
  const interfaces::Interfaces& all_;
  int dimension_;
  std::vector<int> levels_;  // [owned node] level of a slave; 0: it depends on no other node
  std::vector<unsigned char> free_;
  std::vector<double> values_;  // of components of z
};

Factors::Factors(const mesh::Mesh& mesh, const interfaces::Interfaces& all)
    : mesh_(mesh),
      all_(all),
      dimension_(mesh.dimension),
      levels_(interfaces::levelsOfFollowers(mesh, all)),
      free_(all.constraints.held.size(), 1),
      values_(all.constraints.held.size(), 0.0) {
  const auto hold = [&](PetscInt i) { free_[i] = 0, values_[i] = all.constraints.displacement[i]; };
  for (const auto& connection : all.connections) levels_[connection.node] = connection.level;
  for (const auto& [node, layer] : mesh.layers)  // layer nodes without a gap are not used
    for (int d = 0; d < dimension_; ++d) free_[row(layer, d)] = 0;
  for (const auto& node : all.nodes)
    if (node.hasLayer()) free_[row(node.node, dimension_ - 1)] = 1;
  for (PetscInt i = 0; i < dimension_ * mesh.ownedNodes; ++i)
    if (levels_[i / dimension_] == 0 && all.constraints.held[i]) hold(i);
  for (const auto& tied : all.tied)
    for (int d = 0; d < dimension_; ++d) {
      const PetscInt i = row(tied.connection.node, d);
      if (tied.apart[d]) hold(i);
      free_[i] = 0;
    }
  for (const auto& coupled : all.coupled)
    for (int d = 0; d < dimension_; ++d) free_[row(coupled.node, d)] = coupled.free[d];
  for (const auto& dependent : all.constraints.dependent)
    free_[dependent.row] = 0, values_[dependent.row] = dependent.constant;
}

/// Fills the rows of contact node k.
void Factors::setContactRow(std::size_t k, Mat a) {
  const auto& node = all_.nodes[k];
  const bool sticks = node.role == Role::sticking;
  const Frame frame = frameOf(node, all_, dimension_);
  const bool follows = node.hasLayer() && !sticks;  // its node on the face, along the face
  std::vector<double> block(dimension_ * dimension_);
  for (int i = 0; i < dimension_; ++i) {
    for (int t = 0; t < dimension_ - 1 && !follows; ++t)
      block[i * dimension_ + t] = frame.tangents[t][i];
    block[i * dimension_ + dimension_ - 1] = node.side * node.normal[i];
  }
  setBlock(a, dimension_, node.globalNode, node.globalNode, block);
  if (follows) {
    block = outer(node.normal, node.normal, dimension_, -1);
    for (int i = 0; i < dimension_; ++i) block[i * dimension_ + i] += 1;
    setBlock(a, dimension_, node.globalNode, mesh_.firstNode + node.surfaceNode, block);
  }
  for (const auto& [master, weight] : all_.connections[k].masters)
    setBlock(a, dimension_, node.globalNode, master,
             sticks ? identity(dimension_, weight)
                    : outer(node.normal, node.normal, dimension_, weight));
  if (all_.options[node.interface].onObstacle())
    values_[row(node.node, dimension_ - 1)] =
        dot(node.normal, all_.obstacles[node.interface].displacement);
  for (int t = 0; t < dimension_ - 1; ++t) {
    const int component = frame.heldComponent[t];
    if (component < 0) continue;
    free_[row(node.node, t)] = 0;
    values_[row(node.node, t)] = all_.constraints.displacement[row(node.node, component)];
  }
}

/// Collective. Fills the rows of the contact nodes of this level.
void Factors::setContactRows(int level, Mat a) {
  std::string failure;
  for (std::size_t k = 0; k < all_.nodes.size(); ++k) try {
      if (all_.connections[k].level == level) setContactRow(k, a);
    } catch (const Error& error) {
      failure = error.what();
    }
  failTogether(mesh_.comm, failure);
}

/// Collective. Returns A_0, which fills the rows of components that depend on others by equations.
OwnedMat Factors::dependentRows() const {
  std::vector<PetscInt> blocks(mesh_.ownedNodes, 1);
  for (const auto& dependent : all_.constraints.dependent)
    blocks[dependent.row / dimension_] += dependent.others.size();
  OwnedMat rows = nodalMatrix(mesh_, blocks);
  for (PetscInt node = 0; node < mesh_.ownedNodes; ++node)
    setDiagonal(rows, dimension_, mesh_.firstNode + node);
  for (const auto& [at, others, constant] : all_.constraints.dependent)
    for (const auto& [other, factor] : others)
      check(MatSetValue(rows, row(mesh_.firstNode, 0) + at, other, factor, INSERT_VALUES));
  assembled(rows);
  return rows;
}

OwnedMat Factors::product() {
  OwnedMat a;
  if (all_.constraints.anyDependent) a = dependentRows();
  if (all_.constraints.anyTurned) {
    OwnedMat turned = interfaces::turnedAxes(mesh_, all_);
    a = a ? interfaces::product(turned, a) : std::move(turned);
  }
  for (int level = 1; level <= all_.levels; ++level) {
    OwnedMat factor = nodalMatrix(mesh_, blocksOfRows(mesh_, all_, level));
    for (PetscInt node = 0; node < mesh_.ownedNodes; ++node)
      if (levels_[node] != level) setDiagonal(factor, dimension_, mesh_.firstNode + node);
    setContactRows(level, factor);
    interfaces::setFollowers(mesh_, all_, level, factor);
    assembled(factor);
    a = a ? interfaces::product(factor, a) : std::move(factor);
  }
  for (const auto& image : mesh_.images)
    for (int d = 0; d < dimension_; ++d) free_[row(image.node, d)] = 0;
  return a;
}

OwnedVec Factors::held() const {
  OwnedVec vector = elasticity::nodalVector(mesh_);
  std::copy(values_.begin(), values_.end(), WriteArray(vector).begin());
  return vector;
}

/// Returns u_g = A (d − g0) of the gaps g0 without load, which the gap unknowns include, and of the
/// lengths d of bolts.
OwnedVec gapOffset(const mesh::Mesh& mesh, const interfaces::Interfaces& all, Mat a) {
  const OwnedVec gaps = elasticity::nodalVector(mesh);
  {
    const WriteArray values(gaps);
    for (const auto& node : all.nodes) values[mesh.dimension * (node.node + 1) - 1] = -node.gap;
    for (const auto& [row, value] : all.constraints.locked) values[row] = value;
  }
  OwnedVec offset = elasticity::nodalVector(mesh);
  check(MatMult(a, gaps, offset));
  return offset;
}

}  // namespace

PetscInt gapRow(const mesh::Mesh& mesh, const ContactNode& node) {
  return mesh.dimension * (node.globalNode + 1) - 1;
}

std::vector<PetscInt> blocksOfRows(const mesh::Mesh& mesh, const interfaces::Interfaces& all,
                                   int level) {
  std::vector<PetscInt> blocks(mesh.ownedNodes, 1);
  for (std::size_t k = 0; k < all.connections.size(); ++k)
    if (const auto& connection = all.connections[k]; level == 0 || connection.level == level)
      blocks[connection.node] += connection.masters.size() + all.nodes[k].hasLayer();
  if (level > 0) interfaces::countBlocks(all, level, blocks);
  return blocks;
}

Kinematics kinematicsOf(const mesh::Mesh& mesh, const interfaces::Interfaces& all, Mat periodic) {
  Factors factors(mesh, all);
  const OwnedMat a = factors.product();
  Kinematics kinematics;
  kinematics.matrix = interfaces::product(periodic, a);
  if (all.gapBasis) kinematics.matrix = interfaces::product(kinematics.matrix, all.gapBasis.matrix);
  kinematics.offset = elasticity::nodalVector(mesh);
  check(MatMult(kinematics.matrix, factors.held(), kinematics.offset));
  kinematics.gapOffset = gapOffset(mesh, all, kinematics.matrix);
  kinematics.free = factors.free();
  return kinematics;
}

}  // namespace squeal::contact
