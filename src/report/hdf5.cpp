#include "report/hdf5.hpp"

#include <gmsh.h>
#include <petscviewerhdf5.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "petsc/check.hpp"
#include "petsc/text.hpp"

namespace squeal::report {
namespace {

/// Collective. HDF5 would end the run with its own error stack: rank 0 tries first whether the file can be made.
void requireWritable(MPI_Comm comm, const std::filesystem::path& path) {
  int rank = 0;
  check(MPI_Comm_rank(comm, &rank));
  std::string message;
  errno = 0;
  if (rank == 0 && !std::ofstream(path, std::ios::trunc))
    message = "option -report_dir: cannot write " + path.string() + ": " + std::generic_category().message(errno);
  failTogether(comm, message);
}

/// Datasets written while it lives go into `group`.
class InGroup {
 public:
  InGroup(PetscViewer viewer, const std::string& group) : viewer_(viewer) {
    check(PetscViewerHDF5PushGroup(viewer, group.c_str()));
  }
  ~InGroup() { check(PetscViewerHDF5PopGroup(viewer_)); }
  InGroup(const InGroup&) = delete;
  InGroup& operator=(const InGroup&) = delete;

 private:
  PetscViewer viewer_;
};

/// Collective. The gmsh element types of the whole mesh, ascending: a rank may lack cells of a type that others have.
std::vector<int> elementTypes(const mesh::Mesh& mesh) {
  constexpr int most = 256;  // gmsh's type numbers end at 140
  std::vector<int> present(most, 0);
  for (const auto& block : mesh.cells)
    if (!block.body.empty()) present.at(static_cast<std::size_t>(block.type)) = 1;
  check(MPI_Allreduce(MPI_IN_PLACE, present.data(), most, MPI_INT, MPI_MAX, mesh.comm));
  std::vector<int> types;
  for (int type = 0; type < most; ++type)
    if (present[static_cast<std::size_t>(type)]) types.push_back(type);
  return types;
}

}  // namespace

Hdf5File::Hdf5File(MPI_Comm comm, const std::filesystem::path& path) : comm_(comm) {
  requireWritable(comm, path);
  check(PetscViewerHDF5Open(comm, path.c_str(), FILE_MODE_WRITE, viewer_.out()));
  // a dataset keeps its two dimensions where there is one component or column
  check(PetscViewerHDF5SetBaseDimension2(viewer_, PETSC_TRUE));
  check(PetscViewerHDF5SetCollective(viewer_, PETSC_TRUE));
}

void Hdf5File::writeMesh(const mesh::Mesh& mesh) {
  const auto owned = static_cast<std::size_t>(mesh.ownedNodes);
  std::vector<double> coordinates;
  for (std::size_t node = 0; node < owned; ++node)
    coordinates.insert(coordinates.end(), mesh.coordinates[node].begin(), mesh.coordinates[node].end());
  writeReals("/mesh", "coordinates", 3, coordinates);
  writeIntegers("/mesh", "node_tag", 1, {mesh.nodeTag.begin(), mesh.nodeTag.begin() + mesh.ownedNodes});
  writeIntegers("/mesh", "node_part", 1, {mesh.nodePart.begin(), mesh.nodePart.begin() + mesh.ownedNodes});
  writeInteger("/mesh", "dimension", mesh.dimension);
  writeAttribute("/mesh", "bodies", joined(mesh.bodies, ","));
  writeAttribute("/mesh", "parts", joined(mesh.partName, ","));
  for (int type : elementTypes(mesh)) writeCells(mesh, type);
}

void Hdf5File::writeCells(const mesh::Mesh& mesh, int type) {
  std::string name;
  int dimension = 0, order = 0, nodesPerCell = 0, corners = 0;
  std::vector<double> localCoordinates;
  gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodesPerCell, localCoordinates, corners);

  std::vector<PetscInt> nodes, bodies, tags;
  for (const auto& block : mesh.cells) {
    if (block.type != type) continue;
    for (PetscInt node : block.nodes) nodes.push_back(mesh.globalNode[static_cast<std::size_t>(node)]);
    bodies.insert(bodies.end(), block.body.begin(), block.body.end());
    tags.insert(tags.end(), block.tag.begin(), block.tag.end());
  }
  const std::string group = "/mesh/cells_" + std::to_string(type);
  writeIntegers(group, "nodes", nodesPerCell, nodes);
  writeIntegers(group, "body", 1, bodies);
  writeIntegers(group, "tag", 1, tags);
  writeInteger(group, "gmsh_element_type", type);
  writeAttribute(group, "gmsh_element_name", name);
}

void Hdf5File::writeNodeVector(const std::string& group, const std::string& name, Vec values) {
  PetscInt components = 1, localSize = 0;
  check(VecGetBlockSize(values, &components));
  check(VecGetLocalSize(values, &localSize));
  const PetscScalar* array = nullptr;
  check(VecGetArrayRead(values, &array));
  {
    // The dataset takes its name from the vector: a view of the same array is named, so that the caller's keeps its own.
    OwnedVec view;
    check(VecCreateMPIWithArray(comm_, components, localSize, PETSC_DETERMINE, array, view.out()));
    check(PetscObjectSetName(reinterpret_cast<PetscObject>(view.get()), name.c_str()));
    const InGroup inside(viewer_, group);
    check(VecView(view, viewer_));
  }
  check(VecRestoreArrayRead(values, &array));
}

void Hdf5File::writeTable(const std::string& group, const std::string& name, const std::vector<std::string>& columns,
                          const std::vector<std::vector<double>>& rows) {
  std::string message;
  std::vector<double> values;
  for (const auto& row : rows) {
    if (row.size() != columns.size())
      message = formatted("table %s: a row of %zu values for %zu columns", name.c_str(), row.size(), columns.size());
    values.insert(values.end(), row.begin(), row.end());
  }
  failTogether(comm_, message);
  writeReals(group, name, static_cast<int>(columns.size()), values);
  writeAttribute(group + "/" + name, "columns", joined(columns, ","));
}

void Hdf5File::writeAttribute(const std::string& object, const std::string& name, double value) {
  check(PetscViewerHDF5WriteAttribute(viewer_, object.c_str(), name.c_str(), PETSC_DOUBLE, &value));
}

void Hdf5File::writeAttribute(const std::string& object, const std::string& name, const std::string& text) {
  check(PetscViewerHDF5WriteAttribute(viewer_, object.c_str(), name.c_str(), PETSC_STRING, text.c_str()));
}

void Hdf5File::writeInteger(const std::string& object, const std::string& name, PetscInt value) {
  check(PetscViewerHDF5WriteAttribute(viewer_, object.c_str(), name.c_str(), PETSC_INT, &value));
}

void Hdf5File::writeReals(const std::string& group, const std::string& name, int components, const std::vector<double>& values) {
  OwnedVec vector;
  check(
      VecCreateMPIWithArray(comm_, components, static_cast<PetscInt>(values.size()), PETSC_DETERMINE, values.data(), vector.out()));
  writeNodeVector(group, name, vector);
}

void Hdf5File::writeIntegers(const std::string& group, const std::string& name, int components,
                             const std::vector<PetscInt>& values) {
  OwnedIS set;
  check(ISCreateGeneral(comm_, static_cast<PetscInt>(values.size()), values.data(), PETSC_USE_POINTER, set.out()));
  check(ISSetBlockSize(set, components));
  check(PetscObjectSetName(reinterpret_cast<PetscObject>(set.get()), name.c_str()));
  const InGroup inside(viewer_, group);
  check(ISView(set, viewer_));
}

}  // namespace squeal::report
