#pragma once
/// The vectors found over the sweep become a basis by proper orthogonal decomposition. Nothing here
/// is collective.
#include <vector>

#include "algebra/linalg/quadratic.hpp"

namespace squeal::reduction {

/// Returns orthonormal combinations of `size` basis vectors, size × count, that hold the real and
/// imaginary parts of the right vectors of all these pairs, but for parts of length 1e-9, which
/// corrections bring back. Entries that a vector lacks are zero. The matrix has no columns if there
/// are no pairs. Throws Error if LAPACK fails.
linalg::DenseMatrix principalDirections(const std::vector<std::vector<linalg::DensePair>>& solved,
                                        PetscInt size);

/// Replaces the vectors of the pair by their coordinates in the basis V · directions, former size ×
/// new size. The part of a vector outside of this basis, which a left vector may have, is lost.
void turn(const linalg::DenseMatrix& directions, linalg::DensePair& pair);

}  // namespace squeal::reduction
