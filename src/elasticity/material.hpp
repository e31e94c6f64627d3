#pragma once
/// Materials of the bodies from the options.
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

/// [body] in the order of `mesh.bodies`. Errors: bad or missing option, constants without positive
/// strain energy, axes that make a plane problem leave its plane.
std::vector<Material> readMaterials(const mesh::Mesh& mesh);

}  // namespace squeal::elasticity
