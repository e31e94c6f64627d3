// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Solves for steady sliding in the unknowns of the contact; all other equations are linear or
/// nearly so [3.10–3.13, M.59].
#include <memory>
#include <utility>
#include <vector>

#include "steady/condensed/loads.hpp"
#include "steady/impedance/contact_solver.hpp"
#include "steady/impedance/impedance.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::condensed {

using steady::Problem;
using steady::Solution;
using steady::Sticking;

/// A point of the sweep with a given set of closed nodes.
struct ChosenSet {
  sweep::Parameters at;
  /// [contact node of this rank] 1 if it is closed; the others are open
  contact::Mask closed;
  /// Which sticking nodes are held, open or released (steady::Hold).
  Sticking sticking;
};

/// Returns true if the same nodes of this rank are released (steady::Hold), in the same directions.
bool slideAlike(const Sticking& a, const Sticking& b);

/// The condensed problem of a set.
struct SetCase {
  impedance::ContactCase contactCase;
  OwnedMat direct;  ///< borrowed by the conditions of the case; null if no node is released
};

/// The complementarity problem in the gap unknowns only,
///   0 ≤ h ⟂ F(h) ≥ 0,
/// where F(h) are the normal contact forces at the gap unknowns h, in equilibrium with the friction
/// that they cause. One factorisation of the closed contact serves all frictions, pressures and
/// sets of open nodes. Points that are solved together share the computed responses of the contact
/// and use block solves, which take a fraction of the time of single solves. The effects of
/// convective terms on the forces and on the slip enter through corrections from the residual of
/// all equations (a modified Newton method).
class CondensedProblem {
 public:
  /// Returns true if the problem at each point is linear except for the contact. The result of
  /// onSet() then satisfies the equations of its set to round-off, which corrections reduce.
  static bool isExact(const contact::Contact& contact, const elasticity::Bodies& bodies);
  /// Collective. Borrows the problem and `closed`, the system with all contact nodes closed and all
  /// sticking nodes held, during the lifetime of the object.
  CondensedProblem(const Problem& problem, const contact::CoupledSystem& closed);
  ~CondensedProblem();
  /// Collective. Solves at all points as Problem::solve() does, starting from start(). The call
  /// needs memory for several vectors of all unknowns per point.
  std::vector<Solution> solveTogether(const std::vector<sweep::Parameters>& points) {
    return solveTogether(points, false);
  }
  /// Collective. Does the same at one point.
  Solution solve(const sweep::Parameters& at) { return std::move(solveTogether({at}).front()); }
  /// Collective. Does the same at one point; if SNES does not converge, the gaps are sought by
  /// complementary pivoting.
  Solution solveWithPivots(const sweep::Parameters& at) {
    return std::move(solveTogether({at}, true).front());
  }
  /// Collective. Returns the condensed problem of one set: its nodes are closed, all others open.
  /// Convective terms are omitted.
  SetCase caseOn(const ChosenSet& set);
  /// Collective. Returns the forces and gaps on one set. Their signs are not checked.
  impedance::ContactSolution onSet(const ChosenSet& set) {
    return solver_->solve(caseOn(set).contactCase);
  }
  /// Collective. Returns for each point the solution on one set and its responses to changes of the
  /// unknowns w (Impedance), as ContactSolver::respond() does. All points have this set; `set.at`
  /// is ignored.
  std::vector<impedance::ContactResponses> respond(const std::vector<sweep::Parameters>& points,
                                                   ChosenSet set,
                                                   const std::vector<PetscInt>& changed,
                                                   const std::vector<double>& frictionUnits);
  /// Collective. Returns the given forces (R, F)0 of the condensed problem at a point.
  impedance::ContactVector given(const sweep::Parameters& at) { return loads().forces(at); }
  /// Returns the contact node of each unknown w of this rank (Impedance::nodeOf()).
  const std::vector<PetscInt>& nodeOf() const { return impedance_->nodeOf(); }
  /// Makes the next solve() start from these holds and gaps. `gaps` are the gap unknowns h,
  /// [contact node], m.
  void startFrom(std::vector<double> gaps, Sticking sticking) {
    gaps_ = std::move(gaps);
    sticking_ = std::move(sticking);
  }
  /// Returns the gaps and holds from which the next solve() starts.
  std::pair<std::vector<double>, Sticking> start() const { return {gaps_, sticking_}; }
  /// Makes the next solve() start from the contact of a solution, with all its closed sticking
  /// nodes held.
  void continueFrom(const Solution& solution);
  const contact::Contact& contact() const { return contact_; }
  /// Returns the force per opening of the gap of a contact node of this rank, all other unknowns w
  /// held, N/m; 0 if not yet computed.
  double gapStiffness(std::size_t node) const { return solver_->stiffness(node); }
  /// Returns the same for any unknown w of this rank.
  double stiffness(std::size_t unknown) const { return solver_->stiffness(unknown); }
  MPI_Comm comm() const { return impedance_->comm(); }
  /// Returns the total number of right-hand sides of all solves so far.
  long solves() const { return impedance_->solves(); }

 private:
  struct Start;
  struct Trial;
  /// Returns the problem in which no sticking node is held.
  const Problem& open() const { return free_ ? *free_ : problem_; }
  const Loads& loads();
  impedance::ContactConditions conditions(const sweep::Parameters& at,
                                          const Sticking& sticking) const;
  OwnedMat directFriction(const Sticking& sticking);
  std::vector<Solution> solveTogether(const std::vector<sweep::Parameters>& points,
                                      bool withPivots);
  std::vector<Solution> solveFrom(std::vector<Start>& starts);
  Trial trialOf(Start& start);
  OwnedVec unknowns(const Trial& trial, Vec x) const;
  std::vector<Trial*> approach(std::vector<Trial*> moving, double accuracy);
  impedance::ContactVector complementarity(Trial& trial, const impedance::ContactVector& given);
  bool correct(std::vector<Trial>& trials);

  const Problem& problem_;
  const contact::Contact& contact_;
  std::unique_ptr<Problem> free_;  // all nodes free; null if no interface sticks
  std::unique_ptr<impedance::Impedance> impedance_;
  std::unique_ptr<impedance::ContactSolver> solver_;
  std::vector<double> gaps_;  // from which the next solve() starts, [contact node], m
  Sticking sticking_;         // from which the next solve() starts
  OwnedMat direct_;           // direct effect of friction on the released nodes of directOf_
  Sticking directOf_;
  std::unique_ptr<Loads> loads_;  // of open(), created on first use
};

}  // namespace squeal::condensed
