// SPDX-License-Identifier: BSD-2-Clause
#include "problem/terms/influence.hpp"

#include "algebra/linalg/complexvector.hpp"
#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "problem/terms/terms.hpp"
#include "steady/steady/change.hpp"

namespace squeal::terms {
namespace {

/// The step of central differences along the change of the steady state. It balances a truncation
/// error proportional to its square against round-off divided by the step.
constexpr double step = 1e-4;

/// Returns true if the terms of the point depend on the steady state by the direction and law of
/// slip, by friction damping or by prestress.
bool dependsOnSteadyState(const contact::Contact& contact, const sweep::Parameters& at,
                          Mat prestress, const Settings& settings) {
  const bool damping =
      settings.frictionDamping && (contact.mesh->dimension == 3 || !contact.law.constant());
  return prestress || (contact.hasFriction(at.friction) && (damping || !contact.slipIsConstant()));
}

}  // namespace

/// A property of a material.
enum class Influences::Quantity { moduli, density, damping };

/// A parameter θ, and the change of the steady state with θ.
struct Influences::Influence {
  std::string name;
  double sweep::Parameters::*member = nullptr;  // θ in the point; null: θ belongs to a material
  int material = -1;                            // index into Mesh::materialGroups
  Quantity quantity = Quantity::moduli;         // of the material, on which θ is a factor
  int attached = -1;                            // θ is a factor on this spring, bushing or mass
  double size = 1;                              // θ, for the step of differences
  steady::Change change = {};
  std::vector<double> responseForce = {};  // its change
  OwnedMat prestress = {};                 // its change
};

/// A triple on all nodal displacements, with
///   yᴴ L(f)ᵀ X T x = zᴴ X u,   u = T x,   z = L(f) y.
struct Influences::Projected {
  Complex s;
  linalg::ComplexVector u, z;  // T x, L(f) y
  ContactMotion motion;
  std::vector<ComplexPoint> test;  // [T y]
};

void Influences::derive(pencil::ComplexModes& point, const pencil::Pencil& pencil,
                        const BodyPoint& state, const sensitivity::StartSpace& start) {
  if (point.shapes.empty()) return;
  sensitivity::deriveShapes(point, pencil, start, state.system, forms(pencil, state));
}

sensitivity::Forms Influences::forms(const pencil::Pencil& pencil, const BodyPoint& state) {
  const auto list = std::make_shared<const std::vector<Influence>>(influences(state));
  return [this, list, &pencil, &state](const sensitivity::EigenTriple& triple) {
    const Projected pair = project(state, triple);
    std::vector<pencil::Derivative> found;
    for (const auto& influence : *list) {
      const Complex form =
          influence.member ? sensitivity::parameterForm(pencil, state.at, triple, influence.member)
                           : 0;
      found.push_back({influence.name, form + materialForm(influence, state, pair) +
                                           steadyForm(influence, state, pair)});
    }
    return found;
  };
}

std::vector<Influences::Influence> Influences::influences(const BodyPoint& state) {
  if (parts_.empty()) attached_ = elasticity::attachedParts(mesh_, bodies_);
  for (int group = parts_.size(); group < std::ssize(mesh_.materialGroups); ++group)
    parts_.push_back(elasticity::materialPart(mesh_, bodies_, group));
  std::vector<Influence> list;
  for (const auto& parameter : sweep::allParameters) {
    const bool isFriction = parameter.value == &sweep::Parameters::friction;
    list.push_back({.name = parameter.name,
                    .member = parameter.value,
                    .size = isFriction ? 1 : state.at.*parameter.value});
  }
  for (int group = 0; group < std::ssize(mesh_.materialGroups); ++group) {
    const auto add = [&](const char* prefix, Quantity quantity) {
      list.push_back({.name = prefix + mesh_.materialGroups[group].name,
                      .material = group,
                      .quantity = quantity});
    };
    add("young_", Quantity::moduli);
    add("density_", Quantity::density);
    if (parts_[group].massDamping > 0 || parts_[group].stiffnessDamping > 0)
      add("damping_", Quantity::damping);
  }
  for (int i = 0; i < std::ssize(attached_); ++i)
    list.push_back({.name = attached_[i].parameter, .attached = i});
  if (!dependsOnSteadyState(contact_, state.at, state.prestress, settings_)) return list;
  const steady::Problem problem(mesh_, bodies_, contact_);
  for (auto& influence : list) {
    const bool damps = influence.member == &sweep::Parameters::damping ||
                       influence.quantity == Quantity::damping ||
                       (influence.attached >= 0 && attached_[influence.attached].damping);
    if (!damps) addSteadyChange(state, problem, influence);
  }
  return list;
}

void Influences::addSteadyChange(const BodyPoint& state, const steady::Problem& problem,
                                 Influence& influence) const {
  const double v = state.at.speed;
  const OwnedVec force = elasticity::nodalVector(mesh_);
  steady::Cause cause;
  cause.force = force;
  //   dr = factor (K^R u − centrifugal forces), of one body or of all
  const auto inertiaForms = [&](Mat rotationStiffness, Vec centrifugal, double factor) {
    if (rotationStiffness) check(MatMult(rotationStiffness, state.solution.displacement, force));
    check(VecAXPY(force, -1, centrifugal));
    check(VecScale(force, factor));
  };
  if (influence.member == &sweep::Parameters::friction) cause.friction = 1;
  if (influence.member == &sweep::Parameters::speed) {
    inertiaForms(bodies_.rotationStiffness, bodies_.centrifugal, 2 * v);
    cause.speed = 1;
  }
  if (influence.member == &sweep::Parameters::pressure) {
    check(VecAXPY(force, -1, bodies_.load));
    check(VecAXPY(force, 1, bodies_.centrifugal));
    if (bodies_.constantLoad) check(VecAXPY(force, 1, bodies_.constantLoad));
    cause.held = contact_.kinematics.offset;
  }
  if (influence.attached >= 0) {
    const auto& part = attached_[influence.attached];
    if (part.stiffness) check(MatMult(part.stiffness, state.solution.displacement, force));
    if (part.centrifugal) check(VecAXPY(force, -v * v, part.centrifugal));
    if (part.weight) check(VecAXPY(force, -1, part.weight));
  } else if (!influence.member) {
    const auto& part = parts_[influence.material];
    if (influence.quantity == Quantity::density) {
      inertiaForms(part.rotationStiffness, part.centrifugal, v * v);
      if (part.weight) check(VecAXPY(force, -1, part.weight));
    } else {
      check(MatMult(part.stiffness, state.solution.displacement, force));
    }
  }
  influence.change = steady::change(problem, state.solution, state.system, cause);
  influence.responseForce =
      responseForces(state.solution.closed, influence.change.normalForce, settings_);
  if (state.prestress)
    influence.prestress =
        elasticity::geometricStiffness(mesh_, bodies_, influence.change.displacement);
}

Influences::Projected Influences::project(const BodyPoint& state,
                                          const sensitivity::EigenTriple& triple) const {
  const Mat trial = state.system.transformation().trial;
  Projected pair{triple.s, product(trial, triple.x), product(trial, triple.y), {}, {}};
  pair.motion =
      contactMotion(contact_, state.solution.closed, pair.u,
                    motionForces(bodies_, {state.at, triple.s, pair.u, state.prestress}).forces);
  pair.test = atPadNodes(contact_, product(contact_.sliding.jump, pair.z));
  //   L(f) y = T y + f Nᵀ S y
  std::vector<double> alongReal, alongImaginary;
  for (std::size_t k = 0; k < contact_.interfaces.nodes.size(); ++k) {
    const auto& slip = state.solution.slip[k];
    Complex along = 0;
    for (std::size_t d = 0; d < 3; ++d) along += slip.direction[d] * pair.test[k][d];
    along *= slip.friction(state.at.friction);
    alongReal.push_back(along.real()), alongImaginary.push_back(along.imag());
  }
  alongReal = contact_.gapCoefficients(alongReal);
  alongImaginary = contact_.gapCoefficients(alongImaginary);
  const linalg::ComplexVector slips = linalg::ComplexVector::like(pair.z.real);
  {
    const WriteArray real(slips.real), imaginary(slips.imaginary);
    for (std::size_t k = 0; k < contact_.interfaces.nodes.size(); ++k) {
      if (!state.solution.closed[k]) continue;
      const PetscInt row =
          contact_.gapRow(contact_.interfaces.nodes[k]) - mesh_.dimension * mesh_.firstNode;
      real[row] = alongReal[k], imaginary[row] = alongImaginary[k];
    }
  }
  add(pair.z, 1, product(contact_.sliding.reaction, slips, true));
  return pair;
}

/// Returns zᴴ (∂P/∂θ) u for the matrices of one material [M.47]: K, C and K_σ for its moduli, or M,
/// C, G and K^R for its density, or C for its damping; or for those of a spring, bushing or mass.
Complex Influences::materialForm(const Influence& influence, const BodyPoint& state,
                                 const Projected& pair) const {
  if (influence.member) return 0;
  const auto form = [&](Mat matrix) { return matrix ? dot(pair.z, product(matrix, pair.u)) : 0; };
  const Complex s = pair.s;
  const double v = state.at.speed, c = state.at.damping;
  if (influence.attached >= 0) {
    const auto& part = attached_[influence.attached];
    return form(part.stiffness) + s * c * form(part.damping) + s * s * form(part.mass) +
           s * v * form(part.gyroscopic);
  }
  const auto& part = parts_[influence.material];
  if (influence.quantity == Quantity::damping)
    return s * c *
           (part.massDamping * form(part.mass) + part.stiffnessDamping * form(part.stiffness));
  if (influence.quantity == Quantity::density)
    return (s * s + s * c * part.massDamping) * form(part.mass) + s * v * form(part.gyroscopic) +
           v * v * form(part.rotationStiffness);
  Complex sum = (1.0 + s * c * part.stiffnessDamping) * form(part.stiffness);
  if (state.prestress)
    sum += form(elasticity::geometricStiffness(mesh_, bodies_, state.solution.displacement,
                                               influence.material));
  return sum;
}

/// Returns the part from the change of the steady state. The part of K_σ, which is linear in the
/// displacement, is exact; that of friction is a central difference.
Complex Influences::steadyForm(const Influence& influence, const BodyPoint& state,
                               const Projected& pair) const {
  if (!influence.change.displacement) return 0;
  Complex sum = 0;
  if (state.prestress) sum += dot(pair.z, product(influence.prestress, pair.u));
  Complex friction = 0;
  const double h = step * influence.size;
  const OwnedVec u = elasticity::nodalVector(mesh_);
  for (const double sign : {-1.0, 1.0}) {
    sweep::Parameters at = state.solution.at;
    if (influence.member) at.*influence.member += sign * h;
    check(VecWAXPY(u, sign * h, influence.change.displacement, state.solution.displacement));
    std::vector<double> force;
    for (std::size_t k = 0; k < influence.responseForce.size(); ++k)
      force.push_back(state.solution.contact[k].normalForce);
    force = responseForces(state.solution.closed, std::move(force), settings_);
    for (std::size_t k = 0; k < force.size(); ++k)
      force[k] += sign * h * influence.responseForce[k];
    FrictionState moved = frictionState(contact_, at, contact_.slip(at.speed, u), force);
    // The f that multiplies the change of the normal force is constant, a coefficient of the
    // pencil.
    moved.at.friction = state.at.friction;
    for (const auto& form : frictionForms(contact_, moved, pair.s, pair.test, pair.motion))
      friction += sign / (2 * h) * (form.pressing + form.turning);
  }
  return sum + mpi::sum(mesh_.comm, friction);
}

}  // namespace squeal::terms
