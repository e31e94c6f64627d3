// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Steady sliding is solved in the unknowns of the contact, since everything else is linear or
/// nearly so [3.10–3.13, M.59].
#include <memory>
#include <vector>

#include "steady/condensed/loads.hpp"
#include "steady/impedance/contact_solver.hpp"
#include "steady/impedance/impedance.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::condensed {

using steady::Problem;
using steady::Solution;
using steady::Sticking;

/// A point of the sweep with a choice of closed nodes.
struct ChosenSet {
  sweep::Parameters at;
  /// [contact node of this rank] 1 where it is closed; the others are open
  contact::Mask closed;
  /// Nodes that stick are held where they are closed, unless this says otherwise.
  Sticking sticking;
};

/// The complementarity problem in only the gaps,
///   0 ≤ g ⟂ F(g) ≥ 0,
/// where F(g) holds the forces at the gaps with the friction f R in balance. The one factorisation
/// of the closed contact serves all frictions, pressures and sets of open nodes. Points that are
/// solved for together share what they find out about the contact, and what they ask of the
/// factorisation is asked in blocks, which costs a fraction of as many single solves. What
/// convective terms add to forces and slip comes with the corrections by the residual of all
/// equations, a modified Newton method.
class CondensedProblem {
 public:
  /// Returns true if everything but the contact is linear at each point: solutions then need no
  /// corrections except for round-off, and onSets() gives them.
  static bool isExact(const contact::Contact& contact, const elasticity::Bodies& bodies);
  /// Collective. Borrows the problem and `closed`, the system with all contact nodes closed and
  /// all that stick held, during the life of the object.
  CondensedProblem(const Problem& problem, const contact::CoupledSystem& closed);
  ~CondensedProblem();
  /// Collective. Solves at all points as Problem::solve() does, from the gaps and holds of the last
  /// solution of the last call. Some vectors of all unknowns are held for each point meanwhile.
  std::vector<Solution> solveTogether(const std::vector<sweep::Parameters>& points) {
    return solveTogether(points, false);
  }
  /// Collective. The same at one point.
  Solution solve(const sweep::Parameters& at) { return std::move(solveTogether({at}).front()); }
  /// Collective. The same at one point, with complementary pivots where SNES finds no gaps.
  Solution solveWithPivots(const sweep::Parameters& at) {
    return std::move(solveTogether({at}, true).front());
  }
  /// Collective. Returns causes and effects where these nodes are closed and the others open,
  /// whatever signs that gives, without convective terms. Sets that are asked for together are
  /// solved for in blocks.
  std::vector<impedance::ContactSolution> onSets(const std::vector<ChosenSet>& sets);
  /// Collective. The same of one set.
  impedance::ContactSolution onSet(const ChosenSet& set) {
    return std::move(onSets({set}).front());
  }
  /// Lets the next solve() begin with these gaps, [contact node] coefficient of the gap, m, and
  /// holds.
  void beginWith(std::vector<double> gaps, Sticking sticking) {
    gaps_ = std::move(gaps);
    sticking_ = std::move(sticking);
  }
  /// Lets the next solve() begin with the contact of a solution, with what it has released held
  /// again.
  void continueFrom(const Solution& solution);
  const contact::Contact& contact() const { return contact_; }
  /// Returns the force that opens the gap of a contact node of this rank by a unit, N/m; 0 if it
  /// has never been open.
  double gapStiffness(std::size_t node) const { return solver_->gapStiffness(node); }
  MPI_Comm comm() const { return impedance_->comm(); }
  /// Returns the number of right-hand sides solved for so far.
  long solves() const { return impedance_->solves(); }

 private:
  struct Start;
  struct Trial;
  /// Returns the problem without holds.
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
  std::unique_ptr<Problem> free_;  // nothing sticks; null where no interface does
  std::unique_ptr<impedance::Impedance> impedance_;
  std::unique_ptr<impedance::ContactSolver> solver_;
  std::vector<double> gaps_;      // of the last solution, [contact node], m
  Sticking sticking_;             // of the last solution, with what has been released held again
  OwnedMat direct_;               // what the friction of released nodes does to them; null: nothing
  Sticking directOf_;             // the holds that `direct_` belongs to
  std::unique_ptr<Loads> loads_;  // of the problem without holds, made when first needed
};

}  // namespace squeal::condensed
