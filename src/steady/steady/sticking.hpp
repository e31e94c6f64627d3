// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The holds of the nodes of sticking interfaces: whether a node sticks to its master. The steady
/// state frees nodes that open and, where sliding is permitted (`_release`), nodes whose tangential
/// reaction exceeds the friction limit.
#include <optional>
#include <vector>

#include "model/contact/contact.hpp"

namespace squeal::steady {

using mesh::Point;

struct Solution;

/// The state of a node of a sticking interface in the directions along the surface.
enum class Hold : unsigned char {
  held,     ///< no jump
  open,     ///< free, without tangential force: the node is open, or would open or slide if it were
            ///< held
  released  ///< free, and slides with the friction −f R_N d on the pad
};

/// The holds of all contact nodes. On interfaces that are not sticking they have no meaning.
struct Sticking {
  std::vector<Hold> holds;       ///< [contact node]
  std::vector<Point> direction;  ///< [contact node] unit vector d, if released
  contact::Mask heldAgain;       ///< [contact node] 1 if it has been held again after it closed
  /// [contact node] number of times that it was released and, as it slid along its friction, held
  /// again
  contact::Mask slidBack;

  /// Returns holds with all nodes held.
  static Sticking allHeld(const contact::Contact& contact);
  /// Returns holds with all nodes free.
  static Sticking allFree(const contact::Contact& contact);
  /// Returns 1 for the nodes that are not held, [contact node].
  contact::Mask free() const;
};

/// Returns `slip`, [contact node], in which released nodes have their direction d, and their
/// friction limit as a fixed coefficient.
std::vector<contact::Slip> withReleased(const contact::Contact& contact,
                                        std::vector<contact::Slip> slip, const Sticking& sticking);

/// Returns true if node i does not separate and its normal force is tensile.
bool isPulled(const contact::Contact& contact, const Solution& solution, std::size_t i);

/// Returns true if node i is closed and held, and its tangential reaction exceeds the limit f R_N
/// beyond round-off. Under tension the limit is zero. Returns false if the interface has no limit.
bool exceedsLimit(const contact::Contact& contact, const Solution& solution, std::size_t i);

/// Collective. Returns the revised holds of a solution; none if they do not change. A held or
/// released node that has opened is freed, and a free node that has closed is held again, at most
/// once, so that the revisions end: if it is freed once more, it stays free, without tangential
/// force, even if it closes. On interfaces with `_release`, a node above its limit is released, and
/// a node that slides along its friction is held again. Many nodes released together may slide
/// back, each because of the others. Of the nodes that have slid back, therefore, only those that
/// exceed their limit most are released in a revision. After `mostReturns` times a node remains
/// released.
std::optional<Sticking> revised(const contact::Contact& contact, const Solution& solution);

/// Collective. Counts the released nodes that slide in the direction of their friction
/// force, Resultant::returned.
void countReturned(const contact::Contact& contact, Solution& solution);

/// The largest number of times that a node is held again after it has slid back.
inline constexpr unsigned char mostReturns = 3;

}  // namespace squeal::steady
