#pragma once
/// These functions make text for messages and tables. Not collective.
#include <string>
#include <vector>

namespace squeal {

/// Returns the text that printf would print.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);
/// Returns the words with the separator between them.
std::string joined(const std::vector<std::string>& words, const std::string& separator = ", ");
/// Returns the parts between the separators, empty parts included; none for an empty text.
std::vector<std::string> split(const std::string& text, char separator);
/// Returns the text without blanks, tabs and line ends around it.
std::string trimmed(const std::string& text);
/// Returns the text with \u and four hexadecimal digits, as in JSON, for each character of a name
/// that a terminal would obey or not show: control characters except for line breaks and tabs,
/// marks of the direction of writing, characters without a width, and bytes that are not UTF-8
/// (\x and two digits).
std::string escaped(const std::string& text);
/// Returns the shortest decimal text that reads back as the same double.
std::string shortest(double value);

}  // namespace squeal
