// SPDX-License-Identifier: BSD-2-Clause
#include "problem/eigenlist/columns.hpp"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <map>
#include <numbers>
#include <string_view>
#include <utility>

#include "base/system/error.hpp"
#include "base/system/text.hpp"

namespace squeal::eigenlist {
namespace {

/// The columns of s, and what divides them.
struct Columns {
  std::size_t real = 0, imaginary = 1, count = 2;
  double realFactor = 1, imaginaryFactor = 1;
  std::vector<std::size_t> constant;  ///< columns of the parameters of a point
};

bool isComment(const Line& line) { return line.words[0][0] == '#' || line.words[0][0] == '%'; }

bool isHeader(const Line& line) {
  return isComment(line) || std::ranges::none_of(line.words, [](const std::string& word) {
           return number(word).has_value();
         });
}

/// Replaces all occurrences of a part of a word.
void replaceAll(std::string& word, std::string_view part, std::string_view by) {
  for (auto at = word.find(part); at != std::string::npos; at = word.find(part, at + by.size()))
    word.replace(at, part.size(), by);
}

/// Returns the words of a text in capitals, also those that underscores, brackets and colons
/// separate, with "/" for "per" and units in their short forms: real_rad_per_second has the words
/// REAL and RAD/S, and Re/Hz the words RE and HZ.
std::vector<std::string> wordsOf(std::string_view text) {
  std::vector<std::string> words(1);
  for (const char c : text)
    if (std::string_view(" \t\r,;_()[]{}:=#%\"'").find(c) != std::string_view::npos)
      words.emplace_back();
    else
      words.back() += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  std::erase(words, "");
  for (std::size_t i = 1; i + 1 < words.size(); ++i)
    if (words[i] == "PER") {
      words[i - 1] += "/" + words[i + 1];
      words.erase(words.begin() + static_cast<std::ptrdiff_t>(i),
                  words.begin() + static_cast<std::ptrdiff_t>(i) + 2);
    }
  std::vector<std::string> result;
  for (auto& word : words) {
    while (!word.empty() && (word.back() == '.' || word.back() == '!')) word.pop_back();
    for (const char* second : {"/SECONDS", "/SECOND", "/SEC"}) replaceAll(word, second, "/S");
    replaceAll(word, "RADIANS", "RAD");
    replaceAll(word, "HERTZ", "HZ");
    if (word.size() > 3 && word.ends_with("/HZ")) {
      result.push_back(word.substr(0, word.size() - 3));
      word = "HZ";
    }
    result.push_back(std::move(word));
  }
  return result;
}

bool isOneOf(const std::string& word, std::initializer_list<const char*> words) {
  return std::ranges::find(words, word) != words.end();
}

bool isHertz(const std::string& word) {
  return isOneOf(word, {"HZ", "CYCLES", "CYCLES/S", "CYCLES/TIME"});
}

bool isRadians(const std::string& word) {
  return isOneOf(word, {"RAD", "RAD/S", "RAD/TIME", "1/S", "1/TIME", "S-1", "S^-1"});
}

/// Returns true for other units of frequency.
bool isForeignUnit(const std::string& word) {
  return isOneOf(word, {"KHZ", "MHZ", "GHZ", "DEG", "DEG/S", "DEGREES/S", "RPM", "RAD/MS",
                        "RAD/MIN", "1/MS", "1/MIN", "CYCLES/MIN"});
}

/// Returns the unit that a header states; none if it states none. Throws Error for mixed units:
/// "real 1/s, frequency Hz" is not s in one unit.
std::optional<Unit> unitOf(const Line& header) {
  const auto words = wordsOf(header.text);
  const bool hertz = std::ranges::any_of(words, isHertz),
             radians = std::ranges::any_of(words, isRadians);
  if (hertz && radians)
    throw Error(
        formatted("line %ld: the header names both Hz and rad/s or 1/s; write both columns "
                  "in one of them",
                  header.number));
  if (hertz) return Unit::hertz;
  if (radians) return Unit::radians;
  return {};
}

/// Throws Error if a header names a unit that is not understood.
void rejectForeignUnit(const Line& header) {
  const auto words = wordsOf(header.text);
  if (const auto foreign = std::ranges::find_if(words, isForeignUnit); foreign != words.end())
    throw Error(
        formatted("line %ld: the header names the unit %s; write both columns in rad/s or "
                  "in Hz",
                  header.number, foreign->c_str()));
}

bool namesReal(const std::string& word) { return isOneOf(word, {"REAL", "RE"}); }
bool namesImaginary(const std::string& word) { return isOneOf(word, {"IMAGINARY", "IMAG", "IM"}); }

/// Returns −1 for the name of a column of real parts, 1 for that of imaginary parts, otherwise 0.
int partOf(const std::string& name) {
  const auto words = wordsOf(name);
  const auto has = [&](const auto& names) { return std::ranges::any_of(words, names); };
  const bool real = has(namesReal), imaginary = has(namesImaginary);
  if (real || imaginary) return real && imaginary ? 0 : real ? -1 : 1;
  const bool growth = has([](auto&word) {
    return isOneOf(word, {"GROWTH", "SIGMA"});
  }),
             frequency = has([](auto&word) {
               return isOneOf(word, {"FREQUENCY", "FREQ", "OMEGA"});
             });
  return growth && frequency ? 0 : growth ? -1 : frequency ? 1 : 0;
}

/// Returns true if the header has the names of two columns, that of the imaginary parts first.
/// Throws Error if another text names the imaginary part first.
bool namesImaginaryFirst(const Line& header) {
  const auto names = cellsOf(header, delimiterOf(header));
  if (!isComment(header) && names.size() == 2)
    return partOf(names[0]) == 1 && partOf(names[1]) == -1;
  const auto words = wordsOf(header.text);
  const auto real = std::ranges::find_if(words, namesReal);
  if (real == words.end() || !(std::ranges::find_if(words, namesImaginary) < real)) return false;
  throw Error(
      formatted("line %ld: the header names the imaginary part first; write the real part "
                "in the first column, or a header of two names such as "
                "imaginary_Hz,real_Hz",
                header.number));
}

/// Returns the columns of a table with the names of eigenvalues.csv; none for other headers.
std::optional<Columns> namedColumns(const Line& header) {
  const auto names = cellsOf(header, delimiterOf(header));
  Columns columns{.count = names.size(), .constant = {}};
  const auto find = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  columns.real = find("growth_rate_1_per_s");
  columns.imaginary = find("angular_frequency_rad_per_s");
  if (std::max(columns.real, columns.imaginary) >= columns.count) return {};
  for (const char* name : {"friction", "speed", "pressure", "damping"})
    if (const auto place = find(name); place < columns.count) columns.constant.push_back(place);
  return columns;
}

/// The parts of a table, all borrowed.
struct Table {
  std::vector<const Line*> headers;   ///< before the rows
  std::vector<const Line*> rows;      ///< of numbers
  std::vector<const Line*> comments;  ///< between the rows
};

Table tableOf(const std::vector<Line>& lines) {
  Table table;
  std::vector<const Line*> after;  // comments since the last row
  for (const auto& line : lines) {
    if (!isHeader(line)) {
      table.rows.push_back(&line);
      table.comments.insert(table.comments.end(), after.begin(), after.end());
      after.clear();
    } else if (table.rows.empty()) {
      table.headers.push_back(&line);
    } else if (isComment(line)) {
      after.push_back(&line);
    } else {
      throw Error(
          formatted("line %ld: '%s' is not a finite number", line.number, line.words[0].c_str()));
    }
  }
  return table;
}

/// Returns the unit that the headers state, comments only if no other header does; none if none
/// does.
std::optional<Unit> statedUnit(const Table& table) {
  for (const bool ofComments : {false, true}) {
    std::optional<Unit> found;
    for (const auto* header : table.headers)
      if (isComment(*header) == ofComments)
        if (const auto unit = unitOf(*header)) found = unit;  // the last one
    if (found) return found;
  }
  return {};
}

/// Sets the order and the factors of columns without names.
std::string setUnit(const Table& table, std::optional<Unit> unit, Columns& columns) {
  const auto stated = statedUnit(table);
  if (stated && unit && *stated != *unit)
    throw Error("the header states another unit than -referee_unit; leave the option out");
  for (const auto* header : table.headers)
    if (!isComment(*header) || (!stated && !unit)) rejectForeignUnit(*header);
  if (!stated && !unit)
    throw Error(
        "the unit of the two columns is not known; give -referee_unit rad or Hz, or a header line "
        "such as real_rad_per_s,imaginary_rad_per_s");
  const Unit used = stated ? *stated : *unit;
  for (const auto* comment : table.comments)
    if (const auto other = unitOf(*comment); other && *other != used)
      throw Error(
          formatted("line %ld: this comment between rows names another unit than that of "
                    "the rows above",
                    comment->number));
  std::string order;
  for (const auto* header : table.headers)
    if (order.empty() && namesImaginaryFirst(*header)) {
      std::swap(columns.real, columns.imaginary);
      order = ", the imaginary part first";
    }
  if (used == Unit::radians) return "columns, s in 1/s and rad/s" + order;
  columns.realFactor = columns.imaginaryFactor = 2 * std::numbers::pi;
  return "columns, s/(2 pi) in Hz" + order;
}

}  // namespace

std::vector<Complex> columns(const std::vector<Line>& lines, std::optional<Unit> unit,
                             std::string& layout) {
  const auto table = tableOf(lines);
  std::optional<Columns> named;
  char delimiter = ' ';
  for (const auto* header : table.headers)
    if (!named && (named = namedColumns(*header))) delimiter = delimiterOf(*header);
  Columns columns = named.value_or(Columns{});
  if (named && unit == Unit::hertz)
    throw Error("the names of the columns state rad/s; leave -referee_unit out");
  layout = named ? "columns growth_rate_1_per_s and angular_frequency_rad_per_s"
                 : setUnit(table, unit, columns);
  std::vector<Complex> values;
  std::vector<std::string> first;  // words, or cells of a table with names, which may be empty
  for (const auto* line : table.rows) {
    Line row = *line;
    if (named) row.words = cellsOf(*line, delimiter);
    if (first.empty()) first = row.words;
    if (row.words.size() != columns.count)
      throw Error(formatted("line %ld: %zu %s instead of %zu%s", row.number, row.words.size(),
                            named ? "cells" : "words", columns.count,
                            named ? "" : ", the real and the imaginary part"));
    for (const auto place : columns.constant)
      if (row.words[place] != first[place])
        throw Error(
            formatted("line %ld: the table has several points of a sweep; leave the rows "
                      "of one of them",
                      row.number));
    values.emplace_back(columns.realFactor * finiteNumber(row, columns.real),
                        columns.imaginaryFactor * finiteNumber(row, columns.imaginary));
  }
  return values;
}

}  // namespace squeal::eigenlist
