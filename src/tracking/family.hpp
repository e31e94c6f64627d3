#pragma once
/// Dense problems that depend on the friction: small models, or a large pencil in a reduced basis that may grow.
#include <optional>
#include <string>

#include "linalg/dense.hpp"

namespace squeal::flutter {

/// Pairs found at one friction.
struct Located {
  double friction = 0;
  std::vector<DensePair> pairs;
};

/// What a large problem says of pairs of its reduced one.
struct Improvement {
  bool changed = false;  ///< the basis has grown, or near() is better: the pairs are to be solved for again
  /// [located] the largest, of the large problem; NaN where there is no problem at this friction; empty: there is no larger problem
  std::vector<double> backwardError;
};

class Family {
 public:
  virtual ~Family() = default;
  virtual MPI_Comm comm() const = 0;
  /// Collective. The problem at one friction in the basis in force, the same on all ranks; none where it cannot be had, for example
  /// because the contact opens.
  virtual std::optional<DenseProblem> at(double friction) = 0;
  /// Not collective. The same, where it takes other ranks interpolated between the frictions known, exact at those: to look for what
  /// improve() then makes exact.
  virtual std::optional<DenseProblem> near(double friction) { return at(friction); }
  /// Collective. Makes near() know these frictions.
  virtual void know(const std::vector<double>&) {}
  /// Told on all ranks how far the work is.
  virtual void progress(const std::string&) {}
  /// Collective. Adds to the basis what the residuals of these pairs ask for, all together, and makes near() know their frictions.
  virtual Improvement improve(const std::vector<Located>&) { return {}; }
};

/// The eigenvalues that a run is about, and those watched beside them.
struct WatchedBand {
  double top = 1e300;    ///< rad/s, of |s|
  double guard = 1.3;    ///< eigenvalues are watched up to this multiple of `top` and of `damping`
  double damping = 0.5;  ///< largest damping ratio
  double origin = 0.1;   ///< all are watched up to this multiple of `top`: a real eigenvalue may pass through zero
  bool contains(std::complex<double> s) const { return std::abs(s) <= top && lasts(s); }
  bool watches(std::complex<double> s) const {
    return std::abs(s) <= guard * top && (-s.real() <= guard * damping * std::abs(s) || std::abs(s) <= origin * top);
  }
  /// Does not die away at once.
  bool lasts(std::complex<double> s) const { return -s.real() <= damping * std::abs(s); }
};

}  // namespace squeal::flutter
