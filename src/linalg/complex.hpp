#pragma once
/// The complex number of all rooms: PETSc is built with real scalars.
#include <complex>

namespace squeal {

using Complex = std::complex<double>;

}  // namespace squeal
