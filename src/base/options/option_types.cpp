// SPDX-License-Identifier: BSD-2-Clause
#include "base/options/option_types.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/options/settings.hpp"
#include "base/petsc/check.hpp"
#include "base/system/text.hpp"
#include "base/system/unreadable.hpp"

namespace squeal {

namespace {

nlohmann::json schemaOf(const Range& range) {
  nlohmann::json schema{{"type", "number"}};
  if (std::isfinite(range.low)) schema[range.openLow ? "exclusiveMinimum" : "minimum"] = range.low;
  if (std::isfinite(range.high))
    schema[range.openHigh ? "exclusiveMaximum" : "maximum"] = range.high;
  return schema;
}

}  // namespace

bool Range::contains(double x) const {
  return (openLow ? x > low : x >= low) && (openHigh ? x < high : x <= high);
}

std::string Range::bounds() const {
  std::string words;
  if (std::isfinite(low)) words += (openLow ? " > " : " >= ") + shortest(low);
  if (std::isfinite(high))
    words +=
        (words.empty() ? " " : " and ") + std::string(openHigh ? "< " : "<= ") + shortest(high);
  return words;
}

std::string Range::text() const { return "a number" + bounds(); }

RealOption::RealOption(std::string stage, std::string name, std::optional<double> byDefault,
                       std::string unit, Range range, std::string meaning)
    : Option(std::move(stage), std::move(name),
             byDefault ? std::optional(shortest(*byDefault)) : std::nullopt, std::move(unit),
             std::move(meaning), range.text()),
      range_(range) {}

RealOption::RealOption(std::string stage, std::string name, std::string unit, Range range,
                       std::string meaning)
    : Option(std::move(stage), std::move(name), std::string(), std::move(unit), std::move(meaning),
             range.text()),
      range_(range) {}

double RealOption::parsed(const std::string& subject, const std::string& value) const {
  const double x = number(subject, value);
  if (!range_.contains(x)) reject(subject, value);
  return x;
}

OptionalRealOption::OptionalRealOption(std::string stage, std::string name, std::string unit,
                                       Range range, std::string meaning)
    : RealOption(std::move(stage), std::move(name), std::move(unit), range, std::move(meaning)) {}

std::optional<double> OptionalRealOption::get(const std::string& subject) const {
  if (!given(subject)) return {};
  return RealOption::get(subject);
}

WordOrRealOption::WordOrRealOption(std::string stage, std::string name, double byDefault,
                                   std::string unit, std::string word, std::string meaning)
    : Option(std::move(stage), std::move(name), shortest(byDefault), std::move(unit),
             std::move(meaning), "'" + word + "' or a number"),
      word_(std::move(word)) {}

std::optional<double> WordOrRealOption::parsed(const std::string& subject,
                                               const std::string& value) const {
  return value == word_ ? std::nullopt : std::optional(number(subject, value));
}

IntegerOption::IntegerOption(std::string stage, std::string name, int byDefault, int lowest,
                             int highest, std::string meaning)
    : Option(std::move(stage), std::move(name), std::to_string(byDefault), "", std::move(meaning),
             "an integer >= " + std::to_string(lowest) + " and <= " + std::to_string(highest)),
      lowest_(lowest),
      highest_(highest) {}

int IntegerOption::parsed(const std::string& subject, const std::string& value) const {
  int x = 0;
  const auto [stop, error] = std::from_chars(value.data(), value.data() + value.size(), x);
  if (error != std::errc() || stop != value.data() + value.size() || x < lowest_ || x > highest_)
    reject(subject, value);
  return x;
}

RealListOption::RealListOption(std::string stage, std::string name, std::string byDefault,
                               std::string unit, ListRule entries, std::string meaning)
    : Option(std::move(stage), std::move(name), std::move(byDefault), std::move(unit),
             std::move(meaning),
             std::string(entries.sequences ? "first:last:step or " : "") +
                 "a comma-separated list of numbers" + entries.range.bounds()),
      entries_(entries) {}

void RealListOption::requireLength(const std::string& subject, const std::string& value,
                                   double length) const {
  if (length > longestList)
    throw Error(formatted("%s: %.0f values; a list may contain at most %d",
                          named(subject, value.substr(0, 40)).c_str(), length, longestList));
}

std::vector<double> RealListOption::parsed(const std::string& subject,
                                           const std::string& value) const {
  std::vector<double> list;
  const auto parts = split(value, ':');
  if (entries_.sequences && parts.size() > 1) {
    if (parts.size() != 3) reject(subject, value);
    const double first = number(subject, parts[0]), last = number(subject, parts[1]),
                 step = number(subject, parts[2]);
    if (!(step > 0) || last < first) reject(subject, value);
    requireLength(subject, value, std::floor((last - first) / step) + 1);
    // A small tolerance: 0:0.6:0.05 ends at 0.6, although 12 × 0.05 is not the double nearest to
    // it.
    const int steps = std::floor((last - first) / step + 1e-9);
    for (int i = 0; i <= steps; ++i)
      list.push_back(std::stod(formatted("%.12g", first + i * step)));
  } else {
    const auto items = split(value, ',');
    requireLength(subject, value, items.size());
    for (const auto& item : items) list.push_back(number(subject, item));
  }
  for (double x : list)
    if (!entries_.range.contains(x)) reject(subject, value);
  return list;
}

VectorValue RealListOption::vector(const std::string& subject) const {
  return {get(subject), named(subject, text(subject)) + ": " + meaning};
}

std::array<double, 3> VectorValue::in(int dimension) const {
  if (values_.size() != 3 && (values_.size() != 2 || dimension != 2))
    throw Error(text_ + "; must have " +
                (dimension == 2 ? "2 components in plane problems, or 3" : "3 components"));
  return {values_[0], values_[1], values_.size() == 3 ? values_[2] : 0.0};
}

FlagOption::FlagOption(std::string stage, std::string name, bool byDefault, std::string meaning)
    : Option(std::move(stage), std::move(name), byDefault ? "on" : "off", "", std::move(meaning),
             "on or off") {}

bool FlagOption::parsed(const std::string& subject, const std::string& value) const {
  if (value.empty() || value == "on" || value == "true" || value == "yes" || value == "1")
    return true;
  if (value == "off" || value == "false" || value == "no" || value == "0") return false;
  reject(subject, value);
}

ChoiceOption::ChoiceOption(std::string stage, std::string name, std::vector<std::string> choices,
                           std::string byDefault, std::string meaning)
    : Option(std::move(stage), std::move(name), std::move(byDefault), "", std::move(meaning),
             joined(choices, " or ")),
      choices_(std::move(choices)) {}

std::string ChoiceOption::parsed(const std::string& subject, const std::string& value) const {
  if (std::find(choices_.begin(), choices_.end(), value) == choices_.end()) reject(subject, value);
  return value;
}

TextOption::TextOption(std::string stage, std::string name, std::optional<std::string> byDefault,
                       std::string meaning)
    : Option(std::move(stage), std::move(name), std::move(byDefault), "", std::move(meaning),
             "text") {}

std::string TextOption::parsed(const std::string& subject, const std::string& value) const {
  if (value.empty() && given(subject)) reject(subject, "without a value");
  return value;
}

std::vector<std::string> TextOption::list(const std::string& subject) const {
  const std::string value = get(subject);
  auto items = split(value, ',');
  for (auto& item : items)
    if (item = trimmed(item); item.empty())
      throw Error(named(subject, value) + ": an item of the list is empty");
  return items;
}

FileOption::FileOption(std::string stage, std::string name, std::string meaning)
    : Option(std::move(stage), std::move(name), std::nullopt, "", std::move(meaning), "a file") {}

void FileOption::validate(const std::string& subject) const {
  const std::string path = value(subject);
  onFirstRank(PETSC_COMM_WORLD, named(subject, path) + ": ", [&] {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) throw Error("this is a folder");
    const std::string why = whyUnreadable(path);
    if (why.empty()) return;
    const std::string file = origin(fullName(subject), path).file;
    if (why != noSuchFile || file.empty()) throw Error(why);
    throw Error(why + ", neither next to " + file + " nor in the working folder");
  });
}

bool FileOption::isDeclared(const std::string& full) {
  const auto options = all();
  return std::any_of(options.begin(), options.end(), [&](const auto* option) {
    return dynamic_cast<const FileOption*>(option) && option->matches(full);
  });
}

nlohmann::json RealOption::valueSchema() const { return schemaOf(range_); }

nlohmann::json WordOrRealOption::valueSchema() const {
  return {{"anyOf", {schemaOf(anyReal), {{"const", word_}}}}};
}

nlohmann::json IntegerOption::valueSchema() const {
  return {{"type", "integer"}, {"minimum", lowest_}, {"maximum", highest_}};
}

nlohmann::json RealListOption::valueSchema() const {
  const nlohmann::json one = schemaOf(entries_.range);
  return {{"anyOf",
           {one,
            {{"type", "string"}},
            {{"type", "array"}, {"items", one}, {"minItems", 1}, {"maxItems", longestList}}}}};
}

nlohmann::json FlagOption::valueSchema() const {
  // Editors disagree on whether on and off are words or Booleans. Without a value it is on.
  return {{"enum", {true, false, 0, 1, "on", "off", "yes", "no", "true", "false", nullptr}}};
}

nlohmann::json ChoiceOption::valueSchema() const {
  nlohmann::json values = choices_;
  for (const auto& [word, truth] : {std::pair{"on", true}, {"off", false}})
    if (std::ranges::find(choices_, word) != choices_.end()) values.push_back(truth);
  return {{"enum", values}};
}

nlohmann::json TextOption::valueSchema() const {
  return {{"type", {"string", "number", "boolean", "array", "null"}}};
}

nlohmann::json FileOption::valueSchema() const { return {{"type", "string"}, {"minLength", 1}}; }

void validateGivenOptions() {
  for (const auto* option : Option::all())
    for (const auto& subject : option->name.find('<') == std::string::npos
                                   ? std::vector<std::string>{""}
                                   : option->subjects())
      if (option->given(subject)) option->validate(subject);
}

}  // namespace squeal
