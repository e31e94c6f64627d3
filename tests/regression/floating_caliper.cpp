// SPDX-License-Identifier: BSD-2-Clause
// The case floating_caliper with coarse linear cells: ten parts meshed apart, fifteen contacts and
// four ties; and the case floating_caliper_joints with couplings, bushings and bolts.
#include <fstream>
#include <set>
#include <sstream>

#include "support/harness/same_on_ranks.hpp"
#include "support/model/meshed_geometry.hpp"

namespace squeal::test {
namespace {

/// A case with a coarse mesh.
struct CoarseCase {
  std::string name;
  std::vector<std::string> parameters;  ///< of the geometry
  const std::string small = " -modes_count 30 -flutter_friction 0.3 ";
  /// Returns the options with the geometry, which the program meshes.
  std::string fromGeometry() const {
    std::string list;
    for (const auto& parameter : parameters) list += (list.empty() ? "" : ",") + parameter;
    return "-options_file options/" + name + ".yaml" + small + "-mesh_set " + list;
  }
  /// Returns the options with the same mesh from a file: gmsh takes most of the time of a run. A
  /// mesh has no parameters, so the case is used without those that it gives to the geometry.
  std::string fromMesh() const {
    const fs::path mesh = placeFor(name) / "coarse.msh", options = placeFor(name) / "case.yaml";
    static std::set<std::string> written;  // what is on disk may be of an older geometry
    if (written.insert(name).second) {
      fs::create_directories(mesh.parent_path());
      writeMesh("meshes/floating_caliper.geo", parameters, mesh.string());
      std::istringstream lines(contentOf("options/" + name + ".yaml"));
      std::ofstream without(options);
      for (std::string line; std::getline(lines, line);)
        if (!line.starts_with("  set:")) without << line << '\n';
    }
    return "-options_file '" + options.string() + "'" + small + "-mesh_file '" + mesh.string() +
           "'";
  }
};

const CoarseCase brake{"floating_caliper", {"order=1", "size=1.5", "vanes=12", "bolts=0"}};
const CoarseCase jointed{"floating_caliper_joints",
                         {"order=1", "size=1.5", "vanes=12", "bolts=0", "bolted=1"}};

const std::string name = "floating_caliper_ranks", joints = "floating_caliper_joints_ranks";

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
  const ProgramRun& run = runOnRanks(name, brake.fromMesh(), 2, 120);
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
  expectSameOnAllRanks(name, brake.fromGeometry(), 120, 12, brake.fromMesh());
}

// Three active sets, each with its own open nodes. One factorisation serves the steady states and
// one condenses them to the contact; the sets share a reference, its modes with their second pole,
// and the count. K and M are projected with all contact closed and all contact open. The right-hand
// sides are those of contact, modes, constraint modes and corrections, without those of the changes
// of contact between the frictions (`-steady_path`, some 50 more): 844 were measured, and their
// number varies with round-off by some blocks of corrections.
TEST(FloatingCaliper, ActiveSetsShareTheirFactors) {
  const ProgramRun run = runProgram("floating_caliper/shared", 2,
                                    brake.fromMesh() +
                                        " -flutter_friction 0,0.3,0.6 -flutter_track off "
                                        "-steady_path 20 -report_fields off",
                                    120);
  ASSERT_EQ(run.exitCode, 0) << run.error;
  const auto summary = nlohmann::json::parse(contentOf(run.folder / "summary.json"));
  EXPECT_EQ(summary.at("active_sets").size(), 3u);
  const auto& work = summary.at("sparse_work");
  EXPECT_EQ(work.at("factorisations"), 5);
  EXPECT_EQ(work.at("projections"), 4);
  EXPECT_LE(work.at("right_hand_sides"), 900);
  EXPECT_EQ(summary.at("stages").at("modes").at("factorisations"), 2);
}

// A hub on a bearing, guide pins bolted to the bracket, and bushings between pins and caliper.
TEST(FloatingCaliper, JointsAreTheSameOnAllRanks) {
  expectSameOnAllRanks(joints, jointed.fromGeometry(), 120, 12, jointed.fromMesh());
}

// The audit comes before the bolts are tightened, the first solution; a dry run solves nothing.
TEST(FloatingCaliper, AuditComesFirst) {
  const std::string options = jointed.fromMesh();
  const ProgramRun whole = runProgram("floating_caliper_joints/order", 1,
                                      options + " -modes_count 5 -report_fields off", 120),
                   dry = runProgram("floating_caliper_joints/dry", 1, options + " -dry_run", 120);
  ASSERT_EQ(whole.exitCode, 0) << whole.error;
  ASSERT_EQ(dry.exitCode, 0) << dry.error;
  const auto audit = whole.out.find("\naudit "), factor = whole.out.find("\nfactor "),
             bolts = whole.out.find("\nbolts ");
  ASSERT_NE(bolts, std::string::npos) << whole.out;
  EXPECT_LT(audit, factor) << whole.out;
  EXPECT_LT(factor, bolts) << whole.out;
  EXPECT_NE(dry.out.find("\naudit "), std::string::npos) << dry.out;
  EXPECT_EQ(dry.out.find("is 1.3"), std::string::npos) << dry.out;
  for (const char* line :
       {"\nsupports     bracket_bolts (96 nodes, clamped xyz)\n",
        "piston_bottom (64 faces, pressure_pa 1e+06)\n",
        "hub (kind rigid, reference hub, groups hub_seat, 40 nodes)\n",
        "hub (from hub, to the ground, stiffness 5e+08,5e+08,5e+08,1e+06,1e+06,1e+06, damping "
        "0,0,0)",
        "\nbolts        pin_leading (section pin_leading_section, force_n 10000), "})
    EXPECT_NE(dry.out.find(line), std::string::npos) << line << "\n" << dry.out;
  const auto summary = nlohmann::json::parse(contentOf(whole.folder / "summary.json"));
  EXPECT_EQ(summary.at("couplings").size(), 5u);
  EXPECT_EQ(summary.at("couplings").at("hub").at("nodes"), 40);
  EXPECT_EQ(summary.at("references").size(), 5u);
  EXPECT_EQ(summary.at("bolts").at("pin_trailing").at("force_n"), 1e4);
  EXPECT_EQ(summary.at("bushings").at("hub").at("stiffness").at(3), 1e6);
  EXPECT_EQ(summary.at("loads").at("bore_bottom").at("pressure_pa"), 1e6);
  EXPECT_EQ(summary.at("supports").at("bracket_bolts").at("clamped"), "xyz");
}

/// The force and the moment of a row of reactions.csv.
using Reaction = std::array<double, 6>;

/// Returns the rows of a run by their kind and name.
std::map<std::string, Reaction> reactionsOf(const ProgramRun& run) {
  const CsvTable table = readCsv(run.folder / "reactions.csv");
  std::map<std::string, Reaction> rows;
  std::vector<std::vector<double>> columns;
  for (const char* name :
       {"force_x_n", "force_y_n", "force_z_n", "moment_x_n_m", "moment_y_n_m", "moment_z_n_m"})
    columns.push_back(table.column(name));
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    for (std::size_t k = 0; k < 6; ++k)
      rows[table.rows[i][3] + " " + table.rows[i][4]][k] = columns[k][i];
  return rows;
}

// The nodes of couplings, ties, contacts and bolts are on all ranks.
TEST(FloatingCaliper, ReactionsAreTheSameOnAllRanks) {
  const auto one = reactionsOf(runOnRanks(joints, jointed.fromGeometry(), 1, 120));
  double largest[2] = {0, 0};  // force, moment
  for (const auto& [row, values] : one)
    for (std::size_t k = 0; k < 6; ++k)
      largest[k / 3] = std::max(largest[k / 3], std::abs(values[k]));
  std::map<std::string, int> kinds;
  for (const auto& [row, values] : one) ++kinds[row.substr(0, row.find(' '))];
  EXPECT_EQ(kinds["support"], 1);
  EXPECT_EQ(kinds["bushing"], 3);
  EXPECT_EQ(kinds["reference"], 5);
  EXPECT_EQ(kinds["coupling"], 5);
  EXPECT_EQ(kinds["bolt"], 2);
  EXPECT_EQ(kinds["interface"], 15);
  EXPECT_EQ(kinds["tie"], 4);
  for (const int ranks : {1, 2, 3}) {
    const std::string options = ranks == 1 ? jointed.fromGeometry() : jointed.fromMesh();
    const auto other = reactionsOf(runOnRanks(joints, options, ranks, 120));
    ASSERT_EQ(other.size(), one.size());
    double worst = 0, sum = 0;
    for (const auto& [row, values] : one)
      for (std::size_t k = 0; k < 6; ++k)
        worst = worse(worst, std::abs(other.at(row)[k] - values[k]) / largest[k / 3]);
    for (std::size_t k = 0; k < 6; ++k)
      sum = worse(sum, std::abs(other.at("sum ")[k]) / largest[k / 3]);
    print("%d ranks: reactions differ by %.1e of the largest, their sum is %.1e of it\n", ranks,
          worst, sum);
    EXPECT_LT(worst, 1e-8);  // the tolerance of the contact forces
    EXPECT_LT(sum, 1e-10);   // residual of the steady state, and round-off of 1e4 N over springs
  }
}

}  // namespace
}  // namespace squeal::test
