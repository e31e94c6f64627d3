// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Rigid-body modes of bodies that nothing holds.
#include <optional>
#include <string>
#include <vector>

#include "model/contact/contact.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::contact {

/// A connected part of the mesh that can move without strain.
struct LooseBody {
  std::string body, motion;  ///< names of its bodies, and the rigid motion in words
};

/// The contact, without friction, that holds bodies in place.
struct HoldingContact {
  bool any = true;     ///< false: contact holds nothing
  Mask closed = {};    ///< [contact node] 0 where it is open; empty: all are closed
  Mask released = {};  ///< [contact node] 1 where a sticking node does not
                       ///< hold along the surface; empty: all hold
};

/// Collective. Returns the part that can move most freely where neither constraints, springs
/// (Bodies::springs, may be null) nor this contact hold it. Returns none if all parts are held.
std::optional<LooseBody> looseBody(const mesh::Mesh& mesh, const Contact& contact, Vec springs,
                                   const HoldingContact& holding);

/// Collective. Throws Error, naming the body, if a body can move without strain while the contact
/// stays closed without friction.
void rejectLooseBodies(const mesh::Mesh& mesh, const Contact& contact, Vec springs);

}  // namespace squeal::contact
