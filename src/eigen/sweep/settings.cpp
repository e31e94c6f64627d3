// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep/settings.hpp"

#include <algorithm>

#include "base/options/options.hpp"
#include "base/system/error.hpp"

namespace squeal::sweep {
namespace {

const RealListOption frictionOption("flutter", "flutter_friction", "0.4", "",
                                    sequencesOf(nonNegative), "friction coefficients of the sweep");
const RealListOption speedOption(
    "flutter", "flutter_speed", "1", "", sequencesOf(positive),
    "swept factors on the velocities of all -motion_* options and of obstacles");
const RealListOption pressureOption(
    "flutter", "flutter_pressure", "1", "", sequencesOf(positive),
    "swept factors on surface pressures, forces and moments (except on groups with "
    "-load_<group>_hydraulic off), and on prescribed displacements of supports and obstacles; "
    "gravity and centrifugal forces are not scaled");
const RealListOption dampingOption(
    "flutter", "flutter_damping", "1", "", sequencesOf(nonNegative),
    "swept factors on the damping of materials, ground dashpots, springs, bushings and free modes; "
    "friction damping is not scaled");

std::vector<double> ascending(const RealListOption& option) {
  auto list = option.get();
  if (list.empty()) throw Error("option " + option.dashed() + ": the list is empty");
  std::sort(list.begin(), list.end());  // each steady solution starts from a neighbour
  if (std::adjacent_find(list.begin(), list.end()) != list.end())
    throw Error("option " + option.dashed() + ": a value is given twice");
  return list;
}

}  // namespace

Settings Settings::given() {
  return {.frictions = ascending(frictionOption),
          .speeds = ascending(speedOption),
          .pressures = ascending(pressureOption),
          .dampings = ascending(dampingOption)};
}

}  // namespace squeal::sweep
