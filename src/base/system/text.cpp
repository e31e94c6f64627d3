// SPDX-License-Identifier: BSD-2-Clause
#include "base/system/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace squeal {

std::string formatted(const char* format, ...) {
  va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, format, arguments);
  va_end(arguments);
  std::string text(length, '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  return text;
}

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string all;
  for (const auto& word : words) all += (all.empty() ? "" : separator) + word;
  return all;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin <= text.size() && !text.empty()) {
    const auto end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::string trimmed(const std::string& text) {
  const char* blanks = " \t\r\n";
  const auto begin = text.find_first_not_of(blanks);
  return begin == std::string::npos ? ""
                                    : text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

namespace {

/// A character of a text in UTF-8; the length is 0 if the bytes are not UTF-8.
struct Character {
  std::uint32_t code = 0;
  std::size_t length = 0;
};

Character characterAt(const std::string& text, std::size_t at) {
  const unsigned char lead = text[at];
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || at + length > text.size()) return {};
  std::uint32_t code = lead & (0xff >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    const unsigned char next = text[at + i];
    if ((next & 0xc0) != 0x80) return {};
    code = code << 6 | (next & 0x3f);
  }
  constexpr std::uint32_t least[] = {0x80, 0x800, 0x10000};  // of 2, 3 and 4 bytes
  const bool isSurrogate = code >= 0xd800 && code < 0xe000;
  if (code < least[length - 2] || code > 0x10ffff || isSurrogate) return {};
  return {code, length};
}

/// Returns true for control and format characters (Cc, Cf) and line separators of Unicode that
/// change the direction of other characters or have zero width.
bool isHidden(std::uint32_t code) {
  struct Range {
    std::uint32_t first, last;
  };
  constexpr Range hidden[] = {
      {0x00, 0x08},     {0x0b, 0x1f},     {0x7f, 0x9f},      {0xad, 0xad},     {0x34f, 0x34f},
      {0x61c, 0x61c},   {0x180e, 0x180e}, {0x200b, 0x200f},  {0x2028, 0x202e}, {0x2060, 0x206f},
      {0xfeff, 0xfeff}, {0xfff9, 0xfffb}, {0xe0000, 0xe007f}};
  return std::ranges::any_of(
      hidden, [&](const Range& range) { return code >= range.first && code <= range.last; });
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    const auto [code, length] = characterAt(text, at);
    if (length == 0)
      shown += formatted("\\x%02hhx", text[at]);
    else if (!isHidden(code))
      shown += text.substr(at, length);
    else if (code < 0x10000)
      shown += formatted("\\u%04x", unsigned(code));
    else  // as in JSON, two surrogates
      shown += formatted("\\u%04x\\u%04x", unsigned(0xd7c0 + (code >> 10)),
                         unsigned(0xdc00 + (code & 0x3ff)));
    at += std::max<std::size_t>(length, 1);
  }
  return shown;
}

namespace {

/// Returns the value with these digits. If the nearest such number lies on the wrong side of the
/// value, returns the next one in the direction of the sign.
std::string rounded(double value, int digits, int sign) {
  const std::string nearest = formatted("%.*g", digits, value);
  if (value == 0 || sign * (std::strtod(nearest.c_str(), nullptr) - value) >= 0) return nearest;
  const double unit = std::pow(10, std::floor(std::log10(value)) - digits + 1);
  return formatted("%.*g", digits, value + sign * 0.6 * unit);
}

}  // namespace

std::string roundedUp(double value, int digits) { return rounded(value, digits, 1); }
std::string roundedDown(double value, int digits) { return rounded(value, digits, -1); }

std::string shortest(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return std::string(buffer, end);
}

}  // namespace squeal
