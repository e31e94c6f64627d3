// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The supports of each connected part of the model, and findings on conditions that cannot be
/// imposed or that strain cells.
#include <string>
#include <vector>

#include "run/audit/finding.hpp"
#include "run/audit/subject.hpp"

namespace squeal::audit {

/// A support of a part.
struct Support {
  std::string by;  ///< such as "support 'mounting'" or "interface 'pad'"
  /// Number of supported nodes. At an interface, slave nodes are counted on both sides: the part of
  /// the master counts the slave nodes that touch it.
  PetscInt nodes = 0;
};

/// The supports of a connected part, or of a reference node.
struct PartSupports {
  std::string part;  ///< names of its bodies
  std::vector<Support> supports;
  bool needsContact = false;  ///< without contact the part has a rigid-body mode
};

/// Collective. Returns the supports of the parts, [part].
std::vector<PartSupports> partSupports(const Subject& model);

/// Not collective. Returns findings on nodes with more conditions than they can satisfy, and on
/// cells that are strained by the adjustment of a tie.
Findings conditionFindings(const Subject& model);

}  // namespace squeal::audit
