// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Functions for all options: the options of PETSc's solvers, unknown and unused options, and the
/// manual. This header also includes the types of declared options.
#include <petscsys.h>

#include <functional>
#include <string>
#include <vector>

#include "base/options/option_types.hpp"
#include "base/options/settings.hpp"

namespace squeal {

/// Declares the prefix of a PETSc or SLEPc solver. Options that begin with it belong to that
/// solver.
class SolverPrefix {
 public:
  SolverPrefix(std::string stage, std::string prefix, std::string meaning);
  const std::string stage, prefix, meaning;
  /// Returns the names, with a dash, of the options given with this prefix.
  std::vector<std::string> names() const;
  bool given() const { return !names().empty(); }
  /// Collective. Throws Error if an option with this prefix is still unused, that is, unknown to
  /// all solvers. Call it after the solver is configured. `exceptAfter` lists sub-prefixes whose
  /// options are read later, for example by a factorisation.
  void rejectUnused(const std::vector<std::string>& exceptAfter = {}) const;
  /// Returns all prefixes in order of stage, then of declaration; borrowed.
  static std::vector<const SolverPrefix*> all();
};

/// Collective. Runs `configure()`, which calls PETSc and SLEPc to set up a solver from its options
/// and returns their error code. If PETSc or SLEPc rejects an option, such as an unknown type or a
/// text in place of a number, throws Error with the options given to solvers, or only with those
/// whose value is in PETSc's message. If no option is given to a solver, or if the failure is of
/// another kind, passes the code to check().
void applySolverOptions(const std::function<PetscErrorCode()>& configure);

/// Collective. Call it before any work is done. Throws Error, with a similar known name if there is
/// one, for an option that neither this program nor PETSc knows. Also throws Error for a value of a
/// declared option that violates its rule.
void rejectUnknownOptions();

/// Not collective. Call it at the end of a run. Returns a line for each given option that was never
/// read: "option -a 2 (case.yaml, line 3) was not used: …".
std::vector<std::string> unusedOptions();

/// Returns the manual that `-help` prints, or only the part of one stage. Throws Error for an
/// unknown stage.
std::string manual(const std::string& stage = {});

/// Returns the manual for programs, as `-help_json` prints it: an object with the `stages`, the
/// `options` (stage, name, unit, default unless required, meaning, rule, and `value`, a JSON
/// Schema) and the `solvers` (stage, prefix, meaning). `stage` is as for manual().
std::string manualAsJson(const std::string& stage = {});

}  // namespace squeal
