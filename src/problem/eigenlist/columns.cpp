// SPDX-License-Identifier: BSD-2-Clause
#include "problem/eigenlist/columns.hpp"

#include <algorithm>
#include <map>
#include <numbers>

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

/// Returns the unit that a header states for all of s; none if it states none.
std::optional<Unit> unitOf(const Line& header) {
  if (header.has("HZ") || header.has("HERTZ") || header.has("CYCLES")) return Unit::hertz;
  if (header.has("RAD") || header.has("1/S") || header.has("1_PER_S")) return Unit::radians;
  return {};
}

/// Returns the columns of a table with the names of eigenvalues.csv; none for other headers.
std::optional<Columns> namedColumns(const Line& header) {
  Columns columns{.count = header.words.size(), .constant = {}};
  const auto find = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(header.words, name) - header.words.begin());
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
  const bool hertz = header.has("HZ") || header.has("HERTZ") || header.has("CYCLES"),
             radians = header.has("RAD") || header.has("1/S") || header.has("1_PER_S");
  if (hertz && radians)
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
    }
  }
  return rows;
}

/// Sets the factors of columns without names.
std::string setUnit(const Line* header, std::optional<Unit> unit, Columns& columns) {
  if (header) requireOneUnit(*header);
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
    return "columns, s in 1/s and rad/s";
  columns.realFactor = columns.imaginaryFactor = 2 * std::numbers::pi;
  return "columns, s/(2 pi) in Hz";
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
  // Cells behind those of s may be empty, and are then no words.
  std::size_t least = std::max(columns.real, columns.imaginary) + 1;
  for (const auto place : columns.constant) least = std::max(least, place + 1);
  std::vector<Complex> values;
  for (const auto* row : rows) {
    if (named ? row->words.size() < least : row->words.size() != columns.count)
      throw Error(formatted("line %ld: %zu words instead of %zu%s", row->number, row->words.size(),
                            columns.count, named ? "" : ", the real and the imaginary part"));
    for (const auto place : columns.constant)
      if (row->words[place] != rows[0]->words[place])
        throw Error(
            formatted("line %ld: the table has several points of a sweep; leave the rows "
                      "of one of them",
                      row->number));
    values.emplace_back(columns.realFactor * finiteNumber(*row, columns.real),
                        columns.imaginaryFactor * finiteNumber(*row, columns.imaginary));
  }
  return values;
}

}  // namespace squeal::eigenlist
