// SPDX-License-Identifier: BSD-2-Clause
// results.h5: what PETSc's own reader finds in it is what was given.
#include <gtest/gtest.h>

#include <fstream>

#include "base/petsc/object.hpp"
#include "run/fieldfile/hdf5.hpp"
#include "support/harness/hdf5_reader.hpp"
#include "support/harness/messages.hpp"
#include "support/harness/program.hpp"
#include "support/harness/scratch_folder.hpp"
#include "support/run/bar_mesh.hpp"

namespace squeal::fieldfile {
namespace {

using namespace test;

const std::string option = "-folder";

TEST(Hdf5, HoldsTheMeshInGlobalOrder) {
  const Folder folder;
  const Mesh mesh = bar();
  Hdf5File(PETSC_COMM_WORLD, folder.path / "results.h5", option).writeMesh(mesh);
  Reader reader(folder.path / "results.h5");
  const int size = sizeOf(mesh.comm);

  const auto [coordinates, dimensions] = reader.reals("/mesh", "coordinates");
  const auto [tags, one] = reader.integers("/mesh", "node_tag");
  const auto [nodeParts, alsoOne] = reader.integers("/mesh", "node_part");
  ASSERT_EQ(coordinates.size(), static_cast<std::size_t>(3 * mesh.totalNodes));
  ASSERT_EQ(tags.size(), static_cast<std::size_t>(mesh.totalNodes));
  ASSERT_EQ(nodeParts.size(), tags.size());
  EXPECT_EQ(dimensions, 3);
  for (int node = 0; node < mesh.totalNodes; ++node) {
    const auto i = static_cast<std::size_t>(node);
    EXPECT_EQ(coordinates[3 * i], node / 4);
    EXPECT_EQ(coordinates[3 * i + 2], node % 4 / 2 + 1e-12 * node);
    EXPECT_EQ(tags[i], 100 + node);
    EXPECT_EQ(nodeParts[i], node >= 4);
  }

  EXPECT_EQ(reader.hasGroup("/mesh/cells_5"), size > 1);
  if (size > 1) {
    const auto [bricks, perBrick] = reader.integers("/mesh/cells_5", "nodes");
    EXPECT_EQ(perBrick, 8);
    ASSERT_EQ(bricks.size(), static_cast<std::size_t>(8 * (size - 1)));
    for (std::size_t i = 0; i < bricks.size(); ++i)
      EXPECT_EQ(bricks[i], static_cast<PetscInt>(i / 8 * 4 + i % 8));
    EXPECT_EQ(reader.attribute<PetscInt>("/mesh/cells_5", "gmsh_element_type", PETSC_INT), 5);
    EXPECT_EQ(reader.text("/mesh/cells_5", "gmsh_element_name"), "Hexahedron 8");
  }
  const auto [wedges, perWedge] = reader.integers("/mesh/cells_6", "nodes");
  std::vector<PetscInt> expected{0, 1, 2, 4, 5, 6, 0, 2, 3, 4, 6, 7};
  for (auto& node : expected) node += 4 * (size - 1);
  EXPECT_EQ(perWedge, 6);
  EXPECT_EQ(wedges, expected);
  EXPECT_EQ(reader.integers("/mesh/cells_6", "body").first, (std::vector<PetscInt>{1, 0}));
  EXPECT_EQ(reader.integers("/mesh/cells_6", "tag").first,
            (std::vector<PetscInt>{999 + size, 1000 + size}));
  EXPECT_EQ(reader.attribute<PetscInt>("/mesh/cells_6", "gmsh_element_type", PETSC_INT), 6);
  EXPECT_EQ(reader.attribute<PetscInt>("/mesh", "dimension", PETSC_INT), 3);
  EXPECT_EQ(reader.text("/mesh", "bodies"), "disc,pad");
}

TEST(Hdf5, HoldsTheMaterialsOfSections) {
  const Folder folder;
  const Mesh mesh = sectionedBar();
  Hdf5File(PETSC_COMM_WORLD, folder.path / "results.h5", option).writeMesh(mesh);
  Reader reader(folder.path / "results.h5");
  EXPECT_EQ(reader.text("/mesh", "materials"), "disc,first,second");
  EXPECT_EQ(reader.integers("/mesh/cells_6", "material").first, (std::vector<PetscInt>{1, 2}));
}

TEST(Hdf5, HoldsNodeVectors) {
  const Folder folder;
  const Mesh mesh = bar();
  OwnedVec u;
  check(VecCreateMPI(mesh.comm, 2 * mesh.ownedNodes, PETSC_DETERMINE, u.out()));
  check(VecSetBlockSize(u, 2));
  check(PetscObjectSetName(object(u.get()), "mine"));
  for (PetscInt i = 2 * mesh.firstNode; i < 2 * (mesh.firstNode + mesh.ownedNodes); ++i)
    check(VecSetValue(u, i, 1.0 / (1 + i), INSERT_VALUES));
  check(VecAssemblyBegin(u));
  check(VecAssemblyEnd(u));
  {
    Hdf5File file(mesh.comm, folder.path / "results.h5", option);
    file.writeNodeVector("/modes", "shape_0001", u);
    file.writeNodeVector("/flutter/friction_0.4", "shape_0001_real", u);
  }
  const char* name = nullptr;
  check(PetscObjectGetName(object(u.get()), &name));
  EXPECT_STREQ(name, "mine");

  Reader reader(folder.path / "results.h5");
  for (const auto& [group, dataset] :
       {std::pair{"/modes", "shape_0001"}, std::pair{"/flutter/friction_0.4", "shape_0001_real"}}) {
    const auto [values, components] = reader.reals(group, dataset);
    EXPECT_EQ(components, 2);
    ASSERT_EQ(values.size(), static_cast<std::size_t>(2 * mesh.totalNodes));
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_EQ(values[i], 1.0 / (1 + static_cast<double>(i)));
  }
}

TEST(Hdf5, HoldsTablesAndAttributes) {
  const Folder folder;
  const bool first = rankOf(PETSC_COMM_WORLD) == 0;
  using Rows = std::vector<std::vector<double>>;
  {
    Hdf5File file(PETSC_COMM_WORLD, folder.path / "results.h5", option);
    file.writeTable("/flutter", "eigenvalues", {"growth_rate_1_per_s", "frequency_hz"},
                    first ? Rows{{-1.5, 440}, {0, 880}, {2, 1}} : Rows{});
    file.writeTable("/flutter", "single", {"mode"}, first ? Rows{{7}, {8}} : Rows{});
    file.writeTable("/flutter", "none", {"a", "b", "c"}, {});
    file.writeAttribute("/flutter", "friction", 0.4);
    file.writeAttribute("/flutter", "method", "reduced");
    file.writeAttribute("/flutter", "empty", "");
    file.writeAttribute("/flutter/single", "unit", "1");
    EXPECT_THROW(file.writeTable("/flutter", "bad", {"a", "b"}, first ? Rows{{1}} : Rows{}), Error);
  }
  Reader reader(folder.path / "results.h5");
  const auto [values, columns] = reader.reals("/flutter", "eigenvalues");
  EXPECT_EQ(columns, 2);
  EXPECT_EQ(values, (std::vector<double>{-1.5, 440, 0, 880, 2, 1}));
  EXPECT_EQ(reader.text("/flutter/eigenvalues", "columns"), "growth_rate_1_per_s,frequency_hz");
  EXPECT_EQ(reader.reals("/flutter", "single").first, (std::vector<double>{7, 8}));
  EXPECT_EQ(reader.text("/flutter/none", "columns"), "a,b,c");
  EXPECT_EQ(reader.attribute<double>("/flutter", "friction", PETSC_DOUBLE), 0.4);
  EXPECT_EQ(reader.text("/flutter", "method"), "reduced");
  EXPECT_EQ(reader.text("/flutter", "empty"), "");
  EXPECT_EQ(reader.text("/flutter/single", "unit"), "1");
}

TEST(Hdf5, NamesTheOptionWhereTheFileCannotBeMade) {
  const Folder folder;
  const fs::path file = folder.path / "file";  // a file is not a folder, even for root
  if (rankOf(PETSC_COMM_WORLD) == 0) std::ofstream(file) << "x";
  MPI_Barrier(PETSC_COMM_WORLD);
  EXPECT_NE(errorOf([&] { Hdf5File(PETSC_COMM_WORLD, file / "inside", option); }).find("-folder"),
            std::string::npos);
}

TEST(Hdf5, IsWrittenNeitherThroughALinkNorIntoAPipe) {
  for (const std::string kind : {"a link", "a named pipe", "a folder"}) {
    const Folder folder;
    const fs::path path = folder.path / "results.h5", foreign = folder.path / "foreign";
    plant(kind, path, foreign);
    const auto message = errorOf([&] { Hdf5File(PETSC_COMM_WORLD, path, option); });
    EXPECT_EQ(message, "option -folder: " + path.string() + " is " + kind + ", not a regular file");
    EXPECT_EQ(contentOf(foreign), "foreign");
    MPI_Barrier(PETSC_COMM_WORLD);
  }
}

}  // namespace
}  // namespace squeal::fieldfile
