// SPDX-License-Identifier: BSD-2-Clause
// Files that are handed to gmsh: none is taken for a script that is none by its name, none brings
// the program down, and all formats are read whole.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "model/elasticity/element.hpp"
#include "support/harness/messages.hpp"
#include "support/model/gmsh_library.hpp"
#include "support/model/layer_file.hpp"
#include "support/model/mesh_checks.hpp"
#include "support/model/mesh_text.hpp"

namespace squeal::test {
namespace {

namespace fs = std::filesystem;

TEST(MeshFile, TextsAreSound) {
  EXPECT_EQ(messageOf(writeFile("sound2.msh", quadranglesMsh2())), "");
  EXPECT_EQ(messageOf(writeFile("sound4.msh", quadranglesMsh4())), "");
}

// gmsh runs what it does not know as a script, and SystemCall in it starts a program: here one that
// would leave a file behind.
TEST(MeshFile, OnlyAGeometryIsAScript) {
  const std::string trace = SQUEAL_OUTPUT_DIR "/script_ran";
  const auto script = "SystemCall \"touch " + trace + "\";\n";
  if (rankOf() == 0) fs::remove(trace);
  for (const char* name :
       {"script.msh",  "script.MSH",    "script.Msh",    "script.txt",  "script.pos",  "script.py",
        "script.opt",  "script",        "script.unv",    "script.Unv",  "script.cgns", "script.med",
        "script.step", "script.stp",    "script.brep",   "script.iges", "script.igs",  "script.IGS",
        "script.inp",  "script.msh.gz", "script.geo.txt"}) {
    expectMessage(messageOf(writeFile(name, script)), {"-mesh_file", name});
    EXPECT_FALSE(fs::exists(trace)) << name;
  }
  // An empty first line, and a header further down.
  expectMessage(messageOf(writeFile("below.msh", "\n" + script + quadranglesMsh2())),
                {"does not begin with '$MeshFormat'"});
  EXPECT_FALSE(fs::exists(trace));
  messageOf(writeFile("script.geo", script));
  EXPECT_TRUE(fs::exists(trace)) << "this test cannot fail";
  check(MPI_Barrier(PETSC_COMM_WORLD));
  if (rankOf() == 0) fs::remove(trace);
  // gmsh merges NAME.opt after NAME, by the same rule.
  const auto sound = writeFile("beside.msh", quadranglesMsh2());
  writeFile("beside.msh.opt", script);
  expectMessage(messageOf(sound), {"beside.msh.opt", "script"});
  EXPECT_FALSE(fs::exists(trace));
  check(MPI_Barrier(PETSC_COMM_WORLD));
  if (rankOf() == 0) fs::remove(SQUEAL_OUTPUT_DIR "/beside.msh.opt");
}

TEST(MeshFile, SaysWhatToDoWithOtherFormats) {
  expectMessage(messageOf(writeFile("abaqus.inp", "*NODE\n1, 0, 0, 0\n")),
                {"Abaqus", "cannot read", ".unv"});
  expectMessage(messageOf(writeFile("shape.stl", "solid\n")),
                {"no physical groups", "Merge", ".geo"});
}

// Version 2 may give the nodes with their coordinates on the geometry.
TEST(MeshFile, ParametricNodesOfVersion2AreRead) {
  auto text = changed(changed(quadranglesMsh2(), "$Nodes", "$ParametricNodes"), "$EndNodes",
                      "$EndParametricNodes");
  text = changed(changed(text, "1 0 0 0\n", "1 0 0 0 0 1\n"), "2 1 0 0\n", "2 1 0 0 1 1 0.5\n");
  text = changed(changed(text, "3 2 0 0\n", "3 2 0 0 0 2\n"), "4 0 1 0\n", "4 0 1 0 0 3\n");
  text = changed(changed(text, "5 1 1 0\n", "5 1 1 0 2 1 0.5 1\n"), "6 2 1 0\n", "6 2 1 0 3 1\n");
  const auto file = writeFile("parametric.msh", text);
  const std::string binary = SQUEAL_OUTPUT_DIR "/parametric_binary.msh";
  if (rankOf() == 0) {
    startGmsh();
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
  setOptions("-mesh_file " + file + layer + "-load_top_pressure 1");
  const auto mesh = readMesh();
  EXPECT_EQ(mesh.totalNodes, 6);
  EXPECT_NEAR(areaVectors(mesh).at("top")[1], 2, 1e-14);
  const auto ring = [](const std::string& name) {
    setOptions("-mesh_file " + name + material("ring", "1", "0.3", "1"));
    return readMesh();
  };
  const auto written = ring(binary), made = ring("meshes/ring.geo");
  EXPECT_EQ(written.totalCells, made.totalCells);
  EXPECT_EQ(written.totalNodes, made.totalNodes);
  expectMessage(messageOf(writeFile("parametric_damaged.msh",
                                    changed(text, "0 2 1 0.5 1\n", "0 7 1 0.5 1\n"))),
                {"node 5 is on an entity of dimension 7: must be 0 to 3"});
  expectMessage(
      messageOf(writeFile("parametric_short.msh", changed(text, "0 2 1 0.5 1\n", "0 2 1 0.5\n"))),
      {"line 18", "'$EndParametricNodes'"});
}

// The checks look only at nodes and elements; where gmsh crashes on the rest, its process dies and
// not this one.
TEST(MeshFile, ACrashOfGmshIsAnError) {
  const auto text = changed(quadranglesMsh4(), "1 1 \"bottom\"", "900000000 1 \"bottom\"");
  expectMessage(messageOf(writeFile("crash.msh", text)),
                {"-mesh_file", "crash.msh: gmsh crashed (", "Segmentation fault"});
}

TEST(MeshFile, BinaryFilesAreReadAndChecked) {
  for (const double version : {2.2, 4.1}) {
    const auto from =
        writeFile("to_binary.msh", version < 4 ? quadranglesMsh2() : quadranglesMsh4());
    const std::string file = SQUEAL_OUTPUT_DIR "/binary.msh";
    std::string bytes;
    if (rankOf() == 0) {
      writeBinaryMsh(from, file, version);
      std::ifstream stream(file, std::ios::binary);
      bytes.assign(std::istreambuf_iterator<char>(stream), {});
    }
    check(MPI_Barrier(PETSC_COMM_WORLD));
    setOptions("-mesh_file " + file + layer);
    const auto mesh = readMesh();
    EXPECT_EQ(mesh.totalCells, 2);
    EXPECT_EQ(mesh.totalNodes, 6);
    const auto inNodes = bytes.find("$Nodes") + 60, inElements = bytes.find("$EndElements") - 10;
    for (const auto length : {inNodes, inElements})
      expectMessage(messageOf(writeFile("cut.msh", bytes.substr(0, length))), {"byte", "the file"});
    // The count of nodes, 6: text in version 2, behind the count of blocks in version 4.
    const auto at = bytes.find("$Nodes\n") + 7 + (version < 4 ? 0 : 8);
    if (rankOf() == 0) bytes.replace(at, 1, version < 4 ? "9" : "\x09");
    expectMessage(messageOf(writeFile("promise.msh", bytes)), {"byte"});
  }
}

// By gmsh's names. A geometry can bring them: it is not checked as a mesh file is.
TEST(MeshFile, ElementsOfOtherTypesAreNamed) {
  const auto merged = [](const std::string& name, const std::string& was, const std::string& is) {
    const auto file = writeFile(name + ".msh", changed(quadranglesMsh2(), was, is));
    return writeFile(name + ".geo", "Merge \"" + file + "\";\n");
  };
  expectMessage(messageOf(merged("cubic", "5 3 2 3 1 1 2 5 4", "5 21 2 3 1 1 2 5 4 3 6 1 2 5 4")),
                {"group 'layer' has cells 'Triangle 10'", "supported are tri3"});
  expectMessage(messageOf(merged("cubic_line", "1 1 2 1 1 1 2\n", "1 26 2 1 1 1 2 4 5\n"),
                          layer + "-load_bottom_pressure 1"),
                {"group 'bottom' has faces 'Line 4'", "supported are line2"});
}

struct Change {
  const char *was, *is;
};

// Of nodes that are in no element gmsh drops some and keeps others, by format.
TEST(MeshFile, NodesInNoCellAreCounted) {
  const auto unused = [](const std::string& file, const std::string& more = layer) {
    setOptions("-mesh_file " + file + more);
    const auto mesh = readMesh();
    return std::pair(mesh.totalNodes, mesh.unusedNodes);
  };
  using Counts = std::pair<PetscInt, PetscInt>;
  const auto written = [](const char* name, std::string text, const std::vector<Change>& changes) {
    for (const auto& change : changes) text = changed(text, change.was, change.is);
    return writeFile(name, text);
  };
  const std::string text2 = quadranglesMsh2(), text4 = quadranglesMsh4();
  EXPECT_EQ(unused(written("nodes2.msh", text2, {})), Counts(6, 0));
  EXPECT_EQ(unused(written("nodes4.msh", text4, {})), Counts(6, 0));
  EXPECT_EQ(unused(written("nodes.unv", quadranglesUnv(), {})), Counts(6, 0));
  const Change eight2{"$Nodes\n6", "$Nodes\n8"}, more2{"$EndNodes", "7 5 5 0\n8 6 5 0\n$EndNodes"};
  EXPECT_EQ(unused(written("nodes2.msh", text2, {eight2, more2})), Counts(6, 2));
  // A line that is the side of no cell, and a point.
  EXPECT_EQ(unused(written("nodes2.msh", text2,
                           {eight2,
                            more2,
                            {"$Elements\n6", "$Elements\n7"},
                            {"$EndElements", "7 1 2 1 7 7 8\n$EndElements"}})),
            Counts(6, 2));
  EXPECT_EQ(unused(written("nodes2.msh", text2,
                           {eight2,
                            more2,
                            {"$Elements\n6", "$Elements\n7"},
                            {"$EndElements", "7 15 2 0 7 7\n$EndElements"}})),
            Counts(6, 1));
  EXPECT_EQ(unused(written("nodes4.msh", text4,
                           {{"1 6 1 6\n2 1 0 6", "1 8 1 8\n2 1 0 8"},
                            {"5\n6\n0 0 0", "5\n6\n7\n8\n0 0 0"},
                            {"$EndNodes", "5 5 0\n6 5 0\n$EndNodes"}})),
            Counts(6, 2));
  // Its points have nodes, in a cell or not.
  EXPECT_EQ(unused(written("nodes4.msh", text4,
                           {{"$Entities\n0 2", "$Entities\n1 2"},
                            {"1 0 0 0 2 0 0", "9 5 5 0 0\n1 0 0 0 2 0 0"},
                            {"1 6 1 6\n2 1 0 6", "2 7 1 7\n0 9 0 1\n7\n5 5 0\n2 1 0 6"}})),
            Counts(6, 0));
  const std::string node =
      "         7         1         1        11\n"
      "   5.0000000000000000D+00   5.0000000000000000D+00   0.0000000000000000D+00\n";
  const std::string unv =
      changed(quadranglesUnv(), "    -1\n    -1\n  2412", node + "    -1\n    -1\n  2412");
  EXPECT_EQ(unused(writeFile("nodes.unv", unv)), Counts(6, 1));
  // Centres of circles, and quadratic cells without the nodes in their middles.
  const std::string ring = material("inner", "1", "0.3", "1") + material("outer", "1", "0.3", "1");
  EXPECT_EQ(unused("meshes/cylinders.geo", ring + "-mesh_set order=2,serendipity=1").second, 0);
}

}  // namespace
}  // namespace squeal::test
