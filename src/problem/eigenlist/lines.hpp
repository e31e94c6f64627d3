// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The lines of a printed list, split into words.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace squeal::eigenlist {

struct Line {
  long number = 0;                 ///< counted from 1
  std::string title;               ///< the line without blanks, in capitals
  std::vector<std::string> words;  ///< separated by blanks, tabs, commas and semicolons

  /// Returns true if the title contains this text, in capitals and without blanks.
  bool has(std::string_view text) const { return title.find(text) != std::string::npos; }
};

/// Returns all lines that are not blank.
std::vector<Line> linesOf(std::string_view text);

/// Returns the number of a word; none if it is not a number. Exponents may be Fortran's D.
std::optional<double> number(std::string_view word);
/// Returns the number of a word in a row. Throws Error, naming the line, if it is not a number or
/// not finite.
double finiteNumber(const Line& line, std::size_t word);
/// Returns the whole number ≥ 1 of a word; none if it is none.
std::optional<long> count(std::string_view word);

}  // namespace squeal::eigenlist
