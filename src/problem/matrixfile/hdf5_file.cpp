// SPDX-License-Identifier: BSD-2-Clause
#include "problem/matrixfile/hdf5_file.hpp"

#include <algorithm>

#include "base/petsc/check.hpp"
#include "base/system/text.hpp"

namespace squeal::matrixfile {
namespace {

constexpr hsize_t mostText = 64;

std::vector<hsize_t> extentOf(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> shape(std::max(rank, 0));
  if (rank > 0) H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

/// Returns the product of the extents and `size`. Throws Error if 64 bits cannot count it.
hsize_t product(const std::vector<hsize_t>& shape, hsize_t size) {
  for (const auto extent : shape)
    if (__builtin_mul_overflow(size, extent, &size)) throw Error("its sizes exceed 64 bits");
  return size;
}

/// Returns the largest number of bytes that `stored` bytes can expand to; HSIZE_UNDEF with an
/// unknown filter. Of the known filters, deflate has the highest ratio, about a thousand.
hsize_t mostUnpacked(hid_t properties, hsize_t stored) {
  const int filters = H5Pget_nfilters(properties);
  for (int k = 0; k < filters; ++k) {
    unsigned flags = 0, configuration = 0;
    std::size_t count = 0;
    const H5Z_filter_t filter =
        H5Pget_filter2(properties, k, &flags, &count, nullptr, 0, nullptr, &configuration);
    if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE &&
        filter != H5Z_FILTER_FLETCHER32)
      return HSIZE_UNDEF;
  }
  return filters > 0 ? 1040 * stored : stored;
}

/// Returns the number of chunks, each of `chunk` numbers per dimension.
hsize_t chunksOf(const std::vector<hsize_t>& shape, const std::vector<hsize_t>& chunk) {
  hsize_t chunks = 1;
  for (std::size_t k = 0; k < shape.size(); ++k) {
    if (chunk[k] == 0) throw Error("its layout is damaged");
    chunks = product({chunks}, shape[k] / chunk[k] + (shape[k] % chunk[k] != 0));
  }
  return chunks;
}

/// Returns the size of the values in bytes, in whole chunks. Throws Error if some chunks were never
/// written.
hsize_t wantedBytes(hid_t dataset, hid_t properties, hsize_t width,
                    const std::vector<hsize_t>& shape) {
  const hsize_t wanted = product(shape, width);
  if (wanted == 0 || H5Pget_layout(properties) != H5D_CHUNKED) return wanted;
  std::vector<hsize_t> chunk(shape.size());
  if (H5Pget_chunk(properties, chunk.size(), chunk.data()) < 0)
    throw Error("its layout is damaged" + cause());
  const hsize_t chunks = chunksOf(shape, chunk);
  hsize_t present = 0;
  const SpaceId space(H5Dget_space(dataset));
  if (H5Dget_num_chunks(dataset, space, &present) < 0 || present != chunks)
    throw Error(std::to_string(present) + " of its " + std::to_string(chunks) +
                " chunks were written");
  return product(chunk, product({chunks}, width));
}

/// Throws Error unless the values are in the file: HDF5 reads zeros if nothing was written, and
/// allocates the memory that a header requests.
void requireStored(hid_t dataset, hid_t type, const std::vector<hsize_t>& shape) {
  const PropertiesId properties(H5Dget_create_plist(dataset));
  if (H5Pget_layout(properties) == H5D_VIRTUAL || H5Pget_external_count(properties) > 0)
    throw Error("its values are in other files: merge them with h5repack");
  const hsize_t wanted = wantedBytes(dataset, properties, H5Tget_size(type), shape),
                stored = H5Dget_storage_size(dataset);
  if (wanted > mostUnpacked(properties, stored))
    throw Error("the file contains " + std::to_string(stored) +
                " bytes of it, but its size requires " + std::to_string(wanted));
}

/// Returns the name of a type for messages.
std::string kindOf(hid_t type) {
  switch (H5Tget_class(type)) {
    case H5T_INTEGER:
      return "integers";
    case H5T_FLOAT:
      return "reals";
    case H5T_COMPOUND:
      return "a compound type, such as complex numbers";
    case H5T_STRING:
      return "text";
    default:
      return "another type";
  }
}

template <class Number>
std::vector<Number> valuesOf(hid_t dataset, bool onlyIntegers, hid_t memory, int dimensions) {
  const TypeId type(H5Dget_type(dataset));
  const auto kind = H5Tget_class(type);
  if (kind != H5T_INTEGER && (onlyIntegers || kind != H5T_FLOAT))
    throw Error(std::string(onlyIntegers ? "integers" : "real numbers") +
                " are expected, but it contains " + kindOf(type));
  const SpaceId space(H5Dget_space(dataset));
  if (H5Sget_simple_extent_type(space) != H5S_SIMPLE ||
      H5Sget_simple_extent_ndims(space) != dimensions)
    throw Error(formatted("%d dimensions are expected, but it has %d", dimensions,
                          H5Sget_simple_extent_ndims(space)));
  const auto shape = extentOf(space);
  requireStored(dataset, type, shape);
  std::vector<Number> values(product(shape, 1));
  if (!values.empty() && H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    throw Error("it cannot be read" + cause());
  return values;
}

template <class Number>
std::vector<Number> valuesIn(hid_t group, const std::string& name, bool onlyIntegers, hid_t memory,
                             int dimensions) {
  const DatasetId dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT));
  if (!dataset.valid()) throw Error("there is no dataset '" + name + "'" + cause());
  try {
    return valuesOf<Number>(dataset, onlyIntegers, memory, dimensions);
  } catch (const Error& error) {
    throw Error("dataset '" + name + "': " + error.what());
  }
}

/// Returns the text of an attribute or a dataset; empty for anything else. `read(type, to)` calls
/// H5Aread or H5Dread.
template <class Read>
std::string text(hid_t type, hid_t space, const Read& read) {
  if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) return "";
  if (H5Tis_variable_str(type) > 0) {
    char* characters = nullptr;
    if (read(type, &characters) < 0 || !characters) return "";
    const std::string copy(characters);
    H5free_memory(characters);
    return copy.substr(0, mostText);
  }
  const std::size_t size = H5Tget_size(type);
  if (size == 0 || size > mostText) return "";
  std::string copy(size, '\0');
  if (read(type, copy.data()) < 0) return "";
  return copy.c_str();
}

}  // namespace

std::string cause() {
  std::string text;
  const auto first = [](unsigned, const H5E_error2_t* error, void* to) -> herr_t {
    auto& kept = *static_cast<std::string*>(to);
    if (kept.empty() && error->desc) kept = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, first, &text);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.empty() ? "" : " (HDF5: " + text + ")";
}

bool has(hid_t group, const std::string& name) {
  return H5Lexists(group, name.c_str(), H5P_DEFAULT) > 0;
}

bool hasAttribute(hid_t object, const std::string& name) {
  return H5Aexists(object, name.c_str()) > 0;
}

std::vector<hsize_t> shapeOf(hid_t dataset) {
  const SpaceId space(H5Dget_space(dataset));
  return extentOf(space);
}

std::vector<long long> integers(hid_t group, const std::string& name) {
  return valuesIn<long long>(group, name, true, H5T_NATIVE_LLONG, 1);
}

std::vector<double> reals(hid_t group, const std::string& name, int dimensions) {
  return valuesIn<double>(group, name, false, H5T_NATIVE_DOUBLE, dimensions);
}

std::string textOfAttribute(hid_t object, const std::string& name) {
  if (!hasAttribute(object, name)) return "";
  const AttributeId id(H5Aopen(object, name.c_str(), H5P_DEFAULT));
  const TypeId type(H5Aget_type(id));
  const SpaceId space(H5Aget_space(id));
  return text(type, space, [&](hid_t as, void* to) { return H5Aread(id, as, to); });
}

std::string textOfDataset(hid_t group, const std::string& name) {
  if (!has(group, name)) return "";
  const DatasetId id(H5Dopen2(group, name.c_str(), H5P_DEFAULT));
  if (!id.valid()) return "";
  const TypeId type(H5Dget_type(id));
  const SpaceId space(H5Dget_space(id));
  return text(type, space, [&](hid_t as, void* to) {
    return H5Dread(id, as, H5S_ALL, H5S_ALL, H5P_DEFAULT, to);
  });
}

std::vector<long long> integersOfAttribute(hid_t object, const std::string& name) {
  if (!hasAttribute(object, name)) return {};
  const AttributeId id(H5Aopen(object, name.c_str(), H5P_DEFAULT));
  const TypeId type(H5Aget_type(id));
  const SpaceId space(H5Aget_space(id));
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (H5Tget_class(type) != H5T_INTEGER || count < 1 || count > 64) return {};
  std::vector<long long> values(count);
  if (H5Aread(id, H5T_NATIVE_LLONG, values.data()) < 0) return {};
  return values;
}

}  // namespace squeal::matrixfile
