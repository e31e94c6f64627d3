// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/stability/settings.hpp"

#include <cmath>

#include "base/options/options.hpp"
#include "eigen/pencil/settings.hpp"

namespace squeal::stability {
namespace {

const FlagOption trackOption(
    "flutter", "flutter_track", true,
    "tracking of the eigenvalues in the band as the friction changes, through crossings and "
    "mergers: branches.csv; reduced method only. A run with a single friction (tracked from "
    "0 if the contact stays the same), or with terms that depend on the steady state (friction "
    "damping, prestress), "
    "tracks only if this option or -flutter_critical is given as on");
const FlagOption criticalOption(
    "flutter", "flutter_critical", true,
    "search for the frictions at which stability changes: critical.csv; needs -flutter_track");
const RealOption toleranceOption("flutter", "flutter_critical_tolerance", 1e-8, "", positive,
                                 "convergence tolerance of a critical friction: its basis is "
                                 "improved until the friction changes by less than this fraction");
const IntegerOption halvingsOption("flutter", "flutter_track_halvings", 10, 0, 50,
                                   "largest number of times that a step of the sweep is halved "
                                   "where the tracking of an eigenvalue is uncertain");

}  // namespace

Settings Settings::given(const pencil::Settings& problem) {
  Settings settings;
  settings.track = trackOption.get();
  if (!settings.track) return settings;
  settings.requested = trackOption.given() || (criticalOption.given() && criticalOption.get());
  if (problem.method == pencil::Method::direct) return settings;
  settings.smallest = std::ldexp(1.0, -halvingsOption.get());
  settings.critical = criticalOption.get();
  if (settings.critical) settings.tolerance = toleranceOption.get();
  return settings;
}

}  // namespace squeal::stability
