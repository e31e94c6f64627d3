// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Handles that own PETSc and SLEPc objects. They can be moved, but not copied. A raw `Mat`, `Vec`,
/// … in a parameter list is borrowed.
#include <slepceps.h>

#include <utility>

#include "base/petsc/check.hpp"
#include "base/petsc/object.hpp"

namespace squeal {

template <class Handle, PetscErrorCode (*destroy)(Handle*)>
class Owned {
 public:
  Owned() = default;
  /// Takes ownership of one reference.
  explicit Owned(Handle handle) : handle_(handle) {}
  Owned(Owned&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() {
    if (handle_) destroy(&handle_);
  }
  /// Collective. Destroys the owned object and returns the address for a PETSc create call to fill.
  Handle* out() {
    if (handle_) check(destroy(&handle_));
    handle_ = nullptr;
    return &handle_;
  }
  Handle get() const { return handle_; }
  operator Handle() const { return handle_; }  // NOLINT: most uses borrow
  explicit operator bool() const { return handle_ != nullptr; }
  /// Returns a second owner of the same object, with one more PETSc reference.
  Owned share() const {
    if (handle_) check(PetscObjectReference(object(handle_)));
    return Owned(handle_);
  }

 private:
  Handle handle_ = nullptr;
};

/// Returns an owned Mat, Vec, KSP, … as a PetscObject, for PETSc functions that take any object.
template <class Handle, PetscErrorCode (*destroy)(Handle*)>
PetscObject object(const Owned<Handle, destroy>& owned) {
  return object(owned.get());
}

/// Returns the communicator of an owned Mat, Vec, KSP, …
template <class Handle, PetscErrorCode (*destroy)(Handle*)>
MPI_Comm commOf(const Owned<Handle, destroy>& owned) {
  return commOf(owned.get());
}

using OwnedVec = Owned<Vec, VecDestroy>;
using OwnedMat = Owned<Mat, MatDestroy>;
using OwnedIS = Owned<IS, ISDestroy>;
using OwnedKSP = Owned<KSP, KSPDestroy>;
using OwnedScatter = Owned<VecScatter, VecScatterDestroy>;
using OwnedEPS = Owned<EPS, EPSDestroy>;
using OwnedBV = Owned<BV, BVDestroy>;
using OwnedViewer = Owned<PetscViewer, PetscViewerDestroy>;

/// Collective. Returns a vector of zeros with the column layout of `matrix`.
inline OwnedVec rightVector(Mat matrix) {
  OwnedVec vector;
  check(MatCreateVecs(matrix, vector.out(), nullptr));
  return vector;
}

}  // namespace squeal
