#pragma once
/// The direct method solves the eigenproblem on all unknowns, without reduction.
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::direct {

/// Returns true if `-flutter_method` asks for the direct method.
bool directWanted();

/// Options of the direct method.
struct Options {
  PetscInt count;            ///< `-flutter_direct_count`: eigenvalues nearest to zero wanted
  PetscInt limit;            ///< `-flutter_direct_limit`: most eigenvalues found to cover the band
  double low = 0, high = 0;  ///< `-flutter_direct_band` in rad/s; high = 0: no band
  bool confirmed;            ///< `-flutter_direct_confirm`
  pencil::Criteria criteria;
  /// Reads the options. Throws Error if the band is not two ascending frequencies.
  static Options given();
};

/// Collective. Solves the problem on all unknowns by SLEPc with shift-and-invert at zero. Returns
/// the `count` eigenvalues nearest to zero, with others that are as near as the last of them, or
/// all in the band (low ≤ Im s ≤ high, |s| ≤ high) that `limit` of them reach:
/// ComplexModes::coveredTo. `trial` is T, N×n, for the shapes. Throws Error if the solver does not
/// converge.
pencil::ComplexModes solveDirect(const pencil::Pencil& pencil, const sweep::Parameters& at,
                                 Mat trial, const Options& options = Options::given());

}  // namespace squeal::direct
