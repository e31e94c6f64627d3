// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Candidate nodes of interfaces, and the assignment of nodes that several interfaces claim.
#include <string>
#include <vector>

#include "model/coupling/coupling.hpp"
#include "model/coupling/exchange.hpp"
#include "model/interfaces/nodes.hpp"

namespace squeal::interfaces {

/// A candidate node of an interface.
struct Candidate {
  int interface;
  int discBody;      ///< index into Mesh::bodies; −1 on a rigid obstacle
  PetscInt partner;  ///< global node of the master if the meshes match, otherwise −1
  coupling::SlaveNode slave;
};

/// The claims of interfaces on nodes. Each list is [local node]: the index of the interface plus 1;
/// 0: no claim.
class Claims {
 public:
  /// Collective. The exchange is borrowed.
  Claims(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange);
  /// Returns flags, [local node], of the nodes that an interface with this role must leave to other
  /// interfaces.
  std::vector<unsigned char> against(Role role, int interface, const Interfaces& all) const;
  /// Collective. Claims these local nodes for an interface. Throws Error if a node already slides
  /// on another disc.
  void add(const std::vector<PetscInt>& nodes, const std::vector<InterfaceSettings>& options,
           int interface);

 private:
  void share(std::vector<int>& claims) const;
  const mesh::Mesh& mesh_;
  const coupling::NodeExchange& exchange_;
  std::vector<int> tied_, sliding_, other_;
};

/// Collective. Returns the slave surface, whose nodes the interface couples to the other surface.
std::string slaveSurface(const mesh::Mesh& mesh, const InterfaceSettings& options);

/// Collective. Returns the owned nodes of a surface that are not periodic images.
std::vector<PetscInt> slaveNodesOf(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                                   const std::string& surface);

/// Collective. Returns the candidate nodes of an interface, from pairs of nodes or from the
/// coupling of its surfaces. Nodes with excluded[local node] set are left out and added to
/// Interfaces::lost. Also sets the report and the slave side of an interface whose meshes do not
/// match. `bodies` may be null for a tie. Throws Error for surfaces that do not meet, and if all
/// nodes of the slave belong to other interfaces.
std::vector<Candidate> candidatesOf(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                                    const elasticity::Bodies* bodies, int interface,
                                    const std::vector<unsigned char>& excluded, Interfaces& all);

/// Returns the local nodes of these candidates.
std::vector<PetscInt> nodesOf(const std::vector<Candidate>& candidates);

/// Returns the connection of a node to its masters.
Connection connectionOf(const coupling::SlaveNode& slave);

}  // namespace squeal::interfaces
