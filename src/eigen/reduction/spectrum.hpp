// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The eigenvalues of the reduced problem of one point, while the basis grows.
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "eigen/pencil/band.hpp"

namespace squeal::reduction {

/// The watched eigenpairs of a point, with right and left vectors, by ascending imaginary part.
/// Full solves for all eigenvalues would take most of the time in a large problem, and with damping
/// the linearised problem is twice as large as the basis. Only small bases are therefore solved in
/// full; in larger ones, the inaccurate pairs are improved instead.
struct Spectrum {
  std::vector<linalg::DensePair> band;   ///< in the band
  std::vector<linalg::DensePair> guard;  ///< in the guard zone around the band
  /// True if the pairs have been improved since all eigenvalues were computed: an eigenvalue that
  /// has entered the band may then be missing.
  bool improved = false;
};

/// Smaller problems are solved in full, which is at least as fast as an improvement.
inline constexpr PetscInt smallestImproved = 400;

/// A request to solve a problem for its Spectrum.
struct SpectrumRequest {
  const linalg::DenseProblem* problem;
  Spectrum* spectrum;
  /// [pair of the band] error divided by tolerance. A pair with a ratio above 1 is improved.
  std::vector<double> errorRatio;
};

/// Collective. Updates each spectrum to the problem of its request. The basis of this problem must
/// begin with the basis of the spectrum. A spectrum is computed in full if its band is empty, if
/// the problem is small or conservative, or if the improvement fails. The work is distributed over
/// the ranks; every rank must pass all problems. Throws Error on all ranks if a solve fails.
void solveSpectra(MPI_Comm comm, const pencil::WatchedBand& band,
                  const std::vector<SpectrumRequest>& requests);

/// Collective. Returns for each request whether findMissing() finds an eigenvalue in the band that
/// its spectrum does not contain. Throws Error on all ranks if findMissing() fails.
std::vector<bool> incomplete(MPI_Comm comm, const pencil::WatchedBand& band,
                             const std::vector<SpectrumRequest>& requests);

}  // namespace squeal::reduction
