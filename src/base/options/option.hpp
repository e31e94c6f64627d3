// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A declared option of the user interface, and the stages that options belong to. Each option is
/// declared once, next to the code that uses it, with its stage, default, unit, meaning and rule.
///
/// A name has at most one placeholder in angle brackets, e.g. `part_<group>_length`, for a name
/// from the mesh or the case: the subject. All values come from the PETSc options database, which
/// is the same on every rank, so every Error thrown here is thrown on all ranks.
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace squeal {

/// Returns the stages in the order of the method, which is also that of the manual.
const std::vector<std::string>& stages();
/// Returns the index of a stage in this order.
std::size_t stageRank(const std::string& stage);

/// A declared option, as `-help` prints it.
class Option {
 public:
  const std::string stage, name, defaultText, unit, meaning, rule;
  const bool required;  ///< without a default: reading the option throws Error unless it is given

  /// Returns the full name, without dash, with `subject` in place of the placeholder.
  std::string fullName(const std::string& subject = {}) const;
  /// Returns fullName() with a dash, for messages.
  std::string dashed(const std::string& subject = {}) const { return "-" + fullName(subject); }
  /// Returns true if the option is given for this subject.
  bool given(const std::string& subject = {}) const;
  /// Returns the names given in place of the placeholder, sorted, such as the <group> of each given
  /// `-part_<group>_length`.
  std::vector<std::string> subjects() const;
  /// Returns true if this is the full name (no dash) of this option for some subject.
  bool matches(const std::string& fullName) const;
  /// Throws Error if the value given for this subject violates the rule.
  virtual void validate(const std::string& subject) const = 0;
  /// Returns the JSON Schema (draft 2020-12) of the values in an options file. A value that
  /// conforms to this schema may still violate the rule.
  virtual nlohmann::json valueSchema() const = 0;
  /// Returns all declared options in order of stage, then of declaration; borrowed.
  static std::vector<const Option*> all();

 protected:
  /// Declares an option. Without `byDefault`, the option is required.
  Option(std::string stage, std::string name, std::optional<std::string> byDefault,
         std::string unit, std::string meaning, std::string rule);
  ~Option() = default;
  Option(const Option&) = delete;
  /// Returns the given text without surrounding blanks, or the default. Throws Error if an option
  /// without default is not given.
  std::string value(const std::string& subject) const;
  /// Returns value(), and records that the run uses this option.
  std::string text(const std::string& subject) const;
  /// Returns a text such as "option -part_disc_length -1 (disc.yaml, line 3)".
  std::string named(const std::string& subject, const std::string& value) const;
  /// Throws Error with the value, the meaning of the option and its rule.
  [[noreturn]] void reject(const std::string& subject, const std::string& value) const;
  /// Returns the value as a number. Throws Error unless it is finite, and zero or of an admissible
  /// magnitude.
  double number(const std::string& subject, const std::string& value) const;
};

/// Bounds of the magnitude of nonzero numbers, so that products of several numbers neither overflow
/// nor underflow.
inline constexpr double smallestMagnitude = 1e-50, largestMagnitude = 1e50;
/// The largest number of values in one list.
inline constexpr int longestList = 100'000;

/// Throws Error if an option of this list is given for a subject for which `needed` is not given.
void requireOption(const std::vector<const Option*>& options, const Option& needed);

/// Returns the name and value of every declared option that has been read so far, including options
/// that have their default.
const std::map<std::string, std::string>& resolvedOptions();

}  // namespace squeal
