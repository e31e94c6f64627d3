#include "model/contact/friction.hpp"

#include <algorithm>
#include <cmath>

#include "base/options/options.hpp"
#include "base/petsc/check.hpp"

namespace squeal::contact {
namespace {

const ChoiceOption lawOption("contact", "friction_law", {"constant", "exponential", "table"},
                             "constant",
                             "coefficient of friction at the sliding speed |w|: -flutter_friction "
                             "times 1, times 1 + (r - 1) exp(-|w|/v), "
                             "or times a table's factor");
const RealOption ratioOption("contact", "friction_static_ratio", 1, "", nonNegative,
                             "r, exponential law: coefficient at rest over that at high speed");
const RealOption decayOption("contact", "friction_decay_speed", 1, "m/s", positive,
                             "v, exponential law: speed of the decay");
const RealListOption tableSpeedOption("contact", "friction_table_speed", "0", "m/s", nonNegative,
                                      "ascending sliding speeds of the table");
const RealListOption tableFactorOption(
    "contact", "friction_table_factor", "1", "", nonNegative,
    "factors at these speeds, linear between them and constant beyond");

/// Throws Error for a given option of another law.
void rejectIdle(const std::string& law) {
  const auto idle = [&](const Option& option, const char* owner) {
    if (option.given() && law != owner)
      throw Error("option -" + option.fullName() + " is used by -friction_law " + owner +
                  " alone, not by '" + law + "'");
  };
  idle(ratioOption, "exponential");
  idle(decayOption, "exponential");
  idle(tableSpeedOption, "table");
  idle(tableFactorOption, "table");
}

}  // namespace

FrictionLaw FrictionLaw::read() {
  FrictionLaw law;
  const std::string name = lawOption.get();
  rejectIdle(name);
  if (name == "exponential") {
    law.kind_ = Kind::exponential;
    law.staticRatio_ = ratioOption.get();
    law.decaySpeed_ = decayOption.get();
  } else if (name == "table") {
    law.kind_ = Kind::table;
    law.speeds_ = tableSpeedOption.get();
    law.factors_ = tableFactorOption.get();
    if (law.speeds_.empty() || law.speeds_.size() != law.factors_.size())
      throw Error("options -" + tableSpeedOption.fullName() + " and -" +
                  tableFactorOption.fullName() + ": the lists must have the same length");
    for (std::size_t i = 0; i + 1 < law.speeds_.size(); ++i)
      if (!(law.speeds_[i] < law.speeds_[i + 1]))
        throw Error("option -" + tableSpeedOption.fullName() + ": the speeds must ascend");
  }
  return law;
}

/// Returns the number of knots of the table at or below the speed.
std::size_t FrictionLaw::interval(double speed) const {
  return std::upper_bound(speeds_.begin(), speeds_.end(), speed) - speeds_.begin();
}

double FrictionLaw::value(double speed) const {
  if (kind_ == Kind::constant) return 1;
  if (kind_ == Kind::exponential) return 1 + (staticRatio_ - 1) * std::exp(-speed / decaySpeed_);
  const std::size_t i = interval(speed);
  if (i == 0) return factors_.front();
  return factors_[i - 1] + slope(speed) * (speed - speeds_[i - 1]);
}

double FrictionLaw::slope(double speed) const {
  if (kind_ == Kind::constant) return 0;
  if (kind_ == Kind::exponential)
    return -(staticRatio_ - 1) / decaySpeed_ * std::exp(-speed / decaySpeed_);
  const std::size_t i = interval(speed);
  if (i == 0 || i == speeds_.size()) return 0;
  return (factors_[i] - factors_[i - 1]) / (speeds_[i] - speeds_[i - 1]);
}

}  // namespace squeal::contact
