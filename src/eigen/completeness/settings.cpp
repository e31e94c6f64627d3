// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/completeness/settings.hpp"

#include "base/options/options.hpp"

namespace squeal::completeness {
namespace {

const FlagOption proofOption(
    "flutter", "flutter_proof", false,
    "proof, at each point of the sweep, that the full problem has exactly the listed eigenvalues "
    "in the band, each in a disc of known radius; takes four to eight solves per contact node, "
    "one or more per vector of the basis, and some seconds of dense algebra per point, up to a "
    "minute with damping or rotation");
const IntegerOption discsOption("flutter", "flutter_proof_discs", 400, 1, 1'000'000,
                                "largest number of discs in the complex plane that cover the "
                                "boundary of the region of the proof, per point");

}  // namespace

Settings Settings::given() {
  Settings settings;
  settings.wanted = proofOption.get();
  if (settings.wanted) settings.discs = discsOption.get();
  return settings;
}

}  // namespace squeal::completeness
