// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Dense problems that depend on the friction: a small model, or a large pencil in a reduced basis
/// that may grow.
#include <optional>
#include <string>
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/rayleigh_ritz.hpp"
#include "eigen/reduction/reduced.hpp"

namespace squeal::tracking {

/// Eigenpairs at one friction.
struct PairsAtFriction {
  double friction = 0;
  std::vector<linalg::DensePair> pairs;
};

/// The interface to a dense problem for each friction.
class Family {
 public:
  virtual ~Family() = default;
  virtual MPI_Comm comm() const = 0;
  /// Collective. Returns the problem at one friction in the present basis, the same on all ranks;
  /// none where it does not exist, for example because the contact opens.
  virtual std::optional<linalg::DenseProblem> at(double friction) = 0;
  /// Collective. Returns the eigenpairs of at(friction) that the band watches, with both vectors,
  /// if they are known; in a basis that has grown since, entries of the vectors are missing.
  virtual std::optional<std::vector<linalg::DensePair>> watchedPairs(double) { return {}; }
  /// Not collective. Returns the same problem. Where at() would need other ranks, its matrices are
  /// interpolated between the known frictions. At these they are exact for the basis in which they
  /// became known; in one that has grown since, their new rows and columns are zero. A root found
  /// so is made exact by improve().
  virtual std::optional<linalg::DenseProblem> near(double friction) { return at(friction); }
  /// Collective. Returns the pairs of at(friction) for comparison with those of another family of
  /// the same path: in coordinates that all of these share.
  virtual linalg::Spectrum shared(double friction, const std::vector<linalg::DensePair>& pairs) {
    return linalg::Spectrum(*at(friction), pairs);
  }
  /// Collective. Makes these frictions known to near().
  virtual void know(const std::vector<double>&) {}
  /// Reports progress; called on all ranks.
  virtual void progress(const std::string&) {}
  /// Collective. Corrects the basis by the residuals of these pairs, all together, and makes their
  /// frictions known to near().
  virtual reduction::Improvement improve(const std::vector<PairsAtFriction>&) { return {}; }
};

}  // namespace squeal::tracking
