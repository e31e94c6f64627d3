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
  /// Separated by semicolons, or by commas if the line has none, without blanks at their ends; they
  /// may be empty, and double quotes enclose one that contains a delimiter. The words, if the line
  /// has neither.
  std::vector<std::string> cells;

  /// Returns true if the title contains `text`, which must be in capitals and without blanks.
  bool has(std::string_view text) const { return title.find(text) != std::string::npos; }
};

/// Returns all lines that are not blank.
std::vector<Line> linesOf(std::string_view text);

/// Returns the number that a word contains; none if the word is not a number. An exponent may begin
/// with D, as in Fortran.
std::optional<double> number(std::string_view word);
/// Returns the number in the word with the index `word`. Throws Error, naming the line, if there is
/// no such word or if it is not a finite number.
double finiteNumber(const Line& line, std::size_t word);
/// Returns the number that a word contains if it is a whole number ≥ 1; otherwise none.
std::optional<long> count(std::string_view word);

}  // namespace squeal::eigenlist
