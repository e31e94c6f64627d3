#pragma once
/// PETSc objects of any type.
#include <petscsys.h>

namespace squeal {

/// Returns the object as that of PETSc's base class.
template <class Handle>
PetscObject object(Handle handle) {
  return reinterpret_cast<PetscObject>(handle);
}

/// Not collective. Returns the communicator of an object.
template <class Handle>
MPI_Comm commOf(Handle handle) {
  return PetscObjectComm(object(handle));
}

}  // namespace squeal
