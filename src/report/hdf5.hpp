#pragma once
/// The results file: mesh, fields and tables in one HDF5 file, each rank writing its part.
#include <petscvec.h>

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "petsc/owned.hpp"

namespace squeal::report {

/// An HDF5 file open for writing; closed by the destructor. All methods are collective. Groups are absolute ("/modes") and made
/// when first written to.
class Hdf5File {
 public:
  /// Replaces the file if there is one; the folder must exist. Errors (all ranks): a file that cannot be made, naming -report_dir.
  Hdf5File(MPI_Comm comm, const std::filesystem::path& path);

  /// /mesh: `coordinates` [global node][3], `node_tag` and `node_part` [global node], attributes `dimension`, `bodies` and `parts`
  /// (names joined by commas). For each gmsh element type T of the mesh a group cells_T: `nodes` [cell][node] global nodes in
  /// gmsh's order, `body` [cell] index into bodies, `tag` [cell], attributes `gmsh_element_type` and `gmsh_element_name`.
  void writeMesh(const mesh::Mesh& mesh);
  /// A field at the nodes: dataset [global node][component]; the block size of `values` is the number of components.
  void writeNodeVector(const std::string& group, const std::string& name, Vec values);
  /// A small table of reals: dataset [row][column] with attribute `columns` (names joined by commas). Rank 0 passes the rows, the
  /// others none.
  void writeTable(const std::string& group, const std::string& name, const std::vector<std::string>& columns,
                  const std::vector<std::vector<double>>& rows);
  /// An attribute of the group or dataset `object`; the same value on all ranks.
  void writeAttribute(const std::string& object, const std::string& name, double value);
  void writeAttribute(const std::string& object, const std::string& name, const std::string& text);

 private:
  void writeReals(const std::string& group, const std::string& name, int components, const std::vector<double>& values);
  void writeIntegers(const std::string& group, const std::string& name, int components, const std::vector<PetscInt>& values);
  void writeInteger(const std::string& object, const std::string& name, PetscInt value);
  void writeCells(const mesh::Mesh& mesh, int type);

  MPI_Comm comm_;
  OwnedViewer viewer_;
};

}  // namespace squeal::report
