#pragma once
/// These functions find bodies that can move rigidly because nothing holds them.
#include <optional>
#include <string>

#include "contact/contact.hpp"
#include "mesh/mesh.hpp"

namespace squeal::contact {

/// A connected part of the mesh that can move without strain.
struct LooseBody {
  std::string body, motion;  ///< names of its bodies, and the rigid motion in words
};

/// Collective. Returns the part that can move most freely where neither constraints nor springs
/// (Bodies::springs, may be null) hold it, nor, if `contactCloses`, closed contact without
/// friction. Sticking nodes with released[i] set do not hold along the surface; an empty list
/// releases none. Returns none if all parts are held.
std::optional<LooseBody> looseBody(const mesh::Mesh& mesh, const Contact& contact, Vec springs,
                                   bool contactCloses,
                                   const std::vector<unsigned char>& released = {});

/// Collective. Throws Error, naming the body, if a body can move without strain while the contact
/// stays closed without friction.
void rejectLooseBodies(const mesh::Mesh& mesh, const Contact& contact, Vec springs);

}  // namespace squeal::contact
