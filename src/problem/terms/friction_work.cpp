// SPDX-License-Identifier: BSD-2-Clause
#include "problem/terms/friction_work.hpp"

#include "base/petsc/arrays.hpp"
#include "eigen/sweep/parameters.hpp"
#include "model/contact/response.hpp"
#include "problem/terms/terms.hpp"

namespace squeal::terms {

MotionForces motionForces(const elasticity::Bodies& bodies, const Motion& motion) {
  const auto& [at, s, u, prestress] = motion;
  MotionForces result{.forces = linalg::ComplexVector::like(u.real),
                      .elastic = product(bodies.stiffness, u),
                      .inertia = product(bodies.mass, u)};
  auto& r = result.forces;
  add(r, 1, result.elastic);
  if (prestress) add(r, 1, product(prestress, u));
  if (bodies.rotationStiffness) add(r, at.speed * at.speed, product(bodies.rotationStiffness, u));
  result.energy = std::norm(s) * dot(u, result.inertia).real() + dot(u, r).real();
  add(r, s * s, result.inertia);
  if (bodies.damping) {
    result.damped = product(bodies.damping, u);
    add(r, s * at.damping, result.damped);
  }
  if (bodies.gyroscopic) add(r, s * at.speed, product(bodies.gyroscopic, u));
  return result;
}

std::vector<ComplexPoint> atPadNodes(const contact::Contact& contact,
                                     const linalg::ComplexVector& u) {
  const int dimension = contact.mesh->dimension;
  std::vector<ComplexPoint> points;
  const ReadArray real(u.real), imaginary(u.imaginary);
  for (const auto& node : contact.interfaces.nodes) {
    ComplexPoint point{};
    for (int d = 0; d < dimension; ++d)
      point[d] = {real[dimension * node.node + d], imaginary[dimension * node.node + d]};
    points.push_back(point);
  }
  return points;
}

ContactMotion contactMotion(const contact::Contact& contact,
                            const std::vector<unsigned char>& closed,
                            const linalg::ComplexVector& u, const linalg::ComplexVector& forces) {
  ContactMotion motion{product(contact.sliding.jump, u), {}, {}};
  if (contact.sliding.convected) motion.convected = product(contact.sliding.convected, u);
  const int component = contact.mesh->dimension - 1;  // the row of the gap
  std::vector<double> real, imaginary;
  for (const auto& reaction : atPadNodes(contact, product(contact.sliding.reaction, forces)))
    real.push_back(reaction[component].real()), imaginary.push_back(reaction[component].imag());
  real = contact.nodalForce(real, closed), imaginary = contact.nodalForce(imaginary, closed);
  for (std::size_t k = 0; k < real.size(); ++k)
    motion.nodalForce.emplace_back(real[k], imaginary[k]);
  return motion;
}

FrictionState frictionState(const contact::Contact& contact, const sweep::Parameters& at,
                            std::vector<contact::Slip> slip,
                            const std::vector<double>& responseForce) {
  OwnedMat response = contact::distributedResponse(contact, slip, responseForce, at.friction);
  OwnedMat turning = response.share();
  if (!contact.law.constant()) {
    auto turned = slip;
    for (auto& one : turned) one.slope = 0;
    turning = contact::distributedResponse(contact, turned, responseForce, at.friction);
  }
  return {at, std::move(slip), std::move(response), std::move(turning)};
}

FrictionState frictionState(const contact::Contact& contact, const steady::Solution& solution,
                            const Settings& settings) {
  std::vector<double> normalForce;
  for (const auto& state : solution.contact) normalForce.push_back(state.normalForce);
  return frictionState(contact, solution.at, solution.slip,
                       responseForces(solution.closed, normalForce, settings));
}

std::vector<FrictionForm> frictionForms(const contact::Contact& contact, const FrictionState& state,
                                        Complex s, const std::vector<ComplexPoint>& test,
                                        const ContactMotion& motion) {
  linalg::ComplexVector velocity = linalg::ComplexVector::like(motion.jump.real);
  add(velocity, s, motion.jump);
  if (motion.convected.real) add(velocity, -state.at.speed, motion.convected);
  const auto turning = atPadNodes(contact, product(state.response, velocity));
  std::vector<FrictionForm> forms;
  for (std::size_t k = 0; k < contact.interfaces.nodes.size(); ++k) {
    const auto& slip = state.slip[k];
    FrictionForm form{};
    for (std::size_t d = 0; d < 3; ++d) {
      form.pressing += std::conj(test[k][d]) * slip.direction[d];
      form.turning += std::conj(test[k][d]) * turning[k][d];
    }
    form.pressing *= slip.friction(state.at.friction) * motion.nodalForce[k];
    forms.push_back(form);
  }
  return forms;
}

std::vector<pencil::GrowthParts> frictionGrowth(const contact::Contact& contact,
                                                const std::vector<unsigned char>& closed,
                                                const FrictionState& friction, const Motion& mode,
                                                const MotionForces& force) {
  const ContactMotion motion = contactMotion(contact, closed, mode.u, force.forces);
  const auto jumps = atPadNodes(contact, motion.jump);
  linalg::ComplexVector rate = linalg::ComplexVector::like(mode.u.real);
  add(rate, mode.s, motion.jump);
  const auto turned = atPadNodes(contact, product(friction.turning, rate)),
             answered = atPadNodes(contact, product(friction.response, rate));
  std::vector<pencil::GrowthParts> growth;
  std::size_t k = 0;
  for (const auto& form : frictionForms(contact, friction, mode.s, jumps, motion)) {
    const auto part = [&](Complex value) {
      return -(std::conj(mode.s) * value).real() / force.energy;
    };
    Complex turning = 0, jump = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      turning += std::conj(jumps[k][d]) * turned[k][d];
      jump += std::conj(jumps[k][d]) * answered[k][d];
    }
    growth.push_back({.follower = part(form.pressing),
                      .turning = part(turning),
                      .slope = part(jump - turning),
                      .convective = part(form.turning - jump)});
    ++k;
  }
  return growth;
}

}  // namespace squeal::terms
