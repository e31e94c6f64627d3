// SPDX-License-Identifier: BSD-2-Clause
#include "base/options/options.hpp"

#include <petscsys.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/options/settings.hpp"
#include "base/petsc/check.hpp"
#include "base/system/text.hpp"

namespace squeal {
namespace {

std::vector<const SolverPrefix*>& prefixes() {
  static std::vector<const SolverPrefix*> list;
  return list;
}

std::vector<std::string> givenNames() {
  std::vector<std::string> names;
  for (const auto& [name, value] : givenOptions()) names.push_back(name);
  return names;
}

std::vector<std::string> unusedNames() {
  PetscInt count = 0;
  char **names = nullptr, **values = nullptr;
  check(PetscOptionsLeftGet(nullptr, &count, &names, &values));
  std::vector<std::string> left(names, names + count);
  check(PetscOptionsLeftRestore(nullptr, &count, &names, &values));
  return left;
}

/// Returns true if this program declares an option of this full name (no dash).
bool isOurs(const std::string& name) {
  const auto options = Option::all();
  return std::any_of(options.begin(), options.end(),
                     [&](const auto* option) { return option->matches(name); });
}

/// Returns true if the full name (no dash) begins with the prefix of a PETSc or SLEPc solver.
bool isOfSolver(const std::string& name) {
  const auto solvers = SolverPrefix::all();
  return std::any_of(solvers.begin(), solvers.end(),
                     [&](const auto* solver) { return name.starts_with(solver->prefix); });
}

std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

/// Returns the option nearest to a mistyped name, with its placeholder replaced by the best-fitting
/// part of the name; empty if none is near.
std::string nearestName(const std::string& name) {
  std::string nearest;
  if (name.size() > 100) return nearest;  // not a typing error, and slow to compare
  std::size_t least = 4;                  // more than three wrong letters make another word
  const auto consider = [&](const std::string& candidate) {
    if (candidate.size() >= name.size() + least || name.size() >= candidate.size() + least) return;
    if (const auto distance = editDistance(name, candidate); distance < least)
      least = distance, nearest = candidate;
  };
  for (const auto* option : Option::all()) {
    if (option->name.find('<') == std::string::npos)
      consider(option->name);
    else
      for (std::size_t begin = 0; begin < name.size(); ++begin)
        for (std::size_t end = begin + 1; end <= name.size(); ++end)
          consider(option->fullName(name.substr(begin, end - begin)));
  }
  return nearest;
}

/// Returns the subject of a given option that is nearest to a mistyped one; empty if none is near.
std::string nearestSubject(const Option& option, const std::string& subject) {
  std::string nearest;
  std::size_t least = std::min<std::size_t>(3, subject.size());  // one or two wrong letters
  if (subject.size() > 100) return nearest;
  for (const auto& known : option.subjects())
    if (const auto distance = editDistance(subject, known); distance < least)
      least = distance, nearest = known;
  return nearest;
}

}  // namespace

void requireOption(const std::vector<const Option*>& options, const Option& needed) {
  for (const Option* option : options)
    for (const auto& subject : option->subjects()) {
      if (needed.given(subject)) continue;
      const std::string near = nearestSubject(needed, subject);
      throw Error("option " + option->dashed(subject) + " needs " + needed.dashed(subject) +
                  (near.empty() ? "" : "; did you mean " + option->dashed(near) + "?"));
    }
}

SolverPrefix::SolverPrefix(std::string stage_, std::string prefix_, std::string meaning_)
    : stage(std::move(stage_)), prefix(std::move(prefix_)), meaning(std::move(meaning_)) {
  prefixes().push_back(this);
}

std::vector<std::string> SolverPrefix::names() const {
  std::vector<std::string> ours;
  for (const auto& name : givenNames())
    if (name.starts_with(prefix)) ours.push_back("-" + name);
  return ours;
}

std::vector<const SolverPrefix*> SolverPrefix::all() {
  std::vector<const SolverPrefix*> list = prefixes();
  std::stable_sort(list.begin(), list.end(), [](const auto* a, const auto* b) {
    return stageRank(a->stage) < stageRank(b->stage);
  });
  return list;
}

void SolverPrefix::rejectUnused(const std::vector<std::string>& exceptAfter) const {
  for (const auto& name : unusedNames()) {
    if (!name.starts_with(prefix) || isOurs(name)) continue;
    const std::string rest = name.substr(prefix.size());
    if (std::any_of(exceptAfter.begin(), exceptAfter.end(),
                    [&](const auto& later) { return rest.starts_with(later); }))
      continue;
    throw Error("option -" + name + " is unknown to the solver with prefix -" + prefix);
  }
}

void applySolverOptions(const std::function<PetscErrorCode()>& configure) {
  std::vector<std::pair<std::string, std::string>> given;  // to solvers
  for (const auto& option : givenOptions())
    if (isOfSolver(option.first)) given.push_back(option);
  if (given.empty()) return check(configure());
  const std::set<PetscErrorCode> rejections{PETSC_ERR_ARG_UNKNOWN_TYPE,
                                            PETSC_ERR_ARG_OUTOFRANGE,
                                            PETSC_ERR_ARG_WRONG,
                                            PETSC_ERR_ARG_SIZ,
                                            PETSC_ERR_ARG_INCOMP,
                                            PETSC_ERR_ARG_WRONGSTATE,
                                            PETSC_ERR_MISSING_FACTOR,
                                            PETSC_ERR_SUP,
                                            PETSC_ERR_USER,
                                            PETSC_ERR_USER_INPUT,
                                            PETSC_ERR_ORDER};
  const CapturedError error;
  const PetscErrorCode code = configure();
  if (code == 0) return;
  if (!rejections.count(error.code())) return check(code);
  const std::string message = error.message().substr(0, error.message().find('\n'));
  std::vector<std::string> all, named;
  for (const auto& [name, value] : given) {
    all.push_back("-" + name + (value.empty() ? "" : " " + value));
    if (!value.empty() && message.find(value) != std::string::npos) named.push_back(all.back());
  }
  throw Error("PETSc rejects an option of its solvers, " + joined(named.empty() ? all : named) +
              ": " + message);
}

void rejectUnknownOptions() {
  for (const auto& name : unusedNames()) {
    if (isOurs(name) || isOfSolver(name)) continue;
    for (const auto* option : Option::all())
      if (option->fullName("") == name && option->name != name)
        throw Error("option -" + name + ": the name in it is empty; it should be -" + option->name);
    const std::string nearest = nearestName(name);
    const auto& given = givenOptions();
    throw Error("unknown " + optionText(name, "", given.count(name) ? given.at(name) : "") +
                (nearest.empty() ? "" : "; did you mean -" + nearest + "?") +
                " (squeal -help lists all options)");
  }
  validateGivenOptions();
}

std::vector<std::string> unusedOptions() {
  std::vector<std::string> unused, left = unusedNames();
  for (const auto& [name, value] : givenOptions()) {
    const bool used = isOurs(name) ? resolvedOptions().count(name) > 0
                                   : std::find(left.begin(), left.end(), name) == left.end();
    if (!used)
      unused.push_back(optionText(name, value, value) +
                       " was not used: no stage of this run reads it");
  }
  return unused;
}

/// Throws Error for an unknown stage; an empty name means all stages.
static void requireStage(const std::string& wanted) {
  const auto& all = stages();
  if (!wanted.empty() && std::ranges::find(all, wanted) == all.end())
    throw Error("-help " + wanted + ": there is no such stage; the stages are " + joined(all));
}

std::string manual(const std::string& wanted) {
  const auto& all = stages();
  requireStage(wanted);
  std::string page =
      "squeal -options_file CASE.yaml [-option value …]: flutter instability of brakes in steady "
      "sliding (brake squeal)\n"
      "Lengths in m, masses in kg, times in s, unless the case uses another consistent system. <…> "
      "is a name that you choose or that the mesh contains.\n"
      "Numbers are zero or have a magnitude between 1e-50 and 1e50. Commas separate the entries of "
      "a list; quote a list that contains blanks.\n";
  const auto options = Option::all();
  const auto solvers = SolverPrefix::all();
  for (const auto& stage : all) {
    if (!wanted.empty() && stage != wanted) continue;
    page += "\n" + stage + "\n";
    for (const auto* option : options) {
      if (option->stage != stage) continue;
      const std::string left =
          "  -" + option->name + (option->unit.empty() ? "" : " [" + option->unit + "]");
      page += formatted("%-52s ", left.c_str()) + option->meaning;
      page += option->required
                  ? " (required; " + option->rule + ")\n"
                  : " (default " + (option->defaultText.empty() ? "none" : option->defaultText) +
                        "; " + option->rule + ")\n";
    }
    for (const auto* solver : solvers)
      if (solver->stage == stage)
        page +=
            formatted("%-52s ", ("  -" + solver->prefix + "*").c_str()) + solver->meaning + "\n";
  }
  return page;
}

std::string manualAsJson(const std::string& wanted) {
  requireStage(wanted);
  nlohmann::ordered_json page;
  page["stages"] = wanted.empty() ? stages() : std::vector<std::string>{wanted};
  for (const auto* option : Option::all()) {
    if (!wanted.empty() && option->stage != wanted) continue;
    nlohmann::ordered_json entry;
    entry["stage"] = option->stage;
    entry["name"] = option->name;
    entry["unit"] = option->unit;
    if (!option->required) entry["default"] = option->defaultText;
    entry["required"] = option->required;
    entry["meaning"] = option->meaning;
    entry["rule"] = option->rule;
    entry["value"] = option->valueSchema();
    page["options"].push_back(std::move(entry));
  }
  for (const auto* solver : SolverPrefix::all()) {
    if (!wanted.empty() && solver->stage != wanted) continue;
    nlohmann::ordered_json entry;
    entry["stage"] = solver->stage;
    entry["prefix"] = solver->prefix;
    entry["meaning"] = solver->meaning;
    page["solvers"].push_back(std::move(entry));
  }
  return page.dump(1) + "\n";
}

}  // namespace squeal
