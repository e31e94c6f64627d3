// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Steady sliding judged without the program's own residual: from displacements, the bodies'
/// stiffness and the laws of contact.
#include <vector>

#include "run/analysis/analysis.hpp"
#include "steady/steady/steady.hpp"
#include "support/harness/largest_error.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal::test {

/// Violations of the laws of steady sliding over the whole contact, each relative to the largest
/// gap, displacement or force.
struct Violations {
  double gap = 0;          ///< the solution's gap against the distance of the displaced surfaces
  double penetration = 0;  ///< −gap, at nodes and of the coefficients of the gap basis
  double tension = 0;      ///< −R_N
  double complementarity = 0;  ///< gap · R_N, of the coefficients
  double coulomb = 0;          ///< |R_T − f R_N V/|V||, V the velocity of the disc
  double equilibrium = 0;  ///< K u − b less the contact forces, on all components that are not held
};

/// Collective. Meshes without periodic images and with V along +x; `obstacle`: displacement along y
/// of a rigid obstacle.
inline Violations violations(const analysis::Analysis& analysis, const steady::Solution& solution,
                             double obstacle = 0) {
  const auto& mesh = *analysis.model.mesh;
  const auto& contact = analysis.model.contact;
  const auto dimension = static_cast<std::size_t>(mesh.dimension);
  const auto u = allEntries(solution.displacement);
  const OwnedVec rest = elasticity::nodalVector(mesh);  // K u − b − contact forces
  check(MatMult(analysis.model.bodies.stiffness, solution.displacement, rest));
  check(VecAXPY(rest, -1, analysis.model.bodies.load));
  double force = 0, length = 0;
  for (const auto& state : solution.contact)
    force = worse(force, std::abs(state.normalForce)), length = worse(length, std::abs(state.gap));
  for (double component : u) length = worse(length, std::abs(component));
  force = largest(force), length = largest(length);

  std::vector<double> nodal;
  for (const auto& state : solution.contact) nodal.push_back(state.normalForce);
  nodal = contact.nodalForce(nodal);
  Violations worst;
  for (std::size_t i = 0; i < contact.interfaces.nodes.size(); ++i) {
    const auto& node = contact.interfaces.nodes[i];
    const auto& state = solution.contact[i];
    double distance = node.master < 0 ? -obstacle * node.normal[1] : 0, slip = 0;
    for (std::size_t d = 0; d < dimension; ++d) {
      const double disc =
          node.master < 0 ? 0 : u[dimension * static_cast<std::size_t>(node.master) + d];
      distance +=
          node.normal[d] * (u[dimension * static_cast<std::size_t>(node.globalNode) + d] - disc);
      slip += std::abs(state.frictionForce[d] -
                       (d == 0 ? solution.at.friction * state.normalForce : 0));
      const double onPad = nodal[i] * (node.normal[d] + (d == 0 ? solution.at.friction : 0));
      check(VecSetValue(rest, mesh.dimension * node.globalNode + static_cast<PetscInt>(d), -onPad,
                        ADD_VALUES));
      if (node.master >= 0)
        check(VecSetValue(rest, mesh.dimension * node.master + static_cast<PetscInt>(d), onPad,
                          ADD_VALUES));
    }
    worst.gap = worse(worst.gap, std::abs(state.gap - distance) / length);
    worst.penetration = worse(worst.penetration, -std::min(state.gap, state.coefficient) / length);
    worst.tension = worse(worst.tension, -state.normalForce / force);
    worst.complementarity = worse(
        worst.complementarity, std::abs(state.coefficient * state.normalForce) / (length * force));
    worst.coulomb = worse(worst.coulomb, slip / force);
  }
  check(VecAssemblyBegin(rest));
  check(VecAssemblyEnd(rest));
  const PetscScalar* values = nullptr;
  check(VecGetArrayRead(rest, &values));
  const auto& held = contact.interfaces.constraints.held;
  for (std::size_t row = 0; row < held.size(); ++row)
    if (!held[row]) worst.equilibrium = worse(worst.equilibrium, std::abs(values[row]) / force);
  check(VecRestoreArrayRead(rest, &values));
  for (double* value : {&worst.gap, &worst.penetration, &worst.tension, &worst.complementarity,
                        &worst.coulomb, &worst.equilibrium})
    *value = largest(*value);
  return worst;
}

/// What the contact as a whole transmits, from the nodal forces.
struct Transmitted {
  double normal = 0;    ///< Σ R_N
  double friction = 0;  ///< Σ R_T along x
  double centre = 0;    ///< x of the centre of pressure
};

/// Collective.
inline Transmitted transmitted(const analysis::Analysis& analysis,
                               const steady::Solution& solution) {
  Transmitted sums;
  for (std::size_t i = 0; i < solution.contact.size(); ++i) {
    sums.normal += solution.contact[i].normalForce;
    sums.friction += solution.contact[i].frictionForce[0];
    sums.centre +=
        solution.contact[i].normalForce * analysis.model.contact.interfaces.nodes[i].position[0];
  }
  sums.normal = total(sums.normal), sums.friction = total(sums.friction),
  sums.centre = total(sums.centre) / sums.normal;
  return sums;
}

}  // namespace squeal::test
