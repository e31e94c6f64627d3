// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// PETSc handles as PetscObjects, and their communicators.
#include <petscsys.h>

namespace squeal {

/// Returns a Mat, Vec, KSP, … as a PetscObject, for PETSc functions that take any object.
template <class Handle>
PetscObject object(Handle* handle) {
  return reinterpret_cast<PetscObject>(handle);
}

/// Not collective. Returns the communicator of a Mat, Vec, KSP, …
template <class Handle>
MPI_Comm commOf(Handle* handle) {
  return PetscObjectComm(object(handle));
}

}  // namespace squeal
