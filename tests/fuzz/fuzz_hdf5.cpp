// SPDX-License-Identifier: BSD-2-Clause
#include <hdf5.h>

#include "fuzz/fuzz.hpp"
#include "problem/matrices/read.hpp"

namespace squeal::fuzz {
namespace {

/// [[2, 0], [1, 3]], with the format of the file, the type of the indices and the layout of the
/// datasets.
struct Writer {
  H5F_libver_t version = H5F_LIBVER_EARLIEST;
  hid_t indexType = H5T_NATIVE_INT;
  bool chunked = false, table = false;

  void dataset(hid_t place, const char* name, hid_t type, hid_t stored, const void* values,
               std::vector<hsize_t> shape) const {
    const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    const hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    if (chunked) {
      H5Pset_chunk(layout, static_cast<int>(shape.size()), shape.data());
      H5Pset_deflate(layout, 1);
    }
    const hid_t set = H5Dcreate2(place, name, stored, space, H5P_DEFAULT, layout, H5P_DEFAULT);
    H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    H5Dclose(set);
    H5Pclose(layout);
    H5Sclose(space);
  }

  void operator()(const std::string& path) const {
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_libver_bounds(access, version, H5F_LIBVER_LATEST);
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
    const int begin[] = {0, 1, 3}, index[] = {0, 0, 1};
    const double data[] = {2, 1, 3}, all[] = {2, 0, 1, 3};
    if (table) {
      dataset(file, "matrix", H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, all, {2, 2});
    } else {
      const hid_t group = H5Gcreate2(file, "matrix", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      dataset(group, "data", H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, data, {3});
      dataset(group, "indices", H5T_NATIVE_INT, indexType, index, {3});
      dataset(group, "indptr", H5T_NATIVE_INT, indexType, begin, {3});
      const hid_t scalar = H5Screate(H5S_SCALAR), text = H5Tcopy(H5T_C_S1);
      H5Tset_size(text, 10);
      const hid_t attribute = H5Acreate2(group, "format", text, scalar, H5P_DEFAULT, H5P_DEFAULT);
      H5Awrite(attribute, text, "csr\0\0\0\0\0\0");
      H5Aclose(attribute);
      H5Tclose(text);
      H5Sclose(scalar);
      H5Gclose(group);
    }
    H5Fclose(file);
    H5Pclose(access);
  }
};

}  // namespace

Target target() {
  return {
      "hdf5",
      ".h5",
      {bytesWritten(Writer{}), bytesWritten(Writer{H5F_LIBVER_LATEST, H5T_STD_I64LE, false, false}),
       bytesWritten(Writer{H5F_LIBVER_EARLIEST, H5T_STD_U32BE, true, false}),
       bytesWritten(Writer{H5F_LIBVER_EARLIEST, H5T_STD_I32LE, false, true}),
       bytesWritten(Writer{H5F_LIBVER_LATEST, H5T_STD_I32LE, true, true})},
      [](const std::string& path) { matrices::read(PETSC_COMM_WORLD, path); }};
}

}  // namespace squeal::fuzz
