// SPDX-License-Identifier: BSD-2-Clause
// Files that are handed to gmsh: none is taken for a script that is none by its name, none brings
// the program down, and the contents of a damaged or doubtful one are reported.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "base/system/child.hpp"
#include "model/elasticity/element.hpp"
#include "model/mesh/gmsh_model.hpp"
#include "support/harness/messages.hpp"
#include "support/model/gmsh_library.hpp"
#include "support/model/mesh_checks.hpp"
#include "support/model/mesh_text.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

namespace fs = std::filesystem;
using test::changed;
using test::expectMessage;

int rank() {
  int rank = 0;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  return rank;
}

const std::string layer = test::material("layer", "1", "0.3", "1");

std::string messageOf(const std::string& file, const std::string& more = layer) {
  return test::messageOfMesh(file, more);
}

TEST(MeshFile, TextsAreSound) {
  EXPECT_EQ(messageOf(test::writeFile("sound2.msh", test::quadranglesMsh2())), "");
  EXPECT_EQ(messageOf(test::writeFile("sound4.msh", test::quadranglesMsh4())), "");
}

// gmsh runs what it does not know as a script, and SystemCall in it starts a program: here one that
// would leave a file behind.
TEST(MeshFile, OnlyAGeometryIsAScript) {
  const std::string trace = SQUEAL_OUTPUT_DIR "/script_ran";
  const auto script = "SystemCall \"touch " + trace + "\";\n";
  if (rank() == 0) fs::remove(trace);
  for (const char* name :
       {"script.msh",  "script.MSH",    "script.Msh",    "script.txt",  "script.pos",  "script.py",
        "script.opt",  "script",        "script.unv",    "script.Unv",  "script.cgns", "script.med",
        "script.step", "script.stp",    "script.brep",   "script.iges", "script.igs",  "script.IGS",
        "script.inp",  "script.msh.gz", "script.geo.txt"}) {
    expectMessage(messageOf(test::writeFile(name, script)), {"-mesh_file", name});
    EXPECT_FALSE(fs::exists(trace)) << name;
  }
  // An empty first line, and a header further down.
  expectMessage(messageOf(test::writeFile("below.msh", "\n" + script + test::quadranglesMsh2())),
                {"does not begin with '$MeshFormat'"});
  EXPECT_FALSE(fs::exists(trace));
  messageOf(test::writeFile("script.geo", script));
  EXPECT_TRUE(fs::exists(trace)) << "this test cannot fail";
  check(MPI_Barrier(PETSC_COMM_WORLD));
  if (rank() == 0) fs::remove(trace);
  // gmsh merges NAME.opt after NAME, by the same rule.
  const auto sound = test::writeFile("beside.msh", test::quadranglesMsh2());
  test::writeFile("beside.msh.opt", script);
  expectMessage(messageOf(sound), {"beside.msh.opt", "script"});
  EXPECT_FALSE(fs::exists(trace));
  check(MPI_Barrier(PETSC_COMM_WORLD));
  if (rank() == 0) fs::remove(SQUEAL_OUTPUT_DIR "/beside.msh.opt");
}

TEST(MeshFile, SaysWhatToDoWithOtherFormats) {
  expectMessage(messageOf(test::writeFile("abaqus.inp", "*NODE\n1, 0, 0, 0\n")),
                {"Abaqus", "cannot read", ".unv"});
  expectMessage(messageOf(test::writeFile("shape.stl", "solid\n")),
                {"no physical groups", "Merge", ".geo"});
}

struct Damage {
  const char *was, *is;
  std::vector<std::string> words;
};

// What gmsh's reader makes of these: a crash, another mesh without a word, or numbers that fit no
// array.
TEST(MeshFile, DamagedMshIsToldByLine) {
  const Damage ofVersion4[] = {
      {"\n3\n4\n", "\n-1\n4\n", {"line 21", "node tag -1"}},
      {"\n3\n4\n", "\n0\n4\n", {"line 21", "node tag 0"}},
      {"\n3\n4\n", "\n2\n4\n", {"$Nodes has the tag 2 twice"}},
      // beyond 32-bit indices; with 64 bits, a tag that no element refers to
      {"\n3\n4\n",
       "\n3000000000\n4\n",
       {sizeof(PetscInt) == 4 ? "node tag 3000000000" : "refers to node 3"}},
      {"5 1 2 5 4", "5 1 2 -1 4", {"element 5", "node -1"}},
      {"5 1 2 5 4", "5 1 2 7 4", {"element 5", "node 7"}},
      {"5 1 2 5 4", "6 1 2 5 4", {"$Elements has the tag 6 twice"}},
      {"2 1 0\n$EndNodes", "2 nan 0\n$EndNodes", {"node 6", "nan"}},
      {"2 1 0\n$EndNodes", "2 1e200 0\n$EndNodes", {"node 6", "1e+200", "below 1e100"}},
      {"2 1 0\n$EndNodes", "2,5 1 0\n$EndNodes", {"line 30", "'2,5'"}},
      {"2 1 0\n$EndNodes", "2 4.0D+2 0\n$EndNodes", {"'4.0D+2'"}},
      {"1 6 1 6\n2 1 0 6",
       "1 2000000000 1 6\n2 1 0 6",
       {"2000000000 nodes are promised", "cannot hold"}},
      {"1 6 1 6\n2 1 0 6", "1 5 1 6\n2 1 0 6", {"the blocks of the section hold more"}},
      {"1 6 1 6\n2 1 0 6", "1 7 1 6\n2 1 0 6", {"1 fewer nodes"}},
      {"1 6 1 6\n2 1 0 6", "0 6 1 6\n2 1 0 6", {"6 fewer nodes"}},
      {"3 6 1 6\n1 1 1 2", "2 6 1 6\n1 1 1 2", {"2 fewer elements"}},
      {"2 1 3 2\n", "2 1 77 2\n", {"element type 77"}},
      {"2 1 3 2\n", "2 9 3 2\n", {"gmsh reports", "entity 9"}},
      {"$EndElements\n", "", {"$EndElements", "nothing"}},
      {"2 3 6 5\n$EndElements\n", "2 3", {"the file ends"}},
      {"4.1 0 8", "7 0 8", {"version 7"}},
  };
  for (const auto& [was, is, words] : ofVersion4)
    expectMessage(
        messageOf(test::writeFile("damaged4.msh", changed(test::quadranglesMsh4(), was, is))),
        words);
  const Damage ofVersion2[] = {
      {"3 2 0 0", "-1 2 0 0", {"line 14", "node tag -1"}},
      {"3 2 0 0", "2 2 0 0", {"$Nodes has the tag 2 twice"}},
      {"3 2 0 0", "3 inf 0 0", {"node 3", "inf"}},
      {"$Nodes\n6", "$Nodes\n5", {"line 17", "$EndNodes is expected"}},
      {"$Nodes\n6", "$Nodes\n7", {"'$EndNodes'"}},
      {"$Elements\n6",
       "$Elements\n5",
       {"$EndElements is expected"}},  // gmsh would leave out the last cell
      {"$Elements\n6", "$Elements\n2000000000", {"2000000000 elements are promised"}},
      {"5 3 2 3 1 1 2 5 4", "5 3 2 3 1 1 2 9 4", {"element 5", "node 9"}},
      {"5 3 2 3 1 1 2 5 4", "5 3 2 3 -1 1 2 5 4", {"element 5", "-1"}},  // gmsh would leave it out
      {"5 3 2 3 1 1 2 5 4", "5 3 2000000000 3 1 1 2 5 4", {"labels are promised"}},
      {"5 3 2 3 1 1 2 5 4", "5 3 2 3 1 1 2 5.5 4", {"'5.5'"}},
  };
  for (const auto& [was, is, words] : ofVersion2)
    expectMessage(
        messageOf(test::writeFile("damaged2.msh", changed(test::quadranglesMsh2(), was, is))),
        words);
}

// Version 2 may give the nodes with their coordinates on the geometry.
TEST(MeshFile, ParametricNodesOfVersion2AreRead) {
  auto text = changed(changed(test::quadranglesMsh2(), "$Nodes", "$ParametricNodes"), "$EndNodes",
                      "$EndParametricNodes");
  text = changed(changed(text, "1 0 0 0\n", "1 0 0 0 0 1\n"), "2 1 0 0\n", "2 1 0 0 1 1 0.5\n");
  text = changed(changed(text, "3 2 0 0\n", "3 2 0 0 0 2\n"), "4 0 1 0\n", "4 0 1 0 0 3\n");
  text = changed(changed(text, "5 1 1 0\n", "5 1 1 0 2 1 0.5 1\n"), "6 2 1 0\n", "6 2 1 0 3 1\n");
  const auto file = test::writeFile("parametric.msh", text);
  const std::string binary = SQUEAL_OUTPUT_DIR "/parametric_binary.msh";
  if (rank() == 0) {
    test::startGmsh();
    gmsh::clear();
    gmsh::open("meshes/ring.geo");
    gmsh::model::mesh::generate(3);
    gmsh::option::setNumber("Mesh.SaveParametric", 1);
    gmsh::option::setNumber("Mesh.MshFileVersion", 2.2);
    gmsh::option::setNumber("Mesh.Binary", 1);
    gmsh::write(binary);
    gmsh::clear();
    gmsh::option::setNumber("Mesh.SaveParametric", 0);
  }
  check(MPI_Barrier(PETSC_COMM_WORLD));
  test::setOptions("-mesh_file " + file + layer + "-load_top_pressure 1");
  const auto mesh = test::readMesh();
  EXPECT_EQ(mesh.totalNodes, 6);
  EXPECT_NEAR(test::areaVectors(mesh).at("top")[1], 2, 1e-14);
  const auto ring = [](const std::string& name) {
    test::setOptions("-mesh_file " + name + test::material("ring", "1", "0.3", "1"));
    return test::readMesh();
  };
  const auto written = ring(binary), made = ring("meshes/ring.geo");
  EXPECT_EQ(written.totalCells, made.totalCells);
  EXPECT_EQ(written.totalNodes, made.totalNodes);
  expectMessage(messageOf(test::writeFile("parametric_damaged.msh",
                                          changed(text, "0 2 1 0.5 1\n", "0 7 1 0.5 1\n"))),
                {"node 5 is on an entity of dimension 7: must be 0 to 3"});
  expectMessage(messageOf(test::writeFile("parametric_short.msh",
                                          changed(text, "0 2 1 0.5 1\n", "0 2 1 0.5\n"))),
                {"line 18", "'$EndParametricNodes'"});
}

// Version 2 repeats a cell for each of its groups.
TEST(MeshFile, GroupsOfVersion2MayOverlap) {
  auto text =
      changed(test::quadranglesMsh2(), "$PhysicalNames\n3\n", "$PhysicalNames\n4\n2 4 \"right\"\n");
  text = changed(changed(text, "$Elements\n6", "$Elements\n7"), "$EndElements",
                 "7 3 2 4 1 2 3 6 5\n$EndElements");
  const auto file = test::writeFile("overlap.msh", text);
  test::setOptions("-mesh_file " + file + layer);
  EXPECT_EQ(test::readMesh().totalCells, 2);
  expectMessage(messageOf(file, layer + test::material("right", "1", "0.3", "1")),
                {"cells 6 of group 'layer' and 7 of group 'right' have the same nodes"});
  expectMessage(messageOf(file, test::material("right", "1", "0.3", "1")),
                {"group 'layer' has no material", "(cell 5)"});
}

// gmsh's reader leaves a section at the first line that it does not understand, and the rest of the
// cells with it.
TEST(MeshFile, DamagedUnvIsToldByLine) {
  const std::string sound = test::quadranglesUnv();
  test::setOptions("-mesh_file " + test::writeFile("sound.unv", sound) + layer +
                   "-load_top_pressure 1");
  const auto mesh = test::readMesh();
  EXPECT_EQ(mesh.totalCells, 2);
  EXPECT_EQ(mesh.totalNodes, 6);
  const Damage damages[] = {
      {"         6        44", "         x        44", {"line 32", "'x' is not a number"}},
      {"         6        44", "         6       999", {"line 32", "element 6 is of type 999"}},
      {"         6        44", "         6        45", {"element 6 of type 45 has 8 nodes, not 4"}},
      {"         6        44", "         5        44", {"two elements with the tag 5"}},
      {"2         3         6         5",
       "2         3         9         5",
       {"line 33", "element 6 refers to node 9"}},
      {"2         3         6         5",
       "2         3         6",
       {"3 numbers where there should be 4"}},
      {"2.0000000000000000D+00", "nan", {"line 8", "finite"}},
      {"2.0000000000000000D+00", "2,0", {"line 8", "'2,0'"}},
      {"         3         1         1        11",
       "        -3         1         1        11",
       {"line 7", "node tag -3"}},
      {"bottom", " top ", {"two groups of the name 'top'"}},
  };
  for (const auto& [was, is, words] : damages)
    expectMessage(messageOf(test::writeFile("damaged.unv", changed(sound, was, is))), words);
  for (const std::size_t length : {sound.size() - 7, sound.size() / 2, sound.size() / 4})
    expectMessage(messageOf(test::writeFile("short.unv", sound.substr(0, length))), {"line"});
}

// gmsh knows the sections 2435, 2452 and 2477 of groups; Salome writes 2467, of the same records.
// Of a name gmsh reads the first word.
TEST(MeshFile, GroupsOfUnvHaveTheirWholeNames) {
  int ranks = 1;
  check(MPI_Comm_size(PETSC_COMM_WORLD, &ranks));
  const fs::path folder = SQUEAL_OUTPUT_DIR "/copies_" + std::to_string(ranks);
  fs::create_directories(folder);
  setenv("TMPDIR", folder.c_str(), 1);
  for (const char* section : {"2435", "2452", "2467", "2477"}) {
    auto text = changed(test::quadranglesUnv(), "  2477\n", std::string("  ") + section + "\n");
    text = changed(changed(text, "\nbottom\n", "\nface of it\n"), "\ntop\n", "\nface  above\r\n");
    const auto file = test::writeFile("names.unv", text);
    test::setOptions("-mesh_file " + file + layer +
                     "-load_face_of_it_pressure 1 -load_face_above_pressure 1");
    const auto mesh = test::readMesh();
    EXPECT_EQ(mesh.totalCells, 2) << section;
    const auto areas = test::areaVectors(mesh);
    EXPECT_NEAR(areas.at("face_of_it")[1], -2, 1e-14) << section;
    EXPECT_NEAR(areas.at("face_above")[1], 2, 1e-14) << section;
    expectMessage(messageOf(file, layer + "-load_face_pressure 1"),
                  {"its groups are: face_above, face_of_it, layer"});
  }
  EXPECT_TRUE(fs::is_empty(folder));  // the copies are gone
  unsetenv("TMPDIR");
}

// The checks look only at nodes and elements; where gmsh crashes on the rest, its process dies and
// not this one.
TEST(MeshFile, ACrashOfGmshIsAnError) {
  const auto text = changed(test::quadranglesMsh4(), "1 1 \"bottom\"", "900000000 1 \"bottom\"");
  expectMessage(messageOf(test::writeFile("crash.msh", text)),
                {"-mesh_file", "crash.msh: gmsh crashed (", "Segmentation fault"});
}

TEST(MeshFile, BinaryFilesAreReadAndChecked) {
  for (const double version : {2.2, 4.1}) {
    const auto from = test::writeFile(
        "to_binary.msh", version < 4 ? test::quadranglesMsh2() : test::quadranglesMsh4());
    const std::string file = SQUEAL_OUTPUT_DIR "/binary.msh";
    std::string bytes;
    if (rank() == 0) {
      test::writeBinaryMsh(from, file, version);
      std::ifstream stream(file, std::ios::binary);
      bytes.assign(std::istreambuf_iterator<char>(stream), {});
    }
    check(MPI_Barrier(PETSC_COMM_WORLD));
    test::setOptions("-mesh_file " + file + layer);
    const auto mesh = test::readMesh();
    EXPECT_EQ(mesh.totalCells, 2);
    EXPECT_EQ(mesh.totalNodes, 6);
    const auto inNodes = bytes.find("$Nodes") + 60, inElements = bytes.find("$EndElements") - 10;
    for (const auto length : {inNodes, inElements})
      expectMessage(messageOf(test::writeFile("cut.msh", bytes.substr(0, length))),
                    {"byte", "the file"});
    // The count of nodes, 6: text in version 2, behind the count of blocks in version 4.
    const auto at = bytes.find("$Nodes\n") + 7 + (version < 4 ? 0 : 8);
    if (rank() == 0) bytes.replace(at, 1, version < 4 ? "9" : "\x09");
    expectMessage(messageOf(test::writeFile("promise.msh", bytes)), {"byte"});
  }
}

// By gmsh's names. A geometry can bring them: it is not checked as a mesh file is.
TEST(MeshFile, ElementsOfOtherTypesAreNamed) {
  const auto merged = [](const std::string& name, const std::string& was, const std::string& is) {
    const auto file = test::writeFile(name + ".msh", changed(test::quadranglesMsh2(), was, is));
    return test::writeFile(name + ".geo", "Merge \"" + file + "\";\n");
  };
  expectMessage(messageOf(merged("cubic", "5 3 2 3 1 1 2 5 4", "5 21 2 3 1 1 2 5 4 3 6 1 2 5 4")),
                {"group 'layer' has cells 'Triangle 10'", "supported are tri3"});
  expectMessage(messageOf(merged("cubic_line", "1 1 2 1 1 1 2\n", "1 26 2 1 1 1 2 4 5\n"),
                          layer + "-load_bottom_pressure 1"),
                {"group 'bottom' has faces 'Line 4'", "supported are line2"});
}

// gmsh puts the elements of one entity into all groups of that entity; many programs write 1 for
// every entity.
TEST(MeshFile, EachElementOfVersion2IsInTheGroupThatItNames) {
  std::string text = changed(test::quadranglesMsh2(), "3 1 2 2 2 4 5", "3 1 2 2 1 4 5");
  text = changed(text, "4 1 2 2 2 5 6", "4 1 2 2 1 5 6");
  test::setOptions("-mesh_file " + test::writeFile("one_entity.msh", text) + layer +
                   "-constraint_bottom_clamped xy");
  const auto mesh = test::readMesh();
  EXPECT_EQ(test::total(static_cast<double>(mesh.nodeGroups.at("bottom").size())),
            3);  // not all six
}

// A surface with two names, as a shared contact surface has, is written twice in version 2.
TEST(MeshFile, ASurfaceWithTwoNamesIsNotDoubled) {
  const std::string file = SQUEAL_OUTPUT_DIR "/two_names.msh";
  if (rank() == 0) {
    std::string text = changed(test::quadranglesMsh2(), "$Elements\n6", "$Elements\n8");
    text = changed(text, "$EndElements", "7 1 2 4 2 4 5\n8 1 2 4 2 5 6\n$EndElements");
    std::ofstream(file) << changed(changed(text, "$PhysicalNames\n3", "$PhysicalNames\n4"),
                                   "2 3 \"layer\"", "1 4 \"roof\"\n2 3 \"layer\"");
  }
  check(MPI_Barrier(PETSC_COMM_WORLD));
  for (const std::string surface : {"top", "roof"}) {
    test::setOptions("-mesh_file " + file + layer + "-load_" + surface + "_pressure 1");
    const auto mesh = test::readMesh();
    const auto bodies = test::assembleBodies(mesh);
    EXPECT_NEAR(test::dot(test::nodalField(mesh,
                                           [](const mesh::Point&) {
                                             return mesh::Point{0, 1, 0};
                                           }),
                          bodies.load),
                -2, 1e-14)
        << surface;  // 1 Pa on 2 m
  }
}

TEST(MeshFile, GroupNamesWithBlanksHaveUnderscoresInOptions) {
  const auto file = test::writeFile(
      "blanks.msh", changed(test::quadranglesMsh2(), "\"layer\"", "\"brake  disc\""));
  EXPECT_EQ(messageOf(file, test::material("brake__disc", "1", "0.3", "1")), "");
  expectMessage(messageOf(file, test::material("disc", "1", "0.3", "1")),
                {"'disc'", "its groups are: bottom, brake__disc, top"});
  const auto both = test::writeFile(
      "blanks2.msh",
      changed(changed(test::quadranglesMsh2(), "\"bottom\"", "\"a b\""), "\"top\"", "\"a_b\""));
  expectMessage(messageOf(both), {"'a b'", "'a_b'", "underscores stand for blanks"});
}

// Of nodes that are in no element gmsh drops some and keeps others, by format.
TEST(MeshFile, NodesInNoCellAreCounted) {
  const auto unused = [](const std::string& file, const std::string& more = layer) {
    test::setOptions("-mesh_file " + file + more);
    const auto mesh = test::readMesh();
    return std::pair(mesh.totalNodes, mesh.unusedNodes);
  };
  using Counts = std::pair<PetscInt, PetscInt>;
  const auto written = [](const char* name, std::string text, const std::vector<Damage>& changes) {
    for (const auto& change : changes) text = changed(text, change.was, change.is);
    return test::writeFile(name, text);
  };
  const std::string text2 = test::quadranglesMsh2(), text4 = test::quadranglesMsh4();
  EXPECT_EQ(unused(written("nodes2.msh", text2, {})), Counts(6, 0));
  EXPECT_EQ(unused(written("nodes4.msh", text4, {})), Counts(6, 0));
  EXPECT_EQ(unused(written("nodes.unv", test::quadranglesUnv(), {})), Counts(6, 0));
  const Damage eight2{"$Nodes\n6", "$Nodes\n8", {}},
      more2{"$EndNodes", "7 5 5 0\n8 6 5 0\n$EndNodes", {}};
  EXPECT_EQ(unused(written("nodes2.msh", text2, {eight2, more2})), Counts(6, 2));
  // A line that is the side of no cell, and a point.
  EXPECT_EQ(unused(written("nodes2.msh", text2,
                           {eight2,
                            more2,
                            {"$Elements\n6", "$Elements\n7", {}},
                            {"$EndElements", "7 1 2 1 7 7 8\n$EndElements", {}}})),
            Counts(6, 2));
  EXPECT_EQ(unused(written("nodes2.msh", text2,
                           {eight2,
                            more2,
                            {"$Elements\n6", "$Elements\n7", {}},
                            {"$EndElements", "7 15 2 0 7 7\n$EndElements", {}}})),
            Counts(6, 1));
  EXPECT_EQ(unused(written("nodes4.msh", text4,
                           {{"1 6 1 6\n2 1 0 6", "1 8 1 8\n2 1 0 8", {}},
                            {"5\n6\n0 0 0", "5\n6\n7\n8\n0 0 0", {}},
                            {"$EndNodes", "5 5 0\n6 5 0\n$EndNodes", {}}})),
            Counts(6, 2));
  // Its points have nodes, in a cell or not.
  EXPECT_EQ(unused(written("nodes4.msh", text4,
                           {{"$Entities\n0 2", "$Entities\n1 2", {}},
                            {"1 0 0 0 2 0 0", "9 5 5 0 0\n1 0 0 0 2 0 0", {}},
                            {"1 6 1 6\n2 1 0 6", "2 7 1 7\n0 9 0 1\n7\n5 5 0\n2 1 0 6", {}}})),
            Counts(6, 0));
  const std::string node =
      "         7         1         1        11\n"
      "   5.0000000000000000D+00   5.0000000000000000D+00   0.0000000000000000D+00\n";
  const std::string unv =
      changed(test::quadranglesUnv(), "    -1\n    -1\n  2412", node + "    -1\n    -1\n  2412");
  EXPECT_EQ(unused(test::writeFile("nodes.unv", unv)), Counts(6, 1));
  // Centres of circles, and quadratic cells without the nodes in their middles.
  const std::string ring =
      test::material("inner", "1", "0.3", "1") + test::material("outer", "1", "0.3", "1");
  EXPECT_EQ(unused("meshes/cylinders.geo", ring + "-mesh_set order=2,serendipity=1").second, 0);
}

TEST(MeshFile, AMeshWithoutGroupsSaysSo) {
  const auto file = test::writeFile(
      "nameless.geo", "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 1, 1};\n");
  expectMessage(messageOf(file), {"'layer'", "it has no physical groups at all"});
}

// nx = 0 and -3 gave 12 cells, 2.5 gave 24 instead of 2.5 × 12.
TEST(MeshParameters, MustBeWhatTheGeometryDeclares) {
  const std::string geometry = "meshes/layer.geo";
  for (const char* value : {"0", "-3", "2.5", "100001", "1e9"})
    expectMessage(messageOf(geometry, layer + "-mesh_set nx=" + value),
                  {"-mesh_set nx=", "must be a whole number >= 1"});
  for (const char* value : {"nan", "inf", "-inf", "1e999", "0x10", "", "3=4"})
    expectMessage(messageOf(geometry, layer + "-mesh_set nx=" + value),
                  {"-mesh_set", "name=number"});
  expectMessage(messageOf(geometry, layer + "-mesh_set order=3"), {"order=3", "must be 1 or 2"});
  expectMessage(messageOf(geometry, layer + "-mesh_set nx=3,ny=2,nx=4"),
                {"-mesh_set", "'nx' twice"});
  expectMessage(messageOf(geometry, layer + "-mesh_set mx=3"),
                {"no parameter 'mx'", "it has: Lx, h, nx"});
  expectMessage(messageOf("meshes/ring.geo",
                          test::material("ring", "1", "0.3", "1") + "-mesh_set n_theta=66"),
                {"n_theta = 66", "multiple of 4"});
  const auto mesh = test::writeFile("sound2.msh", test::quadranglesMsh2());
  expectMessage(messageOf(mesh, layer + "-mesh_set nx=3"), {"-mesh_set", "sound2.msh", "a mesh"});
}

std::string square(const std::string& declarations) {
  return "DefineConstant[" + declarations +
         "];\nPoint(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, "
         "0};\n"
         "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = "
         "{1 : 4}; Plane Surface(1) = "
         "{1};\n"
         "Transfinite Curve {1, 3} = n + 1; Transfinite Curve {2, 4} = 3; Transfinite Surface {1}; "
         "Recombine Surface {1};\n"
         "Physical Surface(\"layer\") = {1};\n";
}

TEST(MeshParameters, RangesOfOtherGeometries) {
  // gmsh makes up a range for its sliders where none is declared, here 7 to 180: that is not a
  // rule.
  const auto free = test::writeFile("free.geo", square("n = {36, Name \"n\"}"));
  test::setOptions("-mesh_file " + free + layer + "-mesh_set n=3");
  EXPECT_EQ(test::readMesh().totalCells, 6);
  const auto bounded = test::writeFile("bounded.geo", square("n = {3, Name \"n\", Min 2, Max 5}"));
  expectMessage(messageOf(bounded, layer + "-mesh_set n=6"),
                {"n=6", "must be a number >= 2 and <= 5"});
  expectMessage(messageOf(bounded, layer + "-mesh_set n=1"), {"n=1", ">= 2"});
  EXPECT_EQ(messageOf(bounded, layer + "-mesh_set n=5"), "");
  const auto fixed = test::writeFile("fixed.geo", square("n = {3, Name \"n\", ReadOnly 1}"));
  expectMessage(messageOf(fixed, layer + "-mesh_set n=5"), {"n=5", "takes 3 in its place"});
  const auto none = test::writeFile("none.geo", "n = 2;\n" + square("m = 1"));
  expectMessage(messageOf(none, layer + "-mesh_set n=5"), {"no parameter 'n'", "it has none"});
}

// 10¹⁰ cells: estimated from the numbers on the edges, before gmsh asks for them.
TEST(MeshParameters, AMeshTooLargeIsToldBeforeItIsMade) {
  expectMessage(messageOf("meshes/layer.geo", layer + "-mesh_set nx=100000,ny=100000"),
                {"about 1e+10 cells"});
  expectMessage(messageOf("meshes/beam.geo", test::material("beam", "1", "0.3", "1") +
                                                 "-mesh_set nx=5000,ny=2000,nz=1000"),
                {"about 1e+10 cells"});
}

TEST(Child, ItsEndIsAnErrorHere) {
  if (rank() != 0) return;
  const ChildLimits limits{"the work", 1.0, 1e9, "it is too large", "the worker"};
  const auto end = [&](const std::function<void()>& work) {
    return test::errorOf([&] {
      inChild(limits, [&](const Warn&) {
        work();
        return std::vector<char>();
      });
    });
  };
  EXPECT_EQ(end([] {}), "");
  expectMessage(end([] { std::abort(); }), {"the work: ", "crashed", "Aborted"});
  expectMessage(end([] { raise(SIGSEGV); }), {"crashed", "Segmentation fault"});
  expectMessage(end([] { _exit(3); }), {"exited with code 3"});
  expectMessage(end([] { raise(SIGKILL); }), {"was killed"});
  expectMessage(end([] { throw Error("so it is"); }), {"so it is"});
  expectMessage(end([] { throw std::bad_alloc(); }), {"the work: it is too large"});
  expectMessage(end([] {
                  for (std::atomic<int> i = 0;; ++i) continue;
                }),
                {"not finished after 1 s"});
}

TEST(Child, ItsMemoryIsLimitedAndItsResultWhole) {
  if (rank() != 0) return;
  const auto numbers = [](std::size_t count) {
    return [count](const Warn&) {
      std::vector<double> values(count);
      for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<double>(i);
      Stream stream;
      stream(values);
      return std::move(stream).bytes();
    };
  };
  const ChildLimits limits{"the work", {}, 1e8, "it is too large", "the worker"};
  // 8 MB, many times what a pipe holds
  Stream stream(inChild(limits, numbers(1000000)));
  std::vector<double> values;
  stream(values);
  ASSERT_EQ(values.size(), 1000000u);
  EXPECT_EQ(values[999999], 999999);
#if !defined(__SANITIZE_ADDRESS__)  // which has an end of its own for this
  expectMessage(test::errorOf([&] { inChild(limits, numbers(100000000)); }),
                {"the work", "it is too large"});
#endif
}

}  // namespace
}  // namespace squeal
