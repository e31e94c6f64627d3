// SPDX-License-Identifier: BSD-2-Clause
// The program as it is called: options files, words of the command line, and what is said of
// mistakes in them.
#include <dlfcn.h>

#include "support/harness/bad_input.hpp"
#include "support/model/mesh_text.hpp"
#include "support/run/own_case.hpp"

namespace squeal::test {
namespace {

// PETSc's reader ends with a traceback, or skips what it does not understand.
TEST(CommandLine, OptionsFilesThatCannotBeRead) {
  const fs::path place = placeFor("command_line/files");
  const auto file = [&](const std::string& name, const std::string& text) {
    writeText(place / name, text);
    return with({}, {{"options_file", (place / name).string()}});
  };
  expectRefused({
      {"yaml_tab", file("tab.yaml", "mesh:\n\tfile: x\n"), {"tab.yaml, line 2", "tab"}},
      {"yaml_quote",
       file("quote.yaml", "mesh:\n  file: \"x\nquiet:\n"),
       {"quote.yaml, line", "begins in line 2", "quote"}},
      {"yaml_list", file("list.yaml", "- mesh\n"), {"list.yaml, line 1", "a list at the top"}},
      {"yaml_binary",
       file("binary.yaml", std::string("mesh: \0\1\2", 9)),
       {"binary.yaml, line 1", "text in UTF-8"}},
      {"yaml_duplicate",
       file("twice.yaml", "mesh:\n  file: x\nmesh_file: y\n"),
       {"twice.yaml, line 3", "-mesh_file", "line 2"}},
      {"yaml_empty",
       file("empty.yaml", "# nothing\n"),
       {"-options_file", "empty.yaml", "no option"}},
      {"yaml_rule",
       with(without(layer, {"material_layer_density"}),
            file("rule.yaml", "material:\n  layer:\n    density: -1\n")),
       {"-material_layer_density -1", "rule.yaml, line 3", "must be a number > 0"}},
      {"lines_stray",
       file("stray.txt", "-quiet\n-flutter_friction 0 0.2\n"),
       {"stray.txt, line 2", "'0.2'", "-flutter_friction 0"}},
      {"lines_many",
       file("many.txt",
            [] {
              std::string text;
              for (int i = 0; i < 600; ++i) text += "-material_" + std::to_string(i) + "_young 1\n";
              return text;
            }()),
       {"601 options"}},
      {"folder",
       with({}, {{"options_file", place.string()}}),
       {"-options_file " + place.string(), "folder"}},
  });
}

// Of each stage one mistake: the others are in bad_input.cpp.
TEST(CommandLine, MistakesEndTheRun) {
  const fs::path place = placeFor("command_line/meshes");
  writeText(place / "inverted.msh", twoQuadrangles(true));
  writeText(place / "faces.geo", squares("4", "5"));
  const std::vector<BadInput> mistakes{
      {"unknown",
       with(layer, {{"flutter_frictions", "0.2"}}),
       {"unknown option -flutter_frictions"}},
      {"density", with(layer, {{"material_layer_density", "-1"}}), {"-material_layer_density -1"}},
      {"mesh_file", with(layer, {{"mesh_file", "meshes/nosuch.geo"}}), {"no such file"}},
      {"faces",
       with(onSquares(place / "faces.geo"), {{"contact_face_pad", "top"}}),
       {"no part of 'top' faces a part of 'disc_face'"}},
      {"inverted",
       with(without(layer, {"mesh_set", "constraint_right_image_of"}),
            {{"mesh_file", (place / "inverted.msh").string()}, {"modes_count", "2"}}),
       {"inverted element"}},
      {"loose", without(layer, {"constraint_bottom_clamped"}), {"body 'layer' can move rigidly"}},
      {"no_slip", without(layer, {"contact_plate_obstacle_velocity"}), {"|w| = 0"}},
      {"steady_solver", with(layer, {{"steady_snes_foo", "1"}}), {"-steady_snes_foo"}},
      {"modes_solver", with(layer, {{"modes_eps_foo", "1"}}), {"-modes_eps_foo"}},
      {"count_too_large", with(layer, {{"modes_count", "100000"}}), {"30 unknowns"}}};
  for (const int ranks : {1, 2}) expectExplained(mistakes, ranks);
}

TEST(CommandLine, FileInTheWayOfTheResults) {
  for (int ranks : {1, 2}) {
    const std::string name = "bad_input/unwritable_np" + std::to_string(ranks);
    fs::remove_all(placeFor(name));
    writeText(placeFor(name) / "results", "not a folder\n");
    const ProgramRun run = runAgain(name, ranks, commandLine(layer), 60);
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_NE(messageOf(run).find("option -report_dir"), std::string::npos) << run.error;
    EXPECT_NE(messageOf(run).find(run.folder.string()), std::string::npos) << run.error;
    EXPECT_EQ(contentOf(run.folder), "not a folder\n");
  }
}

TEST(CommandLine, StrayWords) {
  expectExplained({
      {"list_as_words",
       with(layer, {{"flutter_friction", "0.2' '0.4"}}),
       {"'0.4'", "-flutter_friction 0.2", "commas"}},
      {"list_split",
       with(layer, {{"flutter_friction", "0,' '0.4"}}),
       {"'0.4'", "-flutter_friction 0,", "quotes"}},
      {"flag_with_word",
       with(without(layer, {"quiet"}), {{"quiet", "disc_brake"}}),
       {"-quiet disc_brake", "on or off"}},
      {"equals",
       with(without(layer, {"modes_count"}), {{"modes_count=5", ""}}),
       {"-modes_count=5", "-modes_count 5"}},
      {"capitals",
       with(layer, {{"material_Layer_young", "2"}}),
       {"-material_Layer_young", "-material_layer_young", "capital"}},
  });
}

// They may be a slip of whoever wrote the mesh: nothing but this line would tell.
TEST(CommandLine, NodesInNoCellAreTold) {
  const fs::path place = placeFor("command_line/nodes");
  for (const int extra : {0, 1, 2}) {
    std::string nodes;
    for (int i = 0; i < extra; ++i)
      nodes += std::to_string(7 + i) + " 5 " + std::to_string(i) + " 0\n";
    std::string text =
        changed(quadranglesMsh2(), "$Nodes\n6", "$Nodes\n" + std::to_string(6 + extra));
    writeText(place / "layer.msh", changed(text, "$EndNodes", nodes + "$EndNodes"));
    const Options options = with(
        without(layer, {"mesh_set", "constraint_right_image_of", "quiet"}),
        {{"mesh_file", (place / "layer.msh").string()}, {"modes_count", "2"}, {"dry_run", ""}});
    const int ranks = extra == 2 ? 2 : 1;
    const ProgramRun run = runProgram("command_line/nodes_run", ranks, commandLine(options));
    EXPECT_EQ(run.exitCode, 0) << run.error;
    const std::string note =
        extra == 1 ? "; 1 node in no cell is not used\n" : "; 2 nodes in no cell are not used\n";
    EXPECT_EQ(run.out.find("in no cell") != std::string::npos, extra > 0) << run.out;
    EXPECT_EQ(run.out.find(note) != std::string::npos, extra > 0) << run.out;
  }
}

/// The program without mpirun, and without the environment of the one that runs this test.
const std::string alone =
    "env -i PATH=\"$PATH\" HOME=\"$HOME\" OMPI_ALLOW_RUN_AS_ROOT=1 "
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 '" SQUEAL_EXECUTABLE "'";

const std::string program = "'" SQUEAL_MPIEXEC "' 2 '" SQUEAL_EXECUTABLE "' ",
                  onOneRank = "'" SQUEAL_MPIEXEC "' serial '" SQUEAL_EXECUTABLE "' ";

// Files named in a case are found beside it, and options.txt repeats the run, both from any working
// folder.
TEST(CommandLine, CasesRunFromAnywhere) {
  const fs::path place = ownCase("command_line/anywhere"), results = place / "results";
  ASSERT_EQ(shell(place.parent_path(),
                  program + "-options_file 'my cases/my case.yaml' -report_dir 'my cases/results'" +
                      small + " >out"),
            0);
  EXPECT_NE(contentOf(place.parent_path() / "out").find("my cases/my layer.geo: 28 nodes"),
            std::string::npos);  // (6 + 1) x (3 + 1)
  EXPECT_NE(contentOf(results / "summary.json").find("my cases/my layer.geo"), std::string::npos);
  EXPECT_EQ(readCsv(results / "stability_map.csv").column("friction"),
            (std::vector<double>{0, 0.2}));
  ASSERT_EQ(shell("/", program + "-options_file '" + (results / "options.txt").string() +
                           "' -quiet -report_dir '" + (place / "again").string() + "'"),
            0);
  const CsvTable first = readCsv(results / "eigenvalues.csv"),
                 again = readCsv(place / "again/eigenvalues.csv");
  EXPECT_FALSE(first.rows.empty());
  EXPECT_EQ(again.column("friction"), first.column("friction"));
  for (std::size_t i = 0; i < first.rows.size(); ++i)  // sums over two ranks differ by rounding
    EXPECT_NEAR(again.column("frequency_hz").at(i), first.column("frequency_hz").at(i), 1e-10);
  EXPECT_EQ(shell("/", onOneRank +
                           "-options_file '" SQUEAL_SOURCE_DIR
                           "/options/external.yaml' -quiet -report_dir '" +
                           (place / "external").string() + "'"),
            0);
}

TEST(CommandLine, MagnitudesAndSizesHaveLimits) {
  const fs::path place = placeFor("command_line/limits");
  writeText(place / "huge.mtx",
            "%%MatrixMarket matrix coordinate real general\n2 2 2\n1 1 1e200\n2 2 1\n");
  writeText(place / "unit.mtx",
            "%%MatrixMarket matrix coordinate real general\n2 2 2\n1 1 1\n2 2 1\n");
  const Options matrices{{"matrices_k_file", (place / "unit.mtx").string()},
                         {"matrices_k_role", "stiffness"},
                         {"matrices_m_file", (place / "unit.mtx").string()},
                         {"matrices_m_role", "mass"},
                         {"matrices_x_file", (place / "unit.mtx").string()},
                         {"matrices_x_role", "stiffness"},
                         {"matrices_x_friction_exponent", "10"}};
  expectExplained({
      // All of these ended in rows of inf or nan, or went on for hours.
      {"young",
       with(layer, {{"material_layer_young", "1e300"}}),
       {"-material_layer_young 1e300", "1e-50 and 1e+50"}},
      {"friction",
       with(layer, {{"flutter_friction", "1e300"}}),
       {"-flutter_friction 1e300", "1e-50 and 1e+50"}},
      {"matrix",
       with(matrices, {{"matrices_m_file", (place / "huge.mtx").string()}}),
       {"-matrices_m_file", "squares overflow"}},
      {"matrix_factors",
       with(matrices, {{"flutter_friction", "1e50"}}),
       {"matrix 'x' times its factors", "its square"}},  // 1e500
      {"range",
       with(layer, {{"flutter_friction", "0:1:1e-7"}}),
       {"-flutter_friction 0:1:1e-7", "10000001 values", "at most 100000"}},
      {"grid",
       with(layer, {{"flutter_friction", "0:0.999:0.001"}, {"flutter_speed", "1:1000:1"}}),
       {"1000 x 1000 x 1 x 1 = 1000000 points"}},
      {"modes",
       with(layer, {{"modes_count", "2000000000"}}),
       {"-modes_count 2000000000", ">= 1 and <= 1000000"}},
      {"frames",
       with(layer, {{"report_frames", "2000000000"}}),
       {"-report_frames 2000000000", "<= 1000"}},
  });
}

TEST(CommandLine, DryRunSaysWhatARunWouldDo) {
  const fs::path place = placeFor("command_line/dry");
  fs::remove_all(place);
  writeText(place / "results/eigenvalues.csv", "of an earlier run\n");
  const auto dry = [&](const std::string& options, const std::string& start = onOneRank) {
    const int code =
        shell(SQUEAL_SOURCE_DIR,
              start + options + " -dry_run -report_dir '" + (place / "results").string() + "' >'" +
                  (place / "out").string() + "' 2>'" + (place / "err").string() + "'");
    EXPECT_EQ(code, 0) << contentOf(place / "err");
    return contentOf(place / "out");
  };
  const auto expect = [](const std::string& out, const std::vector<std::string>& pieces) {
    for (const auto& piece : pieces)
      EXPECT_NE(out.find(piece), std::string::npos) << piece << "\n" << out;
  };
  // 12 x 4 cells; 12 columns of three free nodes, and one on the plate that slides.
  expect(
      dry("-options_file options/layer.yaml -mesh_set nx=12,ny=4 -flutter_friction 0,0.2 "
          "-flutter_speed 1,2,3",
          program),
      {"meshes/layer.geo: 65 nodes, 48 cells", "layer (48 cells)", "bottom (12 nodes, clamped xy)",
       "plate (12 nodes on a rigid obstacle)",
       "6 points: 2 frictions x 3 speeds x 1 pressures x 1 dampings; 6 steady states",
       "unknowns     84", "GB on all ranks", "\ntime         about ", "\naudit ",
       "\n# Audit of the model\n", "\nNo finding.\n", "| layer | 48 | 3 | (1.5, -0.5, 0) | 2.5 |"});
  EXPECT_EQ(dry("-options_file options/layer.yaml -audit off").find("audit"), std::string::npos);
  // A loose body: the audit comes before the error, which points to it.
  EXPECT_EQ(shell(place, onOneRank +
                             " -mesh_file '" SQUEAL_SOURCE_DIR
                             "/meshes/beam.geo' -material_beam_young 1e9 "
                             "-material_beam_poisson 0.3 -material_beam_density 1 -modes_count 4 "
                             "-dry_run >'" +
                             (place / "out").string() + "' 2>'" + (place / "err").string() + "'"),
            1);
  EXPECT_NE(contentOf(place / "out").find("| beam | none | loose |"), std::string::npos)
      << contentOf(place / "out");
  EXPECT_NE(contentOf(place / "err")
                .find("the audit, which -dry_run prints, lists the supports of "
                      "each part"),
            std::string::npos)
      << contentOf(place / "err");
  expect(dry("-options_file options/external.yaml"),
         {"mass: 2 rows, 2 entries, with s^2", "friction: 2 rows, 1 entries, with s^0, friction^1",
          "unknowns     2,"});
  dry("-options_file options/external.yaml -flutter_friction 0:0.9999:0.0001");
  EXPECT_NE(contentOf(place / "err").find("a sweep of 10000 points"), std::string::npos)
      << contentOf(place / "err");
  std::vector<std::string> left;
  for (const auto& entry : fs::directory_iterator(place / "results"))
    left.push_back(entry.path().filename());
  EXPECT_EQ(left, std::vector<std::string>{"eigenvalues.csv"});
  EXPECT_EQ(contentOf(place / "results/eigenvalues.csv"), "of an earlier run\n");
  // What a run refuses, a dry run refuses.
  EXPECT_EQ(
      shell(SQUEAL_SOURCE_DIR,
            onOneRank +
                "-options_file options/layer.yaml -dry_run -contact_plate_pad topp 2>/dev/null"),
      1);
}

bool blasHasSeveralCodes() {
  void* const config = dlsym(RTLD_DEFAULT, "openblas_get_config");
  return config && std::string(reinterpret_cast<char* (*)()>(config)()).find("DYNAMIC_ARCH") !=
                       std::string::npos;
}

// Debian's OpenBLAS takes some processors for one of 2004. The program then chooses other code,
// unless the user has chosen.
TEST(CommandLine, OpenBlasFitsTheProcessor) {
  if (!blasHasSeveralCodes()) GTEST_SKIP() << "another BLAS, or OpenBLAS for one processor";
  const fs::path place = placeFor("command_line/blas");
  writeText(place / "out", "");
  const auto version = [&](const std::string& variable) {
    const int code = shell(place, "env -u OPENBLAS_CORETYPE '" SQUEAL_MPIEXEC "' serial " +
                                      variable + " '" SQUEAL_EXECUTABLE "' -version >out 2>&1");
    EXPECT_EQ(code, 0);
    return contentOf(place / "out");
  };
  const auto names = [](const std::string& out, const std::string& before) {
    std::vector<std::string> found;
    for (auto at = out.find(before); at != std::string::npos; at = out.find(before, at)) {
      at += before.size();
      found.push_back(out.substr(at, out.find('\n', at) - at));
    }
    return found;
  };
  const std::string code = "OpenBLAS with the code for ";
#ifdef __x86_64__
  EXPECT_EQ(names(version("OPENBLAS_CORETYPE=Prescott"), code),
            std::vector<std::string>{"Prescott"});
  // OpenBLAS names its choice each time it is loaded.
  const std::string out = version("OPENBLAS_VERBOSE=2");
  const auto loaded = names(out, "Core: ");
  ASSERT_FALSE(loaded.empty()) << out;
  std::string best = loaded[0];
  if (best == "Prescott" && __builtin_cpu_supports("avx2")) best = "Haswell";
  if (best == "Haswell" && loaded[0] == "Prescott" && __builtin_cpu_supports("avx512bw"))
    best = "SkylakeX";
  EXPECT_EQ(loaded.size(), best == loaded[0] ? 1u : 2u) << out;
  EXPECT_EQ(names(out, code), std::vector<std::string>{best}) << out;
#endif
}

// Different code rounds differently: ranks that decide differently wait for each other forever.
TEST(CommandLine, RanksWithDifferentOpenBlas) {
#ifdef __x86_64__
  if (!blasHasSeveralCodes()) GTEST_SKIP() << "another BLAS, or OpenBLAS for one processor";
  const fs::path place = placeFor("command_line/mixed_blas");
  writeText(place / "err", "");
  const auto errors = [&](const std::string& second) {
    const std::string words = " '" SQUEAL_EXECUTABLE "' -options_file options/layer.yaml -dry_run";
    EXPECT_EQ(
        shell(SQUEAL_SOURCE_DIR, "'" SQUEAL_MPIEXEC "' 1 env OPENBLAS_CORETYPE=Nehalem" + words +
                                     " : -n 1 env OPENBLAS_CORETYPE=" + second + words +
                                     " >/dev/null 2>'" + (place / "err").string() + "'"),
        0);
    return contentOf(place / "err");
  };
  EXPECT_NE(
      errors("Prescott")
          .find("OpenBLAS uses the code for Nehalem on rank 0, but that for Prescott on rank 1"),
      std::string::npos)
      << contentOf(place / "err");
  EXPECT_EQ(errors("Nehalem").find("OpenBLAS"), std::string::npos) << contentOf(place / "err");
#endif
}

TEST(CommandLine, VersionManualAndUsage) {
  const fs::path place = placeFor("command_line/words");
  writeText(place / "out", "");
  // Without mpirun Open MPI searches for networks and starts a daemon, a third of a second.
  const auto start = [&](const std::string& word) {
    return shell(place, (word == "--version" || word.empty() ? alone : onOneRank) + " " + word +
                            " >'" + (place / "out").string() + "' 2>&1");
  };
  for (const char* word : {"--version", "-version"}) {
    ASSERT_EQ(start(word), 0);
    const std::string out = contentOf(place / "out");
    for (const char* part : {"squeal ", "Petsc Release Version 3.", "SLEPc Release Version 3.",
                             "MUMPS ", "MPI ", "indices: "})
      EXPECT_NE(out.find(part), std::string::npos) << part << "\n" << out;
  }
  for (const char* word : {"--help", "-help", "-help -options_file nosuch.yaml"}) {
    ASSERT_EQ(start(word), 0);
    EXPECT_NE(contentOf(place / "out").find("-material_<group>_young [Pa]"), std::string::npos)
        << word;
  }
  // Of one stage alone: what belongs to others is not there.
  for (const char* word : {"--help modes", "-help modes", "-help_json modes"}) {
    ASSERT_EQ(start(word), 0);
    const std::string page = contentOf(place / "out");
    EXPECT_NE(page.find("modes_count"), std::string::npos) << word;
    EXPECT_EQ(page.find("material_<group>_young"), std::string::npos) << word;
  }
  for (const char* word : {"-help nosuch", "-help_json nosuch"}) EXPECT_EQ(start(word), 1) << word;
  // Without any option: a script whose arguments went missing must not believe that it has run.
  ASSERT_EQ(start(""), 1);
  const std::string out = contentOf(place / "out");
  EXPECT_EQ(out.rfind("usage: squeal", 0), 0U) << out;
  EXPECT_LE(std::count(out.begin(), out.end(), '\n'), 12);
  EXPECT_FALSE(fs::exists(place / "results"));
}

// Two unknowns have two modes, not the 200 of the default: 1001 problems of order 4 take no time.
TEST(CommandLine, LongSweepsAreEstimatedByTheModesThereAre) {
  const ProgramRun run = runProgram(
      "command_line/long", 1, "-options_file options/external.yaml -flutter_friction 0:0.1:0.0001");
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_NE(run.error.find("a sweep of 1001 points"), std::string::npos) << run.error;
  EXPECT_NE(run.error.find("(2 free modes)"), std::string::npos) << run.error;
}

}  // namespace
}  // namespace squeal::test
