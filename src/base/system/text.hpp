// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Formats texts for messages and tables. Not collective.
#include <string>
#include <vector>

namespace squeal {

/// Returns the text that printf would print.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);
/// Returns the words with the separator between them.
std::string joined(const std::vector<std::string>& words, const std::string& separator = ", ");
/// Returns the parts of the text between the separators, empty parts included; none for an empty
/// text.
std::vector<std::string> split(const std::string& text, char separator);
/// Returns the text without leading and trailing blanks, tabs and line breaks.
std::string trimmed(const std::string& text);
/// Returns the text with escapes, as in JSON (\u and four hexadecimal digits), for characters that
/// a terminal would interpret or not show: control characters except line breaks and tabs,
/// direction marks and characters of zero width. Bytes that are not UTF-8 become \x and two digits.
std::string escaped(const std::string& text);
/// Returns a number, finite and not negative, with this number of significant digits. The text
/// reads as a number that is not smaller than the value: an upper bound remains one when it is
/// printed.
std::string roundedUp(double value, int digits);
/// Does the same for lower bounds: the text does not read as a larger number.
std::string roundedDown(double value, int digits);
/// Returns the shortest decimal text that reads back as the same double.
std::string shortest(double value);

}  // namespace squeal
