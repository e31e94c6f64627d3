// SPDX-License-Identifier: BSD-2-Clause
#include "problem/matrixfile/matrix_market.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string_view>

#include "base/output/file.hpp"
#include "base/petsc/check.hpp"
#include "base/system/text.hpp"

namespace squeal::matrixfile {
namespace {

/// The lines of a file that are neither empty nor comments, split into words.
class Lines {
 public:
  explicit Lines(const std::filesystem::path& path) : file_(path) {
    if (!file_) throw Error("the file cannot be read");
  }
  /// Moves to the next line. Returns false at the end of the file.
  bool next() {
    while (std::getline(file_, line_)) {
      ++number_;
      split();
      if (count_ > 0 && (number_ == 1 || words_[0][0] != '%')) return true;
    }
    if (file_.bad()) fail("cannot be read");
    return false;
  }
  std::size_t count() const { return count_; }
  std::string_view word(std::size_t i) const { return words_[i]; }
  [[noreturn]] void fail(const std::string& why) const {
    throw Error(formatted("line %lld: ", number_) + why);
  }

  void requireWords(std::size_t wanted, const char* what) const {
    if (count_ != wanted) fail(formatted("%zu words instead of %s", count_, what));
  }
  long long integer(std::size_t i, const char* what) const {
    const std::string_view text = withoutPlus(words_[i]);
    long long value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      fail(what + quoted(i) + " is not a whole number");
    return value;
  }
  double real(std::size_t i) const {
    std::string text(withoutPlus(words_[i]));
    if (const auto exponent = text.find_first_of("Dd"); exponent != std::string::npos)
      text[exponent] = 'e';  // Fortran's
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range)
      fail("the value" + quoted(i) + " is beyond the range of doubles");
    if (error != std::errc() || end != text.data() + text.size())
      fail("the value" + quoted(i) + " is not a number");
    if (!std::isfinite(value)) fail("the value" + quoted(i) + " is not a finite number");
    return value;
  }

 private:
  static std::string_view withoutPlus(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    return text;
  }
  std::string quoted(std::size_t i) const {
    return " '" + std::string(words_[i].substr(0, 40)) + "'";
  }
  /// Splits the line into words, at most one more than expected.
  void split() {
    const std::string_view line = line_, blanks = " \t\r\f\v";
    count_ = 0;
    for (std::size_t begin = line.find_first_not_of(blanks);
         begin < line.size() && count_ < words_.size();) {
      const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
      words_[count_++] = line.substr(begin, end - begin);
      begin = line.find_first_not_of(blanks, end);
    }
  }

  std::ifstream file_;
  std::string line_;
  long long number_ = 0;
  std::array<std::string_view, 6> words_;
  std::size_t count_ = 0;
};

std::string lowerCase(std::string_view word) {
  std::string text(word);
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c += 'a' - 'A';
  return text;
}

/// The contents announced by the first lines.
struct Header {
  bool array = false, pattern = false, integer = false, symmetric = false, skew = false;
  long long rows = 0, columns = 0, count = 0;

  bool oneTriangle() const { return symmetric || skew; }
};

Header kindOf(const Lines& lines) {
  lines.requireWords(5, "%%MatrixMarket, matrix, format, field and symmetry");
  std::array<std::string, 5> word;
  for (std::size_t i = 0; i < word.size(); ++i) word[i] = lowerCase(lines.word(i));
  const auto oneOf = [&](std::size_t i, const std::vector<std::string>& known) {
    for (const auto& name : known)
      if (word[i] == name) return;
    lines.fail("'" + word[i].substr(0, 40) + "' where " + joined(known, " or ") + " is read");
  };
  if (word[3] == "complex") lines.fail("the matrix is complex, not real");
  oneOf(0, {"%%matrixmarket"});
  oneOf(1, {"matrix"});
  oneOf(2, {"coordinate", "array"});
  oneOf(3, {"real", "double", "integer", "unsigned-integer", "pattern"});
  oneOf(4, {"general", "symmetric", "skew-symmetric"});
  Header header;
  header.array = word[2] == "array";
  header.pattern = word[3] == "pattern";
  header.integer = word[3] == "integer" || word[3] == "unsigned-integer";
  header.symmetric = word[4] == "symmetric";
  header.skew = word[4] == "skew-symmetric";
  if (header.pattern && (header.array || header.skew))
    lines.fail("a pattern is a coordinate matrix, general or symmetric");
  return header;
}

Header readHeader(Lines& lines) {
  if (!lines.next()) throw Error("the file is empty");
  Header header = kindOf(lines);
  if (!lines.next())
    throw Error("the file ends before the line with the numbers of rows and columns");
  lines.requireWords(header.array ? 2 : 3,
                     header.array ? "rows and columns" : "rows, columns and entries");
  header.rows = lines.integer(0, "the number of rows");
  header.columns = lines.integer(1, "the number of columns");
  if (header.rows < 0 || header.columns < 0) lines.fail("a negative number of rows or columns");
  const Entries checked(header.rows, header.columns);  // their product must fit into 64 bits
  if (header.oneTriangle() && header.rows != header.columns)
    lines.fail(
        formatted("a symmetric matrix of %lld rows and %lld columns", header.rows, header.columns));
  const long long half = header.rows * (header.rows - 1) / 2;
  if (!header.array)
    header.count = lines.integer(2, "the number of entries");
  else
    header.count = header.symmetric ? half + header.rows
                   : header.skew    ? half
                                    : header.rows * header.columns;
  if (header.count < 0) lines.fail("a negative number of entries");
  return header;
}

/// Adds entries to a matrix, and mirrors the entries of a stored triangle.
class Filler {
 public:
  Filler(const Lines& lines, const Header& header)
      : lines_(lines), header_(header), entries_(header.rows, header.columns) {}
  /// Adds an entry, with row and column counted from 0.
  void add(long long i, long long j, double x) {
    if (header_.oneTriangle() && i != j) requireTriangle(i, j);
    if (header_.skew && i == j && x != 0)
      lines_.fail("the diagonal of a skew-symmetric matrix is zero");
    entries_.add(i, j, x);
    if (header_.oneTriangle() && i != j) entries_.add(j, i, header_.skew ? -x : x);
  }
  Entries take() { return std::move(entries_); }

 private:
  /// Throws Error for entries on both sides of the diagonal, which would be counted twice. The
  /// standard requires the lower triangle, but a file with only the upper one is unambiguous.
  void requireTriangle(long long i, long long j) {
    const bool lower = i > j;
    if (lower ? upper_ : lower_)
      lines_.fail(
          formatted("the entry in row %lld and column %lld is %s the diagonal, earlier ones are %s "
                    "it: the format stores only the lower triangle of a %s matrix",
                    i + 1, j + 1, lower ? "below" : "above", lower ? "above" : "below",
                    header_.skew ? "skew-symmetric" : "symmetric"));
    (lower ? lower_ : upper_) = true;
  }

  const Lines& lines_;
  const Header& header_;
  Entries entries_;
  bool lower_ = false, upper_ = false;
};

double valueOf(const Lines& lines, const Header& header, std::size_t word) {
  if (header.integer &&
      lines.word(word).find_first_not_of("+-0123456789") != std::string_view::npos)
    lines.fail("the value '" + std::string(lines.word(word).substr(0, 40)) +
               "' of a matrix of integers is not a whole number");
  return lines.real(word);
}

long long indexOf(const Lines& lines, std::size_t word, const char* what, long long size) {
  const long long index = lines.integer(word, what);
  if (index < 1 || index > size)
    lines.fail(formatted("%s %lld is outside 1 to %lld", what, index, size));
  return index - 1;
}

void addCoordinate(const Lines& lines, const Header& header, Filler& filler) {
  lines.requireWords(header.pattern ? 2 : 3,
                     header.pattern ? "row and column" : "row, column and value");
  const long long i = indexOf(lines, 0, "row", header.rows),
                  j = indexOf(lines, 1, "column", header.columns);
  filler.add(i, j, header.pattern ? 1 : valueOf(lines, header, 2));
}

/// The index of the next value of an array. Values are stored by columns; columns of a symmetric
/// matrix start at the diagonal, those of a skew-symmetric one below it.
class Place {
 public:
  explicit Place(const Header& header) : header_(header), row_(firstRow()) {}
  long long row() const { return row_; }
  long long column() const { return column_; }
  void advance() {
    if (++row_ < header_.rows) return;
    ++column_;
    row_ = firstRow();
  }

 private:
  long long firstRow() const {
    return header_.symmetric ? column_ : header_.skew ? column_ + 1 : 0;
  }

  const Header& header_;
  long long column_ = 0, row_;
};

}  // namespace

Entries readMatrixMarket(const std::filesystem::path& path) {
  Lines lines(path);
  const Header header = readHeader(lines);
  requireSquare(header.rows, header.columns);
  Filler filler(lines, header);
  Place place(header);
  long long count = 0;
  for (; lines.next(); ++count) {
    if (count == header.count)
      lines.fail(formatted("more than the %lld entries that the header announces", header.count));
    if (!header.array) {
      addCoordinate(lines, header, filler);
      continue;
    }
    lines.requireWords(1, "only the next value");
    filler.add(place.row(), place.column(), valueOf(lines, header, 0));
    place.advance();
  }
  if (count < header.count)
    throw Error(formatted("the file ends after %lld of the %lld entries that its header announces",
                          count, header.count));
  return filler.take();
}

void writeMatrixMarket(const std::filesystem::path& path, const Entries& entries) {
  output::reserve(path, 0);  // rejects links and pipes
  errno = 0;
  std::ofstream file(path);
  file << "%%MatrixMarket matrix coordinate real general\n"
       << entries.rows << ' ' << entries.columns << ' ' << entries.value.size() << '\n';
  for (std::size_t k = 0; k < entries.value.size(); ++k)
    file << entries.row[k] + 1 << ' ' << entries.column[k] + 1
         << formatted(" %.17g\n", entries.value[k]);
  if (!file.flush()) throw output::WriteError(output::cannotWrite(path, errno));
}

}  // namespace squeal::matrixfile
