// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/dry_run.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "algebra/factor/symmetric_solver.hpp"
#include "base/options/options.hpp"
#include "base/session/stages.hpp"
#include "base/system/text.hpp"
#include "eigen/sweep/sweep.hpp"
#include "model/contact/coupled.hpp"
#include "model/mesh/mesh.hpp"
#include "run/analysis/analysis.hpp"
#include "run/analysis/checks.hpp"
#include "run/analysis/cost.hpp"
#include "run/analysis/inventory.hpp"
#include "run/analysis/matrix_flutter.hpp"
#include "run/analysis/matrix_referee.hpp"
#include "run/analysis/point_groups.hpp"

namespace squeal::analysis {
namespace {

std::string counted(const std::string& name, double count, const std::string& what) {
  return formatted("%s (%.0f %s)", name.c_str(), count, what.c_str());
}

void printList(MPI_Comm comm, const char* head, const std::vector<std::string>& items) {
  printLine(comm, formatted("%-12s %s", head, items.empty() ? "none" : joined(items).c_str()));
}

void printMesh(const mesh::Mesh& mesh, const ModelSettings& settings) {
  std::vector<std::string> bodies, sections;
  for (int b = 0; b < std::ssize(mesh.bodies); ++b) {
    double cells = 0;
    for (const auto& block : mesh.cells)
      cells += std::count(block.body.begin(), block.body.end(), b);
    bodies.push_back(counted(mesh.bodies[b], mpi::sum(mesh.comm, cells), "cells"));
  }
  for (int m = 0; m < std::ssize(mesh.materialGroups); ++m) {
    if (!mesh.materialGroups[m].isSection) continue;
    double cells = 0;
    for (const auto& block : mesh.cells)
      cells += std::count(block.material.begin(), block.material.end(), m);
    sections.push_back(counted(mesh.materialGroups[m].name, mpi::sum(mesh.comm, cells), "cells"));
  }
  printList(mesh.comm, "bodies", bodies);
  if (!sections.empty()) printList(mesh.comm, "sections", sections);
  const auto lists = inventory(mesh, settings);
  for (const char* kind : {"supports", "loads"})
    if (std::ranges::find(lists, kind, &ItemList::kind) == lists.end())
      printList(mesh.comm, kind, {});
  for (const auto& [kind, items] : lists) {
    std::vector<std::string> lines;
    for (const auto& item : items) lines.push_back(text(item));
    printList(mesh.comm, kind.c_str(), lines);
  }
}

void printContact(const contact::Contact& contact, MPI_Comm comm) {
  std::vector<std::string> interfaces;
  for (std::size_t i = 0; i < contact.interfaces.names.size(); ++i) {
    const auto& report = contact.interfaces.reports[i];
    std::string what = contact.interfaces.options[i].onObstacle() ? "nodes on a rigid obstacle"
                       : report.matching                          ? "pairs of nodes"
                                                                  : "mortar nodes";
    const auto& options = contact.interfaces.options[i];
    if (options.isTied()) what += ", tied";
    if (options.layerStiffness > 0)
      what += formatted(", soft layer of %.4g N/m3", options.layerStiffness);
    if (!options.separates) what += ", do not separate";
    interfaces.push_back(counted(contact.interfaces.names[i], report.nodes, what));
  }
  printList(comm, "contact", interfaces);
}

void printSweep(MPI_Comm comm, const sweep::Sweep& sweep, bool steady) {
  std::string text =
      formatted("%-12s %.0f points: %zu frictions x %zu speeds x %zu pressures x %zu dampings",
                "sweep", sweep.pointCount(), sweep.frictions.size(), sweep.speeds.size(),
                sweep.pressures.size(), sweep.dampings.size());
  if (steady) text += formatted("; %zu steady states", sweep.steadyPoints().size());
  printLine(comm, text);
}

std::string duration(double seconds) {
  if (seconds < 90) return formatted("%.2g s", std::max(seconds, 1.0));
  if (seconds < 90 * 60) return formatted("%.2g min", seconds / 60);
  return formatted("%.3g h", seconds / 3600);
}

std::string gigabytes(double bytes) {
  return formatted(bytes < 1e11 ? "%.2g GB" : "%.0f GB", 1e-9 * bytes);
}

PetscInt rowsOf(Mat matrix) {
  PetscInt rows = 0;
  check(MatGetSize(matrix, &rows, nullptr));
  return rows;
}

/// Collective. Returns the size of the run with the matrix K0, as far as it is independent of
/// contact.
RunSize sizeOf(MPI_Comm comm, const Settings& settings, const sweep::Sweep& sweep, Mat k0) {
  const factor::FactorSize factor = factor::factorSize(k0);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  RunSize size;
  size.unknowns = rowsOf(k0);
  size.modes =
      std::min<double>(settings.solver.modes.value_or(modes::Settings()).count, size.unknowns);
  size.points = sweep.pointCount();
  size.factorBytes = factor.bytes;
  size.factorEntries = factor.entries;
  size.factorFlops = factor.operations;
  size.bytesInUse = mpi::sum(comm, 1024.0 * usage.ru_maxrss);
  for (const auto& stage : stageRecords()) size.secondsSoFar += stage.seconds;
  size.corrected = settings.solver.reduction && settings.solver.reduction->corrected;
  size.damped = settings.pencil.isModallyDamped();
  return size;
}

/// Returns which requested stages the estimate of the time does not include.
std::string notEstimated(const Settings& settings) {
  std::vector<std::string> stages;
  if (settings.solver.proof.wanted) stages.emplace_back("the proofs");
  if (settings.solver.sensitivity.wanted) stages.emplace_back("the sensitivities");
  if (settings.regime.enabled()) stages.emplace_back("the motion after flutter");
  return stages.empty() ? "" : "; not included: " + joined(stages);
}

/// Collective. Prints the number of unknowns, and estimates of memory and time. `mayDiffer`: the
/// active sets of the points may differ; a second estimate is then for an assumed number of
/// changes.
void printCost(MPI_Comm comm, const Settings& settings, Mat k0, const RunSize& size,
               bool mayDiffer) {
  MatInfo info;
  check(MatGetInfo(k0, MAT_GLOBAL_SUM, &info));
  printLine(comm, formatted("%-12s %.0f, %.0f entries in the stiffness", "unknowns", size.unknowns,
                            info.nz_used));
  const double machine = 1.0 * sysconf(_SC_PHYS_PAGES) * sysconf(_SC_PAGESIZE);
  const double speed = denseSpeed(comm);
  const RunCost same = runCost(size, false, speed);
  std::string memory = "about " + gigabytes(same.bytes) + " on all ranks";
  std::string time = "about " + duration(same.seconds);
  if (mayDiffer && size.steadyPoints > 1) {
    constexpr double noticeable = 1.05;
    const double changes = changesOnStep(size.contactUnknowns);
    const std::string whenever =
        changes < 1.5
            ? std::string(" if a contact node opens or closes between points")
            : formatted(" if about %.0f contact nodes open or close between points", changes);
    const RunCost different = runCost(size, true, speed);
    if (different.bytes > noticeable * same.bytes)
      memory += ", " + gigabytes(different.bytes) + whenever;
    if (different.seconds > noticeable * same.seconds)
      time += ", " + duration(different.seconds) + whenever;
  }
  printLine(comm,
            formatted("%-12s %s; in use now %s; this machine has %s", "memory", memory.c_str(),
                      gigabytes(size.bytesInUse).c_str(), gigabytes(machine).c_str()));
  printLine(comm, formatted("%-12s %s", "time", (time + notEstimated(settings)).c_str()));
}

void printUnknownCost(MPI_Comm comm, Mat k0, const char* what) {
  printLine(comm, formatted("%-12s %.0f; memory and time are not estimated for %s", "unknowns",
                            static_cast<double>(rowsOf(k0)), what));
}

/// Collective. Returns the number of gaps that can open, and of tangential displacements of nodes
/// that stick.
double contactUnknowns(const Model& model) {
  double count = 0;
  for (const auto& node : model.contact.interfaces.nodes)
    count +=
        node.separates + (node.role == interfaces::Role::sticking ? model.mesh->dimension - 1 : 0);
  return mpi::sum(model.mesh->comm, count);
}

/// Returns true if contact can open, or sticking nodes can slide. The same on all ranks.
bool setsMayDiffer(const Model& model) {
  return std::ranges::any_of(model.contact.interfaces.options, [](const auto& one) {
    return !one.isTied() && (one.separates || one.releases);
  });
}

bool hasFriction(const Model& model, const sweep::Sweep& sweep) {
  return std::ranges::any_of(sweep.frictions,
                             [&](double f) { return model.contact.hasFriction(f); });
}

/// Collective. Returns the size with the members that contact and motion determine.
RunSize withContact(RunSize size, const Model& model, const Settings& settings,
                    const sweep::Sweep& sweep) {
  const auto& contact = model.contact;
  const bool friction = hasFriction(model, sweep);
  const bool frictionDamping = friction && settings.mesh->terms.frictionDamping &&
                               (model.mesh->dimension == 3 || !contact.law.constant());
  size.steadyPoints = sweep.steadyPoints().size();
  size.released = settings.mesh->released;
  size.contactUnknowns = contactUnknowns(model);
  const double steps =
      (sweep.frictions.size() - 1.0) * sweep.speeds.size() * sweep.pressures.size();
  if (!settings.mesh->steady.full)
    size.followedSteps = followedSteps(steps, size.contactUnknowns, settings.mesh->steady.path);
  if (areTracked(settings, model, sweep.frictions.back()))
    size.trackedSteps = steps * sweep.dampings.size();
  size.varied = model.bodies.gyroscopic || model.bodies.damping;
  size.damped = size.damped || size.varied || frictionDamping;
  // K̄ and M̄ have friction terms; Z̄ has them with damping.
  if (friction && !contact.slipIsConstant())
    size.pointTerms = size.damped ? 3 : 2;
  else if (frictionDamping)
    size.pointTerms = 1;
  return size;
}

void checkMatrices(MPI_Comm comm, const Settings& settings, const sweep::Sweep& sweep) {
  if (settings.referee) readList(comm, settings, sweep);
  const auto named = readMatrices(comm, settings, sweep);
  OwnedMat pattern;  // of K0
  for (const auto& [name, term] : named) {
    MatInfo info;
    check(MatGetInfo(term.matrix, MAT_GLOBAL_SUM, &info));
    printLine(comm, formatted("%-12s %s: %" PetscInt_FMT
                              " rows, %.0f entries, with s^%d, friction^%d, speed^%d, damping^%d",
                              "matrix", name.c_str(), rowsOf(term.matrix), info.nz_used, term.power,
                              term.frictionExponent, term.speedExponent, term.dampingExponent));
    if (term.power != 0) continue;
    if (!pattern)
      check(MatDuplicate(term.matrix, MAT_COPY_VALUES, pattern.out()));
    else
      check(MatAXPY(pattern, 1, term.matrix, DIFFERENT_NONZERO_PATTERN));
  }
  printSweep(comm, sweep, false);
  warnOfDenseWork(comm, settings, sweep, rowsOf(named.front().term.matrix));
  if (!pattern) return;
  if (settings.referee) return printUnknownCost(comm, pattern, "-referee_list");
  if (settings.solver.direct) return printUnknownCost(comm, pattern, "-flutter_method direct");
  RunSize size = sizeOf(comm, settings, sweep, pattern);
  for (const auto& [name, term] : named) {
    size.damped = size.damped || term.power == 1;
    size.varied = size.varied || term.speedExponent != 0 || term.dampingExponent != 0;
  }
  printCost(comm, settings, pattern, size, false);
}

}  // namespace

void dryRun(MPI_Comm comm, const Settings& settings) {
  const sweep::Sweep sweep = sweep::grid(settings.sweep);
  if (!settings.mesh) {
    checkMatrices(comm, settings, sweep);
  } else {
    const Model model = buildModel(comm, settings.mesh->model);
    std::string audit;
    if (settings.mesh->audit)
      audit = "\n" + audit::markdown(auditModel(model, settings.mesh->model, ""));
    try {
      checkModel(model, settings, sweep);
    } catch (const Error&) {
      printLine(comm, audit);
      throw;
    }
    printMesh(*model.mesh, settings.mesh->model);
    printContact(model.contact, comm);
    printSweep(comm, sweep, true);
    const contact::CoupledSystem system(model.bodies, model.contact, model.bonded());
    if (settings.solver.direct)
      printUnknownCost(comm, system.k0(), "-flutter_method direct");
    else
      printCost(comm, settings, system.k0(),
                withContact(sizeOf(comm, settings, sweep, system.k0()), model, settings, sweep),
                setsMayDiffer(model));
    if (settings.mesh->audit) printLine(comm, audit);
  }
  printLine(comm,
            "dry run: no fault found in options and files; nothing was solved or written, so "
            "solvers and the steady state are untested");
}

}  // namespace squeal::analysis
