// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Hourglass modes of cells with reduced integration that neither neighbouring cells nor supports
/// prevent.
#include <string>

#include "model/contact/contact.hpp"
#include "model/contact/supports.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::contact {

/// Collective. Describes the hourglass modes without strain energy that neighbouring cells,
/// supports and the contact `holding` do not prevent: their body, their number and one of their
/// cells. Returns an empty text if there are none. No body may have a rigid-body mode with
/// `holding`. Only the cells in Bodies::exposed can have such modes. The first 2000 of them are
/// examined, and the others are treated as rigid.
std::string hourglassModes(const mesh::Mesh& mesh, const Contact& contact,
                           const elasticity::Bodies& bodies, const SupportingContact& holding);

/// Collective. Throws Error if closed frictionless contact does not prevent all hourglass modes.
/// Warns if not all exposed cells are examined.
void rejectHourglassModes(const mesh::Mesh& mesh, const Contact& contact,
                          const elasticity::Bodies& bodies);

}  // namespace squeal::contact
