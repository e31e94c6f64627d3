// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep/parameters.hpp"

#include "base/system/text.hpp"

namespace squeal::sweep {

bool growsInFriction(const Parameters& before, const Parameters& at) {
  Parameters lower = at;
  lower.friction = before.friction;
  return lower == before && before.friction < at.friction;
}

std::vector<Parameter> sweptParameters(const std::vector<Parameters>& points) {
  std::vector<Parameter> swept;
  for (const auto& parameter : allParameters)
    for (const auto& at : points)
      if (at.*parameter.value != points.front().*parameter.value) {
        swept.push_back(parameter);
        break;
      }
  return swept;
}

std::string parameterColumns() {
  std::vector<std::string> names;
  for (const auto& parameter : allParameters) names.push_back(parameter.name);
  return joined(names, ",");
}

std::string parameterValues(const Parameters& at) {
  std::vector<std::string> values;
  for (const auto& parameter : allParameters) values.push_back(shortest(at.*parameter.value));
  return joined(values, ",");
}

std::string parameterText(const Parameters& at, int digits) {
  std::string text = formatted("friction %.*g", digits, at.friction);
  for (const auto& parameter : allParameters)
    if (parameter.value != &Parameters::friction && at.*parameter.value != 1)
      text += formatted(", %s %.*g", parameter.name, digits, at.*parameter.value);
  return text;
}

}  // namespace squeal::sweep
