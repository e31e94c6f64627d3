// SPDX-License-Identifier: BSD-2-Clause
// Which sweeps are followed without being asked to, and over which frictions.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/run/case.hpp"

namespace squeal::test {
namespace {

const std::string plane =
    "-mesh_set nx=6,ny_disc=2,ny_pad=2 -modes_count 15 -steady_uniqueness off ";
/// Anti-plane motion is damped by friction, by the steady forces of each point.
const std::string slab =
    "-mesh_set nx=6,ny_disc=2,ny_pad=1,order=1 -modes_count 15 -steady_uniqueness off ";

struct Rule {
  std::string name, options;
  bool followed;
};

/// Frictions that the sweep asks for and that were followed.
std::vector<double> sweptStations(const stability::TrackedLine& followed) {
  std::vector<double> list;
  for (const auto& station : followed.branches.stations)
    if (station.swept) list.push_back(station.friction);
  return list;
}

TEST(TrackedLine, WhichSweepsAre) {
  const std::string sweep = "-flutter_friction 0.1,0.2 ", single = "-flutter_friction 0.2 ";
  const std::vector<Rule> rules{
      // terms that hold at all points
      {"two_layers", plane + sweep, true},
      {"two_layers", plane + sweep + "-flutter_track off", false},
      {"two_layers", plane + single, false},
      {"two_layers", plane + single + "-flutter_track", true},
      {"two_layers", plane + single + "-flutter_critical", true},
      {"two_layers", plane + "-flutter_friction 0 -flutter_track", false},
      {"two_layers", plane + sweep + "-material_pad_rayleigh_mass 0.01 -flutter_speed 1,2", true},
      {"two_layers", plane + sweep + "-flutter_basis modal -flutter_track", false},
      {"two_layers",
       plane + sweep + "-flutter_method direct -flutter_direct_count 10 -flutter_track", false},
      // terms that follow the steady state
      {"two_layers", plane + sweep + "-elasticity_prestress on", false},
      {"two_layers", plane + sweep + "-elasticity_prestress on -flutter_track", true},
      {"two_layers_antiplane", slab + sweep, false},
      {"two_layers_antiplane", slab + sweep + "-flutter_track", true},
      {"two_layers_antiplane", slab + sweep + "-flutter_critical", true},
      {"two_layers_antiplane", slab + sweep + "-flutter_friction_damping off", true},
      // matrices from files
      {"external", sweep, true},
      {"external", single, false},
  };
  for (const auto& [name, options, wanted] : rules) {
    SCOPED_TRACE(name + " " + options);
    const analysis::Analysis analysis = runCase(name, options);
    ASSERT_EQ(analysis.flutter.segments.size(), 1U);
    const auto& followed = analysis.flutter.segments[0].trackedLines;
    const auto lines = wanted ? analysis.sweep.speeds.size() : 0;
    EXPECT_EQ(lines > 0, wanted);
    EXPECT_EQ(followed.size(), lines);
    for (const auto& line : followed) {
      EXPECT_EQ(sweptStations(line), analysis.sweep.frictions);
      ASSERT_FALSE(line.branches.stations.empty());
      EXPECT_EQ(line.branches.stations.front().friction,
                0);  // where the number of eigenvalues is known
      EXPECT_GT(line.branches.count, 0);
    }
  }
}

}  // namespace
}  // namespace squeal::test
