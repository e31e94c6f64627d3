// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A finding of the audit: a property of the model that is probably a mistake.
#include <cstddef>
#include <string>
#include <vector>

namespace squeal::audit {

enum class Kind {
  units,            ///< values that do not belong to one system of units
  rotation,         ///< an axis of rotation away from the bodies that rotate about it
  nearFaces,        ///< faces of two bodies that face each other in no interface
  unmergedNodes,    ///< nodes at the same place that nothing joins
  cells,            ///< distorted cells
  locking,          ///< linear cells of a nearly incompressible body
  detached,         ///< sections of a body that nothing joins to its others
  overconstrained,  ///< nodes with more conditions than unknowns
  adjustment        ///< cells that the adjustment of a tie strains
};

enum class Severity {
  warning,  ///< the results are probably wrong
  note      ///< probably intended
};

struct Finding {
  Kind kind;
  Severity severity;
  std::string text;    ///< the finding with groups, places and figures, without full stop
  std::string remedy;  ///< without full stop
};

using Findings = std::vector<Finding>;

/// Returns "1 face", "2 faces".
inline std::string counted(std::ptrdiff_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

}  // namespace squeal::audit
