// SPDX-License-Identifier: BSD-2-Clause
#include "run/audit/audit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "run/audit/detached.hpp"
#include "run/audit/near_faces.hpp"
#include "run/audit/rotation.hpp"

namespace squeal::audit {

Audit auditOf(const Subject& model) {
  Audit audit;
  audit.dimension = model.mesh.dimension;
  audit.bodies = bodyMasses(model);
  audit.points = pointMasses(model);
  auto all = audit.bodies;
  all.insert(all.end(), audit.points.begin(), audit.points.end());
  audit.total = totalOf(all);
  audit.waveSpeed = waveSpeeds(model);
  audit.cells = cellQuality(model.mesh);
  audit.parts = partSupports(model);
  const auto add = [&](const Findings& more) {
    std::ranges::copy(more, std::back_inserter(audit.findings));
  };
  add(unitFindings(model, audit.bodies));
  add(rotationFindings(model, audit.bodies));
  add(nearFindings(model));
  add(cellFindings(model, audit.cells));
  add(detachedFindings(model));
  add(conditionFindings(model));
  std::ranges::stable_sort(audit.findings, {}, &Finding::severity);
  return audit;
}

std::string text(Kind kind) {
  switch (kind) {
    case Kind::units:
      return "units";
    case Kind::rotation:
      return "axis of rotation";
    case Kind::nearFaces:
      return "faces without an interface";
    case Kind::unmergedNodes:
      return "unmerged nodes";
    case Kind::cells:
      return "distorted cells";
    case Kind::locking:
      return "locking";
    case Kind::detached:
      return "detached sections";
    case Kind::overconstrained:
      return "over-constrained nodes";
    case Kind::adjustment:
      return "adjustment of a tie";
  }
  return "";
}

}  // namespace squeal::audit
