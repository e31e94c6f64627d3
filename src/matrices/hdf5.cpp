#include <hdf5.h>

#include <algorithm>
#include <cmath>

#include "matrices/formats.hpp"
#include "petsc/check.hpp"
#include "petsc/text.hpp"

namespace squeal::matrices {
namespace {

/// An HDF5 identifier with its close function.
template <herr_t (*close)(hid_t)>
class Id {
 public:
  explicit Id(hid_t id) : id_(id) {}
  ~Id() {
    if (id_ >= 0) close(id_);
  }
  Id(const Id&) = delete;
  Id& operator=(const Id&) = delete;
  operator hid_t() const { return id_; }  // NOLINT
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
};
using FileId = Id<H5Fclose>;
using ObjectId = Id<H5Oclose>;
using DatasetId = Id<H5Dclose>;
using SpaceId = Id<H5Sclose>;
using AttributeId = Id<H5Aclose>;
using TypeId = Id<H5Tclose>;

/// HDF5 prints its errors itself unless told not to; they reach the user through ours.
class Silence {
 public:
  Silence() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

bool has(hid_t group, const std::string& name) { return H5Lexists(group, name.c_str(), H5P_DEFAULT) > 0; }

bool isCompressed(hid_t object) {
  return H5Iget_type(object) == H5I_GROUP && has(object, "data") && has(object, "indices") && has(object, "indptr");
}

std::vector<hsize_t> shapeOf(hid_t dataset) {
  const SpaceId space(H5Dget_space(dataset));
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(rank, 0)));
  if (rank > 0) H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

bool isTable(hid_t object) {
  if (H5Iget_type(object) != H5I_DATASET || shapeOf(object).size() != 2) return false;
  const TypeId type(H5Dget_type(object));
  const auto kind = H5Tget_class(type);
  return kind == H5T_FLOAT || kind == H5T_INTEGER;
}

template <class Number>
std::vector<Number> numbers(hid_t dataset, const std::string& name, hid_t type) {
  std::size_t size = 1;
  for (const auto extent : shapeOf(dataset)) size *= extent;
  std::vector<Number> values(size);
  if (H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    throw Error("dataset '" + name + "' cannot be read");
  return values;
}

template <class Number>
std::vector<Number> numbersIn(hid_t group, const std::string& name, hid_t type) {
  const DatasetId dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT));
  if (!dataset.valid()) throw Error("there is no dataset '" + name + "'");
  return numbers<Number>(dataset, name, type);
}

/// Text of an attribute, of fixed or variable length; empty if there is none.
std::string attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return "";
  const AttributeId id(H5Aopen(object, name, H5P_DEFAULT));
  const TypeId type(H5Aget_type(id));
  if (H5Tget_class(type) != H5T_STRING) return "";
  if (H5Tis_variable_str(type) > 0) {
    char* text = nullptr;
    if (H5Aread(id, type, &text) < 0 || !text) return "";
    const std::string copy = text;
    H5free_memory(text);
    return copy;
  }
  std::string text(H5Tget_size(type), '\0');
  H5Aread(id, type, text.data());
  return text;
}

/// scipy.sparse.save_npz keeps the format as a dataset; a copy of it in HDF5 does too.
std::string formatDataset(hid_t group) {
  if (!has(group, "format")) return "";
  const DatasetId dataset(H5Dopen2(group, "format", H5P_DEFAULT));
  const TypeId type(H5Dget_type(dataset));
  if (!dataset.valid() || H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0) return "";
  std::string text(H5Tget_size(type), '\0');
  H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data());
  return text;
}

bool byColumns(hid_t group) {
  for (const std::string& text :
       {attribute(group, "format"), attribute(group, "h5sparse_format"), attribute(group, "encoding-type"), formatDataset(group)})
    if (text.compare(0, 3, "csc") == 0) return true;
  return false;
}

Entries compressedGroup(hid_t group) {
  const auto begin = numbersIn<long long>(group, "indptr", H5T_NATIVE_LLONG);
  const auto size = static_cast<long long>(begin.size()) - 1;  // of rows and columns: a square matrix
  return compressed(size, size, byColumns(group), begin, numbersIn<long long>(group, "indices", H5T_NATIVE_LLONG),
                    numbersIn<double>(group, "data", H5T_NATIVE_DOUBLE));
}

Entries table(hid_t dataset, const std::string& name) {
  const auto shape = shapeOf(dataset);
  const auto values = numbers<double>(dataset, name, H5T_NATIVE_DOUBLE);
  Entries entries{static_cast<PetscInt>(shape[0]), static_cast<PetscInt>(shape[1]), {}, {}, {}};
  for (std::size_t i = 0, k = 0; i < shape[0]; ++i)
    for (std::size_t j = 0; j < shape[1]; ++j, ++k) entries.add(static_cast<long long>(i), static_cast<long long>(j), values[k]);
  return entries;
}

std::string onlyMatrix(hid_t file) {
  const ObjectId root(H5Oopen(file, "/", H5P_DEFAULT));
  if (isCompressed(root)) return "/";
  std::vector<std::string> all, matrices;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  H5Literate(root, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &all);
  for (const auto& name : all)
    if (const ObjectId object(H5Oopen(root, name.c_str(), H5P_DEFAULT)); isCompressed(object) || isTable(object))
      matrices.push_back(name);
  if (matrices.empty())
    throw Error("the HDF5 file holds no matrix: no group with data, indices and indptr, no dataset of two dimensions");
  if (matrices.size() > 1) throw Error("the HDF5 file holds several matrices, " + joined(matrices) + ": name one");
  return matrices[0];
}

}  // namespace

Entries readHdf5(const std::filesystem::path& path, const std::string& name) {
  const Silence silence;
  const FileId file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  if (!file.valid()) throw Error("HDF5 finds the file damaged");
  const std::string wanted = name.empty() ? onlyMatrix(file) : name;
  const ObjectId object(H5Oopen(file, wanted.c_str(), H5P_DEFAULT));
  if (!object.valid()) throw Error("the HDF5 file holds no object '" + wanted + "'");
  if (isCompressed(object)) return compressedGroup(object);
  if (isTable(object)) return table(object, wanted);
  throw Error("'" + wanted + "' is neither a group with data, indices and indptr nor a dataset of two dimensions");
}

}  // namespace squeal::matrices
