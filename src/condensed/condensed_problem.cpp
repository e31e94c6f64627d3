#include "condensed/condensed_problem.hpp"

#include <petscsnes.h>

#include <algorithm>
#include <cmath>

#include "interfaces/algebra.hpp"
#include "petsc/arrays.hpp"
#include "petsc/text.hpp"
#include "steady/complementarity.hpp"

namespace squeal::condensed {

using impedance::ContactConditions;
using impedance::ContactVector;
using steady::accuracyNear;
using steady::Hold;
using steady::naturalResidual;

namespace {

/// Returns τ·[u] of u = T x in the rows of the gaps, in the basis of the gaps.
OwnedMat unitSlipRows(const contact::Contact& contact,
                      const contact::Transformation& transformation,
                      std::vector<contact::Slip> slips) {
  for (auto& slip : slips) slip.coefficient = {1, 0}, slip.law = 1;
  return contact.slipRows(transformation, slips,
                          std::vector<unsigned char>(contact.nodes.size(), 1), 0);
}

/// The largest number of corrections by the residual of all equations.
constexpr int mostCorrections = 5;

/// The context of SNES, of the Jacobian and of its parts.
struct GapProblem {
  impedance::ContactSolver& solver;
  ContactConditions conditions;  // `free` says of gaps which of them SNES lets open
  ContactVector given;           // (R, F) without friction and gaps
  double gapUnit, forceUnit;
  MPI_Comm comm;
  PetscInt first;  // number of the first contact node of this rank
  std::size_t nodes;
  std::vector<unsigned char> before = {};  // `free` of the Newton step before the last
};

/// Collective. Says which nodes the last two Newton steps disagree about; empty if about none.
std::string alternating(const GapProblem& problem, const contact::Contact& contact) {
  int count = 0, rank = 0;
  std::size_t one = 0;
  for (std::size_t i = 0; i < problem.nodes && !problem.before.empty(); ++i)
    if (problem.before[i] != problem.conditions.free[i] && count++ == 0) one = i;
  check(MPI_Comm_rank(problem.comm, &rank));
  struct {
    int count, rank;
  } most{count, rank};
  check(MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_2INT, MPI_MAXLOC, problem.comm));
  check(MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_INT, MPI_SUM, problem.comm));
  if (count == 0) return "";
  mesh::Point position{};
  if (rank == most.rank) position = contact.nodes[one].position;
  check(MPI_Bcast(position.data(), 3, MPI_DOUBLE, most.rank, problem.comm));
  return formatted("%d %s in turn, such as that at %s", count,
                   count == 1 ? "contact node opens and closes" : "contact nodes open and close",
                   interfaces::text(position).c_str());
}

/// Sets F(g) in units, with the friction in balance.
void forces(GapProblem& problem, const ContactVector& given, Vec gaps, Vec f) {
  std::vector<double> scaled;
  for (const ReadArray values(gaps); double value : values)
    scaled.push_back(problem.gapUnit * value);
  const auto found = problem.solver.withGaps(scaled, problem.conditions, given);
  const WriteArray values(f);
  for (PetscInt i = 0; i < values.size(); ++i)
    values[i] = found.effects[values.size() + i] / problem.forceUnit;
}

ContactVector nothing(const GapProblem& problem) {
  return ContactVector(problem.given.size(), 0.0);
}

PetscErrorCode evaluate(SNES, Vec gaps, Vec f, void* context) {
  auto& problem = *static_cast<GapProblem*>(context);
  PetscFunctionBegin;
  forces(problem, problem.given, gaps, f);
  PetscFunctionReturn(0);
}

/// The Jacobian does not change.
PetscErrorCode differentiate(SNES, Vec, Mat, Mat, void*) { return 0; }

PetscErrorCode multiply(Mat jacobian, Vec gaps, Vec f) {
  GapProblem* problem = nullptr;
  PetscFunctionBegin;
  PetscCall(MatShellGetContext(jacobian, &problem));
  forces(*problem, nothing(*problem), gaps, f);
  PetscFunctionReturn(0);
}

/// Returns the part of the Jacobian for the gaps that SNES lets open.
PetscErrorCode openPart(Mat jacobian, IS rows, IS, MatReuse, Mat* part) {
  GapProblem* problem = nullptr;
  PetscInt count = 0;
  const PetscInt* indices = nullptr;
  PetscFunctionBegin;
  PetscCall(MatShellGetContext(jacobian, &problem));
  PetscCall(ISGetLocalSize(rows, &count));
  PetscCall(ISGetIndices(rows, &indices));
  problem->before = problem->conditions.free;
  std::fill_n(problem->conditions.free.begin(), problem->nodes, 0);
  for (PetscInt i = 0; i < count; ++i) problem->conditions.free[indices[i] - problem->first] = 1;
  PetscCall(ISRestoreIndices(rows, &indices));
  PetscCall(
      MatCreateShell(problem->comm, count, count, PETSC_DETERMINE, PETSC_DETERMINE, problem, part));
  PetscFunctionReturn(0);
}

/// Solves with the part of the Jacobian in use.
PetscErrorCode solvePart(PC pc, Vec right, Vec gaps) {
  GapProblem* problem = nullptr;
  PetscFunctionBegin;
  PetscCall(PCShellGetContext(pc, &problem));
  const auto& open = problem->conditions.free;
  ContactVector given = nothing(*problem);
  {
    const ReadArray values(right);
    for (std::size_t i = 0, k = 0; i < problem->nodes; ++i)
      if (open[i]) given[problem->nodes + i] = -problem->forceUnit * values[k++];
  }
  const auto found = problem->solver.solve(problem->conditions, given);
  const WriteArray values(gaps);
  for (std::size_t i = 0, k = 0; i < problem->nodes; ++i)
    if (open[i]) values[k++] = found.causes[problem->nodes + i] / problem->gapUnit;
  PetscFunctionReturn(0);
}

}  // namespace

/// A state of the closed contact without friction.
struct CondensedProblem::Loaded {
  OwnedVec x;           // in the unknowns of the open contact
  ContactVector given;  // (R, F)

  void add(double factor, const Loaded& other) {
    check(VecAXPY(x, factor, other.x));
    for (std::size_t i = 0; i < given.size(); ++i) given[i] += factor * other.given[i];
  }
};

/// SNES is asked for the gaps under these conditions, in these units, to this accuracy.
struct CondensedProblem::Asked {
  ContactConditions conditions;  // closed gaps
  steady::Accuracy accuracy;
  double gapUnit;
};

bool CondensedProblem::serves(const contact::Contact& contact, const elasticity::Bodies& bodies) {
  return contact.slipIsGiven() && !bodies.rotationStiffness;
}

CondensedProblem::CondensedProblem(const Problem& problem, const contact::CoupledSystem& closed)
    : problem_(problem),
      contact_(problem.contact()),
      gaps_(contact_.nodes.size(), 0.0),
      sticking_(Sticking::allHeld(contact_)) {
  if (contact_.hasSticking())
    free_ = std::make_unique<Problem>(problem.mesh(), problem.bodies(), contact_,
                                      Sticking::allFree(contact_));
  const Problem& open = free_ ? *free_ : problem_;
  impedance_ = std::make_unique<impedance::Impedance>(
      contact_, open.transformation(), open.stiffness(),
      unitSlipRows(contact_, open.transformation(), contact_.slip(1, nullptr)), closed);
  solver_ = std::make_unique<impedance::ContactSolver>(*impedance_);
}

CondensedProblem::~CondensedProblem() = default;

/// Returns the state under the loads of a point, with its residual balanced by one solve; the loads
/// of `less` are taken off before.
CondensedProblem::Loaded CondensedProblem::relaxed(const sweep::Parameters& at,
                                                   const sweep::Parameters* less) {
  const Problem& open = free_ ? *free_ : problem_;
  Loaded state{rightVector(open.transformation().trial), {}};
  const auto unmoved = [&](const sweep::Parameters& point, Vec residual) {
    const OwnedVec forces = open.forces(point, open.displacement(point, state.x));
    check(MatMultTranspose(open.transformation().trial, forces, residual));
    return open.normalForces(forces);
  };
  const OwnedVec residual = rightVector(open.transformation().trial);
  auto normal = unmoved(at, residual);
  if (less) {
    const OwnedVec other = rightVector(open.transformation().trial);
    const auto otherNormal = unmoved(*less, other);
    check(VecAXPY(residual, -1, other));
    for (std::size_t i = 0; i < normal.size(); ++i) normal[i] -= otherNormal[i];
  }
  PetscReal size = 0;
  check(VecNorm(residual, NORM_2, &size));
  state.given.assign(impedance_->length(), 0.0);
  if (size > 0) state.given = impedance_->relax(residual, state.x);
  for (std::size_t i = 0; i < normal.size(); ++i) state.given[i] += normal[i];
  return state;
}

/// Returns the state under the loads of a point: they are p times the pressures and held
/// displacements, v² times the centrifugal forces, and what gaps there are without load.
CondensedProblem::Loaded CondensedProblem::loaded(const sweep::Parameters& at) {
  if (loads_.empty()) {
    const sweep::Parameters none{0, 0, 0}, pressed{0, 0, 1}, turning{0, 1, 0};
    loads_.push_back(relaxed(none, nullptr));
    loads_.push_back(relaxed(pressed, &none));
    loads_.push_back(relaxed(turning, &none));
  }
  Loaded state{{}, ContactVector(impedance_->length(), 0.0)};
  check(VecDuplicate(loads_[0].x, state.x.out()));
  state.add(1, loads_[0]);
  state.add(at.pressure, loads_[1]);
  state.add(at.speed * at.speed, loads_[2]);
  return state;
}

/// Returns the conditions with all gaps closed.
ContactConditions CondensedProblem::conditions(const sweep::Parameters& at,
                                               const Sticking& sticking) const {
  ContactConditions result;
  for (const auto& slip :
       steady::withReleased(contact_, contact_.slip(at.speed, nullptr), sticking))
    result.coefficient.push_back(slip.friction(at.friction));
  const auto& nodeOf = impedance_->nodeOf();
  result.free.assign(nodeOf.size(), 0);
  for (std::size_t k = contact_.nodes.size(); k < nodeOf.size(); ++k)
    result.free[k] = sticking.holds[nodeOf[k]] != Hold::held;
  return result;
}

/// Collective. Returns what the friction of released nodes does to them, borrowed until the next
/// call; null if there are none.
Mat CondensedProblem::directFriction(const Sticking& sticking) {
  int any = std::count(sticking.holds.begin(), sticking.holds.end(), Hold::released) > 0;
  int known = directOf_.holds == sticking.holds && directOf_.direction == sticking.direction;
  check(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_LOR, comm()));
  check(MPI_Allreduce(MPI_IN_PLACE, &known, 1, MPI_INT, MPI_LAND, comm()));
  if (!any) return nullptr;
  if (known) return direct_;
  std::vector<contact::Slip> slips(contact_.nodes.size());
  for (std::size_t i = 0; i < slips.size(); ++i)
    if (sticking.holds[i] == Hold::released) slips[i].direction = sticking.direction[i];
  direct_ = impedance_->directFriction(unitSlipRows(contact_, free_->transformation(), slips));
  directOf_ = sticking;
  return direct_;
}

impedance::ContactSolution CondensedProblem::onSet(const sweep::Parameters& at,
                                                   const std::vector<unsigned char>& closed,
                                                   const Sticking& sticking) {
  ContactConditions asked = conditions(at, sticking);
  asked.direct = directFriction(sticking);
  const auto& nodeOf = impedance_->nodeOf();
  for (std::size_t k = 0; k < nodeOf.size(); ++k)
    if (!closed[nodeOf[k]]) asked.free[k] = 1;
  return solver_->solve(asked, loaded(at).given);
}

/// Returns (t, w).
ContactVector CondensedProblem::complementarity(const Asked& asked, const ContactVector& given,
                                                Solution& solution) {
  const PetscInt n = impedance_->nodes();
  PetscInt end = 0;
  check(MPI_Scan(&n, &end, 1, MPIU_INT, MPI_SUM, comm()));
  GapProblem problem{
      *solver_, asked.conditions, given,         asked.gapUnit, asked.accuracy.forceUnit,
      comm(),   end - n,          std::size_t(n)};
  std::fill_n(problem.conditions.free.begin(), n, 1);  // where SNES asks for no part
  OwnedMat jacobian;
  check(MatCreateShell(comm(), n, n, PETSC_DETERMINE, PETSC_DETERMINE, &problem, jacobian.out()));
  check(MatShellSetOperation(jacobian, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
  check(MatShellSetOperation(jacobian, MATOP_CREATE_SUBMATRIX,
                             reinterpret_cast<void (*)()>(openPart)));
  const OwnedVec x = rightVector(jacobian), low = rightVector(jacobian),
                 high = rightVector(jacobian), f = rightVector(jacobian);
  {
    const WriteArray start(x);
    for (PetscInt i = 0; i < n; ++i) start[i] = gaps_[i] / asked.gapUnit;
  }
  check(VecSet(high, PETSC_INFINITY));
  const steady::OwnedSNES snes = steady::newSnes(comm(), asked.accuracy.asked);
  check(SNESSetFunction(snes, f, evaluate, &problem));
  check(SNESSetJacobian(snes, jacobian, jacobian, differentiate, nullptr));
  check(SNESVISetVariableBounds(snes, low, high));
  KSP ksp = nullptr;
  PC pc = nullptr;
  check(SNESGetKSP(snes, &ksp));
  check(KSPSetType(ksp, KSPPREONLY));
  check(KSPGetPC(ksp, &pc));
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetContext(pc, &problem));
  check(PCShellSetApply(pc, solvePart));
  if (!steady::solveSnes(snes, x, solution))
    if (const std::string who = alternating(problem, contact_); !who.empty())
      solution.reason += ": " + who;
  {
    const ReadArray values(x);
    for (PetscInt i = 0; i < n; ++i) gaps_[i] = asked.gapUnit * values[i];
  }
  return solver_->withGaps(gaps_, asked.conditions, given).causes;
}

Solution CondensedProblem::solve(const sweep::Parameters& at) {
  problem_.requireSlip(at);
  Solution solution = problem_.settle(
      solveWith(at, sticking_), [&](const Sticking& sticking) { return solveWith(at, sticking); });
  if (solution.converged) {
    sticking_ = Sticking::allHeld(contact_);
    for (std::size_t i = 0; i < solution.closed.size(); ++i)
      if (!solution.closed[i]) sticking_.holds[i] = solution.sticking.holds[i];
  }
  return solution;
}

Solution CondensedProblem::solveWith(const sweep::Parameters& at, const Sticking& sticking) {
  Solution solution;
  solution.at = at;
  const Problem& open = free_ ? *free_ : problem_;
  std::optional<Problem> other;  // with these holds
  if (free_) other.emplace(problem_.mesh(), problem_.bodies(), contact_, sticking);
  const Problem& held = other ? *other : problem_;
  const auto& openTo = open.transformation();
  const auto& heldTo = held.transformation();
  const auto restricted = [&](Vec x) {
    const OwnedVec z = elasticity::nodalVector(problem_.mesh());
    OwnedVec result = rightVector(heldTo.trial);
    check(MatMult(openTo.selection, x, z));
    check(MatMultTranspose(heldTo.selection, z, result));
    return result;
  };

  Loaded start = loaded(at);
  const OwnedVec& x = start.x;
  Asked asked{conditions(at, sticking), {}, 0};
  asked.conditions.direct = directFriction(sticking);
  for (double gap : gaps_) asked.gapUnit = std::max(asked.gapUnit, gap);
  check(MPI_Allreduce(MPI_IN_PLACE, &asked.gapUnit, 1, MPI_DOUBLE, MPI_MAX, comm()));
  if (asked.gapUnit == 0) check(VecNorm(x, NORM_INFINITY, &asked.gapUnit));
  if (asked.gapUnit == 0) asked.gapUnit = 1;
  asked.accuracy = accuracyNear(held, at, restricted(x));
  ContactVector causes(impedance_->length(), 0.0);
  if (impedance_->size() > 0) causes = complementarity(asked, start.given, solution);
  impedance_->addUnknowns(causes, x);
  // Friction may move a weakly held body far, which is known only now.
  asked.accuracy = accuracyNear(held, at, restricted(x));
  double left = naturalResidual(held, at, restricted(x));
  const OwnedVec residual = rightVector(openTo.trial), corrected = rightVector(openTo.trial);
  for (int k = 0; k < mostCorrections && left > asked.accuracy.asked * asked.accuracy.forceUnit;
       ++k) {
    // With t = c R and w as they are, y is corrected. What the contact then feels without t and w
    // is the new start.
    const auto normal = open.normalForces(open.forces(at, open.displacement(at, x)));
    open.residual(at, x, residual);
    for (std::size_t i = 0; i < normal.size(); ++i)
      causes[i] = asked.conditions.coefficient[i] * normal[i];
    check(VecCopy(x, corrected));
    ContactVector given = impedance_->relax(residual, corrected);
    for (std::size_t i = 0; i < normal.size(); ++i) given[i] += normal[i];
    const auto known = impedance_->responses(linalg::DenseView(causes.data(), causes.size(), 1));
    for (std::size_t i = 0; i < given.size(); ++i) given[i] -= known(i, 0);
    ContactVector better = causes;
    if (impedance_->size() > 0) better = complementarity(asked, given, solution);
    for (std::size_t i = 0; i < causes.size(); ++i) causes[i] = better[i] - causes[i];
    impedance_->addUnknowns(causes, corrected);
    const double now = naturalResidual(held, at, restricted(corrected));
    if (!(now < 0.5 * left)) break;
    left = now;
    check(VecCopy(corrected, x));
    causes = std::move(better);
  }
  steady::accept(solution, left, asked.accuracy);
  if (solution.reason.empty()) solution.reason = "LINEAR";
  held.conclude(restricted(x), left, solution);
  return solution;
}

}  // namespace squeal::condensed
