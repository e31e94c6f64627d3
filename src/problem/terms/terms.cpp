// SPDX-License-Identifier: BSD-2-Clause
#include "problem/terms/terms.hpp"

#include "problem/terms/body_matrices.hpp"
#include "problem/terms/friction_work.hpp"

namespace squeal::terms {
namespace {

/// Appends the terms f^a S_aᵀ N X T of one matrix X for all powers a, at the nodes that slide.
void addFriction(std::vector<pencil::Term>& terms, const BodyMatrix& role,
                 const contact::Contact& contact, const contact::CoupledSystem& system,
                 const std::vector<contact::Slip>& slip, const std::vector<unsigned char>& slides) {
  for (const int exponent : contact.frictionExponents()) {
    const OwnedMat rows = contact.slipRows(system.transformation(), slip, slides, exponent);
    terms.push_back({.matrix = role.projection.friction(rows),
                     .power = role.power,
                     .frictionExponent = exponent,
                     .speedExponent = role.speedExponent,
                     .dampingExponent = role.dampingExponent,
                     .ofFriction = true});
  }
}

/// Appends these terms for each matrix X of the bodies.
void addFriction(std::vector<pencil::Term>& terms, const contact::Contact& contact,
                 const contact::CoupledSystem& system, const std::vector<contact::Slip>& slip,
                 const std::vector<unsigned char>& slides) {
  for (const auto& role : bodyMatrices(system))
    if (role.projection) addFriction(terms, role, contact, system, slip, slides);
}

/// Appends the terms of the change −B w* of the friction force [4.7, M.21].
void addVelocityResponse(std::vector<pencil::Term>& terms, const contact::Contact& contact,
                         const contact::CoupledSystem& system, const steady::Solution& solution,
                         const Settings& settings) {
  const FrictionState friction = frictionState(contact, solution, settings);
  const Mat trial = system.transformation().trial;
  OwnedMat jumps, answered, damping;
  check(MatMatMult(contact.sliding.jump, trial, MAT_INITIAL_MATRIX, PETSC_DEFAULT, jumps.out()));
  check(MatMatMult(friction.response, jumps, MAT_INITIAL_MATRIX, PETSC_DEFAULT, answered.out()));
  check(MatTransposeMatMult(jumps, answered, MAT_INITIAL_MATRIX, PETSC_DEFAULT, damping.out()));
  // With a constant law, only round-off remains in the plane, and also if supports prevent motion
  // across the sliding direction.
  PetscReal size = 0, scale = 0;
  check(MatNorm(damping, NORM_FROBENIUS, &size));
  check(MatNorm(friction.response, NORM_FROBENIUS, &scale));
  if (size <= 1e-14 * scale) return;
  check(MatSetOption(damping, MAT_SYMMETRIC, PETSC_TRUE));
  terms.push_back({.matrix = std::move(damping), .power = 1, .ofFriction = true});
  if (!contact.sliding.convected) return;
  OwnedMat convected, turned, stiffness;
  check(MatMatMult(contact.sliding.convected, trial, MAT_INITIAL_MATRIX, PETSC_DEFAULT,
                   convected.out()));
  check(MatMatMult(friction.response, convected, MAT_INITIAL_MATRIX, PETSC_DEFAULT, turned.out()));
  check(MatTransposeMatMult(jumps, turned, MAT_INITIAL_MATRIX, PETSC_DEFAULT, stiffness.out()));
  terms.push_back(
      {.matrix = std::move(stiffness), .factor = -solution.at.speed, .ofFriction = true});
}

}  // namespace

std::vector<BodyMatrix> bodyMatrices(const contact::CoupledSystem& system) {
  const auto& projections = system.projections();
  return {{.projection = projections.stiffness},
          {.projection = projections.mass, .power = 2},
          {.projection = projections.damping, .power = 1, .dampingExponent = 1},
          {.projection = projections.gyroscopic, .power = 1, .speedExponent = 1},
          {.projection = projections.rotationStiffness, .speedExponent = 2}};
}

pencil::Pencil affineTerms(const contact::Contact& contact, const contact::CoupledSystem& system) {
  std::vector<pencil::Term> terms;
  for (const auto& role : bodyMatrices(system))
    if (role.projection)
      terms.push_back({.matrix = role.projection.matrix.share(),
                       .power = role.power,
                       .speedExponent = role.speedExponent,
                       .dampingExponent = role.dampingExponent});
  pencil::Pencil pencil(std::move(terms));
  pencil.add(slidingTerms(contact, system, system.closed()));
  return pencil;
}

std::vector<pencil::Term> slidingTerms(const contact::Contact& contact,
                                       const contact::CoupledSystem& system,
                                       const std::vector<unsigned char>& slides) {
  std::vector<pencil::Term> terms;
  if (contact.slipIsConstant())
    addFriction(terms, contact, system, contact.slip(1, nullptr), slides);
  return terms;
}

std::vector<pencil::Term> pointTerms(const contact::Contact& contact,
                                     const contact::CoupledSystem& system,
                                     const steady::Solution& solution, Mat prestressChange,
                                     const Settings& settings) {
  std::vector<pencil::Term> terms;
  const bool friction = contact.hasFriction(solution.at.friction);
  if (friction && !contact.slipIsConstant())
    addFriction(terms, contact, system, solution.slip, solution.closed);
  if (friction && settings.frictionDamping)
    addVelocityResponse(terms, contact, system, solution, settings);
  if (prestressChange) {
    contact::Projection change =
        contact::project(contact, system.transformation(), prestressChange);
    addFriction(terms, {.projection = change}, contact, system, solution.slip, solution.closed);
    terms.push_back({.matrix = std::move(change.matrix)});
  }
  return terms;
}

bool hasPointTerms(const contact::Contact& contact, double friction, bool prestressed,
                   const Settings& settings) {
  // In the plane, the direction of a slip with a constant law does not turn.
  const bool turns = settings.frictionDamping && contact.mesh->dimension == 3;
  return prestressed || (contact.hasFriction(friction) && (!contact.slipIsConstant() || turns));
}

std::vector<double> responseForces(const std::vector<unsigned char>& closed,
                                   std::vector<double> normalForce, const Settings& settings) {
  if (!settings.frictionDamping) return std::vector<double>(normalForce.size(), 0.0);
  for (std::size_t i = 0; i < normalForce.size(); ++i)
    if (!closed[i]) normalForce[i] = 0;
  return normalForce;
}

}  // namespace squeal::terms
