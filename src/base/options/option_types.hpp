#pragma once
/// This file holds the user interface: every option is declared once, beside the physics that uses
/// it, with stage, default, unit, meaning and check. Names hold at most one placeholder in angle
/// brackets, e.g. `part_<group>_length`, replaced by a name from the mesh. All values come from the
/// PETSc options database, the same on every rank, so every Error thrown here is thrown on all
/// ranks.
#include <array>
#include <limits>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace squeal {

/// Returns the stages in the order of the method, in which the manual lists them.
const std::vector<std::string>& stages();
/// Returns the place of a stage in this order.
std::size_t stageRank(const std::string& stage);

/// A declared option, as `-help` prints it.
class Option {
 public:
  const std::string stage, name, defaultText, unit, meaning, rule;
  const bool required;  ///< without default: reading it throws Error unless it is given

  /// Returns the full name without the dash, the placeholder replaced by `subject`.
  std::string fullName(const std::string& subject = {}) const;
  /// Returns true if the option is given for this subject.
  bool given(const std::string& subject = {}) const;
  /// Returns the words in place of the placeholder in the options given, sorted: the <group> of
  /// each `-part_<group>_length`.
  std::vector<std::string> subjects() const;
  /// Returns true if this is the full name (no dash) of this option for some subject.
  bool matches(const std::string& fullName) const;
  /// Throws Error if the value given for this subject breaks the rule.
  virtual void validate(const std::string& subject) const = 0;
  /// Returns the JSON Schema (draft 2020-12) of the values that an options file may hold; what it
  /// admits may still break the rule.
  virtual nlohmann::json valueSchema() const = 0;
  /// Returns all declared options in order of stage, then of declaration; borrowed.
  static std::vector<const Option*> all();

 protected:
  Option(std::string stage, std::string name, std::string defaultText, std::string unit,
         std::string meaning, std::string rule, bool required = false);
  ~Option() = default;
  Option(const Option&) = delete;
  /// Returns the text given by the user, without blanks around it, or the default. Throws Error if
  /// an option without default is not given.
  std::string value(const std::string& subject) const;
  /// Returns the same, and records that the run uses this option.
  std::string text(const std::string& subject) const;
  /// Returns a text such as "option -part_disc_length -1 (disc.yaml, line 3)".
  std::string named(const std::string& subject, const std::string& value) const;
  /// Throws Error with the value, the meaning of the option and its rule.
  [[noreturn]] void reject(const std::string& subject, const std::string& value) const;
  /// Returns the value as a number. Throws Error unless it is a finite number, and is zero or of an
  /// admissible magnitude.
  double number(const std::string& subject, const std::string& value) const;
};

/// The magnitudes of numbers other than zero lie between these bounds: products of several of them
/// must neither overflow nor vanish.
inline constexpr double smallestMagnitude = 1e-50, largestMagnitude = 1e50;
/// The largest number of values in one list.
inline constexpr int longestList = 100'000;

/// An interval of the reals, with or without its ends.
struct Range {
  double low = -std::numeric_limits<double>::infinity(),
         high = std::numeric_limits<double>::infinity();
  bool openLow = false, openHigh = false;
  bool holds(double x) const;
  std::string text() const;
};
inline constexpr Range anyReal{};
inline constexpr Range positive{0, std::numeric_limits<double>::infinity(), true, false};
inline constexpr Range nonNegative{0};

class RealOption : public Option {
 public:
  /// Declares an option. Without `byDefault` it is required wherever it is asked for.
  RealOption(std::string stage, std::string name, std::optional<double> byDefault, std::string unit,
             Range range, std::string meaning);
  double get(const std::string& subject = {}) const { return parsed(subject, text(subject)); }
  void validate(const std::string& subject) const override { parsed(subject, value(subject)); }
  nlohmann::json valueSchema() const override;

 private:
  /// Throws Error unless the text is a value of this option.
  double parsed(const std::string& subject, const std::string& text) const;
  Range range_;
};

/// A WordOrRealOption is a real, or one word in place of it.
class WordOrRealOption : public Option {
 public:
  WordOrRealOption(std::string stage, std::string name, double byDefault, std::string unit,
                   std::string word, std::string meaning);
  /// Returns the number, or nothing for the word.
  std::optional<double> get(const std::string& subject = {}) const {
    return parsed(subject, text(subject));
  }
  void validate(const std::string& subject) const override { parsed(subject, value(subject)); }
  nlohmann::json valueSchema() const override;

 private:
  /// Throws Error unless the text is a value of this option.
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
  /// Throws Error unless the text is a value of this option.
  int parsed(const std::string& subject, const std::string& text) const;
  int lowest_, highest_;
};

/// A RealListOption holds reals separated by commas, with blanks allowed beside them. With
/// `ranges`, `first:last:step` stands for the arithmetic sequence up to `last`, which is included
/// if a whole number of steps leads to it.
class RealListOption : public Option {
 public:
  RealListOption(std::string stage, std::string name, std::string byDefault, std::string unit,
                 Range range, std::string meaning, bool ranges = false);
  std::vector<double> get(const std::string& subject = {}) const {
    return parsed(subject, text(subject));
  }
  void validate(const std::string& subject) const override { parsed(subject, value(subject)); }
  nlohmann::json valueSchema() const override;
  /// Returns the values as a vector, in the plane with a zero in place of a third one that is not
  /// given. Throws Error unless there are three; two are enough for a mesh in the plane.
  std::array<double, 3> components(const std::string& subject, int dimension) const;

 private:
  /// Throws Error unless the text is a value of this option.
  std::vector<double> parsed(const std::string& subject, const std::string& text) const;
  void requireLength(const std::string& subject, const std::string& value, double length) const;
  Range range_;
  bool ranges_;
};

class FlagOption : public Option {
 public:
  FlagOption(std::string stage, std::string name, bool byDefault, std::string meaning);
  bool get(const std::string& subject = {}) const { return parsed(subject, text(subject)); }
  void validate(const std::string& subject) const override { parsed(subject, value(subject)); }
  nlohmann::json valueSchema() const override;

 private:
  /// Throws Error unless the text is a value of this option.
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
  /// Throws Error unless the text is a value of this option.
  std::string parsed(const std::string& subject, const std::string& text) const;
  std::vector<std::string> choices_;
};

class TextOption : public Option {
 public:
  /// Declares an option. Without `byDefault` it is required wherever it is asked for.
  TextOption(std::string stage, std::string name, std::optional<std::string> byDefault,
             std::string meaning);
  std::string get(const std::string& subject = {}) const { return parsed(subject, text(subject)); }
  void validate(const std::string& subject) const override { parsed(subject, value(subject)); }
  nlohmann::json valueSchema() const override;
  /// Returns the text split at commas, without the blanks beside them; empty if the option is not
  /// given and its default is empty. Throws Error for an empty item.
  std::vector<std::string> list(const std::string& subject = {}) const;

 private:
  /// Throws Error unless the text is a value of this option.
  std::string parsed(const std::string& subject, const std::string& text) const;
};

/// A FileOption names a file to be read. If an options file names it, it is sought beside that
/// file, then in the working folder; if the command line names it, in the working folder.
class FileOption : public Option {
 public:
  /// Declares an option without default: it is required wherever it is asked for.
  FileOption(std::string stage, std::string name, std::string meaning);
  /// Returns the path to read.
  std::string get(const std::string& subject = {}) const { return text(subject); }
  /// Collective. Throws Error if rank 0 finds no such file, or may not read it.
  void validate(const std::string& subject) const override;
  nlohmann::json valueSchema() const override;
  /// Returns true if this is the full name (no dash) of an option for a file.
  static bool isOne(const std::string& fullName);
};

/// Collective. Throws Error if a given option of this program has a value that breaks its rule.
void validateGivenOptions();

/// Returns name and value of every declared option that has been read so far, defaults included.
const std::map<std::string, std::string>& resolvedOptions();

}  // namespace squeal
