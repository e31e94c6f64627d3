#pragma once
/// The points of a batch while the basis is corrected.
#include <array>
#include <vector>

#include "algebra/linalg/serialization.hpp"
#include "base/checkpoint/archive.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/reduction/spectrum.hpp"

namespace squeal::reduction {

using Norms = std::array<double, 3>;  ///< 2-norms of K̄, Z̄, M̄ of a point

/// What is known of one point.
struct PointFound {
  Norms norms{};
  Spectrum spectrum;
  // Of the pairs of the band:
  std::vector<double> backwardError;  ///< [pair]
  // The estimate of |δs|/|s| is the product of the two, each with the norm of diag(K0)⁻¹ for that
  // of K0⁻¹. The second counts as 1 at most.
  std::vector<double> rightError;  ///< [pair] of the right vector, times the condition number of s
  std::vector<double> leftError;   ///< [pair] of the left vector; infinite above the modes
  std::vector<double> roundOff;    ///< [pair] what it adds at most to yᴴP(s)x of unit vectors
  std::vector<double> rounding;    ///< [pair] error of the dense solve
  pencil::Symmetry symmetry = pencil::Symmetry::none;
};

/// A batch between two rounds of corrections.
struct BatchInHand {
  int round = 0;                    ///< the next one
  PetscInt largest = 0;             ///< size of the basis from which on no round begins
  std::vector<PointFound> found;    ///< [point]
  std::vector<unsigned char> open;  ///< [point] 1 if it is not done
};

/// Not collective. Writes what is known of a point, the same on all ranks, or sets it.
inline void fields(checkpoint::Stream& stream, PointFound& found) {
  // All members are named, so that a new one does not compile until it is kept too.
  auto& [norms, spectrum, backwardError, rightError, leftError, roundOff, rounding, symmetry] =
      found;
  auto& [band, guard, improved] = spectrum;
  stream(norms, band, guard, improved, backwardError, rightError, leftError, roundOff, rounding,
         symmetry);
}

}  // namespace squeal::reduction
