// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The eigenvalues of the reduced problem of one point, while the basis grows.
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "eigen/pencil/band.hpp"

namespace squeal::reduction {

/// A Spectrum holds the eigenpairs of a point that are watched, with both vectors, by ascending
/// imaginary part. Where there is damping, all eigenvalues of a problem of twice the size of the
/// basis are computed for the first basis only; after that the pairs that are still inaccurate are
/// improved.
struct Spectrum {
  std::vector<linalg::DensePair> band;   ///< in the band
  std::vector<linalg::DensePair> guard;  ///< in the guard zone around the band
  /// True if the pairs have been improved since all eigenvalues were computed: an eigenvalue that
  /// has come into the band may then be missing.
  bool improved = false;
};

/// A problem to be solved for a Spectrum.
struct SpectrumRequest {
  const linalg::DenseProblem* problem;
  Spectrum* spectrum;
  /// The ratios of the errors of the pairs of the band to what is asked for, [pair]: above 1, a
  /// pair is improved.
  std::vector<double> errorRatio;
};

/// Collective. Brings the spectra to their problems, whose bases begin with those of the spectra;
/// an empty one is computed in full. The work is spread over the ranks, which all need all
/// problems. Throws Error on all ranks if a solve fails.
void solveSpectra(MPI_Comm comm, const pencil::WatchedBand& band,
                  const std::vector<SpectrumRequest>& requests);

/// Collective. Returns whether an eigenvalue of the band is missing in the spectrum, [request], as
/// findMissing() finds. Throws Error on all ranks if that fails.
std::vector<bool> incomplete(MPI_Comm comm, const pencil::WatchedBand& band,
                             const std::vector<SpectrumRequest>& requests);

}  // namespace squeal::reduction
