// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/reactions.hpp"

#include <optional>

#include "base/system/text.hpp"
#include "steady/steady/reactions.hpp"

namespace squeal::report {

std::string reactionTable(const analysis::Analysis& analysis) {
  std::string table =
      "friction,speed,pressure,kind,name,force_x_n,force_y_n,force_z_n,moment_x_n_m,moment_y_n_m,"
      "moment_z_n_m\n";
  const auto& [mesh, bodies, contact] = analysis.model;
  std::optional<steady::Reactions> reactions;
  for (const auto& solution : analysis.steady.solutions) {
    if (!solution.converged) continue;
    if (!reactions) reactions.emplace(*mesh, bodies, contact);
    const auto& at = solution.at;
    for (const auto& [kind, name, wrench] : reactions->of(solution)) {
      const auto& [f, m] = wrench;
      table +=
          shortest(at.friction) + "," + shortest(at.speed) + "," + shortest(at.pressure) + "," +
          kind + "," + name +
          formatted(",%.12e,%.12e,%.12e,%.12e,%.12e,%.12e\n", f[0], f[1], f[2], m[0], m[1], m[2]);
    }
  }
  return table;
}

}  // namespace squeal::report
