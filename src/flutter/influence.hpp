#pragma once
/// What the eigenvalues depend on: the parameters of the point, moduli and density of each body.
/// Here the pencil meets the matrices it is made of.
#include <vector>

#include "contact/coupled.hpp"
#include "elasticity/elasticity.hpp"
#include "flutter/work.hpp"
#include "mesh/mesh.hpp"
#include "pencil/complex_modes.hpp"
#include "pencil/pencil.hpp"
#include "sensitivity/derive.hpp"
#include "sensitivity/left.hpp"
#include "sensitivity/sensitivity.hpp"
#include "steady/steady.hpp"
#include "sweep/parameters.hpp"

namespace squeal::flutter {

/// One point of a sweep, in the terms of the bodies; all borrowed.
struct BodyPoint {
  sweep::Parameters at;
  const contact::CoupledSystem& system;
  const steady::Solution& solution;
  Mat prestress = nullptr;  ///< K_σ of the steady state; null: none
};

class Influences {
 public:
  /// Borrows all for its life.
  Influences(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
             const contact::Contact& contact)
      : mesh_(mesh), bodies_(bodies), contact_(contact) {}

  /// Collective. Fills ComplexModes::sensitivities for all shapes of the point, whose terms the
  /// pencil holds: total derivatives of the eigenvalues, by the terms that follow the steady state,
  /// too, while the active set stays. Modal damping is taken as given. Parameters: friction, speed,
  /// pressure and damping as in Parameters, and factors young_BODY on all moduli of a body (ds/d ln
  /// E) and density_BODY on its density (ds/d ln ρ).
  void derive(pencil::ComplexModes& point, const pencil::Pencil& pencil, const BodyPoint& state,
              const sensitivity::StartSpace& start);

 private:
  struct Influence;
  struct Projected;
  std::vector<Influence> influences(const BodyPoint& state);
  void followSteadyState(const BodyPoint& state, const steady::Problem& problem,
                         Influence& influence) const;
  std::complex<double> materialForm(const Influence& influence, const BodyPoint& state,
                                    const Projected& pair) const;
  std::complex<double> steadyForm(const Influence& influence, const BodyPoint& state,
                                  const Projected& pair) const;
  std::complex<double> frictionSum(const FrictionState& friction, const BodyPoint& state,
                                   const Projected& pair) const;
  Projected project(const BodyPoint& state, const sensitivity::EigenTriple& triple) const;

  const mesh::Mesh& mesh_;
  const elasticity::Bodies& bodies_;
  const contact::Contact& contact_;
  std::vector<elasticity::BodyPart> parts_;  // [body], made when first needed
};

}  // namespace squeal::flutter
