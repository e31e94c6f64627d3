// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The supports of each part of the model, and conditions that are lost or strain cells.
#include <string>
#include <vector>

#include "run/audit/finding.hpp"
#include "run/audit/subject.hpp"

namespace squeal::audit {

/// A support of a part, by the words of its option.
struct Support {
  std::string by;      ///< "support 'mounting'", "interface 'pad'"
  PetscInt nodes = 0;  ///< of the part; where meshes do not match, only nodes of the slave count,
                       ///< and for the master those of the slave that touch it
};

/// The supports of a connected part, or of a reference node.
struct PartSupports {
  std::string part;  ///< names of its bodies
  std::vector<Support> supports;
  bool needsContact = false;  ///< without contact it has a rigid-body mode
};

/// Collective. Returns the supports, [part].
std::vector<PartSupports> partSupports(const Subject& model);

/// Not collective. Returns findings on nodes whose conditions exclude each other, and on cells that
/// the adjustment of a tie strains.
Findings conditionFindings(const Subject& model);

}  // namespace squeal::audit
