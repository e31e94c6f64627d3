// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Two ways to the same result, compared within what their error estimates allow.
#include <string>

#include "fuzz/models/outcome.hpp"

namespace squeal::fuzz {

/// What two runs have in common.
struct Extent {
  bool sameSweep = true;     ///< all points; otherwise those of `second` are some of `first`
  bool criticals = true;     ///< both solve for critical frictions
  bool sameUnknowns = true;  ///< the numbers of open nodes agree
  bool sameWay = true;       ///< of the contact, which chooses where steady sliding is not unique
  bool mayMiss = false;      ///< the second run may find no steady state where the first one does
  double state = 0;          ///< what else the steady states may change of |s|, relative
};

/// Returns the first difference between two results, in a line; empty if there is none.
std::string difference(const Outcome& first, const Outcome& second, const Extent& extent);

}  // namespace squeal::fuzz
