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
  std::string text;                ///< the line itself

  /// Returns true if the title contains `text`, which must be in capitals and without blanks.
  bool has(std::string_view text) const { return title.find(text) != std::string::npos; }
};

/// Returns the delimiter of a line: the first of semicolon, comma and tab that it contains, or a
/// blank.
char delimiterOf(const Line& line);
/// Returns the cells of a line between these delimiters, without blanks at their ends. A cell may
/// be empty, and double quotes enclose one that contains the delimiter. Between blanks, the cells
/// are the words.
std::vector<std::string> cellsOf(const Line& line, char delimiter);

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
