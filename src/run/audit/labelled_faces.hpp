// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The boundary faces of all bodies, with the interfaces that they belong to.
#include <string>
#include <vector>

#include "model/mortar/face.hpp"
#include "run/audit/subject.hpp"

namespace squeal::audit {

/// The body of a face and the interfaces that it belongs to: it is in the group of one of their
/// sides, or all its nodes touch or are tied there. Couplings count as further interfaces.
struct FaceLabel {
  int body = 0;
  std::vector<int> interfaces;  ///< index into Interfaces::options, or their number plus the index
                                ///< of a coupling; ascending
  std::vector<int> groups;      ///< index into LabelledFaces::groups; ascending
  auto operator<=>(const FaceLabel&) const = default;
};

/// The boundary faces of this rank.
struct LabelledFaces {
  /// `body` is an index into `labels`, since the search of faces on other ranks carries it along.
  std::vector<mortar::Face> faces;
  std::vector<FaceLabel> labels;  ///< the same on all ranks
  /// The surface groups and the groups of nodes that options name, the same on all ranks. A face
  /// belongs to a group of nodes if all its nodes do.
  std::vector<std::string> groups;
  /// [face][node] true if the node belongs to an interface, a coupling or a periodic boundary
  std::vector<std::vector<unsigned char>> joined;
};

/// Collective.
LabelledFaces labelledFaces(const Subject& model);

}  // namespace squeal::audit
