// SPDX-License-Identifier: BSD-2-Clause
#include "steady/steady/prestress.hpp"

namespace squeal::steady {

OwnedMat prestressOf(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                     const Solution& solution) {
  if (!bodies.settings.prestress) return {};
  return elasticity::geometricStiffness(mesh, bodies, solution.displacement);
}

}  // namespace squeal::steady
