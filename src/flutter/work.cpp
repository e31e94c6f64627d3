#include "flutter/work.hpp"

#include "flutter/terms.hpp"
#include "petsc/arrays.hpp"
#include "sweep/parameters.hpp"

namespace squeal::flutter {
namespace {

/// Returns the values of a nodal vector in the rows of the pad nodes, [owned contact node].
std::vector<ComplexPoint> atPadNodes(const contact::Contact& contact,
                                     const linalg::ComplexVector& u) {
  const int dimension = contact.mesh->dimension;
  std::vector<ComplexPoint> points;
  const ReadArray real(u.real), imaginary(u.imaginary);
  for (const auto& node : contact.nodes) {
    ComplexPoint point{};
    for (int d = 0; d < dimension; ++d)
      point[d] = {real[dimension * node.node + d], imaginary[dimension * node.node + d]};
    points.push_back(point);
  }
  return points;
}

Complex along(const mesh::Point& direction, const ComplexPoint& u) {
  return direction[0] * u[0] + direction[1] * u[1] + direction[2] * u[2];
}

}  // namespace

MotionForces motionForces(const elasticity::Bodies& bodies, const sweep::Parameters& at, Complex s,
                          const linalg::ComplexVector& u, Mat prestress) {
  MotionForces result{product(bodies.stiffness, u), 0};
  auto& r = result.forces;
  if (prestress) add(r, 1, product(prestress, u));
  if (bodies.rotationStiffness) add(r, at.speed * at.speed, product(bodies.rotationStiffness, u));
  const linalg::ComplexVector inertia = product(bodies.mass, u);
  result.energy = std::norm(s) * dot(u, inertia).real() + dot(u, r).real();
  add(r, s * s, inertia);
  if (bodies.damping) add(r, s * at.damping, product(bodies.damping, u));
  if (bodies.gyroscopic) add(r, s * at.speed, product(bodies.gyroscopic, u));
  return result;
}

std::vector<ComplexPoint> contactJump(const contact::Contact& contact,
                                      const linalg::ComplexVector& u) {
  return atPadNodes(contact, product(contact.jump, u));
}

ContactMotion contactMotion(const contact::Contact& contact, const linalg::ComplexVector& u,
                            const linalg::ComplexVector& forces) {
  ContactMotion motion{contactJump(contact, u), {}, {}};
  motion.convected = contact.convected
                         ? atPadNodes(contact, product(contact.convected, u))
                         : std::vector<ComplexPoint>(contact.nodes.size(), ComplexPoint{});
  const int component = contact.mesh->dimension - 1;  // the row of the gap
  for (const auto& row : atPadNodes(contact, product(contact.reaction, forces)))
    motion.normalForce.push_back(row[component]);
  return motion;
}

FrictionForm frictionForm(const contact::Contact& contact, const FrictionState& state, Complex s,
                          const ComplexPoint& test, const ContactMotion& motion, std::size_t k) {
  const auto& slip = state.slip[k];
  const auto [across, alongSlip] = contact::velocityResponse(
      slip, state.responseForce[k], state.at.friction, contact.mesh->dimension);
  ComplexPoint velocity, conjugate;
  for (std::size_t d = 0; d < 3; ++d) {
    velocity[d] = s * motion.jump[k][d] - state.at.speed * motion.convected[k][d];
    conjugate[d] = std::conj(test[d]);
  }
  const Complex testAlong = along(slip.direction, conjugate),
                velocityAlong = along(slip.direction, velocity),
                velocityNormal = along(contact.nodes[k].normal, velocity),
                testNormal = along(contact.nodes[k].normal, conjugate);
  Complex product = 0;
  for (std::size_t d = 0; d < 3; ++d) product += conjugate[d] * velocity[d];
  return {state.at.friction * slip.law * testAlong * motion.normalForce[k],
          across * (product - testAlong * velocityAlong - testNormal * velocityNormal) +
              alongSlip * testAlong * velocityAlong};
}

FrictionState frictionState(const contact::Contact& contact, const steady::Solution& solution) {
  std::vector<double> normalForce;
  for (const auto& state : solution.contact) normalForce.push_back(state.normalForce);
  return {solution.at, solution.slip, responseForces(contact, solution.closed, normalForce)};
}

std::vector<double> frictionWork(const contact::Contact& contact, const elasticity::Bodies& bodies,
                                 const steady::Solution& solution, const sweep::Parameters& at,
                                 Complex s, const linalg::ComplexVector& u, Mat prestress) {
  const MotionForces forces = motionForces(bodies, at, s, u, prestress);
  const ContactMotion motion = contactMotion(contact, u, forces.forces);
  const FrictionState state = frictionState(contact, solution);
  std::vector<double> work;
  for (std::size_t k = 0; k < contact.nodes.size(); ++k) {
    const FrictionForm form = frictionForm(contact, state, s, motion.jump[k], motion, k);
    work.push_back(solution.closed[k]
                       ? -(std::conj(s) * (form.pressing + form.turning)).real() / forces.energy
                       : 0);
  }
  return work;
}

}  // namespace squeal::flutter
