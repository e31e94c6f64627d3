#include "contact/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "contact/algebra.hpp"
#include "mesh/mesh.hpp"
#include "petsc/arrays.hpp"
#include "petsc/check.hpp"

namespace squeal::contact {
namespace {

/// A Frame holds the tangents t1, t2 at a contact node, with held Cartesian directions first. In a
/// plane problem only the first is used.
struct Frame {
  std::vector<Point> tangents;
  std::vector<int> heldComponent;  ///< [tangent] Cartesian component held along it, or −1
};

Frame frameOf(const ContactNode& node, const Constraints& constraints, int dimension) {
  Frame frame;
  for (int d = 0; d < dimension; ++d)
    if (constraints.held[dimension * node.node + d]) {
      Point e{};
      e[d] = 1;
      if (std::abs(dot(e, node.normal)) > 1e-6)
        throw Error("option -constraint_" +
                    constraints.groups[constraints.heldBy[dimension * node.node + d]] +
                    "_clamped holds component " + "xyz"[d] + " of the pad contact node at " +
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
    const Point t = cross(node.normal, e);
    frame.tangents.push_back(scaled(t, 1 / std::sqrt(dot(t, t))));
    frame.heldComponent.push_back(-1);
  }
  if (frame.tangents.size() == 1)
    frame.tangents.push_back(cross(node.normal, frame.tangents[0])),
        frame.heldComponent.push_back(-1);
  return frame;
}

}  // namespace

OwnedMat buildKinematics(const std::vector<InterfaceOptions>& interfaces,
                         const std::vector<Connection>& connections, Contact& contact, Vec held) {
  const mesh::Mesh& mesh = *contact.mesh;
  OwnedMat a = nodalMatrix(mesh, blocksOfRows(contact, connections));
  const Constraints& constraints = contact.constraints;
  const int dimension = mesh.dimension;
  const auto local = [&](PetscInt node, int d) { return dimension * node + d; };
  contact.free.assign(constraints.held.size(), 1);
  std::vector<unsigned char> isPad(mesh.ownedNodes, 0);
  for (const auto& node : contact.nodes) isPad[node.node] = 1;
  std::vector<double> values(constraints.held.size(), 0.0);
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node) {
    if (isPad[node]) continue;
    for (int d = 0; d < dimension; ++d) {
      check(MatSetValue(a, dimension * (mesh.firstNode + node) + d,
                        dimension * (mesh.firstNode + node) + d, 1, INSERT_VALUES));
      if (!constraints.held[local(node, d)]) continue;
      contact.free[local(node, d)] = 0;
      values[local(node, d)] = constraints.displacement[local(node, d)];
    }
  }
  std::string failure;
  for (std::size_t k = 0; k < contact.nodes.size(); ++k) try {
      const auto& node = contact.nodes[k];
      const Frame frame = frameOf(node, constraints, dimension);
      std::vector<double> block(dimension * dimension);
      for (int i = 0; i < dimension; ++i) {
        for (int t = 0; t < dimension - 1; ++t) block[i * dimension + t] = frame.tangents[t][i];
        block[i * dimension + dimension - 1] = node.side * node.normal[i];
      }
      setBlock(a, dimension, node.globalNode, node.globalNode, block);
      for (const auto& [master, weight] : connections[k].masters)
        setBlock(a, dimension, node.globalNode, master,
                 outer(node.normal, node.normal, dimension, weight));
      if (interfaces[node.interface].onObstacle())
        values[local(node.node, dimension - 1)] =
            dot(node.normal, interfaces[node.interface].obstacleDisplacement);
      for (int t = 0; t < dimension - 1; ++t) {
        const int component = frame.heldComponent[t];
        if (component < 0) continue;
        contact.free[local(node.node, t)] = 0;
        values[local(node.node, t)] = constraints.displacement[local(node.node, component)];
      }
    } catch (const Error& error) {
      failure = error.what();
    }
  failTogether(mesh.comm, failure);
  for (const auto& image : mesh.images)
    for (int d = 0; d < dimension; ++d) contact.free[local(image.node, d)] = 0;
  assembled(a);
  std::copy(values.begin(), values.end(), WriteArray(held).begin());
  return a;
}

}  // namespace squeal::contact
