// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Handles of the HDF5 library.
#include <hdf5.h>

namespace squeal::hdf5 {

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
using GroupId = Id<H5Gclose>;
using ObjectId = Id<H5Oclose>;
using DatasetId = Id<H5Dclose>;
using SpaceId = Id<H5Sclose>;
using AttributeId = Id<H5Aclose>;
using TypeId = Id<H5Tclose>;
using PropertiesId = Id<H5Pclose>;

/// Suppresses HDF5's error output during the object's lifetime. The messages of this program report
/// the errors.
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

}  // namespace squeal::hdf5
