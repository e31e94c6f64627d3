#include "steady/steady/change.hpp"

#include <functional>

#include "base/petsc/arrays.hpp"
#include "base/system/text.hpp"
#include "eigen/sweep/parameters.hpp"
#include "model/contact/response.hpp"

namespace squeal::steady {
namespace {

/// The context of a MatShell that applies dF/dy, with y the unknowns of the closed contact.
struct Linearised {
  std::function<void(Vec, Vec)> apply;
};

PetscErrorCode multiply(Mat matrix, Vec y, Vec result) {
  Linearised* linearised = nullptr;
  PetscFunctionBegin;
  PetscCall(MatShellGetContext(matrix, &linearised));
  linearised->apply(y, result);
  PetscFunctionReturn(0);
}

}  // namespace

/// The equations are, with T of the closed contact, u = T y + p u0 and t = f φ R_N τ(w) at the pad
/// nodes [M.48, M.49],
///   F  = Tᵀ (r + Jᵀ t),
///   dr = (K + v² K^R) du + cause,
///   dt = f φ τ E⁻ᵀ N dr − v B D du + (df φ + f φ′ dv |w|/v) E⁻ᵀ R_N τ,
/// with B of nodalResponse(), where f is the coefficient of the node and df its change.
Change change(const Problem& problem, const Solution& solution,
              const contact::CoupledSystem& system, const Cause& cause) {
  const mesh::Mesh& mesh = problem.mesh();
  const contact::Contact& contact = problem.contact();
  const sweep::Parameters& at = solution.at;
  const Mat trial = system.transformation().trial;
  const auto& nodes = contact.nodes;
  const auto slips = withReleased(contact, solution.slip, solution.sticking);
  std::vector<double> steadyForce;
  for (const auto& state : solution.contact) steadyForce.push_back(state.normalForce);
  steadyForce = contact.nodalForce(steadyForce, system.closed());
  OwnedMat turning;  // B D
  if (contact.convected) {
    const OwnedMat response = contact::nodalResponse(contact, slips, steadyForce, at.friction);
    check(
        MatMatMult(response, contact.convected, MAT_INITIAL_MATRIX, PETSC_DEFAULT, turning.out()));
  }
  // Computes Tᵀ (dr + Jᵀ dt) for given du and dr; if `direct`, dt has its terms in df and dv too.
  const auto test = [&](Vec du, Vec dr, bool direct, Vec result) {
    const OwnedVec friction = elasticity::nodalVector(mesh), sum = elasticity::nodalVector(mesh);
    const auto normal = contact.nodalForce(problem.normalForces(dr), system.closed());
    if (turning) {
      check(MatMult(turning, du, friction));
      check(VecScale(friction, -at.speed));
    }
    {
      const WriteArray values(friction);
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto& slip = slips[i];
        const double causes =
            direct ? (cause.friction * slip.coefficient.swept * slip.law +
                      slip.frictionSlope(at.friction) * cause.speed * slip.speed / at.speed) *
                         steadyForce[i]
                   : 0;
        const double along = slip.friction(at.friction) * normal[i] + causes;
        for (int d = 0; d < mesh.dimension; ++d)
          values[mesh.dimension * nodes[i].node + d] += along * slip.direction[d];
      }
    }
    check(MatMultTransposeAdd(contact.jump, friction, dr, sum));
    check(MatMultTranspose(trial, sum, result));
  };

  const OwnedVec work = elasticity::nodalVector(mesh), explicitU = elasticity::nodalVector(mesh);
  OwnedVec y;
  check(MatCreateVecs(trial, y.out(), nullptr));
  if (cause.held) check(VecCopy(cause.held, explicitU));
  const OwnedVec du = elasticity::nodalVector(mesh);
  const auto residual = [&](Vec changes) {
    check(MatMultAdd(trial, changes, explicitU, du));
    const OwnedVec dr = problem.springForces(at.speed, du);
    if (cause.force) check(VecAXPY(dr, 1, cause.force));
    Residual left{{}, problem.rounding(du, cause.force)};
    check(MatCreateVecs(trial, left.vector.out(), nullptr));
    test(du, dr, true, left.vector);
    return left;
  };

  Linearised linearised{[&](Vec in, Vec out) {
    check(MatMult(trial, in, work));
    test(work, problem.springForces(at.speed, work), false, out);
  }};
  PetscInt local = 0, global = 0;
  check(VecGetLocalSize(y, &local));
  check(VecGetSize(y, &global));
  OwnedMat matrix;
  check(MatCreateShell(mesh.comm, local, local, global, global, &linearised, matrix.out()));
  check(MatShellSetOperation(matrix, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
  if (const auto refinement = refine(innerSolver(matrix, system.solver()), residual, y);
      !refinement.solved())
    throw Error(
        formatted("the change of the steady state with its data was not found at -flutter_friction "
                  "%g: a residual of %.1e is left",
                  at.friction, refinement.relative()));

  Change result{elasticity::nodalVector(mesh), {}};
  check(MatMultAdd(trial, y, explicitU, result.displacement));
  const OwnedVec forces = problem.springForces(at.speed, result.displacement);
  if (cause.force) check(VecAXPY(forces, 1, cause.force));
  result.normalForce = problem.normalForces(forces);
  return result;
}

}  // namespace squeal::steady
