#pragma once
/// This function builds the matrices of sliding at the contact nodes.
#include "model/contact/contact.hpp"
#include "model/elasticity/elasticity.hpp"

namespace squeal::contact {

/// Collective. Fills Contact::reaction, Contact::jump and, with convective terms,
/// Contact::convected.
void buildSliding(const elasticity::Bodies& bodies, Contact& contact);

}  // namespace squeal::contact
