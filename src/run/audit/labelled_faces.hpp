// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The boundary faces of all bodies, with the interfaces that they belong to.
#include <string>
#include <vector>

#include "model/mortar/face.hpp"
#include "run/audit/subject.hpp"

namespace squeal::audit {

/// The body and the interfaces of a face. A face belongs to an interface if it is in the group of
/// either side of the interface, or if all nodes of the face touch or are tied there. Couplings are
/// treated as further interfaces.
struct FaceLabel {
  int body = 0;
  std::vector<int> interfaces;  ///< indices into Interfaces::options; a coupling has its index plus
                                ///< options.size(); ascending
  std::vector<int> groups;      ///< indices into LabelledFaces::groups; ascending
  auto operator<=>(const FaceLabel&) const = default;
};

/// The boundary faces of this rank.
struct LabelledFaces {
  /// Face::body is an index into `labels` here, because the search for near faces sends this member
  /// to other ranks.
  std::vector<mortar::Face> faces;
  std::vector<FaceLabel> labels;  ///< the same on all ranks
  /// The groups of surfaces and of nodes that options name, the same on all ranks. A face belongs
  /// to a group of nodes if all its nodes do.
  std::vector<std::string> groups;
  /// [face][node] 1 if the node belongs to an interface, a coupling or a periodic boundary,
  /// otherwise 0
  std::vector<std::vector<unsigned char>> joined;
};

/// Collective. Returns the boundary faces of this rank with their labels.
LabelledFaces labelledFaces(const Subject& model);

}  // namespace squeal::audit
