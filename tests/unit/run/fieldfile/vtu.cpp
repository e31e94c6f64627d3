// SPDX-License-Identifier: BSD-2-Clause
// VTU and PVD files: what VTK's own reader finds in them is what was given.
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "run/fieldfile/vtu.hpp"
#include "support/harness/messages.hpp"
#include "support/harness/program.hpp"
#include "support/harness/scratch_folder.hpp"
#include "support/harness/vtu_reader.hpp"
#include "support/model/gmsh_library.hpp"
#include "support/run/bar_mesh.hpp"

namespace squeal::fieldfile {
namespace {

using namespace test;

const std::string option = "-folder";

using mesh::Point;

double fieldValue(const Point& x, int component) {
  return (component + 1) * (x[0] + 2 * x[1] + 4 * x[2]);
}

int filesIn(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

/// Checks that a file holds the whole mesh, and the fields of fieldValue() at all its nodes.
void expectFields(const Mesh& mesh, const fs::path& file) {
  const auto grid = readVtu(file);
  const int size = sizeOf(mesh.comm);
  ASSERT_EQ(grid->GetNumberOfCells(), size + 1);
  ASSERT_EQ(grid->GetNumberOfPoints(), 8 * size);
  auto* points = grid->GetPointData();
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
    Point x;
    grid->GetPoint(i, x.data());
    const auto node = static_cast<int>(points->GetArray("node_tag")->GetTuple1(i)) - 100;
    EXPECT_EQ(x[0], node / 4);
    EXPECT_EQ(x[2], node % 4 / 2 + 1e-12 * node);  // coordinates in double precision
    EXPECT_EQ(points->GetArray("part")->GetTuple1(i), x[0] > 0);
    EXPECT_FLOAT_EQ(points->GetArray("pressure")->GetTuple1(i), fieldValue(x, 0));
    for (int c = 0; c < 3; ++c)
      EXPECT_FLOAT_EQ(points->GetArray("displacement")->GetComponent(i, c), fieldValue(x, c));
  }
  auto* cells = grid->GetCellData();
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
    EXPECT_EQ(cells->GetArray("rank")->GetTuple1(i), std::min<vtkIdType>(i, size - 1));
    EXPECT_EQ(cells->GetArray("body")->GetTuple1(i), i == size - 1);
    double box[6];
    grid->GetCellBounds(i, box);
    EXPECT_EQ(box[0], std::min<vtkIdType>(i, size - 1));
    EXPECT_EQ(box[1], box[0] + 1);
  }
}

TEST(Vtu, HoldsFieldsOfAllRanks) {
  const Folder folder;
  const Mesh mesh = bar();
  Field scalar{"pressure", 1, {}}, vector{"displacement", 3, {}};
  for (const auto& x : mesh.coordinates) {
    scalar.values.push_back(fieldValue(x, 0));
    for (int c = 0; c < 3; ++c) vector.values.push_back(fieldValue(x, c));
  }
  const fs::path stem = folder.path / "steady_0.4";  // the dot is part of the name
  writeVtu(mesh, stem, {scalar, vector}, option);
  EXPECT_TRUE(fs::is_directory(stem));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()),
            2);  // steady_0.4.pvtu and the folder
  expectFields(mesh, folder.path / "steady_0.4.pvtu");
  EXPECT_EQ(filesIn(stem), sizeOf(mesh.comm));
  const fs::path together = folder.path / "together";
  writeVtu(mesh, together, {scalar, vector}, option, 1);
  expectFields(mesh, folder.path / "together.pvtu");
  EXPECT_EQ(filesIn(together), 1);
}

// The wedges are sections of the pad; a mesh without sections has no such field.
TEST(Vtu, HoldsTheMaterialsOfSections) {
  const Folder folder;
  const Mesh mesh = sectionedBar();
  writeVtu(mesh, folder.path / "sections", {}, option);
  const auto grid = readVtu(folder.path / "sections.pvtu");
  auto* cells = grid->GetCellData();
  ASSERT_TRUE(cells->GetArray("material"));
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
    const int fromTheEnd = grid->GetNumberOfCells() - 1 - i;
    EXPECT_EQ(cells->GetArray("material")->GetTuple1(i), fromTheEnd < 2 ? 2 - fromTheEnd : 0);
  }
  writeVtu(bar(), folder.path / "bodies", {}, option);
  EXPECT_FALSE(readVtu(folder.path / "bodies.pvtu")->GetCellData()->GetArray("material"));
}

TEST(Vtu, HoldsFieldsOfCells) {
  const Folder folder;
  const Mesh mesh = bar();
  Field field{"axis", 3, {}};
  for (const auto& block : mesh.cells)
    for (const PetscInt tag : block.tag)
      for (int c = 0; c < 3; ++c) field.values.push_back(tag + 0.25 * c);
  writeVtu(mesh, folder.path / "cells", {}, option, 8, {field});
  const auto grid = readVtu(folder.path / "cells.pvtu");
  auto* found = grid->GetCellData()->GetArray("axis");
  ASSERT_TRUE(found);
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(found->GetComponent(i, c), 1000 + i + 0.25 * c);
  field.values.pop_back();
  EXPECT_TRUE(contains(
      errorOf([&] { writeVtu(mesh, folder.path / "few", {}, option, 8, {field}); }), "field axis"));
}

// Names that differ after the last dot only must not share the files of their pieces.
TEST(Vtu, KeepsFilesOfASweepApart) {
  const Folder folder;
  const Mesh mesh = bar();
  for (const double friction : {0.2, 0.4})
    writeVtu(mesh, folder.path / ("steady_" + std::to_string(friction)),
             {{"f", 1, std::vector<double>(mesh.globalNode.size(), friction)}}, option);
  for (const double friction : {0.2, 0.4}) {
    const auto grid = readVtu(folder.path / ("steady_" + std::to_string(friction) + ".pvtu"));
    ASSERT_GT(grid->GetNumberOfPoints(), 0);
    EXPECT_FLOAT_EQ(grid->GetPointData()->GetArray("f")->GetTuple1(0), friction);
  }
}

struct Reference {
  int nodes = 0, dimension = 0;
  std::vector<double> local;  ///< [node][3]
};

Reference gmshReference(int type) {
  test::startGmsh();
  std::string name;
  int dimension = 0, order = 0, nodes = 0, corners = 0;
  std::vector<double> given;
  gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodes, given, corners);
  Reference reference{nodes, dimension,
                      std::vector<double>(static_cast<std::size_t>(3 * nodes), 0.0)};
  for (int node = 0; node < nodes; ++node)
    for (int i = 0; i < dimension; ++i) reference.local[3 * node + i] = given[dimension * node + i];
  return reference;
}

const std::set<int> pyramids{7, 14, 19};

/// gmsh's reference cells span [−1, 1] where VTK's span [0, 1]: all directions of quads and bricks,
/// the third one of wedges.
Point vtkParameters(int type, const Point& local) {
  const std::set<int> quads{3, 10, 16}, bricks{5, 12, 17}, wedges{6, 13, 18};
  Point result = local;
  if (pyramids.contains(type)) {  // VTK's are those of the cube that collapses to the pyramid
    const double half = 1 - local[2];
    if (half == 0) return {0, 0, 1};  // all the upper face of the cube
    return {(1 + local[0] / half) / 2, (1 + local[1] / half) / 2, local[2]};
  }
  for (std::size_t i = 0; i < 3; ++i)
    if (bricks.contains(type) || (quads.contains(type) && i < 2) ||
        (wedges.contains(type) && i == 2))
      result[i] = (1 + local[i]) / 2;
  return result;
}

/// A curved cell on each rank, apart from those of the others: no two nodes lie symmetrically.
Mesh curvedCells(int type) {
  const auto reference = gmshReference(type);
  const int rank = rankOf(PETSC_COMM_WORLD);
  Mesh mesh;
  mesh.comm = PETSC_COMM_WORLD;
  mesh.dimension = reference.dimension;
  mesh.totalCells = sizeOf(mesh.comm);
  mesh.totalNodes = reference.nodes * mesh.totalCells;
  mesh.ownedNodes = reference.nodes;
  mesh.firstNode = rank * reference.nodes;
  mesh::CellBlock block{type, reference.nodes, {}, {0}, {1 + rank}};
  for (int node = 0; node < reference.nodes; ++node) {
    const double* u = &reference.local[3 * node];
    mesh.globalNode.push_back(mesh.firstNode + node);
    mesh.coordinates.push_back(
        {10.0 * rank + u[0] + 0.11 * u[1] * u[1] + 0.07 * u[1] * u[2],
         u[1] + 0.13 * u[0] * u[0] - 0.05 * u[2],
         reference.dimension == 2 ? 0 : u[2] + 0.09 * u[0] * u[1] + 0.06 * u[0]});
    mesh.nodeTag.push_back(node);  // the node's place in gmsh's order, to know it again in the file
    mesh.nodePart.push_back(0);
    block.nodes.push_back(node);
  }
  mesh.parts = 1;
  mesh.bodies = mesh.partName = {"disc"};
  mesh.cells = {block};
  return mesh;
}

class VtuElement : public testing::TestWithParam<int> {};

// Each gmsh node is the VTK node of the same parametric position, and VTK's shape functions make
// the same curved cell of them.
TEST_P(VtuElement, NodesAndShapeAreThoseOfGmsh) {
  const int type = GetParam();
  const Folder folder;
  const Mesh mesh = curvedCells(type);
  writeVtu(mesh, folder.path / "cells", {}, option);
  const auto grid = readVtu(folder.path / "cells.pvtu");
  const auto reference = gmshReference(type);
  ASSERT_EQ(grid->GetNumberOfCells(), mesh.totalCells);
  auto* tags = grid->GetPointData()->GetArray("node_tag");
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
    vtkCell* cell = grid->GetCell(i);
    const vtkIdType nodes =
        type == 14 ? 13 : reference.nodes;  // the middle of its base is left out
    ASSERT_EQ(cell->GetNumberOfPoints(), nodes);
    for (vtkIdType node = 0; node < nodes; ++node) {
      const double* local = &reference.local[3 * tags->GetTuple1(cell->GetPointId(node))];
      const auto expected = vtkParameters(type, {local[0], local[1], local[2]});
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(cell->GetParametricCoords()[3 * static_cast<std::size_t>(node) + c],
                    expected[c], 1e-12)
            << "VTK node " << node;
    }
    if (type == 14 || type == 19) continue;  // between its nodes VTK's pyramid is another one
    const auto origin = 10.0 * grid->GetCellData()->GetArray("rank")->GetTuple1(i);
    for (const Point& local :
         {Point{0.2, 0.3, 0.1}, Point{0.5, 0.15, 0.25}, Point{0.1, 0.6, 0.05}}) {
      int components = 0, orientations = 0, part = 0;
      const double w = reference.dimension == 2 ? 0 : local[2];
      std::vector<double> shape;
      gmsh::model::mesh::getBasisFunctions(type, {local[0], local[1], w}, "Lagrange", components,
                                           shape, orientations);
      Point expected{origin - 10.0 * rankOf(mesh.comm), 0, 0};
      for (std::size_t node = 0; node < shape.size(); ++node)
        for (std::size_t c = 0; c < 3; ++c) expected[c] += shape[node] * mesh.coordinates[node][c];
      double x[3], weights[27];
      cell->EvaluateLocation(part, vtkParameters(type, {local[0], local[1], w}).data(), x, weights);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(x[c], expected[c], 1e-12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(GmshTypes, VtuElement,
                         testing::Values(2, 3, 4, 5, 6, 7, 9, 10, 11, 12, 13, 14, 16, 17, 18, 19));

// More ranks than a small mesh has parts: the last one has nothing.
TEST(Vtu, WritesRanksWithoutCells) {
  const Folder folder;
  const int size = sizeOf(PETSC_COMM_WORLD);
  Mesh mesh = curvedCells(12);
  const bool empty = size > 1 && rankOf(mesh.comm) == 0;
  if (empty) {
    mesh = Mesh();
    mesh.comm = PETSC_COMM_WORLD;
  }
  writeVtu(mesh, folder.path / "x", {{"f", 3, std::vector<double>(3 * mesh.globalNode.size(), 5)}},
           option);
  const auto grid = readVtu(folder.path / "x.pvtu");
  EXPECT_EQ(grid->GetNumberOfCells(), std::max(1, size - 1));
  ASSERT_EQ(grid->GetNumberOfPoints(), 27 * std::max(1, size - 1));
  EXPECT_EQ(grid->GetPointData()->GetArray("f")->GetComponent(26, 2), 5);
}

TEST(Vtu, RejectsFieldOfWrongSizeOnAnyRank) {
  const Folder folder;
  const Mesh mesh = bar();
  const std::size_t missing = rankOf(mesh.comm) == sizeOf(mesh.comm) - 1 ? 1 : 0;
  EXPECT_THROW(writeVtu(mesh, folder.path / "x",
                        {{"p", 1, std::vector<double>(mesh.globalNode.size() - missing)}}, option),
               Error);
}

TEST(Vtu, RejectsCellTypeWithoutVtkCellOnAnyRank) {
  const Folder folder;
  Mesh mesh = bar();
  if (rankOf(mesh.comm) == sizeOf(mesh.comm) - 1) mesh.cells[0].type = 29;  // tet20
  EXPECT_THROW(writeVtu(mesh, folder.path / "x", {}, option), Error);
}
TEST(Vtu, NamesTheOptionWhereAFileCannotBeMade) {
  const Folder folder;
  const fs::path file = folder.path / "file",
                 inside = file / "inside";  // a file is not a folder, even for root
  if (rankOf(PETSC_COMM_WORLD) == 0) std::ofstream(file) << "x";
  MPI_Barrier(PETSC_COMM_WORLD);
  EXPECT_NE(errorOf([&] { writeVtu(bar(), inside, {}, option); }).find("-folder"),
            std::string::npos);
  EXPECT_NE(errorOf([&] { writePvd(PETSC_COMM_WORLD, inside, {}, option); }).find("-folder"),
            std::string::npos);
  MPI_Barrier(PETSC_COMM_WORLD);
  // the folder of the pieces cannot be made where a file has its name
  EXPECT_NE(errorOf([&] { writeVtu(bar(), file, {}, option); }).find("-folder"), std::string::npos);
}

TEST(Vtu, AllRanksLearnOfAPieceThatOneCannotWrite) {
  const Folder folder;
  const fs::path piece =
      folder.path / "x" / ("x_" + std::to_string(sizeOf(PETSC_COMM_WORLD) - 1) + ".vtu");
  if (rankOf(PETSC_COMM_WORLD) == 0)
    fs::create_directories(piece);  // a folder in the place of the file
  MPI_Barrier(PETSC_COMM_WORLD);
  const auto message = errorOf([&] { writeVtu(bar(), folder.path / "x", {}, option); });
  EXPECT_NE(message.find("-folder"), std::string::npos);
  EXPECT_NE(message.find(piece.string()), std::string::npos) << message;
}

TEST(Vtu, IsWrittenNeitherThroughALinkNorIntoAPipe) {
  for (const std::string kind : {"a link", "a named pipe", "a folder"}) {
    for (const bool ofPiece : {true, false}) {
      const Folder folder;
      const fs::path path = folder.path / (ofPiece ? "x/x_0.vtu" : "x.pvtu"),
                     foreign = folder.path / "foreign";
      if (rankOf(PETSC_COMM_WORLD) == 0) fs::create_directories(path.parent_path());
      plant(kind, path, foreign);
      const auto message = errorOf([&] { writeVtu(bar(), folder.path / "x", {}, option); });
      EXPECT_EQ(message,
                "option -folder: " + path.string() + " is " + kind + ", not a regular file");
      EXPECT_EQ(contentOf(foreign), "foreign");
      MPI_Barrier(PETSC_COMM_WORLD);
    }
  }
}

TEST(Pvd, ListsFramesRelativeToItsFolder) {
  const Folder folder;
  writePvd(PETSC_COMM_WORLD, folder.path / "mode.pvd",
           {{0, folder.path / "mode" / "0.pvtu"}, {0.1, folder.path / "a&b.pvtu"}}, option);
  std::ostringstream text;
  text << std::ifstream(folder.path / "mode.pvd").rdbuf();
  EXPECT_NE(text.str().find("timestep=\"0\" part=\"0\" file=\"mode/0.pvtu\""), std::string::npos)
      << text.str();
  EXPECT_NE(text.str().find("timestep=\"0.1\" part=\"0\" file=\"a&amp;b.pvtu\""), std::string::npos)
      << text.str();
}

}  // namespace
}  // namespace squeal::fieldfile
