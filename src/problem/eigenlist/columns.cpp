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

/// Returns the words of a header in capitals, also those that underscores, brackets and colons
/// separate, with "/" for "per": "real_rad_per_s" has the words REAL and RAD/S.
std::vector<std::string> wordsOf(const Line& header) {
  std::vector<std::string> words(1);
  for (const auto& word : header.words) {
    for (const char c : word)
      if (std::string_view("_()[]{}:=#%\"'").find(c) != std::string_view::npos)
        words.emplace_back();
      else
        words.back() += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    words.emplace_back();
  }
  std::erase(words, "");
  for (std::size_t i = 1; i + 1 < words.size(); ++i)
    if (words[i] == "PER") {
      words[i - 1] += "/" + words[i + 1];
      words.erase(words.begin() + i, words.begin() + i + 2);
    }
  return words;
}

bool isOneOf(const std::string& word, std::initializer_list<const char*> words) {
  return std::ranges::find(words, word) != words.end();
}

bool isHertz(const std::string& word) {
  return isOneOf(word, {"HZ", "HERTZ", "CYCLES", "CYCLES/S", "CYCLES/SEC", "CYCLES/TIME"});
}

bool isRadians(const std::string& word) {
  return isOneOf(word, {"RAD", "RADIANS", "RAD/S", "RAD/SEC", "RADIANS/S", "RAD/TIME", "1/S",
                        "1/SEC", "S-1", "S^-1"});
}

/// Returns true for other units of frequency.
bool isForeignUnit(const std::string& word) {
  const bool isMultiple = word.ends_with("HZ") || word.ends_with("HERTZ");
  return (isMultiple && !isHertz(word)) || word.starts_with("DEG") || word == "RPM" ||
         word.starts_with("RAD/M") || word.starts_with("1/M") || word.starts_with("CYCLES/M");
}

/// Returns the unit that a header states for all of s; none if it states none. Throws Error for
/// units that are not understood.
std::optional<Unit> unitOf(const Line& header) {
  const auto words = wordsOf(header);
  if (const auto foreign = std::ranges::find_if(words, isForeignUnit); foreign != words.end())
    throw Error(
        formatted("line %ld: the header names the unit %s; write both columns in rad/s or "
                  "in Hz",
                  header.number, foreign->c_str()));
  if (std::ranges::any_of(words, isHertz)) return Unit::hertz;
  if (std::ranges::any_of(words, isRadians)) return Unit::radians;
  return {};
}

/// Returns true if the header names the imaginary part first. Throws Error unless the header
/// consists of the names of two columns.
bool namesImaginaryFirst(const Line& header) {
  const auto words = wordsOf(header);
  const auto real = std::ranges::find_if(words, [](const auto& word) {
    return isOneOf(word, {"REAL", "RE", "GROWTH", "SIGMA"});
  });
  const auto imaginary = std::ranges::find_if(words, [](const auto& word) {
    return isOneOf(word, {"IMAGINARY", "IMAG", "IM", "FREQUENCY", "FREQ", "OMEGA"});
  });
  if (real == words.end() || !(imaginary < real)) return false;
  if (!isComment(header) && header.cells.size() == 2) return true;
  throw Error(
      formatted("line %ld: the header names the imaginary part first; write the real part "
                "in the first column, or a header of two names such as "
                "imaginary_Hz,real_Hz",
                header.number));
}

/// Returns the columns of a table with the names of eigenvalues.csv; none for other headers.
std::optional<Columns> namedColumns(const Line& header) {
  Columns columns{.count = header.cells.size(), .constant = {}};
  const auto find = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(header.cells, name) - header.cells.begin());
  };
  columns.real = find("growth_rate_1_per_s");
  columns.imaginary = find("angular_frequency_rad_per_s");
  if (std::max(columns.real, columns.imaginary) >= columns.count) return {};
  for (const char* name : {"friction", "speed", "pressure", "damping"})
    if (const auto place = find(name); place < columns.count) columns.constant.push_back(place);
  return columns;
}

/// Throws Error for a header of mixed units: "real 1/s, frequency Hz" is not s in one unit.
void requireOneUnit(const Line& header) {
  const auto words = wordsOf(header);
  if (std::ranges::any_of(words, isHertz) && std::ranges::any_of(words, isRadians))
    throw Error(
        formatted("line %ld: the header names both Hz and rad/s or 1/s; write both columns "
                  "in one of them",
                  header.number));
}

/// Returns the rows of numbers, and the header before them, if any.
std::vector<const Line*> rowsOf(const std::vector<Line>& lines, const Line*& header) {
  std::vector<const Line*> rows;
  for (const auto& line : lines) {
    if (!isHeader(line)) {
      rows.push_back(&line);
    } else if (rows.empty()) {
      if (!header || unitOf(line)) header = &line;
    } else if (!isComment(line)) {
      throw Error(
          formatted("line %ld: '%s' is not a finite number", line.number, line.words[0].c_str()));
    } else if (const auto unit = unitOf(line); unit && !(header && unitOf(*header) == unit)) {
      throw Error(formatted(
          "line %ld: this comment between rows names another unit than the header", line.number));
    }
  }
  return rows;
}

/// Sets the factors of columns without names.
std::string setUnit(const Line* header, std::optional<Unit> unit, Columns& columns) {
  if (header) requireOneUnit(*header);
  const bool swapped = header && namesImaginaryFirst(*header);
  if (swapped) std::swap(columns.real, columns.imaginary);
  const std::string order = swapped ? ", the imaginary part first" : "";
  const auto stated = header ? unitOf(*header) : std::nullopt;
  if (stated && unit && *stated != *unit)
    throw Error(
        formatted("line %ld: the header states another unit than -referee_unit; leave the "
                  "option out",
                  header->number));
  if (!stated && !unit)
    throw Error(
        "the unit of the two columns is not known; give -referee_unit rad or Hz, or a header line "
        "such as real_rad_per_s,imaginary_rad_per_s");
  if (stated.value_or(unit.value_or(Unit::radians)) == Unit::radians)
    return "columns, s in 1/s and rad/s" + order;
  columns.realFactor = columns.imaginaryFactor = 2 * std::numbers::pi;
  return "columns, s/(2 pi) in Hz" + order;
}

}  // namespace

std::vector<Complex> columns(const std::vector<Line>& lines, std::optional<Unit> unit,
                             std::string& layout) {
  const Line* header = nullptr;
  const auto rows = rowsOf(lines, header);
  const auto named = header ? namedColumns(*header) : std::nullopt;
  Columns columns = named.value_or(Columns{});
  if (named && unit == Unit::hertz)
    throw Error("the names of the columns state rad/s; leave -referee_unit out");
  layout = named ? "columns growth_rate_1_per_s and angular_frequency_rad_per_s"
                 : setUnit(header, unit, columns);
  std::vector<Complex> values;
  std::vector<std::string> first;  // words, or cells of a table with names, which may be empty
  for (const auto* line : rows) {
    Line row = *line;
    if (named) row.words = row.cells;
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
