// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// HDF5 files written by hand, with what other programs put into them. Not collective.
#include <hdf5.h>

#include <string>
#include <vector>

namespace squeal::test {

class Hdf5File {
 public:
  /// `userBlock`: bytes left free at the beginning, 0 or a power of 2 from 512 on.
  explicit Hdf5File(const std::string& path, hsize_t userBlock = 0) {
    const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
    H5Pset_userblock(creation, userBlock);
    id_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT);
    H5Pclose(creation);
  }
  ~Hdf5File() { H5Fclose(id_); }
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  void group(const std::string& name) const {
    H5Gclose(H5Gcreate2(id_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  }

  /// `values` null: nothing is written; `chunk`: none, or one number per dimension; `external`: a
  /// file of that name holds the values.
  void dataset(const std::string& name, hid_t type, const void* values, std::vector<hsize_t> shape,
               const std::vector<hsize_t>& chunk = {}, const char* external = nullptr) const {
    const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    const hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    if (!chunk.empty()) {
      H5Pset_chunk(layout, static_cast<int>(chunk.size()), chunk.data());
      H5Pset_deflate(layout, 6);
    }
    if (external) H5Pset_external(layout, external, 0, H5F_UNLIMITED);
    const hid_t set = H5Dcreate2(id_, name.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT);
    if (values) H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    H5Dclose(set);
    H5Pclose(layout);
    H5Sclose(space);
  }
  /// The first numbers of a dataset of one dimension.
  void writeFirst(const std::string& name, hid_t type, const void* values, hsize_t count) const {
    const hid_t set = H5Dopen2(id_, name.c_str(), H5P_DEFAULT), all = H5Dget_space(set),
                some = H5Screate_simple(1, &count, nullptr);
    const hsize_t start = 0;
    H5Sselect_hyperslab(all, H5S_SELECT_SET, &start, nullptr, &count, nullptr);
    H5Dwrite(set, type, some, all, H5P_DEFAULT, values);
    H5Sclose(some);
    H5Sclose(all);
    H5Dclose(set);
  }
  void text(const std::string& object, const std::string& name, const std::string& value) const {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, value.size());
    number(object, name, type, value.data());
    H5Tclose(type);
  }
  /// A dataset of a single text, as h5py makes one of a NumPy array without dimensions.
  void textDataset(const std::string& name, const std::string& value) const {
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, value.size());
    const hid_t set =
        H5Dcreate2(id_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data());
    H5Dclose(set);
    H5Sclose(space);
    H5Tclose(type);
  }
  /// An attribute of a single value.
  void number(const std::string& object, const std::string& name, hid_t type,
              const void* value) const {
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t id = H5Acreate_by_name(id_, object.c_str(), name.c_str(), type, space, H5P_DEFAULT,
                                       H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(id, type, value);
    H5Aclose(id);
    H5Sclose(space);
  }

 private:
  hid_t id_;
};

}  // namespace squeal::test
