#pragma once
/// Convective terms of moving bodies: D u = (V·∇)u on Cartesian components, in the vehicle's axes.
#include "elasticity/elasticity.hpp"
#include "elasticity/material.hpp"
#include "mesh/mesh.hpp"

namespace squeal::elasticity {

/// Collective. Fills `bodies.gyroscopic` and `bodies.rotationStiffness` from `bodies.motions`;
/// leaves them empty if no body moves. Error: matter of a moving body crosses the body's surface,
/// so that the body does not keep its place.
void assembleConvection(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                        Bodies& bodies);

}  // namespace squeal::elasticity
