// SPDX-License-Identifier: BSD-2-Clause
#include "steady/uniqueness/settings.hpp"

#include "base/options/options.hpp"

namespace squeal::uniqueness {
namespace {

const FlagOption wantedOption("steady", "steady_uniqueness", true,
                              "check whether a steady state exists and is unique; costs one "
                              "factorisation in all, and one solve per contact node");
const IntegerOption denseOption(
    "steady", "steady_uniqueness_dense", 1000, 0, 40'000,
    "largest number of contact nodes for which the condensed matrix of the contact is formed; for "
    "more nodes, an iteration finds the friction up to which this matrix is positive definite");
const IntegerOption pMatrixOption(
    "steady", "steady_uniqueness_pmatrix", 18, 0, 30,
    "largest number n of contact nodes for the P-matrix test, which takes 2^n pivots");

}  // namespace

Settings Settings::given() {
  Settings settings;
  settings.wanted = wantedOption.get();
  if (!settings.wanted) return settings;
  settings.dense = denseOption.get();
  settings.pMatrix = pMatrixOption.get();
  return settings;
}

}  // namespace squeal::uniqueness
