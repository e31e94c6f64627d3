// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The options of a generated model, which turn with its axes.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/models/boxes.hpp"

namespace squeal::fuzz {

class Settings {
 public:
  /// Sets an option, whose name is without a dash; a later value replaces an earlier one.
  void set(const std::string& name, const std::string& value);
  void set(const std::string& name, double value);
  void setList(const std::string& name, const std::vector<double>& values);
  /// Components along the axes.
  void setVector(const std::string& name, const Vector& value);
  /// Two vectors.
  void setPair(const std::string& name, const Vector& first, const Vector& second);
  /// Adds to what the option has.
  void addVector(const std::string& name, const Vector& value);
  /// Some of "xyz".
  void setComponents(const std::string& name, const std::string& components);
  /// A linear equation of components, such as "a:x - 2*b:ry = 0".
  void setEquation(const std::string& name, const std::string& equation);
  /// Names and values in the axes of the turned model.
  std::vector<std::pair<std::string, std::string>> turnedBy(int turn) const;

 private:
  struct Entry {
    std::string name, text;
    bool isVector = false, isComponents = false, isEquation = false;
    Vector vector = {};
    std::optional<Vector> second = {};
  };
  void put(Entry entry);
  std::vector<Entry> entries_;
};

}  // namespace squeal::fuzz
