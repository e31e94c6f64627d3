// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// What a run finds, as far as two ways to the same result are compared by it.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "algebra/linalg/complex.hpp"
#include "run/analysis/analysis.hpp"

namespace squeal::fuzz {

struct FoundEigenvalue {
  Complex s;
  double estimate = 0;  ///< of the relative error; NaN: none
  double backwardError = 0;
  pencil::Verdict verdict = pencil::Verdict::uncertified;
  bool unstable = false;
};

struct FoundPoint {
  sweep::Parameters at;
  double top = 0;  ///< all eigenvalues with |s| up to here are listed, rad/s
  std::vector<FoundEigenvalue> eigenvalues;
};

struct FoundSteady {
  sweep::Parameters at;
  bool converged = false;
  PetscInt open = 0, released = 0;      ///< nodes of all ranks
  double imbalance = 0;                 ///< of its forces, a part of them
  bool unique = true;                   ///< no other solution has been met
  std::vector<std::string> interfaces;  ///< [resultant]
  std::vector<double> forces;           ///< [resultant][normal, friction] magnitudes, N
};

struct FoundCritical {
  sweep::Parameters at;
  double error = 0, angularFrequency = 0, slope = 0;
  int kind = 0;
  bool loss = false, converged = false;
};

struct Outcome {
  std::string refusal;                ///< the message of the Error; empty: there are results
  std::vector<std::string> failures;  ///< of points and stages beside results
  double stiffest = 0;                ///< bound of the angular frequencies of the mesh, rad/s
  std::vector<FoundPoint> points;
  std::vector<FoundSteady> steady;
  std::vector<FoundCritical> criticals;
  PetscInt lost = 0;      ///< nodes that are not tied, because they follow from another tie
  bool followed = false;  ///< eigenvalues are followed, without gaps
};

/// Collective. Returns what an analysis has found.
Outcome outcomeOf(const analysis::Analysis& analysis);
/// Numbers that are not finite survive.
nlohmann::json toJson(const Outcome& outcome);
Outcome fromJson(const nlohmann::json& json);

}  // namespace squeal::fuzz
