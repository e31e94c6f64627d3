// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The contact of a mesh is built and checked.
#include <vector>

#include "model/contact/contact.hpp"
#include "model/contact/settings.hpp"
#include "model/elasticity/elasticity.hpp"

namespace squeal::contact {

/// Collective. Builds normals, slip directions, constraints and all matrices. `ties` are those of
/// ties::findTies(). `mesh` is borrowed by the result. Throws Error for surfaces that do not
/// meet, a bad constraint, a pad that moves, a held component that is not tangential at a contact
/// node, an obstacle face that is not flat, and a body that can move rigidly with the contact
/// closed; the message names body and motion.
Contact build(const mesh::Mesh& mesh, const elasticity::Bodies& bodies, interfaces::Interfaces ties,
              const Settings& settings);

/// Collective. Throws Error if nothing moves along a sliding interface, at any friction: its bodies
/// rest on each other, and what holds or frees them along the surface is another role's matter.
void requireMotion(const Contact& contact);

/// Collective. Throws Error, naming position and options, if a contact node with active[i] set
/// carries friction at the swept one and does not slip: friction has no direction there.
void requireSlip(const Contact& contact, const std::vector<Slip>& slip, const Mask& active,
                 double swept);

}  // namespace squeal::contact
