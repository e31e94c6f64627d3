// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The results file holds mesh, fields and tables in one HDF5 file.
#include <hdf5.h>
#include <petscvec.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "model/mesh/mesh.hpp"

namespace squeal::fieldfile {

/// An HDF5 file is open for writing until close(). All methods are collective, and throw Error on
/// all ranks, naming an option, for what cannot be written. Groups are absolute ("/modes") and made
/// when first written to.
///
/// Rank 0 alone writes; the others send it their parts, a piece at a time, so that it never holds
/// more than its own part and a piece. Were each to write its part, a disc that is full for one of
/// them would leave the others waiting inside the library.
class Hdf5File {
 public:
  /// Replaces the file if there is one; the folder must exist. `option`, with its dash, is the one
  /// that names the folder.
  Hdf5File(MPI_Comm comm, const std::filesystem::path& path, const std::string& option);
  /// Closes the file if close() has not, whether or not all of it could be written.
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  /// Writes what the library still keeps in memory, and closes the file.
  void close();

  /// Writes to /mesh `coordinates` [global node][3], `node_tag` and `node_part` [global node], and
  /// the attributes `dimension`, `bodies` and `parts` (names joined by commas). For each gmsh
  /// element type T of the mesh it writes a group cells_T: `nodes` [cell][node] global nodes in
  /// gmsh's order, `body` [cell] index into bodies, `tag` [cell], and the attributes
  /// `gmsh_element_type` and `gmsh_element_name`.
  void writeMesh(const mesh::Mesh& mesh);
  /// Writes a field at the nodes as a dataset [global node][component]. The block size of `values`
  /// is the number of components.
  void writeNodeVector(const std::string& group, const std::string& name, Vec values);
  /// Writes a small table of reals as a dataset [row][column] with the attribute `columns` (names
  /// joined by commas). The rows of rank 0 count.
  void writeTable(const std::string& group, const std::string& name,
                  const std::vector<std::string>& columns,
                  const std::vector<std::vector<double>>& rows);
  /// Writes an attribute of the group or dataset `object`, with the same value on all ranks. A
  /// group is made if there is none.
  void writeAttribute(const std::string& object, const std::string& name, double value);
  void writeAttribute(const std::string& object, const std::string& name, const std::string& text);
  void writeAttribute(const std::string& object, const std::string& name, PetscInt value);

 private:
  template <class Action>
  void onFirst(const Action& action);
  template <class Number>
  void writeRows(const std::string& group, const std::string& name, int columns,
                 std::span<const Number> values);
  template <class Value>
  void writeValue(const std::string& object, const std::string& name, hid_t type,
                  const Value* value);
  void writeCells(const mesh::Mesh& mesh, int type);

  MPI_Comm comm_;
  std::filesystem::path path_;
  std::string head_;  // of messages
  hid_t file_ = -1;   // on rank 0; -1 on the others
};

}  // namespace squeal::fieldfile
