// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/settings.hpp"

#include <algorithm>

#include "base/options/options.hpp"
#include "eigen/direct/nearest.hpp"
#include "eigen/sweep/sweep.hpp"
#include "regime/regime/checks.hpp"
#include "run/audit/settings.hpp"

namespace squeal::analysis {
namespace {

const FlagOption dryRunOption(
    "general", "dry_run", false,
    "check of the input, and estimates of memory and time of a run; nothing is solved or written");
const FlagOption fullOption(
    "steady", "steady_full", false,
    "solution of steady sliding in all unknowns, as a check; off: in the unknowns of the contact");
const IntegerOption pathOption(
    "steady", "steady_path", 1000, 0, 1'000'000,
    "largest number of contact nodes that open or close between two neighbouring points for which "
    "these changes are located; 0 = no search");
const IntegerOption releasedOption(
    "flutter", "flutter_released", 350, 0, 100'000,
    "largest number of contact nodes whose state may differ among points that share a "
    "factorisation and a basis; eigenvalues are tracked over a step of the sweep only if its ends "
    "share a basis; 0 = only points with the same active set share one");

const IntegerOption componentModesOption(
    "report", "report_component_modes", 0, 0, 1000,
    "number of elastic modes of each body by itself, free in space; the run lists their "
    "frequencies and names the motions of bodies after them (such as bending), except those of "
    "bodies of revolution");

/// Adds frictions to those of the sweep.
void addFrictions(sweep::Settings& sweep, const std::vector<double>& more) {
  for (const double friction : more)
    if (std::ranges::find(sweep.frictions, friction) == sweep.frictions.end())
      sweep.frictions.push_back(friction);
  std::ranges::sort(sweep.frictions);
}

/// Sets the swept friction to zero if no interface has it, because all sliding ones have a
/// coefficient of their own. Throws Error if an option gives another one.
void settleFriction(const interfaces::Settings& interfaces, const regime::Settings& regime,
                    sweep::Settings& sweep) {
  if (interfaces::frictionExponents(interfaces.interfaces) != std::vector<int>{0}) return;
  const std::vector<double> none{0};
  const auto refuse = [](const std::string& option) {
    throw Error("option -" + option +
                ": no interface has this coefficient of friction, since each sliding one has a "
                "-contact_<interface>_friction; leave one of them out");
  };
  if (regime.enabled() && regime.frictions != none) refuse("regime_friction");
  if (givenOptions().contains("flutter_friction") && sweep.frictions != none)
    refuse("flutter_friction");
  sweep.frictions = none;
}

SteadySettings steadySettings() {
  SteadySettings settings{.full = fullOption.get()};
  if (!settings.full) settings.path = pathOption.get();
  return settings;
}

MeshSettings meshSettings(const Settings& others) {
  MeshSettings settings{.model = ModelSettings::given(),
                        .steady = steadySettings(),
                        .uniqueness = {},
                        .terms = terms::Settings::given()};
  const auto& interfaces = settings.model.interfaces.interfaces;
  if (!std::ranges::all_of(interfaces, &interfaces::InterfaceSettings::isTie))
    settings.uniqueness = uniqueness::Settings::given();
  // These ask for the matrices of each active set.
  std::string reason;
  if (others.pencil.method == pencil::Method::direct) reason = "-flutter_method direct";
  if (others.solver.sensitivity.wanted) reason = "-flutter_sensitivities";
  if (others.matrixExport.wanted()) reason = "-report_matrices";
  if (others.pencil.isModallyDamped()) reason = "-flutter_modal_damping";
  settings.released = reason.empty() ? releasedOption.get() : 0;
  settings.whySeparate = reason.empty()
                             ? "-flutter_released " + std::to_string(settings.released)
                             : "with " + reason + ", each active set has a basis of its own";
  settings.audit = audit::wanted();
  settings.ownModes = componentModesOption.get();
  return settings;
}

/// Throws Error for an option that asks for results which a referee does not compute, or that
/// changes the problem.
RefereeSettings refereeSettings(eigenlist::Settings list, const matrices::Settings& matrices) {
  const std::string option = "option " + eigenlist::listOption() + ": ";
  if (matrices.ofMesh())
    throw Error(option +
                "a list is judged for matrices (-matrices_<name>_file); -report_matrices writes "
                "those of a mesh");
  if (givenOptions().contains("flutter_modal_damping"))
    throw Error(option + "-flutter_modal_damping is not part of the matrices; leave it out");
  return {std::move(list), referee::Settings::given()};
}

}  // namespace

Settings Settings::given() {
  rejectUnknownOptions();
  Settings settings;
  if (auto list = eigenlist::Settings::given()) {
    settings.sweep = sweep::Settings::given();
    settings.matrices = matrices::Settings::given();
    settings.referee = refereeSettings(std::move(*list), settings.matrices);
    settings.solver.modes = modes::Settings::given();
    settings.output = OutputSettings::given();
    settings.dryRun = dryRunOption.get();
    return settings;
  }
  settings.output = OutputSettings::given();
  settings.dryRun = dryRunOption.get();
  referee::rejectWithout(eigenlist::listOption());
  settings.pencil = pencil::Settings::given();
  direct::rejectIdleSolverOptions(settings.pencil.method);
  if (settings.pencil.method == pencil::Method::direct && settings.pencil.isModallyDamped())
    throw Error(
        "option -flutter_modal_damping: damping of the free modes needs the modes of "
        "-flutter_method reduced");
  settings.sweep = sweep::Settings::given();
  settings.solver = sweep_solver::Settings::given(settings.pencil);
  settings.matrices = matrices::Settings::given();
  settings.matrixExport = matrices::ExportSettings::given();
  settings.regime = regime::Settings::given();
  if (settings.matrices.ofMesh()) settings.mesh = meshSettings(settings);
  regime::checkOptions(settings.regime, settings.pencil,
                       settings.mesh ? &settings.mesh->terms : nullptr);
  addFrictions(settings.sweep, settings.regime.frictions);
  if (settings.mesh)
    settleFriction(settings.mesh->model.interfaces, settings.regime, settings.sweep);
  settings.checkpoint = checkpoint::Settings::given();
  return settings;
}

}  // namespace squeal::analysis
