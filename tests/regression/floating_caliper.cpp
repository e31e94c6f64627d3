// SPDX-License-Identifier: BSD-2-Clause
// The case floating_caliper with coarse linear cells: ten parts meshed apart, fifteen contacts and
// four ties.
#include "support/harness/same_on_ranks.hpp"
#include "support/model/meshed_geometry.hpp"

namespace squeal::test {
namespace {

const std::string common =
    "-options_file options/floating_caliper.yaml -modes_count 30 -flutter_friction 0.3 ";
const std::vector<std::string> coarse{"order=1", "size=1.5", "vanes=12", "bolts=0"};

/// The options with the geometry, which the program meshes.
std::string fromGeometry() {
  std::string list;
  for (const auto& parameter : coarse) list += (list.empty() ? "" : ",") + parameter;
  return common + "-mesh_set " + list;
}

/// The options with the same mesh from a file: gmsh takes most of the time of a run.
const std::string& fromMesh() {
  static const std::string options = [] {
    const fs::path file = placeFor("floating_caliper") / "coarse.msh";
    fs::create_directories(file.parent_path());
    writeMesh("meshes/floating_caliper.geo", coarse, file.string());
    return common + "-mesh_file '" + file.string() + "'";
  }();
  return options;
}

const std::string name = "floating_caliper_ranks";

/// The hydraulic forces along z, N: the pressure of 1 MPa on the bottoms of piston and bore, whose
/// circles are polygons in this mesh.
struct Axial {
  double lining, others;
};

/// The force that a lining passes to the disc, and those of the abutments, rails and guides of its
/// side, all along z and away from the disc.
Axial axialForces(const nlohmann::json& interfaces, const std::string& side, double away) {
  Axial sums{};
  for (const auto& [name, entry] : interfaces.items()) {
    double force = 0;
    for (const char* part : {"normal_force_n", "friction_force_n"})
      force += away * entry.at(part).at(2).get<double>();
    if (name == "lining_" + side) sums.lining += force;
    if (name.starts_with(side + "_")) sums.others += force;
  }
  return sums;
}

// What presses a lining is what its piston or finger brings, less what abutments and rails take.
// The tie passes it on: nothing is lost between parts that are meshed apart.
TEST(FloatingCaliper, ForcesBalanceOnEachLining) {
  const ProgramRun& run = runOnRanks(name, fromMesh(), 2, 120);
  ASSERT_EQ(run.exitCode, 0) << run.error;
  const auto summary = nlohmann::json::parse(contentOf(run.folder / "summary.json"));
  const auto& interfaces = summary.at("frictions").at(0).at("steady").at("interfaces");
  EXPECT_EQ(interfaces.size(), 15u);
  for (const std::string side : {"inner", "outer"}) {
    const double away = side == "inner" ? -1 : 1;
    const auto [lining, others] = axialForces(interfaces, side, away);
    const auto& pressing = interfaces.at(side == "inner" ? "piston_rim" : "finger");
    double force = 0;
    for (const char* part : {"normal_force_n", "friction_force_n"})
      force += away * pressing.at(part).at(2).get<double>();
    print("%s: pressed by %.6f N, lining %.6f N, abutments and rails %.6f N\n", side.c_str(), force,
          lining, others);
    EXPECT_GT(lining, 2000);
    EXPECT_NEAR((lining + others) / force, 1, 1e-8);
  }
  for (const auto& [name, entry] : summary.at("interfaces").items())
    EXPECT_EQ(entry.at("coupling"), "mortar") << name;
  EXPECT_EQ(summary.at("interfaces").size(), 19u);
}

TEST(FloatingCaliper, SameOnAllRanks) {
  // Half of the contact nodes open: SNES takes more steps than where contact stays closed.
  expectSameOnAllRanks(name, fromGeometry(), 120, 12, fromMesh());
}

}  // namespace
}  // namespace squeal::test
