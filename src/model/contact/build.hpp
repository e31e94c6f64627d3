// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Builds and checks the contact of a mesh.
#include <vector>

#include "model/contact/contact.hpp"
#include "model/contact/settings.hpp"
#include "model/elasticity/elasticity.hpp"

namespace squeal::contact {

/// The bodies with the stiffness of their compliant layers, and their contact.
struct Assembled {
  elasticity::Bodies bodies;
  Contact contact;
};

/// Collective. Builds normals, slip directions, constraints and all matrices. `ties` is the result
/// of ties::findTies(). The result borrows `mesh`. Throws Error for surfaces that do not meet, for
/// an invalid constraint, for a sliding interface whose pad moves, for a held component that is not
/// tangential at a contact node, and for a face on a rigid obstacle that is not flat.
Assembled assemble(const mesh::Mesh& mesh, elasticity::Bodies bodies, interfaces::Interfaces ties,
                   const Settings& settings);

/// Collective. Throws Error for a rigid-body mode with closed contact, naming body and motion, and
/// for an hourglass mode that nothing prevents.
void requireSupports(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                     const Contact& contact);

/// Collective. Fixes the lengths of the bolts. `openings`, [section of the mesh], are the openings
/// of the bolts' sections along the normal, m.
void lockBolts(Contact& contact, const elasticity::Bodies& bodies,
               const std::vector<double>& openings);

/// Collective. Throws Error if a sliding interface has no sliding velocity at any node, even
/// without friction: the interface between bodies at rest needs another role.
void requireMotion(const Contact& contact);

/// Collective. Throws Error, naming position and options, if a contact node i with active[i] set
/// has a nonzero coefficient of friction at the swept friction `swept` but no slip velocity: its
/// friction force then has no direction.
void requireSlip(const Contact& contact, const std::vector<Slip>& slip, const Mask& active,
                 double swept);

}  // namespace squeal::contact
