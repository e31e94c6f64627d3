#include "flutter/influence.hpp"

#include <cmath>

namespace squeal::flutter {
namespace {

using Complex = std::complex<double>;

/// Central differences of what follows the steady state: errors of its square beside rounding over it.
constexpr double step = 1e-4;

/// The steady state enters the terms of the point: the direction and law of slip, friction damping, prestress.
bool followsSteadyState(const contact::Contact& contact, const Parameters& at, Mat prestress) {
  const bool damping = frictionDampingWanted() && (contact.mesh->dimension == 3 || !contact.law.constant());
  return prestress || (at.friction > 0 && (damping || !contact.slipIsGiven()));
}

double separation(const std::vector<Eigenvalue>& eigenvalues, std::size_t index) {
  double smallest = INFINITY;
  const Complex s = eigenvalues[index].s;
  for (std::size_t i = 0; i < eigenvalues.size(); ++i)
    if (i != index) smallest = std::min(smallest, std::abs(eigenvalues[i].s - s));
  return smallest / std::abs(s);
}

}  // namespace

/// One parameter θ, and what it does to the steady state.
struct Influences::Parameter {
  std::string name;
  double Parameters::*member = nullptr;  // of the point; null: not one of its own
  int body = -1;
  bool density = false;  // of the body; otherwise its moduli
  double size = 1;       // θ, for the step of differences
  steady::Cause cause;
  OwnedVec force;  // of the cause
  steady::Change change;
  std::vector<double> responseForce;
  OwnedMat prestress;
};

/// A triple on all nodal displacements: yᴴ L(f)ᵀ X T x = zᴴ X u.
struct Influences::Projected {
  Complex s;
  ComplexVector u, z;  // T x, L(f) y
  ContactMotion motion;
  std::vector<ComplexPoint> test;  // [T y]
};

void Influences::derive(FrictionPoint& point, const Pencil& pencil, const contact::AssociatedSystem& system,
                        const steady::Solution& solution, const StartSpace& start, Mat prestress) {
  if (point.shapes.empty()) return;
  std::vector<RightPair> pairs;
  for (const auto& shape : point.shapes) pairs.push_back({point.eigenvalues[shape.index].s, &shape.unknowns});
  const auto left = leftVectors(pencil, point.at, start, system.m0(), system.solver(), pairs);
  const auto parameters = this->parameters(system, solution, prestress);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const EigenTriple triple{pairs[i].s, *pairs[i].vector, left[i].y};
    const Complex slope = slopeForm(pencil, point.at, triple);
    Sensitivity result{
        condition(triple, slope, system.m0()), separation(point.eigenvalues, point.shapes[i].index), left[i].backwardError, {}};
    if (result.regular()) {
      const Projected pair = project(system, solution, triple, prestress);
      for (const auto& parameter : parameters) {
        Complex form = parameter.member ? parameterForm(pencil, point.at, triple, parameter.member) : 0;
        form += materialForm(parameter, solution, pair, prestress) + steadyForm(parameter, solution, pair, prestress);
        result.derivatives.push_back({parameter.name, -form / slope});
      }
    }
    point.sensitivities.push_back(std::move(result));
  }
}

std::vector<Influences::Parameter> Influences::parameters(const contact::AssociatedSystem& system, const steady::Solution& solution,
                                                          Mat prestress) {
  const Parameters& at = solution.at;
  const double v = at.speed;
  for (int body = static_cast<int>(parts_.size()); body < static_cast<int>(mesh_.bodies.size()); ++body)
    parts_.push_back(elasticity::bodyPart(mesh_, body));
  std::vector<Parameter> list(3);
  list[0].name = "friction", list[0].member = &Parameters::friction, list[0].cause.friction = 1;
  list[1].name = "speed", list[1].member = &Parameters::speed, list[1].cause.speed = 1, list[1].size = v;
  list[2].name = "pressure";
  for (std::size_t body = 0; body < mesh_.bodies.size(); ++body)
    for (const bool density : {false, true}) {
      list.emplace_back();
      list.back().name = (density ? "density_" : "young_") + mesh_.bodies[body];
      list.back().body = static_cast<int>(body), list.back().density = density;
    }
  if (!followsSteadyState(contact_, at, prestress)) return list;

  const steady::Problem problem(mesh_, bodies_, contact_);
  const Vec u = solution.displacement;
  for (auto& parameter : list) {
    parameter.force = elasticity::nodalVector(mesh_);
    // dr = c₁ K^R u − c₂ b_centrifugal, of the body or of all.
    const auto inertia = [&](Mat rotationStiffness, Vec centrifugal, double factor) {
      if (rotationStiffness) check(MatMult(rotationStiffness, u, parameter.force));
      check(VecAXPY(parameter.force, -1, centrifugal));
      check(VecScale(parameter.force, factor));
    };
    if (parameter.member == &Parameters::speed) inertia(bodies_.rotationStiffness, bodies_.centrifugal, 2 * v);
    if (!parameter.member && parameter.body < 0) {
      check(VecAXPY(parameter.force, -1, bodies_.load));
      check(VecAXPY(parameter.force, 1, bodies_.centrifugal));
      parameter.cause.held = contact_.offset;
    }
    if (parameter.body >= 0) {
      const auto& part = parts_[static_cast<std::size_t>(parameter.body)];
      if (parameter.density)
        inertia(part.rotationStiffness, part.centrifugal, v * v);
      else
        check(MatMult(part.stiffness, u, parameter.force));
    }
    parameter.cause.force = parameter.force;
    parameter.change = problem.change(solution, system, parameter.cause);
    parameter.responseForce = responseForces(contact_, solution.closed, parameter.change.normalForce);
    if (prestress) parameter.prestress = elasticity::geometricStiffness(mesh_, parameter.change.displacement);
  }
  return list;
}

Influences::Projected Influences::project(const contact::AssociatedSystem& system, const steady::Solution& solution,
                                          const EigenTriple& triple, Mat prestress) const {
  const Mat trial = system.transformation().trial;
  Projected pair{triple.s, product(trial, triple.x), product(trial, triple.y), {}, {}};
  pair.motion = contactMotion(contact_, pair.u, motionForces(bodies_, solution.at, triple.s, pair.u, prestress).forces);
  pair.test = contactJump(contact_, pair.z);
  // L(f) y = T y + Nᵀ f S y
  ComplexVector slips = ComplexVector::like(pair.z.real);
  PetscScalar *real = nullptr, *imaginary = nullptr;
  check(VecGetArray(slips.real, &real));
  check(VecGetArray(slips.imaginary, &imaginary));
  for (std::size_t k = 0; k < contact_.nodes.size(); ++k) {
    if (!solution.closed[k]) continue;
    const auto& slip = solution.slip[k];
    Complex along = 0;
    for (std::size_t d = 0; d < 3; ++d) along += slip.direction[d] * pair.test[k][d];
    along *= solution.at.friction * slip.law;
    const PetscInt row = contact_.gapRow(contact_.nodes[k]) - mesh_.dimension * mesh_.firstNode;
    real[row] = along.real(), imaginary[row] = along.imag();
  }
  check(VecRestoreArray(slips.real, &real));
  check(VecRestoreArray(slips.imaginary, &imaginary));
  add(pair.z, 1, product(contact_.reaction, slips, true));
  return pair;
}

/// zᴴ (∂X/∂θ) u of the matrices of one body: K, C, K_σ with its moduli, M, C, G, K^R with its density.
Complex Influences::materialForm(const Parameter& parameter, const steady::Solution& solution, const Projected& pair,
                                 Mat prestress) const {
  if (parameter.body < 0) return 0;
  const auto& part = parts_[static_cast<std::size_t>(parameter.body)];
  const auto form = [&](Mat matrix) { return matrix ? dot(pair.z, product(matrix, pair.u)) : 0; };
  const Complex s = pair.s;
  const double v = solution.at.speed;
  if (parameter.density)
    return (s * s + s * part.massDamping) * form(part.mass) + s * v * form(part.gyroscopic) + v * v * form(part.rotationStiffness);
  Complex sum = (1.0 + s * part.stiffnessDamping) * form(part.stiffness);
  if (prestress) sum += form(elasticity::geometricStiffness(mesh_, solution.displacement, parameter.body));
  return sum;
}

/// The part by the steady state: of K_σ, linear in its displacement, exactly; of friction by central differences along its change.
Complex Influences::steadyForm(const Parameter& parameter, const steady::Solution& solution, const Projected& pair,
                               Mat prestress) const {
  if (!parameter.change.displacement) return 0;
  Complex sum = 0;
  if (prestress) sum += dot(pair.z, product(parameter.prestress, pair.u));
  const FrictionState base = frictionState(contact_, solution);
  const double h = step * parameter.size;
  const OwnedVec u = elasticity::nodalVector(mesh_);
  for (const double sign : {-1.0, 1.0}) {
    FrictionState state = base;
    if (parameter.member) state.at.*parameter.member += sign * h;
    check(VecWAXPY(u, sign * h, parameter.change.displacement, solution.displacement));
    state.slip = contact_.slip(state.at.speed, u);
    for (std::size_t k = 0; k < base.responseForce.size(); ++k) state.responseForce[k] += sign * h * parameter.responseForce[k];
    sum += sign / (2 * h) * frictionSum(state, solution, pair);
  }
  return sum;
}

/// Σ_k of frictionForm(); f itself, where it multiplies the change of the normal force, is a coefficient of the pencil, and is held.
Complex Influences::frictionSum(const FrictionState& state, const steady::Solution& solution, const Projected& pair) const {
  Complex sum = 0;
  const double coefficient = state.at.friction > 0 ? solution.at.friction / state.at.friction : 0;
  for (std::size_t k = 0; k < contact_.nodes.size(); ++k) {
    if (!solution.closed[k]) continue;
    const auto form = frictionForm(contact_, state, pair.s, pair.test[k], pair.motion, k);
    sum += coefficient * form.pressing + form.turning;
  }
  check(MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_C_DOUBLE_COMPLEX, MPI_SUM, mesh_.comm));
  return sum;
}

}  // namespace squeal::flutter
