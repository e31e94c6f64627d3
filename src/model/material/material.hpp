#pragma once
/// These functions read the materials of the bodies from the options. None is collective; all ranks
/// have the same options, and so the same results and Errors.
#include <string>
#include <vector>

#include "model/material/hooke.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::material {

/// The elastic law, the density and the damping of a body [M.5].
struct Material {
  Law law;
  double density;           ///< kg/m³
  double massDamping;       ///< α, 1/s: C = α M + …
  double stiffnessDamping;  ///< β + η / (2π f), s: C = … + (β + η / (2π f)) K
  /// Poisson's ratio; that of the mean bulk and shear moduli of an orthotropic body. Zero in plane
  /// stress, in which the thickness gives way.
  double poisson;
};

/// Returns the materials in the order of `mesh.bodies`, [body]. Throws Error for a bad or missing
/// option, for constants without positive strain energy, and for axes with which a plane problem
/// would leave its plane.
std::vector<Material> readMaterials(const mesh::Mesh& mesh);

/// Returns the volume groups with a material, from the options that give an elastic law
/// (`-material_<group>_young`, …). Throws Error if there is none, for a group whose other options
/// lack a law, and for a bad or missing option of a material.
std::vector<mesh::GroupRequest> materialGroups();
/// Returns the options that give a material, for messages: "give -…".
std::string howToGiveMaterials();

}  // namespace squeal::material
