#pragma once
/// This function returns the contact pressure on faces whose nodal areas are not all positive.
#include <vector>

#include "contact/contact.hpp"
#include "mesh/mesh.hpp"

namespace squeal::steady {

/// Collective. Returns the nodal pressures P, Pa, [owned contact node], with [M.12]
///   ∫ φ_i P dA = R_N,i
/// on the faces of the pad, for the nodal forces R_N, N, [owned contact node].
std::vector<double> consistentPressure(const mesh::Mesh& mesh, const contact::Contact& contact,
                                       const std::vector<double>& normalForce);

}  // namespace squeal::steady
