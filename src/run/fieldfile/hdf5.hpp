// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The results file: mesh, fields and tables in one HDF5 file.
#include <hdf5.h>
#include <petscvec.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "model/mesh/mesh.hpp"

namespace squeal::fieldfile {

/// An HDF5 file that is open for writing until close(). All methods are collective, and throw Error
/// on all ranks, naming an option, if writing fails. Groups have absolute names ("/modes") and are
/// created on first use.
///
/// Only rank 0 writes. The other ranks send it their parts in pieces, so rank 0 never stores more
/// than its own part and one piece. If each rank wrote its own part, a full disk on one rank would
/// leave the others waiting inside the library.
class Hdf5File {
 public:
  /// Replaces an existing file; the folder must exist. `option`, with its dash, names the folder.
  Hdf5File(MPI_Comm comm, const std::filesystem::path& path, const std::string& option);
  /// Closes the file if it is still open, even if its content is incomplete.
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  /// Flushes the buffers of the library and closes the file.
  void close();

  /// Writes to /mesh `coordinates` [global node][3], `node_tag` and `node_part` [global node], and
  /// the attributes `dimension`, `bodies` and `parts` (names joined by commas). For each gmsh
  /// element type T of the mesh it writes a group cells_T: `nodes` [cell][node] global nodes in
  /// gmsh's order, `body` [cell] index into bodies, `tag` [cell], and the attributes
  /// `gmsh_element_type` and `gmsh_element_name`.
  void writeMesh(const mesh::Mesh& mesh);
  /// Writes a field at the nodes as a dataset [global node][component]. The block size of the
  /// vector `values` is the number of components.
  void writeNodeVector(const std::string& group, const std::string& name, Vec values);
  /// Writes a small table of reals as a dataset [row][column] with the attribute `columns` (names
  /// joined by commas). Only the rows on rank 0 are used.
  void writeTable(const std::string& group, const std::string& name,
                  const std::vector<std::string>& columns,
                  const std::vector<std::vector<double>>& rows);
  /// Writes an attribute of the group or dataset `object`. The value must be the same on all ranks.
  /// Creates the group if it does not exist.
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
