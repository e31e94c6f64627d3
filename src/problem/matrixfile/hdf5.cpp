// SPDX-License-Identifier: BSD-2-Clause
#include "problem/matrixfile/hdf5.hpp"

#include <algorithm>
#include <optional>
#include <tuple>

#include "base/petsc/check.hpp"
#include "base/system/child.hpp"
#include "base/system/process_memory.hpp"
#include "base/system/stream.hpp"
#include "base/system/text.hpp"
#include "problem/matrixfile/hdf5_file.hpp"

namespace squeal::matrixfile {
namespace {

bool isGroup(hid_t object) { return H5Iget_type(object) == H5I_GROUP; }

bool isCompressed(hid_t object) {
  return isGroup(object) && has(object, "data") && has(object, "indices") && has(object, "indptr");
}

/// Returns the class attribute of MATLAB 7.3 variables; empty in other files.
std::string matlabClass(hid_t object) { return textOfAttribute(object, "MATLAB_class"); }
bool isMatlabSparse(hid_t object) {
  return isGroup(object) && has(object, "jc") && hasAttribute(object, "MATLAB_sparse");
}

bool isTable(hid_t object) {
  if (H5Iget_type(object) != H5I_DATASET || shapeOf(object).size() != 2) return false;
  const TypeId type(H5Dget_type(object));
  const auto kind = H5Tget_class(type);
  const std::string matlab = matlabClass(object);
  return (kind == H5T_FLOAT || kind == H5T_INTEGER) && !hasAttribute(object, "MATLAB_empty") &&
         (matlab.empty() || matlab == "double" || matlab == "single");
}

bool isMatrix(hid_t object) {
  return isCompressed(object) || isMatlabSparse(object) || isTable(object);
}

/// Returns true for a single number. MATLAB saves every number as a matrix; if there is a larger
/// matrix, numbers do not count.
bool isNumber(hid_t object) {
  return isTable(object) && shapeOf(object) == std::vector<hsize_t>{1, 1};
}

/// Returns true for lists by columns and false for lists by rows; none if the group does not define
/// it. scipy.sparse.save_npz, and copies of its files in HDF5, store the format as a dataset.
std::optional<bool> byColumns(hid_t group) {
  std::string found;
  for (const std::string& text :
       {textOfAttribute(group, "format"), textOfAttribute(group, "h5sparse_format"),
        textOfAttribute(group, "encoding-type"), textOfDataset(group, "format")}) {
    if (text.empty()) continue;
    const std::string format = text.substr(0, 3);
    if (format != "csr" && format != "csc")
      throw Error("the format '" + text + "' is not supported; use csr or csc");
    if (!found.empty() && found != format) throw Error("the group is marked as both csr and csc");
    found = format;
  }
  return found.empty() ? std::nullopt : std::optional(found == "csc");
}

/// Returns true if the matrix is symmetric. The same lists, read by rows and by columns, are a
/// matrix and its transpose.
bool isSymmetric(const Entries& entries) {
  using Sum = std::tuple<PetscInt, PetscInt, double>;
  const auto sums = [&](const auto& major, const auto& minor) {
    std::vector<Sum> all, summed;
    all.reserve(entries.value.size());
    for (std::size_t k = 0; k < entries.value.size(); ++k)
      all.emplace_back(major[k], minor[k], entries.value[k]);
    const auto place = [](const Sum& sum) { return std::pair(std::get<0>(sum), std::get<1>(sum)); };
    std::stable_sort(all.begin(), all.end(),
                     [&](const Sum& a, const Sum& b) { return place(a) < place(b); });
    for (const auto& entry : all)
      if (!summed.empty() && place(summed.back()) == place(entry))
        std::get<2>(summed.back()) += std::get<2>(entry);
      else
        summed.push_back(entry);
    return summed;
  };
  return sums(entries.row, entries.column) == sums(entries.column, entries.row);
}

/// Throws Error if the stored numbers of rows and columns, if any, differ from `size`: the
/// attribute of anndata or h5sparse, or the dataset of scipy.sparse.save_npz.
void checkShape(hid_t group, long long size) {
  std::vector<long long> shape;
  for (const char* name : {"shape", "h5sparse_shape"})
    if (shape.empty()) shape = integersOfAttribute(group, name);
  if (shape.empty() && has(group, "shape")) shape = integers(group, "shape");
  if (shape.empty()) return;
  if (shape.size() != 2) throw Error(formatted("a shape of %zu numbers", shape.size()));
  requireSquare(shape[0], shape[1]);
  if (shape[0] != size)
    throw Error(formatted("indptr has %lld numbers where a matrix of %lld rows takes %lld",
                          size + 1, shape[0], shape[0] + 1));
}

Entries compressedGroup(hid_t group) {
  Compressed matrix;
  const auto said = byColumns(group);
  matrix.byColumns = said.value_or(false);
  matrix.begin = integers(group, "indptr");
  if (matrix.begin.empty()) throw Error("indptr is empty");
  matrix.rows = matrix.columns = std::ssize(matrix.begin) - 1;  // a square matrix
  checkShape(group, matrix.rows);
  matrix.index = integers(group, "indices");
  matrix.value = reals(group, "data");
  Entries entries = matrix.entries();
  if (!said && !isSymmetric(entries))
    throw Error(
        "the group does not define whether its lists are by rows or by columns, and the matrix is "
        "not symmetric: add the attribute 'format' (or 'h5sparse_format', 'encoding-type') "
        "with the text csr or csc");
  return entries;
}

/// Returns the entries of a sparse matrix of MATLAB 7.3. A matrix without entries has no lists.
Entries matlabSparse(hid_t group) {
  Compressed matrix{0, 0, true, {}, {}, {}, "jc", "ir"};
  const auto rows = integersOfAttribute(group, "MATLAB_sparse");
  if (rows.size() != 1) throw Error("the attribute MATLAB_sparse is damaged");
  if (const std::string type = matlabClass(group); type != "double")
    throw Error("a sparse matrix of class '" + type + "', not double");
  matrix.begin = integers(group, "jc");
  if (matrix.begin.empty()) throw Error("jc is empty");
  matrix.rows = rows[0];
  matrix.columns = std::ssize(matrix.begin) - 1;
  requireSquare(matrix.rows, matrix.columns);
  if (matrix.begin.back() > 0) {
    matrix.index = integers(group, "ir");
    matrix.value = reals(group, "data");
    matrix.dropFree();
  }
  return matrix.entries();
}

/// Returns the entries of a two-dimensional dataset, stored by rows or, in MATLAB files, by
/// columns.
Entries table(hid_t file, hid_t dataset, const std::string& name) {
  const auto shape = shapeOf(dataset);
  if (shape[0] > LLONG_MAX || shape[1] > LLONG_MAX) throw Error("its sizes exceed 64 bits");
  requireSquare(shape[0], shape[1]);
  const bool transposed = !matlabClass(dataset).empty();
  const auto values = reals(file, name, 2);
  const long long size = shape[0];
  Entries entries(size, size);
  for (long long i = 0, k = 0; i < size; ++i)
    for (long long j = 0; j < size; ++j, ++k)
      entries.add(transposed ? j : i, transposed ? i : j, values[k]);
  return entries;
}

std::vector<std::string> namesIn(hid_t group) {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  if (H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names) < 0)
    throw Error("the HDF5 library reports a damaged file" + cause());
  return names;
}

std::string onlyMatrix(hid_t file) {
  const ObjectId root(H5Oopen(file, "/", H5P_DEFAULT));
  if (isCompressed(root)) return "/";
  std::vector<std::string> matrices, numbers;
  for (const auto& name : namesIn(root))
    if (const ObjectId object(H5Oopen(root, name.c_str(), H5P_DEFAULT));
        object.valid() && isMatrix(object))
      (isNumber(object) ? numbers : matrices).push_back(name);
  if (matrices.empty()) matrices = numbers;
  if (matrices.empty())
    throw Error(
        "the HDF5 file contains no matrix: no group with data, indices and indptr (MATLAB: data, "
        "ir "
        "and jc), no dataset of real "
        "numbers of two "
        "dimensions");
  if (matrices.size() > 1)
    throw Error("the HDF5 file contains several matrices, " + joined(matrices) + ": name one");
  return matrices[0];
}

Entries readHere(const std::filesystem::path& path, const std::string& name) {
  const Silence silence;
  const FileId file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  if (!file.valid()) throw Error("the HDF5 library reports a damaged file" + cause());
  const std::string wanted = name.empty() ? onlyMatrix(file) : name;
  const ObjectId object(H5Oopen(file, wanted.c_str(), H5P_DEFAULT));
  if (!object.valid()) throw Error("the HDF5 file contains no object '" + wanted + "'" + cause());
  try {
    if (isCompressed(object)) return compressedGroup(object);
    if (isMatlabSparse(object)) return matlabSparse(object);
    if (isTable(object)) return table(file, object, wanted);
  } catch (const Error& error) {
    throw Error("'" + wanted + "': " + error.what());
  }
  throw Error("'" + wanted +
              "' is neither a group with data, indices and indptr (MATLAB: data, ir and jc) nor a "
              "dataset of real numbers "
              "of two dimensions");
}

}  // namespace

/// Reads the file in a child process, since the HDF5 library crashes on damaged files.
Entries readHdf5(const std::filesystem::path& path, const std::string& name) {
  const ChildLimits limits{"the HDF5 file", 5 + 1e-6 * std::filesystem::file_size(path),
                           availableMemory(), "it requires more memory than is free",
                           "the HDF5 library"};
  const auto serialise = [](Stream& stream, Entries& entries) {
    stream(entries.row, entries.column, entries.value);
  };
  Stream result(inChild(limits, [&](const Warn&) {
    Entries entries = readHere(path, name);
    Stream stream;
    stream(entries.rows, entries.columns);
    serialise(stream, entries);
    return std::move(stream).bytes();
  }));
  PetscInt rows = 0, columns = 0;
  result(rows, columns);
  Entries entries(rows, columns);
  serialise(result, entries);
  return entries;
}

}  // namespace squeal::matrixfile
