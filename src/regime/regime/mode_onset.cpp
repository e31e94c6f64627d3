// SPDX-License-Identifier: BSD-2-Clause
#include "regime/regime/mode_onset.hpp"

#include <mpi.h>

#include <cmath>

#include "base/petsc/check.hpp"
#include "base/system/mpi.hpp"
#include "problem/terms/friction_work.hpp"
#include "regime/regime/contact_nodes.hpp"

namespace squeal::regime {
namespace {

using march::NodeMotion;
using march::OnsetEvent;
using terms::ComplexPoint;

/// Collective. Returns E⁻¹ v of complex values v at the nodes.
std::vector<Complex> coefficients(const contact::Contact& contact,
                                  const std::vector<Complex>& nodal) {
  std::vector<double> real, imaginary;
  for (const Complex value : nodal) real.push_back(value.real()), imaginary.push_back(value.imag());
  real = contact.gapCoefficients(real), imaginary = contact.gapCoefficients(imaginary);
  std::vector<Complex> result;
  for (std::size_t i = 0; i < real.size(); ++i) result.emplace_back(real[i], imaginary[i]);
  return result;
}

/// Collective. Returns the amplitudes of a motion u e^{st} with the nodal forces r at the nodes.
std::vector<NodeMotion> motionAt(const contact::Contact& contact, const std::vector<Node>& nodes,
                                 Complex s, const linalg::ComplexVector& u,
                                 const linalg::ComplexVector& r) {
  const auto forces = terms::atPadNodes(contact, product(contact.sliding.reaction, r)),
             nodal = terms::atPadNodes(contact, r),
             jumps = terms::atPadNodes(contact, product(contact.sliding.jump, u));
  std::vector<NodeMotion> motion(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    motion[i].normalForce = forces[i][contact.mesh->dimension - 1];
  for (int a = 0; a + 1 < contact.mesh->dimension; ++a) {
    std::vector<Complex> slip(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (int d = 0; d < 3; ++d) {
        slip[i] += nodes[i].tangents[a][d] * jumps[i][d];
        motion[i].shear[a] += nodes[i].tangents[a][d] * nodal[i][d];
      }
    slip = coefficients(contact, slip);
    for (std::size_t i = 0; i < nodes.size(); ++i) motion[i].rate[a] = s * slip[i];
  }
  return motion;
}

/// Collective. Replaces an onset by the first one of all ranks.
void takeFirst(MPI_Comm comm, ModeOnset& mode) {
  const double own = mode.onset.factor;
  const auto first = mpi::minLocated(comm, own);
  // `turning` is computed at the factor of this rank's event.
  const double turning = mpi::max(comm, std::isfinite(own) ? mode.onset.turning / own : 0.0);
  mpi::broadcast(comm, mode.onset, first.rank);
  mpi::broadcast(comm, mode.position, first.rank);
  mpi::broadcast(comm, mode.interface, first.rank);
  mode.onset.node = 0;
  mode.onset.turning = std::isfinite(first.value) ? turning * first.value : 0;
}

}  // namespace

std::vector<ModeOnset> onsets(const elasticity::Bodies& bodies, const contact::Contact& contact,
                              const steady::Solution& solution, const pencil::ComplexModes& point,
                              Mat prestress) {
  std::vector<ModeOnset> result;
  const auto nodes = ownNodes(contact, solution);
  for (const auto& shape : point.shapes) {
    const auto& eigenvalue = point.eigenvalues[shape.index];
    if (!eigenvalue.unstable) continue;
    const auto u = linalg::ComplexVector::copied(shape.real, shape.imaginary);
    const auto forces = terms::motionForces(bodies, {point.at, eigenvalue.s, u, prestress});
    ModeOnset mode{.at = point.at, .mode = shape.index, .s = eigenvalue.s};
    mode.onset = firstEvent(nodes, motionAt(contact, nodes, eigenvalue.s, u, forces.forces));
    if (mode.onset.event != OnsetEvent::none) {
      mode.position = nodes[mode.onset.node].position;
      mode.interface = nodes[mode.onset.node].interface;
    }
    takeFirst(contact.mesh->comm, mode);
    // ½ of the largest |Re(s u e^{iφ})|² in M.
    const auto inertia = product(bodies.mass, u);
    const linalg::ComplexVector conjugate = linalg::ComplexVector::copied(u.real, u.imaginary);
    check(VecScale(conjugate.imaginary, -1));
    const Complex squares = dot(conjugate, inertia);
    const double norm = std::norm(eigenvalue.s);
    mode.kinetic = mode.onset.factor * mode.onset.factor * norm *
                   (dot(u, inertia).real() + std::abs(squares)) / 4;
    result.push_back(std::move(mode));
  }
  return result;
}

}  // namespace squeal::regime
