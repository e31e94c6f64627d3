// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Nodes of sticking interfaces are held along their master. The steady state frees them where they
/// open, and where the force that holds them exceeds their limit of friction and they may slide.
#include <optional>
#include <vector>

#include "model/contact/contact.hpp"

namespace squeal::steady {

using mesh::Point;

struct Solution;

/// What becomes of a node of a sticking interface along the surface.
enum class Hold : unsigned char {
  held,     ///< no jump
  open,     ///< free, without a force: it is open, or it opens or slides whenever it is held
  released  ///< free, with the friction −f R_N d on the pad
};

/// The holds of all contact nodes. On other interfaces they mean nothing.
struct Sticking {
  std::vector<Hold> holds;       ///< [owned contact node]
  std::vector<Point> direction;  ///< [owned contact node] d, unit, where released
  contact::Mask heldAgain;       ///< [owned contact node] 1 once it has been held again

  /// Returns the holds with all nodes held.
  static Sticking allHeld(const contact::Contact& contact);
  /// Returns the holds with all nodes free.
  static Sticking allFree(const contact::Contact& contact);
  /// Returns 1 for the nodes that are not held, [owned contact node].
  contact::Mask free() const;
};

/// Returns the slip, [owned contact node], with that of the released nodes: the direction d and
/// their limit as a coefficient that is fixed.
std::vector<contact::Slip> withReleased(const contact::Contact& contact,
                                        std::vector<contact::Slip> slip, const Sticking& sticking);

/// Returns true if the force that holds the closed node i exceeds f R_N beyond rounding.
/// Without a limit it never does.
bool exceedsLimit(const contact::Contact& contact, const Solution& solution, std::size_t i);

/// Collective. Returns the holds that the solution asks for, where they differ from those that it
/// was found with. A held or released node that has opened is freed, and one that has closed is
/// held. On interfaces with `_release` a node that exceeds its limit is released, and one that
/// slides along its friction, rather than against it, is held again. A node is held again once at
/// most, so that the revisions end: after that it stays free, without a force, although it closes.
std::optional<Sticking> revised(const contact::Contact& contact, const Solution& solution);

}  // namespace squeal::steady
