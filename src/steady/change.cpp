/// The first-order change of the steady state with its data: the equations of steady.hpp,
/// differentiated on one active set [M.48, M.49].
#include <functional>

#include "contact/coupled.hpp"
#include "petsc/arrays.hpp"
#include "petsc/text.hpp"
#include "steady/steady.hpp"
#include "sweep/parameters.hpp"

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

/// With T of the closed contact, u = T y + u0 and t = f φ R_N τ(w) at the pad nodes [M.48, M.49]:
///   F  = Tᵀ (r + Jᵀ t),
///   dr = (K + v² K^R) du + cause,
///   dt = f φ τ N dr − v B D du + (df φ + f φ′ dv |w|/v) R_N τ,
/// with B of velocityResponse().
Change Problem::change(const Solution& solution, const contact::CoupledSystem& system,
                       const Cause& cause) const {
  const sweep::Parameters& at = solution.at;
  const Mat trial = system.transformation().trial;
  const auto& nodes = contact_.nodes;
  std::vector<double> steadyForce;
  for (const auto& state : solution.contact) steadyForce.push_back(state.normalForce);
  OwnedMat turning;  // B D
  if (contact_.convected) {
    const OwnedMat response = contact_.velocityResponse(solution.slip, steadyForce, at.friction);
    check(
        MatMatMult(response, contact_.convected, MAT_INITIAL_MATRIX, PETSC_DEFAULT, turning.out()));
  }
  // Computes Tᵀ (dr + Jᵀ dt) for given du and dr; if `direct`, dt has its terms in df and dv too.
  const auto test = [&](Vec du, Vec dr, bool direct, Vec result) {
    const OwnedVec friction = elasticity::nodalVector(mesh_), sum = elasticity::nodalVector(mesh_);
    const auto normal = normalForces(dr);
    if (turning) {
      check(MatMult(turning, du, friction));
      check(VecScale(friction, -at.speed));
    }
    {
      const WriteArray values(friction);
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto& slip = solution.slip[i];
        const double causes =
            direct ? (cause.friction * slip.law +
                      at.friction * slip.slope * cause.speed * slip.speed / at.speed) *
                         steadyForce[i]
                   : 0;
        const double along = system.closed()[i] ? at.friction * slip.law * normal[i] + causes : 0;
        for (int d = 0; d < mesh_.dimension; ++d)
          values[mesh_.dimension * nodes[i].node + d] += along * slip.direction[d];
      }
    }
    check(MatMultTransposeAdd(contact_.jump, friction, dr, sum));
    check(MatMultTranspose(trial, sum, result));
  };

  const OwnedVec work = elasticity::nodalVector(mesh_), explicitU = elasticity::nodalVector(mesh_);
  OwnedVec y;
  check(MatCreateVecs(trial, y.out(), nullptr));
  if (cause.held) check(VecCopy(cause.held, explicitU));
  const OwnedVec du = elasticity::nodalVector(mesh_);
  const auto residual = [&](Vec changes) {
    check(MatMultAdd(trial, changes, explicitU, du));
    const OwnedVec dr = springForces(at.speed, du);
    if (cause.force) check(VecAXPY(dr, 1, cause.force));
    Residual left{{}, rounding(du, cause.force)};
    check(MatCreateVecs(trial, left.vector.out(), nullptr));
    test(du, dr, true, left.vector);
    return left;
  };

  Linearised linearised{[&](Vec in, Vec out) {
    check(MatMult(trial, in, work));
    test(work, springForces(at.speed, work), false, out);
  }};
  PetscInt local = 0, global = 0;
  check(VecGetLocalSize(y, &local));
  check(VecGetSize(y, &global));
  OwnedMat matrix;
  check(MatCreateShell(mesh_.comm, local, local, global, global, &linearised, matrix.out()));
  check(MatShellSetOperation(matrix, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
  if (const auto refinement = refine(innerSolver(matrix, system.solver()), residual, y);
      !refinement.solved())
    throw Error(
        formatted("the change of the steady state with its data was not found at -flutter_friction "
                  "%g: a residual of %.1e is left",
                  at.friction, refinement.relative()));

  Change change{elasticity::nodalVector(mesh_), {}};
  check(MatMultAdd(trial, y, explicitU, change.displacement));
  const OwnedVec forces = springForces(at.speed, change.displacement);
  if (cause.force) check(VecAXPY(forces, 1, cause.force));
  change.normalForce = normalForces(forces);
  return change;
}

}  // namespace squeal::steady
