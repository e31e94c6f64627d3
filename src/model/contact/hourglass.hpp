// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Hourglass modes of reduced integration that neither neighbours nor supports hold.
#include <string>

#include "model/contact/contact.hpp"
#include "model/contact/supports.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::contact {

/// Collective. Returns the hourglass modes without strain energy that neighbours, supports and this
/// contact leave, in words: body, number and a cell; an empty text if there are none. No body may
/// have a rigid-body mode there. Only exposed cells can have such modes, Bodies::exposed; the first
/// 2000 are examined with the others taken as rigid.
std::string hourglassModes(const mesh::Mesh& mesh, const Contact& contact,
                           const elasticity::Bodies& bodies, const SupportingContact& holding);

/// Collective. Throws Error if there are such modes with closed frictionless contact. Warns if
/// there are more cells than are examined.
void rejectHourglassModes(const mesh::Mesh& mesh, const Contact& contact,
                          const elasticity::Bodies& bodies);

}  // namespace squeal::contact
