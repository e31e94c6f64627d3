// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Sound cases to make mistakes in, and what is expected of the program then: it says what is
/// wrong, ends on all ranks with exit code 1, and leaves no results behind.
#include <gtest/gtest.h>

#include <atomic>
#include <future>

#include "support/harness/program.hpp"
#include "support/run/case.hpp"

namespace squeal::test {

// A coarse layer under a rigid plate, and two layers on each other: both run as they stand (see
// BadInput.BaseCasesAreSound).
inline const Options layer{{"mesh_file", "meshes/layer.geo"},
                           {"mesh_set", "nx=6,ny=3"},
                           {"material_layer_young", "1"},
                           {"material_layer_poisson", "0.3"},
                           {"material_layer_density", "1"},
                           {"constraint_bottom_clamped", "xy"},
                           {"constraint_right_image_of", "left"},
                           {"contact_plate_pad", "top"},
                           {"contact_plate_obstacle_velocity", "1,0,0"},
                           {"contact_plate_obstacle_displacement", "0,-0.01,0"},
                           {"modes_count", "5"},
                           {"flutter_friction", "0.2"},
                           {"quiet", ""}};
inline const Options twoLayers{{"options_file", "options/two_layers.yaml"},
                               {"mesh_set", "nx=6,ny_disc=3,ny_pad=3"},
                               {"modes_count", "5"},
                               {"flutter_friction", "0.2"},
                               {"quiet", ""}};

// Two squares, one on the other, in the plane of the layers; the numbers of cells along x and up
// the sides are free.
inline std::string squares(const std::string& lowerFace, const std::string& upperFace,
                           const std::string& right = "2") {
  return "Point(1) = {0, -1, 0}; Point(2) = {1, -1, 0}; Point(3) = {1, 0, 0}; Point(4) = {0, 0, "
         "0};\n"
         "Point(5) = {0, 0, 0}; Point(6) = {1, 0, 0}; Point(7) = {1, 1, 0}; Point(8) = {0, 1, 0};\n"
         "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
         "Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};\n"
         "Curve Loop(1) = {1, 2, 3, 4}; Curve Loop(2) = {5, 6, 7, 8}; Plane Surface(1) = {1}; "
         "Plane Surface(2) = {2};\n"
         "Transfinite Curve {1, 4, 6, 7, 8} = 3; Transfinite Curve {2} = " +
         right +
         " + 1;\n"
         "Transfinite Curve {3} = " +
         lowerFace + " + 1; Transfinite Curve {5} = " + upperFace +
         " + 1;\n"
         "Physical Curve(\"bottom\") = {1}; Physical Curve(\"right\") = {2}; Physical "
         "Curve(\"left\") = {4};\n"
         "Physical Curve(\"disc_face\") = {3}; Physical Curve(\"pad_face\") = {5}; Physical "
         "Curve(\"top\") = {7};\n"
         "Physical Curve(\"pad_right\") = {6}; Physical Curve(\"pad_left\") = {8};\n"
         "Physical Surface(\"disc\") = {1}; Physical Surface(\"pad\") = {2};\n";
}

inline Options onSquares(const fs::path& mesh) {
  return {{"mesh_file", mesh.string()},
          {"material_disc_young", "1"},
          {"material_disc_poisson", "0.3"},
          {"material_disc_density", "1"},
          {"material_pad_young", "1"},
          {"material_pad_poisson", "0.3"},
          {"material_pad_density", "1"},
          {"motion_disc_velocity", "1,0,0"},
          {"constraint_bottom_clamped", "xy"},
          {"constraint_top_clamped", "xy"},
          {"constraint_top_displacement", "0,-0.01,0"},
          {"contact_face_pad", "pad_face"},
          {"contact_face_disc", "disc_face"},
          {"modes_count", "5"},
          {"flutter_friction", "0.2"},
          {"quiet", ""}};
}

inline Options periodicSquares(const fs::path& mesh) {
  return with(onSquares(mesh), {{"constraint_right_image_of", "left"},
                                {"constraint_pad_right_image_of", "pad_left"}});
}

// Two bilinear quadrangles side by side; the nodes of the second run clockwise when it is inverted.
inline std::string twoQuadrangles(bool inverted) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
         "$PhysicalNames\n3\n1 1 \"bottom\"\n1 2 \"top\"\n2 3 \"layer\"\n$EndPhysicalNames\n"
         "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n$EndNodes\n"
         "$Elements\n6\n1 1 2 1 1 1 2\n2 1 2 1 1 2 3\n3 1 2 2 2 4 5\n4 1 2 2 2 5 6\n5 3 2 3 1 1 2 "
         "5 4\n6 3 2 3 1 " +
         std::string(inverted ? "2 5 6 3" : "2 3 6 5") + "\n$EndElements\n";
}

struct BadInput {
  std::string name;
  Options options;
  std::vector<std::string> message;  ///< pieces that the message must hold
};

/// Collective. Writes a file on rank 0, before any rank goes on.
inline void writeOnce(const fs::path& path, const std::string& text) {
  onFirstRank(PETSC_COMM_WORLD, "", [&] { writeText(path, text); });
}

/// Collective. Runs in this process, and returns the message of the error; empty if there is none.
inline std::string refusalOf(const Options& options) {
  try {
    runOptions(commandLine(options));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Collective. A mistake that one rank alone notices leaves the others waiting.
inline void expectRefused(const std::vector<BadInput>& inputs) {
  for (const auto& input : inputs) {
    const std::string message = refusalOf(input.options);
    SCOPED_TRACE(input.name + ": " + message);
    EXPECT_NE(message, "");
    for (const auto& piece : input.message)
      EXPECT_NE(message.find(piece), std::string::npos) << "missing from the message: " << piece;
  }
}

struct Outcome {
  const BadInput* input;
  int ranks;
  ProgramRun run;
};

/// Two runs at a time, since each waits for its ranks to start and to end.
inline std::vector<Outcome> runAll(const std::vector<BadInput>& inputs, int ranks) {
  std::vector<Outcome> outcomes;
  for (const auto& input : inputs) outcomes.push_back({&input, ranks, {}});
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < outcomes.size(); i = next++) {
      auto& [input, ranks, run] = outcomes[i];
      run = runProgram("bad_input/" + input->name + "_np" + std::to_string(ranks), ranks,
                       commandLine(input->options), 60);
    }
  };
  std::vector<std::future<void>> workers;
  for (int i = 0; i < 2; ++i) workers.push_back(std::async(std::launch::async, work));
  for (auto& worker : workers) worker.get();
  return outcomes;
}

/// The program's own message, without what mpirun adds.
inline std::string messageOf(const ProgramRun& run) {
  const std::string start = "squeal: error: ";
  const auto begin = run.error.find(start);
  if (begin == std::string::npos) return "";
  return run.error.substr(begin + start.size(), run.error.find('\n', begin) - begin - start.size());
}

/// On 2 ranks, where a message of one rank alone would leave the other waiting.
inline void expectExplained(const std::vector<BadInput>& inputs, int onRanks = 2) {
  for (const auto& [input, ranks, run] : runAll(inputs, onRanks)) {
    SCOPED_TRACE(input->name + " on " + std::to_string(ranks) + " ranks; stderr:\n" +
                 run.error.substr(0, 600));
    EXPECT_EQ(run.exitCode, 1) << "124: it hangs";
    const std::string message = messageOf(run);
    for (const auto& piece : input->message)
      EXPECT_NE(message.find(piece), std::string::npos) << "missing from the message: " << piece;
    EXPECT_EQ(run.error.find("squeal: error: ", run.error.find("squeal: error: ") + 1),
              std::string::npos)
        << "said more than once";
    EXPECT_EQ(run.out, "");
    if (fs::is_directory(run.folder))
      for (const auto& entry : fs::directory_iterator(run.folder))
        ADD_FAILURE() << "left behind: " << entry.path().filename();
  }
}

}  // namespace squeal::test
