// SPDX-License-Identifier: BSD-2-Clause
// A brake of three steel parts, tet10 with some 42,000 unknowns, from a contact that is closed to
// one that opens: steady sliding is found at all frictions on any number of ranks, with the same
// forces.
#include "support/harness/same_on_ranks.hpp"
#include "support/model/steel_brake.hpp"

namespace squeal::test {
namespace {

TEST(StiffBrake, HasTheSameForcesOnAnyNumberOfRanks) {
  const std::string options =
      steel_brake::options(2, 0.0105, 1e7) +
      " -flutter_friction 0:0.6:0.1 -modes_count 5 -flutter_basis modal -report_fields off ";
  std::vector<Findings> found;
  for (int ranks : {1, 2, 3}) {
    const ProgramRun run =
        runProgram("stiff_brake/np" + std::to_string(ranks), ranks, options, 600);
    ASSERT_EQ(run.exitCode, 0) << run.error;
    found.push_back(findingsOf(run));
  }
  EXPECT_GT(found[0].summary.at("dofs"), 40'000);
  for (std::size_t k = 1; k < found.size(); ++k) {
    ASSERT_EQ(found[k].steady.size(), 7U);
    for (const auto& [friction, table] : found[0].steady) {
      const auto wanted = contactForces(table), other = contactForces(found[k].steady.at(friction));
      ASSERT_EQ(wanted.size(), other.size());
      double size = 0, difference = 0;
      for (const auto& [place, force] : wanted)
        for (std::size_t i = 0; i < force.size(); ++i) {
          size = worse(size, std::abs(force[i]));
          difference = worse(difference, std::abs(force[i] - other.at(place).at(i)));
        }
      print("friction %g, %zu ranks: forces differ by %.1e of the largest\n", friction, k + 1,
            difference / size);
      // Residuals of 1e-11 to 1e-10 of the loads, which rounding of the displacements leaves.
      EXPECT_LT(difference, 1e-9 * size);
    }
  }
  const auto& points = found[0].summary.at("frictions");
  EXPECT_EQ(points.front().at("steady").at("open_nodes"), 0);
  EXPECT_GT(points.back().at("steady").at("open_nodes"), 0);
}

}  // namespace
}  // namespace squeal::test
