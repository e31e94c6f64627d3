#pragma once
/// Dense problems that depend on the friction: small models, or a large pencil in a reduced basis
/// that may grow.
#include <optional>
#include <string>

#include "linalg/dense.hpp"
#include "reduction/reduced.hpp"

namespace squeal::tracking {

/// Pairs found at one friction.
struct Located {
  double friction = 0;
  std::vector<linalg::DensePair> pairs;
};

class Family {
 public:
  virtual ~Family() = default;
  virtual MPI_Comm comm() const = 0;
  /// Collective. The problem at one friction in the basis in force, the same on all ranks; none
  /// where it cannot be had, for example because the contact opens.
  virtual std::optional<linalg::DenseProblem> at(double friction) = 0;
  /// Not collective. The same, where it takes other ranks interpolated between the frictions known,
  /// exact at those: to look for what improve() then makes exact.
  virtual std::optional<linalg::DenseProblem> near(double friction) { return at(friction); }
  /// Collective. Makes near() know these frictions.
  virtual void know(const std::vector<double>&) {}
  /// Told on all ranks how far the work is.
  virtual void progress(const std::string&) {}
  /// Collective. Adds to the basis what the residuals of these pairs ask for, all together, and
  /// makes near() know their frictions.
  virtual reduction::Improvement improve(const std::vector<Located>&) { return {}; }
};

}  // namespace squeal::tracking
