// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/proof/reason.hpp"

#include <cmath>
#include <initializer_list>
#include <utility>

#include "base/system/text.hpp"

namespace squeal::proof {
namespace {

/// Returns the end of a sentence that names the options with a name; each comes with its change.
std::string helping(std::initializer_list<std::pair<const char*, const std::string&>> options) {
  std::string text;
  int count = 0;
  for (const auto& [change, option] : options)
    if (!option.empty()) text += (count++ > 0 ? " or " : "; ") + (change + (" " + option));
  if (count == 0) return text;
  return text + (count > 1 ? " help" : " helps");
}

}  // namespace

std::string reason(const CountProof& count, const Remedies& remedies) {
  const std::string place = formatted("s = %.6g %+.6gi 1/s (%.6g Hz)", count.place.real(),
                                      count.place.imag(), std::abs(count.place) / (2 * M_PI));
  switch (count.verdict) {
    case Verdict::proved:
      return {};
    case Verdict::indefinite:
      return formatted("the space that the basis leaves out is not bounded (delta %.2g)",
                       count.definiteness) +
             helping(
                 {{"a larger", remedies.modes}, {"with strong damping a smaller", remedies.left}});
    case Verdict::irregular:
      return "the reduced problem is singular at the top of the region, or nearly so" +
             helping({{"another", remedies.top}});
    case Verdict::edge:
      return "an eigenvalue lies on the boundary at " + place +
             helping({{"another", remedies.top}});
    case Verdict::ratio:
      return formatted("ratio %.3g at ", count.ratio) + place +
             helping({{"a larger", remedies.modes}, {"another", remedies.top}});
    case Verdict::tooManyDiscs:
      return formatted("%" PetscInt_FMT " expansions do not suffice at ", count.evaluations) +
             place + helping({{"another", remedies.top}, {"a larger", remedies.discs}});
  }
  return {};
}

}  // namespace squeal::proof
