#pragma once
/// Text for messages and tables.
#include <string>
#include <vector>

namespace squeal {

/// Returns the text that printf would print.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);
std::string joined(const std::vector<std::string>& words, const std::string& separator = ", ");
std::vector<std::string> split(const std::string& text, char separator);
/// Returns the text without blanks, tabs and line ends around it.
std::string trimmed(const std::string& text);
/// Returns the shortest decimal text that reads back as the same double.
std::string shortest(double value);

}  // namespace squeal
