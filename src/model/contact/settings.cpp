// SPDX-License-Identifier: BSD-2-Clause
#include "model/contact/settings.hpp"

#include "base/options/options.hpp"
#include "base/petsc/check.hpp"

namespace squeal::contact {
namespace {

const ChoiceOption lawOption(
    "friction", "friction_law", {"constant", "exponential", "table"}, "constant",
    "factor on the coefficient of friction at the sliding speed |w|; constant: 1; exponential: 1 + "
    "(r - 1) exp(-|w|/v); table: from a table");
const RealOption ratioOption(
    "friction", "friction_static_ratio", 1, "", nonNegative,
    "ratio r of the exponential law: coefficient at rest divided by that at high speed");
const RealOption decayOption("friction", "friction_decay_speed", 1, "m/s", positive,
                             "decay speed v of the exponential law");
const RealListOption tableSpeedOption("friction", "friction_table_speed", "0", "m/s", nonNegative,
                                      "ascending sliding speeds of the table");
const RealListOption tableFactorOption(
    "friction", "friction_table_factor", "1", "", nonNegative,
    "factors at the speeds of the table; linear between these speeds, constant beyond");

/// Throws Error for a given option of another law.
void rejectIdle(const std::string& law) {
  const auto idle = [&](const Option& option, const char* owner) {
    if (option.given() && law != owner)
      throw Error("option " + option.dashed() + " is used only by -friction_law " + owner +
                  ", not by '" + law + "'");
  };
  idle(ratioOption, "exponential");
  idle(decayOption, "exponential");
  idle(tableSpeedOption, "table");
  idle(tableFactorOption, "table");
}

FrictionLaw tableGiven() {
  auto speeds = tableSpeedOption.get(), factors = tableFactorOption.get();
  if (speeds.empty() || speeds.size() != factors.size())
    throw Error("options " + tableSpeedOption.dashed() + " and " + tableFactorOption.dashed() +
                ": the lists must have the same length");
  for (std::size_t i = 0; i + 1 < speeds.size(); ++i)
    if (!(speeds[i] < speeds[i + 1]))
      throw Error("option " + tableSpeedOption.dashed() + ": the speeds must ascend");
  return FrictionLaw::table(std::move(speeds), std::move(factors));
}

}  // namespace

Settings Settings::given() {
  const std::string law = lawOption.get();
  rejectIdle(law);
  if (law == "exponential") return {FrictionLaw::exponential(ratioOption.get(), decayOption.get())};
  if (law == "table") return {tableGiven()};
  return {};
}

}  // namespace squeal::contact
