// SPDX-License-Identifier: BSD-2-Clause
#include "problem/eigenlist/listings.hpp"

#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "base/system/error.hpp"
#include "base/system/text.hpp"

namespace squeal::eigenlist {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// Returns true if the line is a title of the program. Tables of real eigenvalues have others.
bool isTitle(const std::vector<Line>& lines, std::size_t i, Format format) {
  const Line& line = lines[i];
  switch (format) {
    case Format::abaqus:
      return line.has("COMPLEXEIGENVALUEOUTPUT");
    case Format::nastran:
      return line.has("COMPLEXEIGENVALUESUMMARY");
    case Format::ansys:
      return line.has("COMPLEXFREQUENCY(HERTZ)") || line.has("COMPLEXFREQUENCIES(HERTZ)");
    case Format::calculix:
      for (std::size_t next = i + 1; next < lines.size() && next <= i + 3; ++next)
        if (line.title == "EIGENVALUEOUTPUT" && lines[next].has("IMAGINARYPART")) return true;
      return false;
    default:
      return false;
  }
}

/// Throws Error unless two figures of a row agree to their printed digits.
void requireEqual(const Line& line, double a, double b, double size, const char* what) {
  if (std::abs(a - b) <= 2e-3 * size) return;
  throw Error(formatted("line %ld: %s", line.number, what));
}

/// Returns s of Re s and Im s in rad/s, and checks the cycles and the damping ratio of the row.
Complex checked(const Line& line, Complex s, double cycles, double ratio) {
  const double size = std::abs(s.imag());
  requireEqual(line, std::abs(cycles) * turn, size, size,
               "the frequencies in rad/s and in cycles of this row do not agree");
  // Printed digits of the real part are unknown, so only a wrong sign or column is noticed.
  if (size > 0 && std::abs(ratio) > 1e-4 && s.real() != 0)
    requireEqual(line, ratio / std::abs(ratio), s.real() < 0 ? 1 : -1, 1,
                 "the signs of the real part and of the damping ratio do not agree; a damping "
                 "ratio is positive where the real part is negative");
  return s;
}

Complex abaqusRow(const Line& line) {
  const double real = finiteNumber(line, 1), second = finiteNumber(line, 2);
  if (line.words.size() >= 5)
    return checked(line, {real, second}, finiteNumber(line, 3), finiteNumber(line, 4));
  const double imaginary = turn * second;
  return checked(line, {real, imaginary}, second, finiteNumber(line, 3));
}

Complex calculixRow(const Line& line) {
  const std::size_t first = line.words.size() >= 5 ? 2 : 1;  // after the nodal diameter, if any
  const double frequency = finiteNumber(line, first);
  return checked(line, {-finiteNumber(line, first + 2), frequency}, finiteNumber(line, first + 1),
                 0);
}

Complex nastranRow(const Line& line) {
  return checked(line, {finiteNumber(line, 2), finiteNumber(line, 3)}, finiteNumber(line, 4),
                 finiteNumber(line, 5));
}

/// Reads a row of Ansys; `first` is 1 after the number of the mode, 0 for its conjugate.
Complex ansysRow(const Line& line, std::size_t first) {
  const Complex s = turn * Complex(finiteNumber(line, first), finiteNumber(line, first + 1));
  if (line.words.size() > first + 3)
    checked(line, s, s.imag() / turn, finiteNumber(line, first + 3));
  return s;
}

bool isConjugate(const Line& line) {
  return line.words.size() >= 3 && (line.words[2] == "j" || line.words[2] == "J") &&
         number(line.words[0]) && number(line.words[1]);
}

Complex rowOf(const Line& line, Format format) {
  switch (format) {
    case Format::abaqus:
      return abaqusRow(line);
    case Format::calculix:
      return calculixRow(line);
    case Format::nastran:
      return nastranRow(line);
    default:
      return ansysRow(line, 1);
  }
}

/// Returns true if the line has as many words as a row of the program.
bool isRow(const Line& line, Format format) {
  const std::size_t words = line.words.size();
  switch (format) {
    case Format::abaqus:
      return words == 4 || words == 5;
    case Format::calculix:
      return words == 4 || words == 5;
    case Format::nastran:
      return words == 6;
    default:
      return words >= 4 && (line.words[3] == "j" || line.words[3] == "J");
  }
}

}  // namespace

Format formatOf(const std::vector<Line>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const auto format : {Format::abaqus, Format::nastran, Format::calculix, Format::ansys})
      if (isTitle(lines, i, format)) return format;
  return Format::columns;
}

std::string layoutOf(Format format) {
  switch (format) {
    case Format::abaqus:
      return "Abaqus, real parts in 1/s, frequencies in rad/s or cycles, damping ratio -2 Re s/|Im "
             "s|";
    case Format::calculix:
      return "CalculiX, frequencies of motions exp(i omega t) in rad/s, growth rate -Im omega";
    case Format::nastran:
      return "Nastran, s in 1/s and rad/s";
    case Format::ansys:
      return "Ansys, s/(2 pi) in Hz";
    default:
      return "columns";
  }
}

namespace {

/// Returns true if a number, or what may be one, follows the number of the mode.
bool hasFigures(const Line& line) {
  return line.words.size() > 1 &&
         std::string_view("+-.0123456789").find(line.words[1][0]) != std::string_view::npos;
}

/// Returns true if the figures of a row agree with each other, which those of other tables do not.
bool isConsistent(const Line& line, Format format) {
  try {
    const Complex s = rowOf(line, format);
    const double size = std::abs(s.imag());
    if (size == 0) return false;
    if (format != Format::abaqus || line.words.size() > 4) return true;
    const double ratio = -2 * s.real() / size;
    return std::abs(finiteNumber(line, 3) - ratio) <= 1e-4 + 0.01 * std::abs(ratio);
  } catch (const Error&) {
    return false;
  }
}

/// Reads the tables of a format.
class Tables {
 public:
  explicit Tables(Format format) : format_(format) {}
  /// Takes a title, which begins a table or continues it on a new page.
  void begin() { place_ = Place::head; }
  void take(const Line& line);

  List list;  ///< `values` contain the conjugates

 private:
  enum class Place { outside, head, rows, between };  // between: after text that follows rows
  void takeRow(const Line& line, long mode);
  void add(const Line& line, long mode);

  Format format_;
  Place place_ = Place::outside;
  long last_ = 0;          // mode of the last row
  std::size_t words_ = 0;  // of a row
};

void Tables::take(const Line& line) {
  if (place_ == Place::outside) return;
  if (format_ == Format::ansys && !list.values.empty() && isConjugate(line)) {
    list.values.push_back(ansysRow(line, 0));
    return;
  }
  const std::size_t place = format_ == Format::calculix && line.words.size() == 5 ? 1 : 0;
  if (const auto mode = count(line.words[place]))
    takeRow(line, *mode);
  else if (place_ == Place::rows)
    place_ = Place::between;
}

/// Takes a line that begins with a mode, or another number.
void Tables::takeRow(const Line& line, long mode) {
  const bool isWhole = isRow(line, format_);
  if (place_ == Place::between) {
    if (!hasFigures(line)) return;  // such as the number of a page
    if (isWhole && line.words.size() == words_ && mode > last_ && isConsistent(line, format_))
      add(line, mode);
    else
      place_ = Place::outside;  // another table
    return;
  }
  if (isWhole) return add(line, mode);
  if (mode == last_ + 1 && (hasFigures(line) || (last_ > 0 && line.words.size() == 1)))
    throw Error(formatted("line %ld: this is not a whole row of mode %ld: %zu words", line.number,
                          mode, line.words.size()));
}

void Tables::add(const Line& line, long mode) {
  if (mode <= last_)
    throw Error(
        formatted("line %ld: mode %ld again: the file has several tables of eigenvalues; "
                  "leave one of them in it",
                  line.number, mode));
  if (format_ != Format::ansys && words_ > 0 && line.words.size() != words_)
    throw Error(formatted("line %ld: %zu words instead of %zu as in the rows above", line.number,
                          line.words.size(), words_));
  list.skipped += mode - last_ - 1;
  place_ = Place::rows;
  last_ = mode;
  words_ = line.words.size();
  list.values.push_back(rowOf(line, format_));
}

}  // namespace

List listed(const std::vector<Line>& lines, Format format) {
  Tables tables(format);
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (isTitle(lines, i, format))
      tables.begin();
    else
      tables.take(lines[i]);
  return std::move(tables.list);
}

}  // namespace squeal::eigenlist
