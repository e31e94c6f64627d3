#pragma once
/// Snapshots over the sweep as a basis: proper orthogonal decomposition. Not collective.
#include <vector>

#include "linalg/quadratic.hpp"

namespace squeal::reduction {

/// Returns orthonormal combinations of `size` basis vectors, size × count, that hold the real and
/// imaginary parts of the right vectors of all these pairs, but for parts of length 1e-9, which
/// corrections bring back. Entries that a vector lacks are zero. The matrix has no columns if there
/// are no pairs. Throws Error if LAPACK fails.
linalg::DenseMatrix principalDirections(const std::vector<std::vector<linalg::DensePair>>& solved,
                                        PetscInt size);

/// Gives the vectors of the pair in coordinates of a basis V · directions.
void turn(const linalg::DenseMatrix& directions, linalg::DensePair& pair);

}  // namespace squeal::reduction
