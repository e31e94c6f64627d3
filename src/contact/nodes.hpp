#pragma once
/// This file finds the nodes of contact, from pairs of nodes where the meshes match and from the
/// coupling of the surfaces where they do not.
#include <vector>

#include "contact/contact.hpp"
#include "contact/interfaces.hpp"
#include "coupling/coupling.hpp"

namespace squeal::contact {

/// A Connection couples a contact node i of the slave side s with nodes l of the master side m:
///   u_i = Σ_l P_il u_l + jump.
struct Connection {
  std::vector<coupling::Weight> masters;    ///< row of P; empty on a rigid obstacle
  std::vector<coupling::Weight> jumps;      ///< row of G: the gaps are g = G h; empty: g = h
  std::vector<coupling::Weight> jumpsOf;    ///< row of G⁻¹
  std::vector<coupling::Weight> convected;  ///< D u_D, 1/s, where the slave is the pad and the
                                            ///< meshes do not match
};

/// Returns the number of blocks in each row of blocks of a matrix that connects the contact nodes
/// with themselves and their masters, [owned node], at least one.
std::vector<PetscInt> blocksOfRows(const Contact& contact,
                                   const std::vector<Connection>& connections);

/// Collective. Fills slave sides, nodes and reports of the contact, whose mesh, interface names and
/// periodic matrix are there, and returns the connections, [contact node]. Throws Error for
/// surfaces that do not meet, for a node that two interfaces claim, and for a node that is slave of
/// one interface and master of another.
std::vector<Connection> findNodes(const elasticity::Bodies& bodies,
                                  const std::vector<InterfaceOptions>& interfaces,
                                  Contact& contact);

}  // namespace squeal::contact
