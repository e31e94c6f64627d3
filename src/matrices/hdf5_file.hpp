#pragma once
/// What HDF5 files hold, with the checks that the HDF5 library leaves to its users.
#include <hdf5.h>

#include <string>
#include <vector>

namespace squeal::matrices {

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
using PropertiesId = Id<H5Pclose>;

/// HDF5 prints its errors itself unless told not to; they reach the user through ours.
class Silence {
 public:
  Silence();
  ~Silence();
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// The cause of HDF5's last failure, " (truncated file: ...)", or nothing.
std::string cause();

bool has(hid_t group, const std::string& name);
bool hasAttribute(hid_t object, const std::string& name);

/// Empty for a scalar and for what has no extent.
std::vector<hsize_t> shapeOf(hid_t dataset);

/// Integers, or reals. Error: of another type or number of dimensions; values that the file does not hold, since they were never written
/// or lie in other files.
std::vector<long long> integers(hid_t group, const std::string& name);
std::vector<double> reals(hid_t group, const std::string& name, int dimensions = 1);

/// Text of an attribute, or of a dataset, a single one of up to 64 characters, of fixed or variable length; otherwise empty.
std::string textOfAttribute(hid_t object, const std::string& name);
std::string textOfDataset(hid_t group, const std::string& name);

/// Integers of an attribute; empty if there is none, or of another kind.
std::vector<long long> integersOfAttribute(hid_t object, const std::string& name);

}  // namespace squeal::matrices
