// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Derivatives of the eigenvalues at a point of a sweep with respect to the swept parameters, and
/// to the properties of materials, springs, bushings and point masses.
#include <vector>

#include "algebra/linalg/complex.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/sensitivity/derive.hpp"
#include "eigen/sensitivity/null_vectors.hpp"
#include "eigen/sensitivity/sensitivity.hpp"
#include "eigen/sweep/parameters.hpp"
#include "model/contact/coupled.hpp"
#include "model/elasticity/attached_parts.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"
#include "problem/terms/friction_work.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::terms {

/// The system and the steady state of a point of a sweep. All members except `at` are borrowed.
struct BodyPoint {
  sweep::Parameters at;
  const contact::CoupledSystem& system;
  const steady::Solution& solution;
  Mat prestress = nullptr;  ///< K_σ of the steady state; null: none
};

/// Computes total derivatives of eigenvalues, which include the change of the steady state.
class Influences {
 public:
  /// Borrows mesh, bodies and contact during the lifetime of the object.
  Influences(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
             const contact::Contact& contact, const Settings& settings)
      : mesh_(mesh), bodies_(bodies), contact_(contact), settings_(settings) {}

  /// Collective. Appends to ComplexModes::sensitivities an entry for each shape of the point.
  /// `pencil` contains the terms of the point. The derivatives [M.46] include the terms that depend
  /// on the steady state; the active set and the matrix of modal damping are held constant. The
  /// parameters are friction, speed, pressure and damping as in sweep::Parameters, and factors on
  /// material properties and on attachments: young_GROUP on all moduli of a material group (ds/d ln
  /// E), density_GROUP on its density (ds/d ln ρ), damping_GROUP on its damping, if it has any, one
  /// factor each on the stiffness and on the damping of each spring and bushing, and one on each
  /// point mass. The search for left vectors starts from `start`. Throws Error if the change of the
  /// steady state does not converge.
  void derive(pencil::ComplexModes& point, const pencil::Pencil& pencil, const BodyPoint& state,
              const sensitivity::StartSpace& start);

  /// Collective. Returns the forms yᴴ (∂P/∂θ) x of the same parameters θ at a point, as a function
  /// of the eigenvalue and its vectors. The returned function borrows the object and the arguments.
  sensitivity::Forms forms(const pencil::Pencil& pencil, const BodyPoint& state);

 private:
  enum class Quantity;
  struct Influence;
  struct Projected;
  std::vector<Influence> influences(const BodyPoint& state);
  void addSteadyChange(const BodyPoint& state, const steady::Problem& problem,
                       Influence& influence) const;
  Complex materialForm(const Influence& influence, const BodyPoint& state,
                       const Projected& pair) const;
  Complex steadyForm(const Influence& influence, const BodyPoint& state,
                     const Projected& pair) const;
  Projected project(const BodyPoint& state, const sensitivity::EigenTriple& triple) const;

  const mesh::Mesh& mesh_;
  const elasticity::Bodies& bodies_;
  const contact::Contact& contact_;
  Settings settings_;
  std::vector<elasticity::MaterialPart> parts_;     // [material group], made when first needed
  std::vector<elasticity::AttachedPart> attached_;  // likewise
};

}  // namespace squeal::terms
