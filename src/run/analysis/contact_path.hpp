// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The changes of the contact nodes of all ranks between the points of a sweep.
#include <vector>

#include "run/analysis/analysis.hpp"

namespace squeal::analysis {

/// The change of one node.
struct PathEvent {
  int order;  ///< index along the path
  sweep::Parameters at;
  mesh::Point position;  ///< m
  int interface;         ///< index into Contact::interfaces
  condensed::Change change;
};

/// Collective. Returns the events of all ranks in their order, the same on all ranks.
std::vector<PathEvent> contactPath(const Analysis& analysis);

}  // namespace squeal::analysis
