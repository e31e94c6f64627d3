// SPDX-License-Identifier: BSD-2-Clause
#include "steady/condensed/condensed_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "algebra/linalg/block.hpp"
#include "base/system/mpi.hpp"
#include "steady/condensed/gaps.hpp"
#include "steady/condensed/pivots.hpp"
#include "steady/steady/complementarity.hpp"

namespace squeal::condensed {

using impedance::ContactCase;
using impedance::ContactConditions;
using impedance::ContactVector;
using linalg::DenseMatrix;
using steady::accuracyNear;
using steady::Hold;
using steady::naturalResidual;

namespace {

/// Returns τ·[u] of u = T x in the rows of the gaps, in the basis of the gaps.
OwnedMat unitSlipRows(const contact::Contact& contact,
                      const contact::Transformation& transformation,
                      std::vector<contact::Slip> slips) {
  for (auto& slip : slips) slip.coefficient = {1, 0}, slip.law = 1;
  return contact.slipRows(transformation, slips, contact::Mask(contact.interfaces.nodes.size(), 1),
                          0);
}

/// The largest number of corrections by the residual of all equations. Each must halve it.
constexpr int mostCorrections = 30;

/// The initial active sets are determined with friction balanced to this relative accuracy.
constexpr double roughAccuracy = 1e-4;
constexpr int mostSteps = 12;

}  // namespace

/// A point with the initial holds and gaps of its solution.
struct CondensedProblem::Start {
  sweep::Parameters at;
  Sticking sticking;
  std::vector<double> gaps;  // [contact node], m; finally those of the solution
  bool withPivots = false;   // if SNES finds no gaps
};

/// The state of the solution at a point.
struct CondensedProblem::Trial {
  Start& start;
  std::unique_ptr<Problem> own;  // with the holds, if any node sticks
  const Problem& held;           // *own, or the problem of all points
  OwnedMat direct;               // the conditions borrow it
  OwnedVec x;                    // in the unknowns of the open contact
  ContactCase contactCase;       // with all gaps closed
  double gapUnit = 0;
  steady::Accuracy accuracy = {};
  ContactVector causes = {};
  Solution solution = {};
  double left = 0;      // natural residual, N
  bool isBest = false;  // a correction would not reduce it

  bool isAccurate() const { return left <= accuracy.target * accuracy.forceUnit; }
};

bool CondensedProblem::isExact(const contact::Contact& contact, const elasticity::Bodies& bodies) {
  return !contact.sliding.convected && !bodies.rotationStiffness;
}

CondensedProblem::CondensedProblem(const Problem& problem, const contact::CoupledSystem& closed)
    : problem_(problem),
      contact_(problem.contact()),
      gaps_(contact_.interfaces.nodes.size(), 0.0),
      sticking_(Sticking::allHeld(contact_)) {
  if (contact_.hasSticking())
    free_ = std::make_unique<Problem>(problem.mesh(), problem.bodies(), contact_,
                                      Sticking::allFree(contact_));
  const auto& transformation = open().transformation();
  impedance_ = std::make_unique<impedance::Impedance>(
      contact_, transformation, problem.bodies().stiffness,
      unitSlipRows(contact_, transformation, contact_.slip(1, nullptr)), closed);
  solver_ = std::make_unique<impedance::ContactSolver>(*impedance_);
}

CondensedProblem::~CondensedProblem() = default;

const Loads& CondensedProblem::loads() {
  if (!loads_) loads_ = std::make_unique<Loads>(open(), *impedance_);
  return *loads_;
}

bool slideAlike(const Sticking& a, const Sticking& b) {
  if (a.holds.size() != b.holds.size()) return false;
  for (std::size_t i = 0; i < a.holds.size(); ++i) {
    const bool slides = a.holds[i] == Hold::released;
    if (slides != (b.holds[i] == Hold::released)) return false;
    if (slides && a.direction[i] != b.direction[i]) return false;
  }
  return true;
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
  for (std::size_t k = contact_.interfaces.nodes.size(); k < nodeOf.size(); ++k)
    result.free[k] = sticking.holds[nodeOf[k]] != Hold::held;
  return result;
}

/// Collective. Returns the direct effect of the friction of released nodes on them; null if there
/// are none.
OwnedMat CondensedProblem::directFriction(const Sticking& sticking) {
  const bool any = mpi::any(comm(), std::ranges::count(sticking.holds, Hold::released) > 0);
  const bool known = mpi::all(comm(), slideAlike(directOf_, sticking));
  if (!any) return {};
  if (known) return direct_.share();
  std::vector<contact::Slip> slips(contact_.interfaces.nodes.size());
  for (std::size_t i = 0; i < slips.size(); ++i)
    if (sticking.holds[i] == Hold::released) slips[i].direction = sticking.direction[i];
  direct_ = impedance_->directFriction(unitSlipRows(contact_, free_->transformation(), slips));
  directOf_ = sticking;
  return direct_.share();
}

SetCase CondensedProblem::caseOn(const ChosenSet& set) {
  SetCase result{{conditions(set.at, set.sticking), loads().forces(set.at)},
                 directFriction(set.sticking)};
  auto& conditions = result.contactCase.conditions;
  conditions.direct = result.direct;
  const auto& nodeOf = impedance_->nodeOf();
  for (std::size_t k = 0; k < nodeOf.size(); ++k)
    if (!set.closed[nodeOf[k]]) conditions.free[k] = 1;
  return result;
}

std::vector<impedance::ContactResponses> CondensedProblem::respond(
    const std::vector<sweep::Parameters>& points, ChosenSet set,
    const std::vector<PetscInt>& changed, const std::vector<double>& frictionUnits) {
  std::vector<ContactCase> cases;
  OwnedMat direct;  // the same for all points; the cases borrow it
  for (const auto& at : points) {
    set.at = at;
    auto [one, ofOne] = caseOn(set);
    cases.push_back(std::move(one));
    direct = std::move(ofOne);
  }
  return solver_->respond(cases, changed, frictionUnits);
}

/// Solves for the gaps of a trial with these given forces, and returns (t, w).
ContactVector CondensedProblem::complementarity(Trial& trial, const ContactVector& given) {
  if (impedance_->size() == 0) return ContactVector(impedance_->length(), 0.0);
  ContactCase contactCase = trial.contactCase;
  contactCase.given = given;
  auto& gaps = trial.start.gaps;
  const auto solve = [&] {
    return solveGaps({.contact = contact_,
                      .solver = *solver_,
                      .contactCase = contactCase,
                      .gapUnit = trial.gapUnit,
                      .forceUnit = trial.accuracy.forceUnit,
                      .accuracy = trial.accuracy.target},
                     gaps, trial.solution);
  };
  if (!solve() && trial.start.withPivots && pivotGaps(*solver_, contact_, contactCase, gaps))
    solve();
  return solver_->withGaps(gaps, contactCase).causes;
}

/// Sets the initial gaps of the trials by the primal-dual active set method (Hintermüller, Ito and
/// Kunisch, SIAM J. Optim. 13, 2003), with friction balanced to the relative `accuracy`. All trials
/// move together, so the solver extends its space in blocks. Returns the trials with consistent
/// active sets.
std::vector<CondensedProblem::Trial*> CondensedProblem::approach(std::vector<Trial*> moving,
                                                                 double accuracy) {
  const std::size_t n = impedance_->nodes();
  std::vector<Trial*> settled;
  for (int step = 0; step < mostSteps && !moving.empty(); ++step) {
    std::vector<ContactCase> cases;
    for (const Trial* trial : moving) {
      cases.push_back(trial->contactCase);
      for (std::size_t i = 0; i < n; ++i)
        cases.back().conditions.free[i] = trial->start.gaps[i] > 0;
    }
    const auto found = solver_->solve(cases, accuracy);
    std::vector<int> changes(moving.size());
    for (std::size_t k = 0; k < moving.size(); ++k) {
      auto& gaps = moving[k]->start.gaps;
      for (std::size_t i = 0; i < n; ++i) {
        const double gap = found[k].causes[n + i], force = found[k].effects[n + i];
        const bool isOpen = cases[k].conditions.free[i],
                   opens = contact_.interfaces.nodes[i].separates && (isOpen ? gap > 0 : force < 0);
        if (opens != isOpen) changes[k] = 1;
        // The size of a new gap is still unknown; only its sign matters.
        gaps[i] = !opens ? 0 : isOpen ? gap : moving[k]->gapUnit;
      }
    }
    mpi::reduce<int>(comm(), changes, MPI_LOR);
    std::vector<Trial*> still;
    for (std::size_t k = 0; k < moving.size(); ++k)
      if (found[k].found) (changes[k] ? still : settled).push_back(moving[k]);
    moving = std::move(still);
  }
  return settled;
}

/// Returns the unknowns x of the open contact that remain with the holds of a trial.
OwnedVec CondensedProblem::unknowns(const Trial& trial, Vec x) const {
  const OwnedVec z = elasticity::nodalVector(problem_.mesh());
  OwnedVec result = rightVector(trial.held.transformation().trial);
  check(MatMult(open().transformation().selection, x, z));
  check(MatMultTranspose(trial.held.transformation().selection, z, result));
  return result;
}

CondensedProblem::Trial CondensedProblem::trialOf(Start& start) {
  std::unique_ptr<Problem> own;
  if (free_)
    own = std::make_unique<Problem>(problem_.mesh(), problem_.bodies(), contact_, start.sticking);
  const Problem& held = own ? *own : problem_;
  Trial trial{start,
              std::move(own),
              held,
              directFriction(start.sticking),
              loads().unknowns(start.at),
              {conditions(start.at, start.sticking), loads().forces(start.at)}};
  trial.contactCase.conditions.direct = trial.direct;
  std::vector<double> friction;
  for (PetscInt i = 0; i < impedance_->nodes(); ++i)
    friction.push_back(trial.contactCase.conditions.coefficient[i] * trial.contactCase.given[i]);
  trial.contactCase.frictionUnit = linalg::length(comm(), friction);
  trial.solution.at = start.at;
  for (double gap : start.gaps) trial.gapUnit = std::max(trial.gapUnit, gap);
  trial.gapUnit = mpi::max(comm(), trial.gapUnit);
  if (trial.gapUnit == 0) check(VecNorm(trial.x, NORM_INFINITY, &trial.gapUnit));
  if (trial.gapUnit == 0) trial.gapUnit = 1;
  trial.accuracy = accuracyNear(trial.held, start.at, unknowns(trial, trial.x));
  return trial;
}

std::vector<Solution> CondensedProblem::solveFrom(std::vector<Start>& starts) {
  std::vector<Trial> trials;
  std::vector<Trial*> all;
  std::vector<Vec> x;
  DenseMatrix causes(impedance_->length());
  trials.reserve(starts.size());
  for (Start& start : starts) all.push_back(&trials.emplace_back(trialOf(start)));
  if (impedance_->size() > 0)
    approach(approach(all, roughAccuracy), impedance::ContactSolver::balanced);
  for (Trial& trial : trials) {
    trial.causes = complementarity(trial, trial.contactCase.given);
    causes.append(trial.causes);
    x.push_back(trial.x);
  }
  impedance_->addUnknowns(causes, x);
  for (Trial& trial : trials) {
    // Friction may move a weakly supported body far, which is known only now.
    trial.accuracy = accuracyNear(trial.held, trial.start.at, unknowns(trial, trial.x));
    trial.left = naturalResidual(trial.held, trial.start.at, unknowns(trial, trial.x));
  }
  int corrections = 0;
  while (corrections < mostCorrections && correct(trials)) ++corrections;
  std::vector<Solution> solutions;
  for (Trial& trial : trials) {
    auto& solution = solutions.emplace_back(std::move(trial.solution));
    steady::accept(solution, trial.left, trial.accuracy);
    if (solution.reason.empty()) solution.reason = "LINEAR";
    trial.held.conclude(unknowns(trial, trial.x), trial.left, solution);
  }
  return solutions;
}

/// Corrects the inaccurate trials by the residual of all equations. Returns false if there are
/// none.
bool CondensedProblem::correct(std::vector<Trial>& trials) {
  std::vector<Trial*> some;
  std::vector<OwnedVec> residuals, corrected;
  std::vector<Vec> r, x;
  std::vector<std::vector<double>> normal;
  DenseMatrix causes(impedance_->length());
  for (Trial& trial : trials) {
    if (trial.isBest || trial.isAccurate()) continue;
    // With t = c R and w unchanged, y is corrected. The forces at the contact without t and w are
    // the new start.
    const auto& at = trial.start.at;
    some.push_back(&trial);
    residuals.push_back(rightVector(open().transformation().trial));
    corrected.push_back(rightVector(open().transformation().trial));
    r.push_back(residuals.back());
    x.push_back(corrected.back());
    open().residual(at, trial.x, r.back());
    check(VecCopy(trial.x, x.back()));
    normal.push_back(open().normalForces(open().forces(at, open().displacement(at, trial.x))));
    for (std::size_t i = 0; i < normal.back().size(); ++i)
      trial.causes[i] = trial.contactCase.conditions.coefficient[i] * normal.back()[i];
    causes.append(trial.causes);
  }
  if (some.empty()) return false;
  DenseMatrix given = impedance_->relax(r, x);
  linalg::addScaled(given, -1, impedance_->responses(causes));
  DenseMatrix steps(impedance_->length());
  std::vector<ContactVector> better;
  for (std::size_t k = 0; k < some.size(); ++k) {
    const auto column = given.column(k);
    for (std::size_t i = 0; i < normal[k].size(); ++i) column[i] += normal[k][i];
    better.push_back(complementarity(*some[k], {column.begin(), column.end()}));
    steps.append(better.back());
  }
  linalg::addScaled(steps, -1, causes);
  impedance_->addUnknowns(steps, x);
  for (std::size_t k = 0; k < some.size(); ++k) {
    Trial& trial = *some[k];
    const double now = naturalResidual(trial.held, trial.start.at, unknowns(trial, x[k]));
    trial.isBest = !(now < 0.5 * trial.left);
    if (trial.isBest) continue;
    trial.left = now;
    check(VecCopy(x[k], trial.x));
    trial.causes = std::move(better[k]);
  }
  return true;
}

std::vector<Solution> CondensedProblem::solveTogether(const std::vector<sweep::Parameters>& points,
                                                      bool withPivots) {
  std::vector<Start> starts;
  for (const auto& at : points) {
    problem_.requireSlip(at);
    starts.push_back({at, sticking_, gaps_, withPivots});
  }
  auto solutions = solveFrom(starts);
  // Points whose holds change are solved again, together.
  std::vector<std::size_t> unsettled(points.size());
  std::iota(unsettled.begin(), unsettled.end(), 0);
  while (true) {
    std::vector<Start> again;
    std::erase_if(unsettled, [&](std::size_t k) {
      auto next = problem_.nextHolds(solutions[k]);
      if (next) again.push_back({points[k], std::move(*next), starts[k].gaps, withPivots});
      return !next;
    });
    if (unsettled.empty()) break;
    auto better = solveFrom(again);
    for (std::size_t i = 0; i < unsettled.size(); ++i) {
      const std::size_t k = unsettled[i];
      better[i].revisions = solutions[k].revisions + 1;
      better[i].iterations += solutions[k].iterations;
      solutions[k] = std::move(better[i]);
      starts[k].gaps = std::move(again[i].gaps);
    }
  }
  if (solutions.back().converged) {
    continueFrom(solutions.back());
    gaps_ = starts.back().gaps;
  }
  return solutions;
}

void CondensedProblem::continueFrom(const Solution& solution) {
  sticking_ = Sticking::allHeld(contact_);
  for (std::size_t i = 0; i < solution.closed.size(); ++i) {
    if (!solution.closed[i]) sticking_.holds[i] = solution.sticking.holds[i];
    gaps_[i] = solution.contact[i].coefficient;
  }
}

}  // namespace squeal::condensed
