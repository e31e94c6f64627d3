// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Holds of the nodes of sticking interfaces along their master. The steady state frees nodes that
/// open, and nodes that may slide if the reaction exceeds their limit of friction.
#include <optional>
#include <vector>

#include "model/contact/contact.hpp"

namespace squeal::steady {

using mesh::Point;

struct Solution;

/// The state of a node of a sticking interface along the surface.
enum class Hold : unsigned char {
  held,     ///< no jump
  open,     ///< free, without a force: the node is open, or separates or slides if it is held
  released  ///< free, with the friction −f R_N d on the pad
};

/// The holds of all contact nodes. They have no meaning on other interfaces.
struct Sticking {
  std::vector<Hold> holds;       ///< [contact node]
  std::vector<Point> direction;  ///< [contact node] d, unit, if released
  contact::Mask heldAgain;       ///< [contact node] 1 after it has been held again

  /// Returns the holds with all nodes held.
  static Sticking allHeld(const contact::Contact& contact);
  /// Returns the holds with all nodes free.
  static Sticking allFree(const contact::Contact& contact);
  /// Returns 1 for the nodes that are not held, [contact node].
  contact::Mask free() const;
};

/// Returns the slip, [contact node], with that of the released nodes: the direction d and
/// their limit as a fixed coefficient.
std::vector<contact::Slip> withReleased(const contact::Contact& contact,
                                        std::vector<contact::Slip> slip, const Sticking& sticking);

/// Returns true if the normal force is tensile at node i, which does not separate.
bool isPulled(const contact::Contact& contact, const Solution& solution, std::size_t i);

/// Returns true if the reaction on the closed node i exceeds f R_N, or zero under tension, beyond
/// round-off; false without a limit.
bool exceedsLimit(const contact::Contact& contact, const Solution& solution, std::size_t i);

/// Collective. Returns the revised holds of a solution; none if they do not change. A held or
/// released node that has opened is freed, and one that has closed is held. On interfaces with
/// `_release`, a node above its limit is released, and a node that slides along its friction
/// instead of against it is held again. Each node is held again at most once, so that the revisions
/// end. After that it stays free and without a force, even if it closes.
std::optional<Sticking> revised(const contact::Contact& contact, const Solution& solution);

}  // namespace squeal::steady
