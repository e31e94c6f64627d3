// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// What results.h5 holds, read by PETSc itself.
#include <petscviewerhdf5.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/petsc/check.hpp"
#include "base/petsc/owned.hpp"

namespace squeal::test {

/// Every rank reads the whole of what all wrote; not collective.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) {
    check(PetscViewerHDF5Open(PETSC_COMM_SELF, path.c_str(), FILE_MODE_READ, viewer_.out()));
  }

  /// Values and number of columns.
  std::pair<std::vector<double>, PetscInt> reals(const std::string& group,
                                                 const std::string& name) {
    OwnedVec vector;
    check(VecCreate(PETSC_COMM_SELF, vector.out()));
    check(PetscObjectSetName(object(vector.get()), name.c_str()));
    check(PetscViewerHDF5PushGroup(viewer_, group.c_str()));
    check(VecLoad(vector, viewer_));
    check(PetscViewerHDF5PopGroup(viewer_));
    PetscInt size = 0, columns = 0;
    const double* values = nullptr;
    check(VecGetSize(vector, &size));
    check(VecGetBlockSize(vector, &columns));
    check(VecGetArrayRead(vector, &values));
    std::vector<double> copy(values, values + size);
    check(VecRestoreArrayRead(vector, &values));
    return {copy, columns};
  }

  std::pair<std::vector<PetscInt>, PetscInt> integers(const std::string& group,
                                                      const std::string& name) {
    OwnedIS set;
    check(ISCreate(PETSC_COMM_SELF, set.out()));
    check(PetscObjectSetName(object(set.get()), name.c_str()));
    check(PetscViewerHDF5PushGroup(viewer_, group.c_str()));
    check(ISLoad(set, viewer_));
    check(PetscViewerHDF5PopGroup(viewer_));
    PetscInt size = 0, columns = 0;
    const PetscInt* values = nullptr;
    check(ISGetSize(set, &size));
    check(ISGetBlockSize(set, &columns));
    check(ISGetIndices(set, &values));
    std::vector<PetscInt> copy(values, values + size);
    check(ISRestoreIndices(set, &values));
    return {copy, columns};
  }

  template <class Value>
  Value attribute(const std::string& object, const std::string& name, PetscDataType type) {
    Value value{};
    check(
        PetscViewerHDF5ReadAttribute(viewer_, object.c_str(), name.c_str(), type, nullptr, &value));
    return value;
  }

  std::string text(const std::string& object, const std::string& name) {
    char* characters = attribute<char*>(object, name, PETSC_STRING);
    const std::string copy = characters;
    check(PetscFree(characters));
    return copy;
  }

  bool hasGroup(const std::string& group) {
    PetscBool has = PETSC_FALSE;
    check(PetscViewerHDF5HasGroup(viewer_, group.c_str(), &has));
    return has;
  }

 private:
  OwnedViewer viewer_;
};

}  // namespace squeal::test
