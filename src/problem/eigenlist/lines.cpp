// SPDX-License-Identifier: BSD-2-Clause
#include "problem/eigenlist/lines.hpp"

#include <charconv>
#include <cmath>
#include <utility>

#include "base/system/error.hpp"
#include "base/system/text.hpp"

namespace squeal::eigenlist {
namespace {

bool isSeparator(char c) { return c == ' ' || c == '\t' || c == '\r' || c == ',' || c == ';'; }

Line lineOf(std::string_view text, long number) {
  Line line{.number = number, .title = {}, .words = {}, .text = std::string(text)};
  std::string word;
  for (const char c : text) {
    if (isSeparator(c)) {
      if (!word.empty()) line.words.push_back(std::move(word));
      word.clear();
      continue;
    }
    word += c;
    line.title += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  if (!word.empty()) line.words.push_back(std::move(word));
  return line;
}

}  // namespace

char delimiterOf(const Line& line) {
  for (const char delimiter : {';', ',', '\t'})
    if (line.text.find(delimiter) != std::string::npos) return delimiter;
  return ' ';
}

std::vector<std::string> cellsOf(const Line& line, char delimiter) {
  if (delimiter == ' ') return line.words;
  std::vector<std::string> cells(1);
  bool isQuoted = false;
  for (const char c : line.text) {
    if (c == '"') isQuoted = !isQuoted;
    if (c == delimiter && !isQuoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  for (auto& cell : cells) {
    const auto first = cell.find_first_not_of(" \t\r");
    cell = first == std::string::npos
               ? ""
               : cell.substr(first, cell.find_last_not_of(" \t\r") + 1 - first);
  }
  return cells;
}

std::vector<Line> linesOf(std::string_view text) {
  std::vector<Line> lines;
  for (long number = 1; !text.empty(); ++number) {
    const auto end = text.find('\n');
    if (auto line = lineOf(text.substr(0, end), number); !line.words.empty())
      lines.push_back(std::move(line));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

std::optional<double> number(std::string_view word) {
  std::string text(word.starts_with('+') ? word.substr(1) : word);
  if (const auto exponent = text.find_first_of("Dd"); exponent != std::string::npos)
    text[exponent] = 'e';
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) return {};
  if (error == std::errc::result_out_of_range) return INFINITY;
  return value;
}

double finiteNumber(const Line& line, std::size_t word) {
  const auto value = word < line.words.size() ? number(line.words[word]) : std::nullopt;
  if (value && std::isfinite(*value)) return *value;
  throw Error(formatted("line %ld: '%s' is not a finite number", line.number,
                        word < line.words.size() ? line.words[word].c_str() : ""));
}

std::optional<long> count(std::string_view word) {
  long value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value < 1) return {};
  return value;
}

}  // namespace squeal::eigenlist
