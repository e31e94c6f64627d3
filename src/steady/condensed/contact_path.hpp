// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The path of the contact: how contact nodes change (open, close, are held or freed) between the
/// points of a sweep.
#include <string>
#include <vector>

#include "model/contact/active_set.hpp"
#include "steady/condensed/condensed_problem.hpp"

namespace squeal::condensed {

enum class Change : unsigned char {
  opens,
  closes,
  unheld,  ///< a closed node of a sticking interface is freed along the surface, without tangential
           ///< force
  held     ///< a closed node of a sticking interface that was free is held again
};

/// Returns the word that tables use for the change.
std::string text(Change change);

/// The change of a contact node on a straight line in the space of parameters.
struct ContactEvent {
  sweep::Parameters at;
  std::size_t node = 0;  ///< contact node of this rank
  Change change = Change::opens;
  bool isReleased = false;  ///< true if released afterwards (contact::ActiveSet)
  int order = 0;            ///< number of earlier events on the path, over all ranks
  std::size_t point = 0;    ///< point of the sweep at the end of the path; set by the caller
};

/// Returns the changes of this rank from one set to another at one point; all get this `order`.
std::vector<ContactEvent> changesBetween(const contact::ActiveSet& before,
                                         const contact::ActiveSet& after,
                                         const sweep::Parameters& at, int order);

struct ContactPath {
  std::vector<ContactEvent> events;  ///< events of this rank, in their order
  int count = 0;                     ///< number of events of all ranks
  /// Why the path does not reach its target; empty if it does.
  std::string obstacle;
  sweep::Parameters end;  ///< the point at which the path ends
  /// The state at `end`, if `obstacle` is empty.
  contact::Mask closed;      ///< [contact node] 1 if it is closed
  std::vector<double> gaps;  ///< [contact node] coefficient h of g = E h, m
  Sticking sticking;
};

/// Collective. Follows the steady state from the solution `from` along the straight line to the
/// parameters `to`, which differ from those of `from` in friction, pressure or speed. On each
/// active set the state is a smooth function of these parameters. The next change is at the first
/// zero of a normal force or gap, located to 1e-11 of the length of the line. A node of a sticking
/// interface that opens is freed along the surface, and held again when it closes. If the node,
/// once held again, would change at once, it is not held again, but stays closed and unheld. A node
/// that opens loses its tangential force, so the state jumps there. If no active set is consistent
/// after a change, the path jumps to the set that SNES finds from the last state slightly further
/// on, at most 1e-3 of the line; all nodes that differ change there. The path ends if SNES finds
/// none, or if the equations of an active set are singular (a pole of forces and gaps). Two zeros
/// of one node between consecutive events may be missed.
ContactPath traceContact(CondensedProblem& problem, const Solution& from,
                         const sweep::Parameters& to);

}  // namespace squeal::condensed
