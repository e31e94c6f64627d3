// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/modes/settings.hpp"

#include <petscsys.h>

#include "base/options/options.hpp"
#include "base/petsc/check.hpp"

namespace squeal::modes {
namespace {

const IntegerOption countOption("modes", "modes_count", 200, 1, 1'000'000,
                                "number of free modes (vibration modes without friction), which "
                                "start the basis of the reduced problem");
const ChoiceOption solverOption(
    "modes", "modes_solver", {"auto", "block_lanczos", "eps"}, "auto",
    "eigensolver for the free modes; block_lanczos: this program's EPS type blocklanczos; eps: "
    "krylovschur, or the type in -modes_eps_type; auto: eps if a type is given or the problem is "
    "small, otherwise block_lanczos");
const IntegerOption blockOption(
    "modes", "modes_block_size", 8, 1, 1000,
    "number of right-hand sides for which block_lanczos solves together");
const RealOption toleranceOption("modes", "modes_tolerance", 1e-8, "", {0, 1e-2, true, false},
                                 "tolerance of the relative errors of the eigenvalues of S = "
                                 "inverse(K) M; for the solver eps, -modes_eps_tol overrides it");
const FlagOption sturmOption("modes", "modes_sturm", true,
                             "check by a Sturm count (the inertia of K - sigma M) that no mode is "
                             "missing, at the cost of one more factorisation");

/// Returns true if the user names a type of SLEPc's EPS.
bool isTypeGiven() {
  PetscBool given = PETSC_FALSE;
  check(PetscOptionsHasName(nullptr, "modes_", "-eps_type", &given));
  return given == PETSC_TRUE;
}

}  // namespace

Settings Settings::given() {
  const std::string name = solverOption.get();
  return {.count = countOption.get(),
          .countGiven = countOption.given(),
          .solver = name == "eps" || isTypeGiven() ? Solver::eps
                    : name == "block_lanczos"      ? Solver::blockLanczos
                                                   : Solver::automatic,
          .blockSize = blockOption.get(),
          .tolerance = toleranceOption.get(),
          .sturm = sturmOption.get()};
}

Settings Settings::withCount(int other) const {
  Settings result = *this;
  result.count = other;
  result.countGiven = true;
  return result;
}

}  // namespace squeal::modes
