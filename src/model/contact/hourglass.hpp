// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Hourglass modes of reduced integration that neither neighbours nor supports hold.
#include "model/contact/contact.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::contact {

/// Collective. Throws Error, naming the body and a cell, if a body has an hourglass mode without
/// strain energy with closed frictionless contact. No body may have a rigid-body mode there. Only
/// exposed cells can have such modes, Bodies::exposed; the first 100 are examined with the others
/// taken as rigid.
void rejectHourglassModes(const mesh::Mesh& mesh, const Contact& contact,
                          const elasticity::Bodies& bodies);

}  // namespace squeal::contact
