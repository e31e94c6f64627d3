// SPDX-License-Identifier: BSD-2-Clause
#include "run/fieldfile/hdf5.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/output/file.hpp"
#include "base/petsc/arrays.hpp"
#include "base/petsc/check.hpp"
#include "base/petsc/hdf5.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"
#include "model/element/shape.hpp"
#include "run/fieldfile/hdf5_driver.hpp"

namespace squeal::fieldfile {
namespace {

template <class Number>
hid_t typeOf() {
  if (std::is_floating_point_v<Number>) return H5T_NATIVE_DOUBLE;
  return sizeof(Number) == 4 ? H5T_NATIVE_INT32 : H5T_NATIVE_INT64;
}

/// Returns the object of this name, or a new group if there is none; negative if that fails.
hid_t openOrMake(hid_t file, const std::string& object) {
  for (std::size_t end = object.find('/', 1);; end = object.find('/', end + 1)) {
    const std::string path = object.substr(0, end);
    const auto exists = H5Lexists(file, path.c_str(), H5P_DEFAULT);
    if (exists < 0) return -1;
    if (!exists &&
        !hdf5::GroupId(H5Gcreate2(file, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT))
             .valid())
      return -1;
    if (end == std::string::npos) return H5Oopen(file, path.c_str(), H5P_DEFAULT);
  }
}

/// Throws output::WriteError, on rank 0, if the preceding call of the library was not `done`, or if
/// the driver has recorded an error or refused to open the file.
void require(bool done, const std::filesystem::path& path) {
  if (!done && !refusalReason().empty()) throw output::WriteError(refusalReason());
  if (!done || recordedError() != 0)
    throw output::WriteError(output::cannotWrite(path, recordedError()));
}

/// Writes a table [row][column] in blocks of rows, on one rank. The constructor and write() throw
/// output::WriteError.
class Rows {
 public:
  Rows(hid_t file, const std::filesystem::path& path, const std::string& name, hid_t type,
       hsize_t rows, hsize_t columns)
      : path_(path), type_(type), columns_(columns), dataset_(create(file, name, rows)) {
    require(dataset_.valid(), path_);
  }
  void write(const void* values, hsize_t rows) {
    if (rows == 0) return;
    const SignalsBlocked whole;
    const std::array<hsize_t, 2> begin{done_, 0}, count{rows, columns_};
    const hdf5::SpaceId here(H5Screate_simple(2, count.data(), nullptr)),
        there(H5Dget_space(dataset_));
    H5Sselect_hyperslab(there, H5S_SELECT_SET, begin.data(), nullptr, count.data(), nullptr);
    require(H5Dwrite(dataset_, type_, here, there, H5P_DEFAULT, values) >= 0, path_);
    done_ += rows;
  }

 private:
  hid_t create(hid_t file, const std::string& name, hsize_t rows) const {
    const std::array<hsize_t, 2> shape{rows, columns_};
    const hdf5::SpaceId space(H5Screate_simple(2, shape.data(), nullptr));
    const hdf5::PropertiesId groups(H5Pcreate(H5P_LINK_CREATE));
    H5Pset_create_intermediate_group(groups, 1);
    return H5Dcreate2(file, name.c_str(), type_, space, groups, H5P_DEFAULT, H5P_DEFAULT);
  }
  const std::filesystem::path& path_;
  hid_t type_;
  hsize_t columns_, done_ = 0;
  hdf5::DatasetId dataset_;
};

/// Collective. Passes the rows of all ranks, in rank order and in pieces, to `take(values,
/// entries)` on rank 0.
template <class Number, class Take>
void inTurn(MPI_Comm comm, std::span<const Number> mine, std::size_t columns, const Take& take) {
  const std::size_t most = std::max<std::size_t>(1, (1 << 20) / columns) *
                           columns;  // entries of a piece: some megabytes
  constexpr int tag = 0;
  const auto counts = concatenated(comm, std::vector{mine.size()});
  if (mpi::rank(comm) != 0) {
    while (!mine.empty()) {
      const auto piece = mine.first(std::min(most, mine.size()));
      check(MPI_Send(piece.data(), piece.size_bytes(), MPI_BYTE, 0, tag, comm));
      mine = mine.subspan(piece.size());
    }
    return;
  }
  take(mine.data(), mine.size());
  std::vector<Number> piece(most);
  for (int other = 1; other < std::ssize(counts); ++other)
    for (std::size_t left = counts[other]; left > 0; left -= std::min(most, left)) {
      const std::size_t entries = std::min(most, left);
      check(MPI_Recv(piece.data(), entries * sizeof(Number), MPI_BYTE, other, tag, comm,
                     MPI_STATUS_IGNORE));
      take(piece.data(), entries);
    }
}

/// Collective. Returns the gmsh element types of the whole mesh, ascending: a rank may lack cells
/// of a type that others have.
std::vector<int> elementTypes(const mesh::Mesh& mesh) {
  constexpr int most = 256;  // gmsh's type numbers end at 140
  std::vector<int> present(most, 0);
  for (const auto& block : mesh.cells)
    if (!block.body.empty()) present.at(block.type) = 1;
  mpi::reduce<int>(mesh.comm, present, MPI_MAX);
  std::vector<int> types;
  for (int type = 0; type < most; ++type)
    if (present[type]) types.push_back(type);
  return types;
}

}  // namespace

/// Collective. Calls `action` on rank 0 without messages of the library. Throws Error on all ranks
/// if it returns false or a write has failed.
template <class Action>
void Hdf5File::onFirst(const Action& action) {
  onFirstRank(comm_, head_, [&] {
    const hdf5::Silence silence;
    const SignalsBlocked whole;
    require(action(), path_);
  });
}

Hdf5File::Hdf5File(MPI_Comm comm, const std::filesystem::path& path, const std::string& option)
    : comm_(comm), path_(path), head_("option " + option + ": ") {
  onFirst([&] {
    const hdf5::PropertiesId access(errorRecordingProperties());
    return (file_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access)) >= 0;
  });
}

Hdf5File::~Hdf5File() {
  const hdf5::Silence silence;
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5File::close() {
  onFirst([&] {
    return H5Fflush(file_, H5F_SCOPE_LOCAL) >= 0 && H5Fclose(std::exchange(file_, -1)) >= 0;
  });
}

void Hdf5File::writeMesh(const mesh::Mesh& mesh) {
  const PetscInt owned = mesh.ownedNodes;
  std::vector<double> coordinates;
  for (PetscInt node = 0; node < owned; ++node)
    coordinates.insert(coordinates.end(), mesh.coordinates[node].begin(),
                       mesh.coordinates[node].end());
  writeRows<double>("/mesh", "coordinates", 3, coordinates);
  writeRows<PetscInt>("/mesh", "node_tag", 1, std::span(mesh.nodeTag).first(owned));
  writeRows<int>("/mesh", "node_part", 1, std::span(mesh.nodePart).first(owned));
  writeAttribute("/mesh", "dimension", PetscInt{mesh.dimension});
  writeAttribute("/mesh", "bodies", joined(mesh.bodies, ","));
  if (mesh.hasSections()) {
    std::vector<std::string> materials;
    for (const auto& group : mesh.materialGroups) materials.push_back(group.name);
    writeAttribute("/mesh", "materials", joined(materials, ","));
  }
  writeAttribute("/mesh", "parts", joined(mesh.partName, ","));
  for (int type : elementTypes(mesh)) writeCells(mesh, type);
}

void Hdf5File::writeCells(const mesh::Mesh& mesh, int type) {
  const auto& table = element::shapeTable(type);
  std::vector<PetscInt> nodes, bodies, tags, materials;
  for (const auto& block : mesh.cells) {
    if (block.type != type) continue;
    for (PetscInt node : block.nodes) nodes.push_back(mesh.globalNode[node]);
    bodies.insert(bodies.end(), block.body.begin(), block.body.end());
    tags.insert(tags.end(), block.tag.begin(), block.tag.end());
    materials.insert(materials.end(), block.material.begin(), block.material.end());
  }
  const std::string group = "/mesh/cells_" + std::to_string(type);
  writeRows<PetscInt>(group, "nodes", table.nodes, nodes);
  writeRows<PetscInt>(group, "body", 1, bodies);
  writeRows<PetscInt>(group, "tag", 1, tags);
  if (mesh.hasSections()) writeRows<PetscInt>(group, "material", 1, materials);
  writeAttribute(group, "gmsh_element_type", PetscInt{type});
  writeAttribute(group, "gmsh_element_name", table.gmshName);
}

void Hdf5File::writeNodeVector(const std::string& group, const std::string& name, Vec values) {
  PetscInt components = 1;
  check(VecGetBlockSize(values, &components));
  writeRows<double>(group, name, components, ReadArray(values));
}

void Hdf5File::writeTable(const std::string& group, const std::string& name,
                          const std::vector<std::string>& columns,
                          const std::vector<std::vector<double>>& rows) {
  std::string message;
  std::vector<double> values;
  const int rank = mpi::rank(comm_);
  for (const auto& row : rows) {
    if (row.size() != columns.size())
      message = formatted("table %s: a row of %zu values for %zu columns", name.c_str(), row.size(),
                          columns.size());
    if (rank == 0) values.insert(values.end(), row.begin(), row.end());
  }
  failTogether(comm_, message);
  writeRows<double>(group, name, columns.size(), values);
  writeAttribute(group + "/" + name, "columns", joined(columns, ","));
}

template <class Value>
void Hdf5File::writeValue(const std::string& object, const std::string& name, hid_t type,
                          const Value* value) {
  onFirst([&] {
    const hdf5::ObjectId owner(openOrMake(file_, object));
    const hdf5::SpaceId single(H5Screate(H5S_SCALAR));
    const hdf5::AttributeId attribute(
        owner.valid() ? H5Acreate2(owner, name.c_str(), type, single, H5P_DEFAULT, H5P_DEFAULT)
                      : -1);
    return attribute.valid() && H5Awrite(attribute, type, value) >= 0;
  });
}

void Hdf5File::writeAttribute(const std::string& object, const std::string& name, double value) {
  writeValue(object, name, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5File::writeAttribute(const std::string& object, const std::string& name,
                              const std::string& text) {
  const hdf5::TypeId type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, text.size() + 1);
  writeValue(object, name, type, text.c_str());
}

void Hdf5File::writeAttribute(const std::string& object, const std::string& name, PetscInt value) {
  writeValue(object, name, typeOf<PetscInt>(), &value);
}

template <class Number>
void Hdf5File::writeRows(const std::string& group, const std::string& name, int columns,
                         std::span<const Number> values) {
  const hsize_t total = mpi::sum(comm_, values.size());
  const hsize_t width = columns;
  const hdf5::Silence silence;
  std::optional<Rows> rows;
  onFirstRank(comm_, head_, [&] {
    rows.emplace(file_, path_, group + "/" + name, typeOf<Number>(), total / width, width);
  });
  std::string failure;  // the other ranks send in any case
  inTurn(comm_, values, width, [&](const Number* piece, std::size_t entries) {
    if (failure.empty()) try {
        rows->write(piece, entries / width);
      } catch (const output::WriteError& error) {
        failure = head_ + error.what();
      }
  });
  failTogether(comm_, failure);
}

}  // namespace squeal::fieldfile
