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
  /// True if the stiffness is integrated by the reduced rule; all cells are then hex20.
  bool reducedIntegration;
  /// Poisson's ratio; for an anisotropic material, the ratio that follows from the mean bulk and
  /// shear moduli. Zero in plane stress, where the thickness is free to change.
  double poisson;
  std::function<Axes(const Point&)> axes = {};  ///< at each point; empty for an isotropic material
};

/// Not collective. Returns the materials in the order of `mesh.materialGroups`. Throws Error for
/// axes that would couple in-plane and out-of-plane motion in a plane problem, and for a frame that
/// does not exist.
std::vector<Material> materialsOf(const mesh::Mesh& mesh, const Settings& settings);

}  // namespace squeal::material
