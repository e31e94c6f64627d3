// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Dense problems that depend on the friction: a small model, or a large pencil in a growing
/// reduced basis.
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
  /// Returns true if all terms of the problems are known for all frictions. at() is then cheap and
  /// not collective.
  virtual bool isAffine() const = 0;
  /// Collective. Returns the problem at one friction in the current basis, the same on all ranks;
  /// none if it does not exist there, for example because the contact opens.
  virtual std::optional<linalg::DenseProblem> at(double friction) = 0;
  /// Collective. Returns the watched eigenpairs of at(friction), with right and left vectors, if
  /// they are known. If the basis has grown since they were computed, the last entries of the
  /// vectors are missing.
  virtual std::optional<std::vector<linalg::DensePair>> watchedPairs(double) { return {}; }
  /// Not collective. Returns the same problem as at(), or an approximation if at() must be
  /// collective: the terms that belong to single points are interpolated between known frictions
  /// (see addFrictions()). At a known friction they are exact, except that the rows and columns of
  /// vectors added to the basis later are zero. At a critical friction that has been located,
  /// improve() removes the interpolation error.
  virtual std::optional<linalg::DenseProblem> near(double friction) { return at(friction); }
  /// Collective. Returns the pairs of at(friction) in coordinates common to all families of a path,
  /// for comparison.
  virtual linalg::Spectrum shared(double friction, const std::vector<linalg::DensePair>& pairs) {
    return linalg::Spectrum(*at(friction), pairs);
  }
  /// Collective. Makes these frictions known to near().
  virtual void addFrictions(const std::vector<double>&) {}
  /// Reports progress; called on all ranks.
  virtual void progress(const std::string&) {}
  /// Collective. Corrects the basis by the residuals of all these pairs together, and makes their
  /// frictions known to near().
  virtual reduction::Improvement improve(const std::vector<PairsAtFriction>&) { return {}; }
  /// Collective. Returns the errors of these pairs.
  virtual reduction::Improvement errorsOf(const std::vector<PairsAtFriction>&) { return {}; }
};

}  // namespace squeal::tracking
