#pragma once
/// This function assembles the convective terms of moving bodies, in the axes of the vehicle and on
/// Cartesian components [M.2]:
///   D u = (V·∇)u.
#include "model/elasticity/elasticity.hpp"
#include "model/material/material.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

/// Collective. Fills `bodies.gyroscopic` and `bodies.rotationStiffness` [4.10] from
/// `bodies.motions`; leaves them null if no body moves. Throws Error if matter of a moving body
/// crosses the body's surface, so that the body does not keep its place.
void assembleConvection(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
                        Bodies& bodies);

}  // namespace squeal::elasticity
