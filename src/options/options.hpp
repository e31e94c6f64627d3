#pragma once
/// The user interface: every option is declared once, beside the physics that uses it, with stage,
/// default, unit, meaning and check. Names hold at most one placeholder in angle brackets, e.g.
/// `part_<group>_length`, replaced by a name from the mesh. All values come from the PETSc options
/// database, the same on every rank, so every Error thrown here is thrown on all ranks.
#include <petscsys.h>

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace squeal {

/// What `-help` prints of an option.
class Option {
 public:
  const std::string stage, name, defaultText, unit, meaning, rule;
  const bool required;  ///< no default: an Error wherever it is asked for and not given

  /// Full name without the dash, the placeholder replaced by `subject`.
  std::string fullName(const std::string& subject = {}) const;
  bool given(const std::string& subject = {}) const;
  /// The words that stand for the placeholder in the options given, sorted: the <group> of each
  /// `-part_<group>_length`.
  std::vector<std::string> subjects() const;
  /// True if the full name (no dash) is this option's for some subject.
  bool matches(const std::string& fullName) const;
  /// Error if the value given for this subject breaks the rule.
  virtual void validate(const std::string& subject) const = 0;
  /// All declared options in order of stage, then of declaration.
  static std::vector<const Option*> all();

 protected:
  Option(std::string stage, std::string name, std::string defaultText, std::string unit,
         std::string meaning, std::string rule, bool required = false);
  ~Option() = default;
  Option(const Option&) = delete;
  /// Text given by the user, without blanks around it, or the default; an option without default
  /// that is not given is an Error. Recorded for the recipe.
  std::string text(const std::string& subject) const;
  /// "option -part_disc_length -1 (disc.yaml, line 3)"
  std::string named(const std::string& subject, const std::string& value) const;
  [[noreturn]] void reject(const std::string& subject, const std::string& value) const;
  /// A number of an admissible magnitude.
  double number(const std::string& subject, const std::string& value) const;
};

/// Numbers are zero or of a magnitude between these: products of several of them must neither
/// overflow nor vanish.
inline constexpr double smallestMagnitude = 1e-50, largestMagnitude = 1e50;
/// Most values of one list.
inline constexpr int longestList = 100'000;

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
  /// No default: required wherever it is asked for.
  RealOption(std::string stage, std::string name, std::optional<double> byDefault, std::string unit,
             Range range, std::string meaning);
  double get(const std::string& subject = {}) const;
  void validate(const std::string& subject) const override { get(subject); }

 private:
  Range range_;
};

class IntegerOption : public Option {
 public:
  IntegerOption(std::string stage, std::string name, int byDefault, int lowest, int highest,
                std::string meaning);
  int get(const std::string& subject = {}) const;
  void validate(const std::string& subject) const override { get(subject); }

 private:
  int lowest_, highest_;
};

/// Reals separated by commas, blanks beside them allowed; with `ranges`, `first:last:step` stands
/// for an arithmetic sequence (last included).
class RealListOption : public Option {
 public:
  RealListOption(std::string stage, std::string name, std::string byDefault, std::string unit,
                 Range range, std::string meaning, bool ranges = false);
  std::vector<double> get(const std::string& subject = {}) const;
  void validate(const std::string& subject) const override { get(subject); }
  /// The values as a vector. Error unless there are three; two will do for a mesh in the plane.
  std::array<double, 3> components(const std::string& subject, int dimension) const;

 private:
  void requireLength(const std::string& subject, const std::string& value, double length) const;
  Range range_;
  bool ranges_;
};

class FlagOption : public Option {
 public:
  FlagOption(std::string stage, std::string name, bool byDefault, std::string meaning);
  bool get(const std::string& subject = {}) const;
  void validate(const std::string& subject) const override { get(subject); }
};

class ChoiceOption : public Option {
 public:
  ChoiceOption(std::string stage, std::string name, std::vector<std::string> choices,
               std::string byDefault, std::string meaning);
  std::string get(const std::string& subject = {}) const;
  void validate(const std::string& subject) const override { get(subject); }

 private:
  std::vector<std::string> choices_;
};

class TextOption : public Option {
 public:
  /// No default: required wherever it is asked for.
  TextOption(std::string stage, std::string name, std::optional<std::string> byDefault,
             std::string meaning);
  std::string get(const std::string& subject = {}) const;
  void validate(const std::string& subject) const override { get(subject); }
  /// Split at commas, without the blanks beside them; empty if the option is not given and its
  /// default is empty. Error for an empty item.
  std::vector<std::string> list(const std::string& subject = {}) const;
};

/// A file to be read. Named in an options file, it is looked for beside that file, then in the
/// working folder; named on the command line, in the working folder.
class FileOption : public Option {
 public:
  /// No default: required wherever it is asked for.
  FileOption(std::string stage, std::string name, std::string meaning);
  /// The path to read.
  std::string get(const std::string& subject = {}) const { return text(subject); }
  /// Collective. Error if rank 0 finds no such file, or may not read it.
  void validate(const std::string& subject) const override;
  /// True if the full name (no dash) is that of an option for a file.
  static bool isOne(const std::string& fullName);
};

/// Prefix handed to a PETSc or SLEPc solver: options that begin with it belong to that solver.
class SolverPrefix {
 public:
  SolverPrefix(std::string stage, std::string prefix, std::string meaning);
  const std::string stage, prefix, meaning;
  /// Options given with this prefix, with a dash.
  std::vector<std::string> names() const;
  bool given() const { return !names().empty(); }
  /// Collective. Error if an option with this prefix is still unused, i.e. known to no solver; call
  /// after the solver is configured. `exceptAfter` names sub-prefixes whose options are read later
  /// (by a factorisation).
  void rejectUnused(const std::vector<std::string>& exceptAfter = {}) const;
  static std::vector<const SolverPrefix*> all();
};

/// Collective. `configure()` calls PETSc and SLEPc to set a solver up from its options, and returns
/// their code. What they refuse there, such as an unknown type or text for a number, is an Error
/// that names the options given to solvers; if none is given, or the failure is of another kind, it
/// is treated as by check().
void applySolverOptions(const std::function<PetscErrorCode()>& configure);

/// Collective. Error for an option that neither this program nor PETSc knows, with the nearest
/// known name, and for a value of ours that breaks its rule: both before any work is done.
void rejectUnknownOptions();

/// Once a run is done, a line for each option given that nothing has asked for: "option -a 2
/// (case.yaml, line 3) was not used: …".
std::vector<std::string> unusedOptions();

/// The manual printed by `-help`.
std::string manual();

/// Name and value of every option of ours asked for so far, defaults included.
const std::map<std::string, std::string>& resolvedOptions();
/// Name and value of every option given, PETSc's own included, whether by file or on the command
/// line.
std::map<std::string, std::string> givenOptions();

}  // namespace squeal
