// SPDX-License-Identifier: BSD-2-Clause
#include "base/options/option.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "base/options/settings.hpp"
#include "base/petsc/check.hpp"
#include "base/system/text.hpp"

namespace squeal {
namespace {

std::vector<const Option*>& registry() {
  static std::vector<const Option*> options;
  return options;
}

std::map<std::string, std::string>& recipe() {
  static std::map<std::string, std::string> values;
  return values;
}

/// Returns the value of an option; none if it was not given.
std::optional<std::string> valueGiven(const std::string& name) {
  const auto& given = givenOptions();
  const auto entry = given.find(name);
  if (entry == given.end()) return {};
  return entry->second;
}

}  // namespace

const std::vector<std::string>& stages() {
  static const std::vector<std::string> inOrder = {
      "general",    "mesh",    "frame",   "matrices", "material", "elasticity", "reference",
      "ground",     "spring",  "bushing", "mass",     "coupling", "equation",   "bolt",
      "constraint", "load",    "motion",  "friction", "contact",  "tie",        "steady",
      "modes",      "flutter", "regime",  "referee",  "report"};
  return inOrder;
}

std::size_t stageRank(const std::string& stage) {
  return std::find(stages().begin(), stages().end(), stage) - stages().begin();
}

Option::Option(std::string stage_, std::string name_, std::optional<std::string> byDefault,
               std::string unit_, std::string meaning_, std::string rule_)
    : stage(std::move(stage_)),
      name(std::move(name_)),
      defaultText(byDefault.value_or("")),
      unit(std::move(unit_)),
      meaning(std::move(meaning_)),
      rule(std::move(rule_)),
      required(!byDefault) {
  registry().push_back(this);
}

std::vector<const Option*> Option::all() {
  std::vector<const Option*> options = registry();
  std::stable_sort(options.begin(), options.end(), [](const auto* a, const auto* b) {
    return stageRank(a->stage) < stageRank(b->stage);
  });
  return options;
}

std::string Option::fullName(const std::string& subject) const {
  const auto open = name.find('<');
  if (open == std::string::npos) return name;
  return name.substr(0, open) + subject + name.substr(name.find('>') + 1);
}

bool Option::given(const std::string& subject) const {
  return valueGiven(fullName(subject)).has_value();
}

bool Option::matches(const std::string& full) const {
  const auto open = name.find('<');
  if (open == std::string::npos) return full == name;
  const std::string before = name.substr(0, open), after = name.substr(name.find('>') + 1);
  return full.size() > before.size() + after.size() && full.starts_with(before) &&
         full.compare(full.size() - after.size(), after.size(), after) == 0;
}

std::vector<std::string> Option::subjects() const {
  const auto open = name.find('<');
  const std::size_t around = name.size() - (name.find('>') - open + 1);
  std::set<std::string> found;
  for (const auto& [full, value] : givenOptions())
    if (matches(full)) found.insert(full.substr(open, full.size() - around));
  return {found.begin(), found.end()};
}

std::string Option::value(const std::string& subject) const {
  const std::string full = fullName(subject);
  const auto given = valueGiven(full);
  if (!given && required) throw Error("option -" + full + " is missing: " + meaning);
  return trimmed(given.value_or(defaultText));
}

std::string Option::text(const std::string& subject) const {
  const std::string text = value(subject);
  recipe()[fullName(subject)] = text;
  return text;
}

std::string Option::named(const std::string& subject, const std::string& value) const {
  const std::string full = fullName(subject);
  return optionText(full, value, valueGiven(full).value_or(""));
}

void Option::reject(const std::string& subject, const std::string& value) const {
  throw Error(named(subject, value) + ": " + meaning + (unit.empty() ? "" : " [" + unit + "]") +
              "; must be " + rule);
}

double Option::number(const std::string& subject, const std::string& value) const {
  double x = 0;
  const std::string digits = trimmed(value);
  const char* begin = digits.c_str() + (digits[0] == '+' ? 1 : 0);
  const char* end = digits.c_str() + digits.size();
  const auto [stop, error] = std::from_chars(begin, end, x);
  if (error != std::errc() || stop != end || !std::isfinite(x)) reject(subject, "'" + digits + "'");
  if (x != 0 && (std::abs(x) > largestMagnitude || std::abs(x) < smallestMagnitude))
    throw Error(named(subject, digits) + ": " + meaning + "; must be " + rule +
                ", and zero or of a magnitude between " + shortest(smallestMagnitude) + " and " +
                shortest(largestMagnitude));
  return x;
}

const std::map<std::string, std::string>& resolvedOptions() { return recipe(); }

}  // namespace squeal
