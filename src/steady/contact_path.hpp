#pragma once
/// The path of the contact tells at which points between those of a sweep nodes open and close.
#include <string>
#include <vector>

#include "steady/condensed_problem.hpp"

namespace squeal::steady {

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
};

/// Collective. Follows the steady state from a solution along the line to `to`, where the friction,
/// the pressure or the speed differ. On each active set the state is a smooth function of them, and
/// the next change is its first zero of a normal force or gap, solved for to 1e-8 of the line. Two
/// zeros of one node between the ends of what is followed at once are not seen.
ContactPath followContact(CondensedProblem& problem, const Solution& from,
                          const sweep::Parameters& to);

}  // namespace squeal::steady
