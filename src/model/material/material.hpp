// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Materials of the bodies: elastic law, density and damping.
#include <vector>

#include "model/material/hooke.hpp"
#include "model/material/settings.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::material {

/// The elastic law, the density and the damping of a body, or of a section of a body [M.5].
struct Material {
  Law law;
  double density;           ///< kg/m³
  double massDamping;       ///< α, 1/s: C = α M + …
  double stiffnessDamping;  ///< β + η / (2π f), s: C = … + (β + η / (2π f)) K
  bool reducedIntegration;  ///< of the stiffness of hex20 cells, its only cells
  /// Poisson's ratio; for an anisotropic body, that of the mean bulk and shear moduli. Zero in
  /// plane stress, where the thickness is free to change.
  double poisson;
  std::function<Axes(const Point&)> axes = {};  ///< at each point; empty if it is isotropic
};

/// Not collective. Returns the materials in the order of `mesh.materialGroups`. Throws Error for
/// axes that would couple in-plane and out-of-plane motion in a plane problem, and for a frame that
/// does not exist.
std::vector<Material> materialsOf(const mesh::Mesh& mesh, const Settings& settings);

}  // namespace squeal::material
