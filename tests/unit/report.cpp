// Field writers: what is read back from the files, by VTK's and PETSc's own readers, is what was given.
#include <gmsh.h>
#include <gtest/gtest.h>
#include <petscviewerhdf5.h>
#include <unistd.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "petsc/check.hpp"
#include "report/hdf5.hpp"
#include "report/vtu.hpp"

namespace squeal::report {
namespace {

namespace fs = std::filesystem;
using mesh::Mesh;
using mesh::Point;

int rankOf(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

int sizeOf(MPI_Comm comm) {
  int size = 1;
  MPI_Comm_size(comm, &size);
  return size;
}

/// A fresh folder that all ranks share, removed at the end of the test.
class Folder {
 public:
  Folder() {
    int id = static_cast<int>(getpid());
    MPI_Bcast(&id, 1, MPI_INT, 0, PETSC_COMM_WORLD);
    path = fs::temp_directory_path() / ("squeal_report_" + std::to_string(id));
    if (rankOf(PETSC_COMM_WORLD) == 0) fs::create_directories(path);
    MPI_Barrier(PETSC_COMM_WORLD);
  }
  ~Folder() {
    MPI_Barrier(PETSC_COMM_WORLD);
    if (rankOf(PETSC_COMM_WORLD) == 0) fs::remove_all(path);
  }
  fs::path path;
};

struct Reference {
  int nodes = 0, dimension = 0;
  std::vector<double> local;  ///< [node][3]
};

Reference gmshReference(int type) {
  std::string name;
  int dimension = 0, order = 0, nodes = 0, corners = 0;
  std::vector<double> given;
  gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodes, given, corners);
  Reference reference{nodes, dimension, std::vector<double>(static_cast<std::size_t>(3 * nodes), 0.0)};
  for (int node = 0; node < nodes; ++node)
    for (int i = 0; i < dimension; ++i)
      reference.local[static_cast<std::size_t>(3 * node + i)] = given[static_cast<std::size_t>(dimension * node + i)];
  return reference;
}

/// gmsh's reference cells span [−1, 1] where VTK's span [0, 1]: all directions of quads and bricks, the third one of wedges.
Point vtkParameters(int type, const Point& local) {
  const std::set<int> quads{3, 10, 16}, bricks{5, 12, 17}, wedges{6, 13, 18};
  Point result = local;
  for (std::size_t i = 0; i < 3; ++i)
    if (bricks.contains(type) || (quads.contains(type) && i < 2) || (wedges.contains(type) && i == 2))
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
    const double* u = &reference.local[static_cast<std::size_t>(3 * node)];
    mesh.globalNode.push_back(mesh.firstNode + node);
    mesh.coordinates.push_back({10.0 * rank + u[0] + 0.11 * u[1] * u[1] + 0.07 * u[1] * u[2],
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

/// A bar along x: a brick of unit length on each rank, the last one made of two wedges; the plane of nodes between two ranks is
/// owned by the lower one. With two ranks each has an element type that the other lacks.
Mesh bar() {
  const int rank = rankOf(PETSC_COMM_WORLD), size = sizeOf(PETSC_COMM_WORLD);
  Mesh mesh;
  mesh.comm = PETSC_COMM_WORLD;
  mesh.totalNodes = 4 * (size + 1);
  mesh.totalCells = size + 1;
  mesh.ownedNodes = rank == 0 ? 8 : 4;
  mesh.firstNode = rank == 0 ? 0 : 4 * (rank + 1);
  const auto addPlane = [&](int plane) {
    for (int corner = 0; corner < 4; ++corner) {
      const int node = 4 * plane + corner;
      mesh.globalNode.push_back(node);
      mesh.coordinates.push_back({double(plane), corner == 1 || corner == 2 ? 1.0 : 0.0, corner / 2 + 1e-12 * node});
      mesh.nodeTag.push_back(100 + node);
      mesh.nodePart.push_back(plane > 0);
    }
  };
  if (rank == 0) addPlane(0);
  addPlane(rank + 1);
  if (rank > 0) addPlane(rank);
  const PetscInt low = rank == 0 ? 0 : 4, high = 4 - low;  // first local node of the two planes of the cell
  if (rank + 1 < size)
    mesh.cells = {{5, 8, {low, low + 1, low + 2, low + 3, high, high + 1, high + 2, high + 3}, {0}, {1000 + rank}}};
  else
    mesh.cells = {{6,
                   6,
                   {low, low + 1, low + 2, high, high + 1, high + 2, low, low + 2, low + 3, high, high + 2, high + 3},
                   {1, 0},
                   {1000 + rank, 1001 + rank}}};
  mesh.parts = 2;
  mesh.bodies = mesh.partName = {"disc", "pad"};
  return mesh;
}

double fieldValue(const Point& x, int component) { return (component + 1) * (x[0] + 2 * x[1] + 4 * x[2]); }

vtkNew<vtkUnstructuredGrid> readVtu(const fs::path& file) {
  vtkNew<vtkXMLPUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkNew<vtkUnstructuredGrid> grid;
  grid->ShallowCopy(reader->GetOutput());
  return grid;
}

class VtuElement : public testing::TestWithParam<int> {};

// Each gmsh node is the VTK node of the same parametric position, and VTK's shape functions make the same curved cell of them.
TEST_P(VtuElement, NodesAndShapeAreThoseOfGmsh) {
  const int type = GetParam();
  const Folder folder;
  const Mesh mesh = curvedCells(type);
  writeVtu(mesh, folder.path / "cells", {});
  const auto grid = readVtu(folder.path / "cells.pvtu");
  const auto reference = gmshReference(type);
  ASSERT_EQ(grid->GetNumberOfCells(), mesh.totalCells);
  auto* tags = grid->GetPointData()->GetArray("node_tag");
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
    vtkCell* cell = grid->GetCell(i);
    ASSERT_EQ(cell->GetNumberOfPoints(), reference.nodes);
    for (vtkIdType node = 0; node < reference.nodes; ++node) {
      const double* local = &reference.local[static_cast<std::size_t>(3 * tags->GetTuple1(cell->GetPointId(node)))];
      const auto expected = vtkParameters(type, {local[0], local[1], local[2]});
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(cell->GetParametricCoords()[3 * static_cast<std::size_t>(node) + c], expected[c], 1e-12) << "VTK node " << node;
    }
    const auto origin = 10.0 * grid->GetCellData()->GetArray("rank")->GetTuple1(i);
    for (const Point& local : {Point{0.2, 0.3, 0.1}, Point{0.5, 0.15, 0.25}, Point{0.1, 0.6, 0.05}}) {
      int components = 0, orientations = 0, part = 0;
      const double w = reference.dimension == 2 ? 0 : local[2];
      std::vector<double> shape;
      gmsh::model::mesh::getBasisFunctions(type, {local[0], local[1], w}, "Lagrange", components, shape, orientations);
      Point expected{origin - 10.0 * rankOf(mesh.comm), 0, 0};
      for (std::size_t node = 0; node < shape.size(); ++node)
        for (std::size_t c = 0; c < 3; ++c) expected[c] += shape[node] * mesh.coordinates[node][c];
      double x[3], weights[27];
      cell->EvaluateLocation(part, vtkParameters(type, {local[0], local[1], w}).data(), x, weights);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(x[c], expected[c], 1e-12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(GmshTypes, VtuElement, testing::Values(2, 3, 4, 5, 6, 9, 10, 11, 12, 13, 16, 17, 18));

TEST(Vtu, HoldsFieldsOfAllRanks) {
  const Folder folder;
  const Mesh mesh = bar();
  Field scalar{"pressure", 1, {}}, vector{"displacement", 3, {}};
  for (const auto& x : mesh.coordinates) {
    scalar.values.push_back(fieldValue(x, 0));
    for (int c = 0; c < 3; ++c) vector.values.push_back(fieldValue(x, c));
  }
  const fs::path stem = folder.path / "steady_0.4";  // the dot is part of the name
  writeVtu(mesh, stem, {scalar, vector});
  EXPECT_TRUE(fs::is_directory(stem));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()), 2);  // steady_0.4.pvtu and the folder

  const auto grid = readVtu(folder.path / "steady_0.4.pvtu");
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
    for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(points->GetArray("displacement")->GetComponent(i, c), fieldValue(x, c));
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

// Names that differ after the last dot only must not share the files of their pieces.
TEST(Vtu, KeepsFilesOfASweepApart) {
  const Folder folder;
  const Mesh mesh = bar();
  for (const double friction : {0.2, 0.4})
    writeVtu(mesh, folder.path / ("steady_" + std::to_string(friction)),
             {{"f", 1, std::vector<double>(mesh.globalNode.size(), friction)}});
  for (const double friction : {0.2, 0.4}) {
    const auto grid = readVtu(folder.path / ("steady_" + std::to_string(friction) + ".pvtu"));
    ASSERT_GT(grid->GetNumberOfPoints(), 0);
    EXPECT_FLOAT_EQ(grid->GetPointData()->GetArray("f")->GetTuple1(0), friction);
  }
}

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
  writeVtu(mesh, folder.path / "x", {{"f", 3, std::vector<double>(3 * mesh.globalNode.size(), 5)}});
  const auto grid = readVtu(folder.path / "x.pvtu");
  EXPECT_EQ(grid->GetNumberOfCells(), std::max(1, size - 1));
  ASSERT_EQ(grid->GetNumberOfPoints(), 27 * std::max(1, size - 1));
  EXPECT_EQ(grid->GetPointData()->GetArray("f")->GetComponent(26, 2), 5);
}

TEST(Vtu, RejectsFieldOfWrongSizeOnAnyRank) {
  const Folder folder;
  const Mesh mesh = bar();
  const std::size_t missing = rankOf(mesh.comm) == sizeOf(mesh.comm) - 1 ? 1 : 0;
  EXPECT_THROW(writeVtu(mesh, folder.path / "x", {{"p", 1, std::vector<double>(mesh.globalNode.size() - missing)}}), Error);
}

TEST(Vtu, RejectsCellTypeWithoutVtkCellOnAnyRank) {
  const Folder folder;
  Mesh mesh = bar();
  if (rankOf(mesh.comm) == sizeOf(mesh.comm) - 1) mesh.cells[0].type = 7;  // pyramid
  EXPECT_THROW(writeVtu(mesh, folder.path / "x", {}), Error);
}

/// The message of the Error that `action` throws; empty if none.
template <class Action>
std::string errorOf(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Report, NamesTheOptionWhereAFileCannotBeMade) {
  const Folder folder;
  const fs::path file = folder.path / "file", inside = file / "inside";  // a file is no folder, for root as well
  if (rankOf(PETSC_COMM_WORLD) == 0) std::ofstream(file) << "x";
  MPI_Barrier(PETSC_COMM_WORLD);
  EXPECT_NE(errorOf([&] { writeVtu(bar(), inside, {}); }).find("-report_dir"), std::string::npos);
  EXPECT_NE(errorOf([&] { writePvd(PETSC_COMM_WORLD, inside, {}); }).find("-report_dir"), std::string::npos);
  EXPECT_NE(errorOf([&] { Hdf5File(PETSC_COMM_WORLD, inside); }).find("-report_dir"), std::string::npos);
  MPI_Barrier(PETSC_COMM_WORLD);
  // the folder of the pieces cannot be made where a file has its name
  EXPECT_NE(errorOf([&] { writeVtu(bar(), file, {}); }).find("-report_dir"), std::string::npos);
}

TEST(Report, AllRanksLearnOfAPieceThatOneCannotWrite) {
  const Folder folder;
  const fs::path piece = folder.path / "x" / ("x_" + std::to_string(sizeOf(PETSC_COMM_WORLD) - 1) + ".vtu");
  if (rankOf(PETSC_COMM_WORLD) == 0) fs::create_directories(piece);  // a folder in the place of the file
  MPI_Barrier(PETSC_COMM_WORLD);
  const auto message = errorOf([&] { writeVtu(bar(), folder.path / "x", {}); });
  EXPECT_NE(message.find("-report_dir"), std::string::npos);
  EXPECT_NE(message.find(piece.string()), std::string::npos) << message;
}

TEST(Pvd, ListsFramesRelativeToItsFolder) {
  const Folder folder;
  writePvd(PETSC_COMM_WORLD, folder.path / "mode.pvd", {{0, folder.path / "mode" / "0.pvtu"}, {0.1, folder.path / "a&b.pvtu"}});
  std::ostringstream text;
  text << std::ifstream(folder.path / "mode.pvd").rdbuf();
  EXPECT_NE(text.str().find("timestep=\"0\" part=\"0\" file=\"mode/0.pvtu\""), std::string::npos) << text.str();
  EXPECT_NE(text.str().find("timestep=\"0.1\" part=\"0\" file=\"a&amp;b.pvtu\""), std::string::npos) << text.str();
}

/// Every rank reads the whole of what all wrote.
class Reader {
 public:
  explicit Reader(const fs::path& path) {
    check(PetscViewerHDF5Open(PETSC_COMM_SELF, path.c_str(), FILE_MODE_READ, viewer_.out()));
  }

  /// Values and number of columns.
  std::pair<std::vector<double>, PetscInt> reals(const char* group, const char* name) {
    OwnedVec vector;
    check(VecCreate(PETSC_COMM_SELF, vector.out()));
    check(PetscObjectSetName(reinterpret_cast<PetscObject>(vector.get()), name));
    check(PetscViewerHDF5PushGroup(viewer_, group));
    check(VecLoad(vector, viewer_));
    check(PetscViewerHDF5PopGroup(viewer_));
    PetscInt size = 0, columns = 0;
    const double* values = nullptr;
    check(VecGetSize(vector, &size));
    check(VecGetBlockSize(vector, &columns));
    check(VecGetArrayRead(vector, &values));
    std::vector<double> copy(values, values + size);
    check(VecRestoreArrayRead(vector, &values));
    return {copy, columns};
  }

  std::pair<std::vector<PetscInt>, PetscInt> integers(const std::string& group, const char* name) {
    OwnedIS set;
    check(ISCreate(PETSC_COMM_SELF, set.out()));
    check(PetscObjectSetName(reinterpret_cast<PetscObject>(set.get()), name));
    check(PetscViewerHDF5PushGroup(viewer_, group.c_str()));
    check(ISLoad(set, viewer_));
    check(PetscViewerHDF5PopGroup(viewer_));
    PetscInt size = 0, columns = 0;
    const PetscInt* values = nullptr;
    check(ISGetSize(set, &size));
    check(ISGetBlockSize(set, &columns));
    check(ISGetIndices(set, &values));
    std::vector<PetscInt> copy(values, values + size);
    check(ISRestoreIndices(set, &values));
    return {copy, columns};
  }

  template <class Value>
  Value attribute(const char* object, const char* name, PetscDataType type) {
    Value value{};
    check(PetscViewerHDF5ReadAttribute(viewer_, object, name, type, nullptr, &value));
    return value;
  }

  std::string text(const char* object, const char* name) {
    char* characters = attribute<char*>(object, name, PETSC_STRING);
    const std::string copy = characters;
    check(PetscFree(characters));
    return copy;
  }

  bool hasGroup(const char* group) {
    PetscBool has = PETSC_FALSE;
    check(PetscViewerHDF5HasGroup(viewer_, group, &has));
    return has;
  }

 private:
  OwnedViewer viewer_;
};

TEST(Hdf5, HoldsTheMeshInGlobalOrder) {
  const Folder folder;
  const Mesh mesh = bar();
  Hdf5File(PETSC_COMM_WORLD, folder.path / "results.h5").writeMesh(mesh);
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
    for (std::size_t i = 0; i < bricks.size(); ++i) EXPECT_EQ(bricks[i], static_cast<PetscInt>(i / 8 * 4 + i % 8));
    EXPECT_EQ(reader.attribute<PetscInt>("/mesh/cells_5", "gmsh_element_type", PETSC_INT), 5);
    EXPECT_EQ(reader.text("/mesh/cells_5", "gmsh_element_name"), "Hexahedron 8");
  }
  const auto [wedges, perWedge] = reader.integers("/mesh/cells_6", "nodes");
  std::vector<PetscInt> expected{0, 1, 2, 4, 5, 6, 0, 2, 3, 4, 6, 7};
  for (auto& node : expected) node += 4 * (size - 1);
  EXPECT_EQ(perWedge, 6);
  EXPECT_EQ(wedges, expected);
  EXPECT_EQ(reader.integers("/mesh/cells_6", "body").first, (std::vector<PetscInt>{1, 0}));
  EXPECT_EQ(reader.integers("/mesh/cells_6", "tag").first, (std::vector<PetscInt>{999 + size, 1000 + size}));
  EXPECT_EQ(reader.attribute<PetscInt>("/mesh/cells_6", "gmsh_element_type", PETSC_INT), 6);
  EXPECT_EQ(reader.attribute<PetscInt>("/mesh", "dimension", PETSC_INT), 3);
  EXPECT_EQ(reader.text("/mesh", "bodies"), "disc,pad");
}

TEST(Hdf5, HoldsNodeVectors) {
  const Folder folder;
  const Mesh mesh = bar();
  OwnedVec u;
  check(VecCreateMPI(mesh.comm, 2 * mesh.ownedNodes, PETSC_DETERMINE, u.out()));
  check(VecSetBlockSize(u, 2));
  check(PetscObjectSetName(reinterpret_cast<PetscObject>(u.get()), "mine"));
  for (PetscInt i = 2 * mesh.firstNode; i < 2 * (mesh.firstNode + mesh.ownedNodes); ++i)
    check(VecSetValue(u, i, 1.0 / (1 + i), INSERT_VALUES));
  check(VecAssemblyBegin(u));
  check(VecAssemblyEnd(u));
  {
    Hdf5File file(mesh.comm, folder.path / "results.h5");
    file.writeNodeVector("/modes", "shape_0001", u);
    file.writeNodeVector("/flutter/friction_0.4", "shape_0001_real", u);
  }
  const char* name = nullptr;
  check(PetscObjectGetName(reinterpret_cast<PetscObject>(u.get()), &name));
  EXPECT_STREQ(name, "mine");

  Reader reader(folder.path / "results.h5");
  for (const auto& [group, dataset] : {std::pair{"/modes", "shape_0001"}, std::pair{"/flutter/friction_0.4", "shape_0001_real"}}) {
    const auto [values, components] = reader.reals(group, dataset);
    EXPECT_EQ(components, 2);
    ASSERT_EQ(values.size(), static_cast<std::size_t>(2 * mesh.totalNodes));
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], 1.0 / (1 + static_cast<double>(i)));
  }
}

TEST(Hdf5, HoldsTablesAndAttributes) {
  const Folder folder;
  const bool first = rankOf(PETSC_COMM_WORLD) == 0;
  using Rows = std::vector<std::vector<double>>;
  {
    Hdf5File file(PETSC_COMM_WORLD, folder.path / "results.h5");
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

}  // namespace
}  // namespace squeal::report
