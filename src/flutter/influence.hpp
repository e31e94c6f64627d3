#pragma once
/// What the eigenvalues depend on: friction, speed and pressure of the point, factors on moduli and on density of each body. Here the
/// pencil meets the matrices it is made of.
#include <vector>

#include "contact/coupled.hpp"
#include "flutter/flutter.hpp"
#include "flutter/left.hpp"
#include "flutter/work.hpp"

namespace squeal::flutter {

class Influences {
 public:
  /// Borrows all for its life.
  Influences(const mesh::Mesh& mesh, const elasticity::Bodies& bodies, const contact::Contact& contact)
      : mesh_(mesh), bodies_(bodies), contact_(contact) {}

  /// Collective. Fills FrictionPoint::sensitivities for all shapes of the point whose terms the pencil holds: total derivatives of
  /// eigenvalues, of the terms that follow the steady state, too, while the active set stays. Modal damping is taken as given.
  /// `prestress`: K_σ of the steady state, may be null. Parameters: friction (f), speed (v), pressure (a factor on all pressures and
  /// held displacements), and factors young_BODY on all moduli of a body and density_BODY on its density, ds/d ln E and ds/d ln ρ.
  void derive(FrictionPoint& point, const Pencil& pencil, const contact::AssociatedSystem& system, const steady::Solution& solution,
              const StartSpace& start, Mat prestress);

 private:
  struct Parameter;
  struct Projected;
  std::vector<Parameter> parameters(const contact::AssociatedSystem& system, const steady::Solution& solution, Mat prestress);
  std::complex<double> materialForm(const Parameter& parameter, const steady::Solution& solution, const Projected& pair,
                                    Mat prestress) const;
  std::complex<double> steadyForm(const Parameter& parameter, const steady::Solution& solution, const Projected& pair,
                                  Mat prestress) const;
  std::complex<double> frictionSum(const FrictionState& state, const steady::Solution& solution, const Projected& pair) const;
  Projected project(const contact::AssociatedSystem& system, const steady::Solution& solution, const EigenTriple& triple,
                    Mat prestress) const;

  const mesh::Mesh& mesh_;
  const elasticity::Bodies& bodies_;
  const contact::Contact& contact_;
  std::vector<elasticity::BodyPart> parts_;  // [body], made when first needed
};

}  // namespace squeal::flutter
