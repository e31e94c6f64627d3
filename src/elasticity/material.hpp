#pragma once
/// The materials of the bodies, from the options.
#include <string>
#include <vector>

#include "elasticity/element.hpp"
#include "mesh/mesh.hpp"

namespace squeal::elasticity {

struct Material {
  Law law;
  double density;           ///< kg/m³
  double massDamping;       ///< α, 1/s: C = α M + …
  double stiffnessDamping;  ///< β + η / (2π f), s: C = … + (β + η / 2πf) K
};

/// Returns the materials in the order of `mesh.bodies`, [body]. Throws Error for a bad or missing
/// option, for constants without positive strain energy, and for axes with which a plane problem
/// would leave its plane.
std::vector<Material> readMaterials(const mesh::Mesh& mesh);

}  // namespace squeal::elasticity
