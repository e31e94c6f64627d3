#pragma once
/// Views of PETSc handles as objects.
#include <petscsys.h>

namespace squeal {

/// Returns a Mat, Vec, KSP, … as an object, for the functions of PETSc that take any object.
template <class Pointee>
PetscObject object(Pointee* handle) {
  return reinterpret_cast<PetscObject>(handle);
}

/// Returns the communicator of a Mat, Vec, KSP, …
template <class Pointee>
MPI_Comm comm(Pointee* handle) {
  return PetscObjectComm(object(handle));
}

}  // namespace squeal
