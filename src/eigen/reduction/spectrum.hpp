// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The eigenvalues of the reduced problem of one point, while the basis grows.
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "eigen/pencil/band.hpp"

namespace squeal::reduction {

/// The watched eigenpairs of a point, with both vectors, by ascending imaginary part. With damping,
/// only the first basis needs all eigenvalues of a problem of twice its size; later, inaccurate
/// pairs are improved.
struct Spectrum {
  std::vector<linalg::DensePair> band;   ///< in the band
  std::vector<linalg::DensePair> guard;  ///< in the guard zone around the band
  /// True if the pairs have been improved since all eigenvalues were computed: an eigenvalue that
  /// has entered the band may then be missing.
  bool improved = false;
};

/// A request to solve a problem for its Spectrum.
struct SpectrumRequest {
  const linalg::DenseProblem* problem;
  Spectrum* spectrum;
  /// The ratios of the errors of the pairs of the band to their tolerances, [pair]: above 1, a pair
  /// is improved.
  std::vector<double> errorRatio;
};

/// Collective. Updates the spectra to their problems, whose bases extend those of the spectra. An
/// empty spectrum is computed in full. The work is distributed over the ranks, and every rank needs
/// all problems. Throws Error on all ranks if a solve fails.
void solveSpectra(MPI_Comm comm, const pencil::WatchedBand& band,
                  const std::vector<SpectrumRequest>& requests);

/// Collective. Returns for each spectrum, [request], whether findMissing() finds an eigenvalue of
/// the band that it lacks. Throws Error on all ranks if that fails.
std::vector<bool> incomplete(MPI_Comm comm, const pencil::WatchedBand& band,
                             const std::vector<SpectrumRequest>& requests);

}  // namespace squeal::reduction
