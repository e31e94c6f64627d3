#pragma once
/// This file holds what concerns all options: those of PETSc's solvers, unknown and unused ones,
/// and the manual. The types of declared options come with it.
#include <petscsys.h>

#include <functional>
#include <string>
#include <vector>

#include "base/options/option_types.hpp"
#include "base/options/settings.hpp"

namespace squeal {

/// A SolverPrefix declares the prefix of a PETSc or SLEPc solver. Options that begin with it belong
/// to that solver.
class SolverPrefix {
 public:
  SolverPrefix(std::string stage, std::string prefix, std::string meaning);
  const std::string stage, prefix, meaning;
  /// Returns the names, with a dash, of the options given with this prefix.
  std::vector<std::string> names() const;
  bool given() const { return !names().empty(); }
  /// Collective. Throws Error if an option with this prefix is still unused, that is, known to no
  /// solver. Call it after the solver is configured. `exceptAfter` names sub-prefixes whose options
  /// are read later, by a factorisation for example.
  void rejectUnused(const std::vector<std::string>& exceptAfter = {}) const;
  /// Returns all prefixes in order of stage, then of declaration; borrowed.
  static std::vector<const SolverPrefix*> all();
};

/// Collective. Runs `configure()`, which calls PETSc and SLEPc to set up a solver from its options
/// and returns their code. Throws Error, naming the options given to solvers, if they reject one,
/// such as an unknown type or text for a number. If no such option is given, or for a failure of
/// another kind, the code is treated as by check().
void applySolverOptions(const std::function<PetscErrorCode()>& configure);

/// Collective. Throws Error, before any work is done, for an option that neither this program nor
/// PETSc knows, with the nearest known name, and for a value of a declared option that breaks its
/// rule.
void rejectUnknownOptions();

/// Not collective. Returns, at the end of a run, a line for each given option that was never read:
/// "option -a 2 (case.yaml, line 3) was not used: …".
std::vector<std::string> unusedOptions();

/// Returns the manual that `-help` prints, that of one stage if its name is not empty. Throws Error
/// for a name that no stage has.
std::string manual(const std::string& stage = {});

/// Returns the same for programs, as `-help_json` prints it: an object with the `stages`, the
/// `options` (stage, name, unit, default unless required, meaning, rule, and `value`, a JSON
/// Schema) and the `solvers` (stage, prefix, meaning). Of one stage alone unless `stage` is empty;
/// throws Error for a word that is none.
std::string manualAsJson(const std::string& stage = {});

}  // namespace squeal
