// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A finding of the audit: a property of the model that may be a mistake.
#include <cstddef>
#include <string>
#include <vector>

namespace squeal::audit {

enum class Kind {
  units,            ///< values that do not belong to one system of units
  rotation,         ///< an axis off the centre of mass, or a rigid tilt of negative stiffness
  nearFaces,        ///< faces that face each other without a common interface
  unmergedNodes,    ///< nodes at the same place that are not joined
  cells,            ///< distorted cells
  locking,          ///< linear cells of a nearly incompressible body
  detached,         ///< sections of a body that are not joined to the others
  overconstrained,  ///< nodes with more conditions than unknowns
  adjustment        ///< cells that are strained by the adjustment of a tie
};

enum class Severity {
  warning,  ///< the results are probably wrong
  note      ///< probably intended
};

struct Finding {
  Kind kind;
  Severity severity;
  std::string text;    ///< names groups, places and figures; without full stop
  std::string remedy;  ///< without full stop
};

using Findings = std::vector<Finding>;

/// Returns "1 face", "2 faces".
inline std::string counted(std::ptrdiff_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

}  // namespace squeal::audit
