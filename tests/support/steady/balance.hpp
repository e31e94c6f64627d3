// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Reactions of steady states, and sums of forces.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "eigen/sweep/parameters.hpp"
#include "model/contact/coupled.hpp"
#include "steady/steady/reactions.hpp"
#include "steady/steady/steady.hpp"
#include "support/harness/ranks.hpp"
#include "support/model/model.hpp"

namespace squeal::test {

/// A box of 4 × 2 × 2 cells, 1 × 0.4 × 0.3 m. It is meshed with groups clamped and tip at the ends
/// of the length, and right, left, bottom and top on its sides.
inline const std::string box = "-mesh_file meshes/beam.geo -mesh_set nx=4,Ly=0.4,Lz=0.3 " +
                               material("beam", "2e11", "0.3", "8000");

/// The reactions of one steady state.
class Balance {
 public:
  /// Collective. Solves with the options in force.
  explicit Balance(const sweep::Parameters& at = {}) {
    const auto model = buildModel();
    dimension_ = model.mesh->dimension;
    const contact::CoupledSystem system(
        model.bodies, model.contact,
        contact::ActiveSet::bonded(model.contact.interfaces.nodes.size()));
    const steady::Problem problem(*model.mesh, model.bodies, model.contact);
    const auto solution = problem.solve(at, system);
    EXPECT_TRUE(solution.converged) << solution.reason;
    rows_ = steady::Reactions(*model.mesh, model.bodies, model.contact).of(solution);
    for (const auto& row : rows_) {
      force_ = std::max(force_, mesh::length(row.wrench.force));
      moment_ = std::max(moment_, mesh::length(row.wrench.moment));
    }
    EXPECT_EQ(rows_.back().kind, "sum");
    expect("sum", "", {});
    print("  imbalance: %.1e of %.3g N, %.1e of %.3g N m\n",
          mesh::length(rows_.back().wrench.force) / force_, force_,
          mesh::length(rows_.back().wrench.moment) / moment_, moment_);
  }
  /// Collective. Solves with these options on the box.
  explicit Balance(const std::string& options, const sweep::Parameters& at = {})
      : Balance((setOptions(box + options), at)) {}
  /// Returns a row; a failure if there is none.
  steady::Wrench row(const std::string& kind, const std::string& name) const {
    const auto found = std::ranges::find_if(
        rows_, [&](const auto& row) { return row.kind == kind && row.name == name; });
    if (found != rows_.end()) return found->wrench;
    ADD_FAILURE() << "no row " << kind << " " << name;
    return {};
  }
  /// Expects force and moment about the origin, within round-off of the largest ones.
  void expect(const std::string& kind, const std::string& name,
              const steady::Wrench& expected) const {
    const steady::Wrench found = row(kind, name);
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_NEAR(found.force[d], expected.force[d], 1e-10 * force_)
          << kind << " " << name << " force " << d;
      EXPECT_NEAR(found.moment[d], expected.moment[d], 1e-10 * moment_)
          << kind << " " << name << " moment " << d;
    }
  }
  bool has(const std::string& kind) const {
    return std::ranges::any_of(rows_, [&](const auto& row) { return row.kind == kind; });
  }

 private:
  std::vector<steady::Reaction> rows_;
  double force_ = 0, moment_ = 0;
  int dimension_ = 0;
};

inline steady::Wrench forceAt(const mesh::Point& x, const mesh::Point& f,
                              const mesh::Point& m = {}) {
  return {f, mesh::plus(mesh::cross(x, f), m)};
}
inline steady::Wrench opposite(const steady::Wrench& w) {
  return {mesh::scaled(w.force, -1), mesh::scaled(w.moment, -1)};
}
inline steady::Wrench sum(steady::Wrench a, const steady::Wrench& b) {
  a.add(b);
  return a;
}

}  // namespace squeal::test
