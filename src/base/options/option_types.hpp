// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The types of declared options: numbers, lists, flags, choices, texts and files.
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/options/option.hpp"

namespace squeal {

/// An interval of real numbers, each end closed or open. An open end does not belong to it.
struct Range {
  double low = -std::numeric_limits<double>::infinity(),
         high = std::numeric_limits<double>::infinity();
  bool openLow = false, openHigh = false;
  bool contains(double x) const;
  /// Returns the bounds as text, such as " >= 0"; empty if there are none.
  std::string bounds() const;
  std::string text() const;
};
inline constexpr Range anyReal{};
inline constexpr Range positive{0, std::numeric_limits<double>::infinity(), true, false};
inline constexpr Range nonNegative{0};

class RealOption : public Option {
 public:
  /// Declares an option. Without `byDefault`, the option is required.
  RealOption(std::string stage, std::string name, std::optional<double> byDefault, std::string unit,
             Range range, std::string meaning);
  double get(const std::string& subject = {}) const { return parsed(subject, text(subject)); }
  void validate(const std::string& subject) const override { parsed(subject, value(subject)); }
  nlohmann::json valueSchema() const override;

 protected:
  /// Declares an option whose default is printed as none.
  RealOption(std::string stage, std::string name, std::string unit, Range range,
             std::string meaning);

 private:
  /// Returns the value of this text. Throws Error if it violates the rule.
  double parsed(const std::string& subject, const std::string& text) const;
  Range range_;
};

/// A real number that has no default.
class OptionalRealOption : public RealOption {
 public:
  OptionalRealOption(std::string stage, std::string name, std::string unit, Range range,
                     std::string meaning);
  /// Returns the number, or none if the option is not given.
  std::optional<double> get(const std::string& subject = {}) const;
};

/// A real number, or one word in place of it.
class WordOrRealOption : public Option {
 public:
  WordOrRealOption(std::string stage, std::string name, double byDefault, std::string unit,
                   std::string word, std::string meaning);
  /// Returns the number, or none for the word.
  std::optional<double> get(const std::string& subject = {}) const {
    return parsed(subject, text(subject));
  }
  void validate(const std::string& subject) const override { parsed(subject, value(subject)); }
  nlohmann::json valueSchema() const override;

 private:
  /// Returns the value of this text. Throws Error if it violates the rule.
  std::optional<double> parsed(const std::string& subject, const std::string& text) const;
  std::string word_;
};

class IntegerOption : public Option {
 public:
  IntegerOption(std::string stage, std::string name, int byDefault, int lowest, int highest,
                std::string meaning);
  int get(const std::string& subject = {}) const { return parsed(subject, text(subject)); }
  void validate(const std::string& subject) const override { parsed(subject, value(subject)); }
  nlohmann::json valueSchema() const override;

 private:
  /// Returns the value of this text. Throws Error if it violates the rule.
  int parsed(const std::string& subject, const std::string& text) const;
  int lowest_, highest_;
};

/// A vector given by an option. The dimension of the mesh, known only later, determines the number
/// of components.
class VectorValue {
 public:
  VectorValue() = default;
  /// Returns the components for a mesh of this dimension. Throws Error unless three are given. In
  /// plane problems two are enough; the third one is then zero.
  std::array<double, 3> in(int dimension) const;

 private:
  friend class RealListOption;
  VectorValue(std::vector<double> values, std::string text)
      : values_(std::move(values)), text_(std::move(text)) {}
  std::vector<double> values_{0, 0, 0};
  std::string text_;  // option and meaning, for the message
};

/// The rule for the entries of a list. If `sequences` is true, the list may also have the form
/// `first:last:step`: the arithmetic sequence from `first` in steps of `step`, up to and including
/// `last` if the steps reach it.
struct ListRule {
  ListRule(Range all) : range(all) {}  // NOLINT: a range is a rule
  Range range;
  bool sequences = false;
};
/// Returns the rule for lists and sequences of numbers in this range.
inline ListRule sequencesOf(Range range) {
  ListRule rule(range);
  rule.sequences = true;
  return rule;
}

/// A list of reals separated by commas, with optional blanks around each.
class RealListOption : public Option {
 public:
  RealListOption(std::string stage, std::string name, std::string byDefault, std::string unit,
                 ListRule entries, std::string meaning);
  std::vector<double> get(const std::string& subject = {}) const {
    return parsed(subject, text(subject));
  }
  void validate(const std::string& subject) const override { parsed(subject, value(subject)); }
  nlohmann::json valueSchema() const override;
  /// Returns the values as a vector.
  VectorValue vector(const std::string& subject = {}) const;

 private:
  /// Returns the value of this text. Throws Error if it violates the rule.
  std::vector<double> parsed(const std::string& subject, const std::string& text) const;
  void requireLength(const std::string& subject, const std::string& value, double length) const;
  ListRule entries_;
};

class FlagOption : public Option {
 public:
  FlagOption(std::string stage, std::string name, bool byDefault, std::string meaning);
  bool get(const std::string& subject = {}) const { return parsed(subject, text(subject)); }
  void validate(const std::string& subject) const override { parsed(subject, value(subject)); }
  nlohmann::json valueSchema() const override;

 private:
  /// Returns the value of this text. Throws Error if it violates the rule.
  bool parsed(const std::string& subject, const std::string& text) const;
};

class ChoiceOption : public Option {
 public:
  ChoiceOption(std::string stage, std::string name, std::vector<std::string> choices,
               std::string byDefault, std::string meaning);
  std::string get(const std::string& subject = {}) const { return parsed(subject, text(subject)); }
  void validate(const std::string& subject) const override { parsed(subject, value(subject)); }
  nlohmann::json valueSchema() const override;

 private:
  /// Returns the value of this text. Throws Error if it violates the rule.
  std::string parsed(const std::string& subject, const std::string& text) const;
  std::vector<std::string> choices_;
};

class TextOption : public Option {
 public:
  /// Declares an option. Without `byDefault`, the option is required.
  TextOption(std::string stage, std::string name, std::optional<std::string> byDefault,
             std::string meaning);
  std::string get(const std::string& subject = {}) const { return parsed(subject, text(subject)); }
  void validate(const std::string& subject) const override { parsed(subject, value(subject)); }
  nlohmann::json valueSchema() const override;
  /// Returns the text split at commas, without surrounding blanks; empty if the option is not given
  /// and its default is empty. Throws Error for an empty item.
  std::vector<std::string> list(const std::string& subject = {}) const;

 private:
  /// Returns the value of this text. Throws Error if it violates the rule.
  std::string parsed(const std::string& subject, const std::string& text) const;
};

/// The path of a file to read. A path in an options file is relative to the folder of the options
/// file or, if it leads to no file there, to the working folder. A path on the command line is
/// relative to the working folder.
class FileOption : public Option {
 public:
  /// Declares an option without default, which is required.
  FileOption(std::string stage, std::string name, std::string meaning);
  /// Returns the path to read.
  std::string get(const std::string& subject = {}) const { return text(subject); }
  /// Collective. Throws Error if rank 0 cannot find or read the file.
  void validate(const std::string& subject) const override;
  nlohmann::json valueSchema() const override;
  /// Returns true if this is the full name (no dash) of a FileOption.
  static bool isDeclared(const std::string& fullName);
};

/// Collective. Throws Error if a given option of this program has a value that violates its rule.
void validateGivenOptions();

}  // namespace squeal
