// SPDX-License-Identifier: BSD-2-Clause
#include "steady/steady/change.hpp"

#include "base/petsc/arrays.hpp"
#include "base/system/text.hpp"
#include "eigen/sweep/parameters.hpp"
#include "model/contact/response.hpp"

namespace squeal::steady {
namespace {

/// The equations linearised at a solution, with T of the closed contact, u = T y + p u0 and
/// t = f φ R_N τ(w) at the pad nodes [M.48, M.49],
///   F  = Tᵀ (r + Jᵀ t),
///   dr = (K + v² K^R) du + cause,
///   dt = f φ τ E⁻ᵀ N dr − v B D du + (df φ + f φ′ dv |w|/v) E⁻ᵀ R_N τ,
/// with B of nodalResponse(), where f is the coefficient of the node and df its change.
class Linearised {
 public:
  /// Collective. Borrows the arguments during the lifetime of the object.
  Linearised(const Problem& problem, const Solution& solution, const contact::CoupledSystem& system,
             const Cause& cause);
  /// Collective. Returns dF/dy as a shell, whose context is this object.
  OwnedMat matrix();
  /// Collective. Returns dF for given dy, with all terms of the cause.
  Residual residual(Vec dy) const;
  /// Collective. Sets `result` to (dF/dy) dy.
  void apply(Vec dy, Vec result) const;
  /// Collective. Returns du = T dy + p u0.
  OwnedVec displacement(Vec dy) const;
  OwnedVec forces(Vec du) const;

 private:
  std::vector<double> causes() const;
  void test(Vec du, Vec dr, const std::vector<double>& causes, Vec result) const;

  const Problem& problem_;
  const sweep::Parameters& at_;
  const contact::Contact& contact_;
  const contact::CoupledSystem& system_;
  const Cause& cause_;
  std::vector<contact::Slip> slips_;
  std::vector<double> steadyForce_;  // E⁻ᵀ R_N
  OwnedMat turning_;                 // B D; null without convective terms
  OwnedVec held_;                    // change of p u0
};

Linearised::Linearised(const Problem& problem, const Solution& solution,
                       const contact::CoupledSystem& system, const Cause& cause)
    : problem_(problem),
      at_(solution.at),
      contact_(problem.contact()),
      system_(system),
      cause_(cause),
      slips_(withReleased(contact_, solution.slip, solution.sticking)),
      held_(elasticity::nodalVector(problem.mesh())) {
  for (const auto& state : solution.contact) steadyForce_.push_back(state.normalForce);
  steadyForce_ = contact_.nodalForce(steadyForce_, system.closed());
  if (contact_.sliding.convected) {
    const OwnedMat response = contact::nodalResponse(contact_, slips_, steadyForce_, at_.friction);
    check(MatMatMult(response, contact_.sliding.convected, MAT_INITIAL_MATRIX, PETSC_DEFAULT,
                     turning_.out()));
  }
  if (cause.held) check(VecCopy(cause.held, held_));
}

/// Returns (df φ + f φ′ dv |w|/v) E⁻ᵀ R_N, [contact node].
std::vector<double> Linearised::causes() const {
  std::vector<double> found;
  for (std::size_t i = 0; i < slips_.size(); ++i) {
    const auto& slip = slips_[i];
    found.push_back((cause_.friction * slip.coefficient.swept * slip.law +
                     slip.frictionSlope(at_.friction) * cause_.speed * slip.speed / at_.speed) *
                    steadyForce_[i]);
  }
  return found;
}

/// Computes Tᵀ (dr + Jᵀ dt) for given du, dr and causes of dt, [contact node].
void Linearised::test(Vec du, Vec dr, const std::vector<double>& causes, Vec result) const {
  const auto& mesh = problem_.mesh();
  const auto& nodes = contact_.interfaces.nodes;
  const OwnedVec friction = elasticity::nodalVector(mesh), sum = elasticity::nodalVector(mesh);
  const auto normal = contact_.nodalForce(problem_.normalForces(dr), system_.closed());
  if (turning_) {
    check(MatMult(turning_, du, friction));
    check(VecScale(friction, -at_.speed));
  }
  {
    const WriteArray values(friction);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double along = slips_[i].friction(at_.friction) * normal[i] + causes[i];
      for (int d = 0; d < mesh.dimension; ++d)
        values[mesh.dimension * nodes[i].node + d] += along * slips_[i].direction[d];
    }
  }
  check(MatMultTransposeAdd(contact_.sliding.jump, friction, dr, sum));
  check(MatMultTranspose(system_.transformation().trial, sum, result));
}

OwnedVec Linearised::displacement(Vec dy) const {
  OwnedVec du = elasticity::nodalVector(problem_.mesh());
  check(MatMultAdd(system_.transformation().trial, dy, held_, du));
  return du;
}

OwnedVec Linearised::forces(Vec du) const {
  OwnedVec dr = problem_.springForces(at_.speed, du);
  if (cause_.force) check(VecAXPY(dr, 1, cause_.force));
  return dr;
}

Residual Linearised::residual(Vec dy) const {
  const OwnedVec du = displacement(dy), dr = forces(du);
  Residual left{rightVector(system_.transformation().trial), problem_.rounding(du, cause_.force)};
  test(du, dr, causes(), left.vector);
  return left;
}

void Linearised::apply(Vec dy, Vec result) const {
  const OwnedVec du = elasticity::nodalVector(problem_.mesh());
  check(MatMult(system_.transformation().trial, dy, du));
  test(du, problem_.springForces(at_.speed, du), std::vector<double>(slips_.size(), 0.0), result);
}

PetscErrorCode multiply(Mat matrix, Vec y, Vec result) {
  Linearised* linearised = nullptr;
  PetscFunctionBegin;
  PetscCall(MatShellGetContext(matrix, &linearised));
  linearised->apply(y, result);
  PetscFunctionReturn(0);
}

OwnedMat Linearised::matrix() {
  const auto& t = system_.transformation();
  OwnedMat matrix;
  check(MatCreateShell(problem_.mesh().comm, t.ownedColumns, t.ownedColumns, t.columns, t.columns,
                       this, matrix.out()));
  check(MatShellSetOperation(matrix, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
  return matrix;
}

}  // namespace

Change change(const Problem& problem, const Solution& solution,
              const contact::CoupledSystem& system, const Cause& cause) {
  Linearised linearised(problem, solution, system, cause);
  const OwnedVec y = rightVector(system.transformation().trial);
  const OwnedMat matrix = linearised.matrix();
  if (const auto refinement = refine(
          innerSolver(matrix, system.solver()), [&](Vec dy) { return linearised.residual(dy); }, y);
      !refinement.solved())
    throw Error(
        formatted("the change of the steady state with its data did not converge at "
                  "-flutter_friction %g: the relative residual is %.1e",
                  solution.at.friction, refinement.relative()));
  Change result{linearised.displacement(y), {}};
  result.normalForce = problem.normalForces(linearised.forces(result.displacement));
  return result;
}

}  // namespace squeal::steady
