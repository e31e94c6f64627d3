// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Rigid-body modes of under-constrained bodies.
#include <optional>
#include <string>
#include <vector>

#include "model/contact/contact.hpp"
#include "model/contact/supports.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::contact {

/// A connected part of the mesh that can move without strain.
struct RigidBodyMode {
  std::string body, motion;        ///< names of its bodies, and the rigid motion in words
  std::vector<std::string> bolts;  ///< bolts whose sections open in this motion
  bool isReference = false;        ///< the part is a reference node
};

/// Collective. Returns the rigid-body mode that constraints, springs, bushings and the contact
/// `holding` resist least; none if all parts are supported.
std::optional<RigidBodyMode> rigidBodyMode(const mesh::Mesh& mesh, const Contact& contact,
                                           const elasticity::Bodies& bodies,
                                           const SupportingContact& holding);

/// Collective. Returns for each connected part, [part], 1 if it moves in any rigid-body mode with
/// the supports of rigidBodyMode().
std::vector<unsigned char> looseParts(const mesh::Mesh& mesh, const Contact& contact,
                                      const elasticity::Bodies& bodies,
                                      const SupportingContact& holding);

/// Collective. Throws Error, naming the body, if a body has a rigid-body mode with closed
/// frictionless contact.
void rejectRigidBodyModes(const mesh::Mesh& mesh, const Contact& contact,
                          const elasticity::Bodies& bodies);

}  // namespace squeal::contact
