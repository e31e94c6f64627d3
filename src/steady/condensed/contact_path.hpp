// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The path of the contact: the points between those of a sweep at which nodes open and close.
#include <string>
#include <vector>

#include "model/contact/active_set.hpp"
#include "steady/condensed/condensed_problem.hpp"

namespace squeal::condensed {

enum class Change : unsigned char {
  opens,
  closes,
  unheld,  ///< a closed node of a sticking interface is freed along the surface, without a force
  held     ///< a closed node that was free is held again
};

/// Returns the word of the tables.
std::string text(Change change);

/// The change of a contact node along a line of parameters.
struct ContactEvent {
  sweep::Parameters at;
  std::size_t node = 0;  ///< contact node of this rank
  Change change = Change::opens;
  bool isReleased = false;  ///< afterwards (contact::ActiveSet)
  int order = 0;            ///< index among the events of all ranks on the path
  std::size_t point = 0;    ///< of the sweep, to which the path leads; set by its owner
};

/// Returns the changes of this rank from one set to another at one place; `order` is their order.
std::vector<ContactEvent> changesBetween(const contact::ActiveSet& before,
                                         const contact::ActiveSet& after,
                                         const sweep::Parameters& at, int order);

struct ContactPath {
  std::vector<ContactEvent> events;  ///< of this rank, in their order
  int count = 0;                     ///< events of all ranks
  /// Why the path does not reach the last point; empty if it does.
  std::string obstacle;
  sweep::Parameters end;  ///< last point of the path
  /// The state at `end`, if it is the last point.
  contact::Mask closed;      ///< [contact node] 1 if it is closed
  std::vector<double> gaps;  ///< [contact node] coefficient h of g = E h, m
  Sticking sticking;
};

/// Two solutions at the ends of a path of the contact; borrowed.
struct ContactInterval {
  const Solution *from, *to;
};

/// Collective. Precomputes in blocks the states that traceContact() will probably need on these
/// paths. Linear interpolation between the ends of a path predicts the changes, their order and the
/// sets in between. This affects only the run time.
void precomputeContact(CondensedProblem& problem, const std::vector<ContactInterval>& intervals);

/// Collective. Follows the steady state from a solution along the line to `to`, which differs in
/// friction, pressure or speed. On each active set the state is a smooth function of these
/// parameters, and the next change is the first zero of a normal force or gap, with an accuracy of
/// 1e-8 of the line. A node of a sticking interface that opens is freed along the surface, and held
/// again when it closes. If this makes it change again at once, it stays closed and unheld. All
/// unheld nodes have lost their tangential force, so the state jumps there. The path ends if the
/// equations of an active set are singular (a pole of forces and gaps), or if no active set is
/// consistent after a change. Two zeros of one node within a single step may be missed.
ContactPath traceContact(CondensedProblem& problem, const Solution& from,
                         const sweep::Parameters& to);

}  // namespace squeal::condensed
