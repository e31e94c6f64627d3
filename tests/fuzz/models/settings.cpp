// SPDX-License-Identifier: BSD-2-Clause
#include "fuzz/models/settings.hpp"

#include <algorithm>
#include <cstdio>

namespace squeal::fuzz {
namespace {

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

std::string vectorText(const Vector& x) {
  return number(x[0]) + "," + number(x[1]) + "," + number(x[2]);
}

}  // namespace

void Settings::put(Entry entry) {
  const auto same = std::find_if(entries_.begin(), entries_.end(),
                                 [&](const auto& one) { return one.name == entry.name; });
  if (same != entries_.end())
    *same = std::move(entry);
  else
    entries_.push_back(std::move(entry));
}

void Settings::set(const std::string& name, const std::string& value) {
  put({.name = name, .text = value});
}

void Settings::set(const std::string& name, double value) {
  put({.name = name, .text = number(value)});
}

void Settings::setList(const std::string& name, const std::vector<double>& values) {
  std::string text;
  for (double value : values) text += (text.empty() ? "" : ",") + number(value);
  put({.name = name, .text = text});
}

void Settings::setVector(const std::string& name, const Vector& value) {
  put({.name = name, .text = "", .isVector = true, .vector = value});
}

void Settings::setPair(const std::string& name, const Vector& first, const Vector& second) {
  put({.name = name, .text = "", .isVector = true, .vector = first, .second = second});
}

void Settings::addVector(const std::string& name, const Vector& value) {
  Vector sum = value;
  for (const auto& entry : entries_)
    if (entry.name == name)
      for (int a = 0; a < 3; ++a) sum[a] += entry.vector[a];
  setVector(name, sum);
}

void Settings::setComponents(const std::string& name, const std::string& components) {
  put({.name = name, .text = components, .isComponents = true});
}

void Settings::setEquation(const std::string& name, const std::string& equation) {
  put({.name = name, .text = equation, .isEquation = true});
}

std::vector<std::pair<std::string, std::string>> Settings::turnedBy(int turn) const {
  std::vector<std::pair<std::string, std::string>> result;
  for (const auto& entry : entries_) {
    std::string text = entry.text;
    if (entry.isComponents)
      for (char& c : text) c = static_cast<char>('x' + (c - 'x' + turn) % 3);
    for (std::size_t i = 1; entry.isEquation && i < text.size(); ++i) {
      const bool follows =
          text[i - 1] == ':' || (i > 1 && text[i - 1] == 'r' && text[i - 2] == ':');
      if (follows && text[i] >= 'x') text[i] = static_cast<char>('x' + (text[i] - 'x' + turn) % 3);
    }
    if (entry.isVector) text = vectorText(turned(entry.vector, turn));
    if (entry.second) text += "," + vectorText(turned(*entry.second, turn));
    result.emplace_back(entry.name, text);
  }
  return result;
}

}  // namespace squeal::fuzz
