// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The path of the contact: the points between those of a sweep at which nodes open and close.
#include <string>
#include <vector>

#include "steady/condensed/condensed_problem.hpp"

namespace squeal::condensed {

/// A contact node that opens or closes where the parameters vary along a line.
struct ContactEvent {
  sweep::Parameters at;
  std::size_t node = 0;  ///< contact node of this rank
  bool opens = false;
  int order = 0;  ///< place among the events of all ranks on the path
};

struct ContactPath {
  std::vector<ContactEvent> events;  ///< of this rank, in their order
  int count = 0;                     ///< events of all ranks
  /// Why the path does not lead to the last point; empty if it does.
  std::string obstacle;
  sweep::Parameters end;  ///< point up to which it has been followed
  /// The state there, if it is the last point.
  contact::Mask closed;      ///< [contact node] 1 where it is closed
  std::vector<double> gaps;  ///< [contact node] coefficient h of g = E h, m
  Sticking sticking;
};

/// Two solutions between which the contact is to be followed; borrowed.
struct ContactWay {
  const Solution *from, *to;
};

/// Collective. Lets the problem learn in blocks what followContact() will ask for on all these
/// ways: the states on the sets between their ends, at the changes and in the order that linear
/// interpolation gives. That decides on nothing but costs.
void anticipateContact(CondensedProblem& problem, const std::vector<ContactWay>& ways);

/// Collective. Follows the steady state from a solution along the line to `to`, where the friction,
/// the pressure or the speed differ. On each active set the state is a smooth function of them, and
/// the next change is its first zero of a normal force or gap, solved for to 1e-8 of the line. The
/// path ends where the equations of an active set are singular, a pole of forces and gaps, and
/// where no active set holds behind a change. Two zeros of one node between the ends of what is
/// followed at once are not seen.
ContactPath followContact(CondensedProblem& problem, const Solution& from,
                          const sweep::Parameters& to);

}  // namespace squeal::condensed
