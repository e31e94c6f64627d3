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
  const std::size_t states = sweep.frictions.size() * sweep.speeds.size() * sweep.pressures.size();
  std::string text =
      formatted("%-12s %zu points: %zu frictions x %zu speeds x %zu pressures x %zu dampings",
                "sweep", states * sweep.dampings.size(), sweep.frictions.size(),
                sweep.speeds.size(), sweep.pressures.size(), sweep.dampings.size());
  if (steady) text += formatted("; %zu steady states", states);
  printLine(comm, text);
}

std::string duration(double seconds) {
  if (seconds < 90) return formatted("%.2g s", std::max(seconds, 1.0));
  if (seconds < 90 * 60) return formatted("%.2g min", seconds / 60);
  return formatted("%.2g h", seconds / 3600);
}

/// Returns the size of the run with the matrix K0, as far as it is independent of contact.
RunSize sizeOf(MPI_Comm comm, const Settings& settings, const sweep::Sweep& sweep, Mat k0) {
  PetscInt unknowns = 0;
  check(MatGetSize(k0, &unknowns, nullptr));
  const factor::FactorSize factor = factor::factorSize(k0);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  RunSize size;
  size.unknowns = unknowns;
  size.modes =
      std::min<PetscInt>(settings.solver.modes.value_or(modes::Settings()).count, unknowns);
  size.points =
      sweep.frictions.size() * sweep.speeds.size() * sweep.pressures.size() * sweep.dampings.size();
  size.factorBytes = factor.bytes;
  size.factorEntries = factor.entries;
  size.factorFlops = factor.operations;
  size.bytesInUse = mpi::sum(comm, 1024.0 * usage.ru_maxrss);
  for (const auto& stage : stageRecords()) size.secondsSoFar += stage.seconds;
  return size;
}

/// Collective. Prints estimates of memory and time, for points that have the same active set and,
/// if `separates` (contact can open), for points that have different ones: two points then share a
/// basis.
void printCost(MPI_Comm comm, const Settings& settings, const RunSize& size, bool separates) {
  if (settings.solver.direct) {
    printLine(comm, formatted("%-12s %.0f; memory and time are not estimated for -flutter_method "
                              "direct",
                              "unknowns", size.unknowns));
    return;
  }
  const double machine = 1.0 * sysconf(_SC_PHYS_PAGES) * sysconf(_SC_PAGESIZE);
  const double speed = denseSpeed(comm);
  const RunCost one = runCost(size, 1, speed);
  std::string memory = formatted("about %.2g GB on all ranks", 1e-9 * one.bytes);
  std::string time = "about " + duration(one.seconds);
  if (separates && size.steadyPoints > 1) {
    const RunCost several = runCost(size, std::ceil(size.steadyPoints / 2), speed);
    const std::string whenever = " if the closed contact nodes change with the friction";
    if (several.bytes > 1.05 * one.bytes)
      memory += formatted(", %.2g GB", 1e-9 * several.bytes) + whenever;
    time += ", " + duration(several.seconds) + whenever;
  }
  printLine(comm, formatted("%-12s %.0f, %.3g million entries in the factor", "unknowns",
                            size.unknowns, 1e-6 * size.factorEntries));
  printLine(comm, formatted("%-12s %s; in use now %.2g GB; this machine has %.3g GB", "memory",
                            memory.c_str(), 1e-9 * size.bytesInUse, 1e-9 * machine));
  if (settings.regime.enabled()) time += "; without the motion after flutter";
  printLine(comm, formatted("%-12s %s", "time", time.c_str()));
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

bool hasFrictionDamping(const Model& model, const Settings& settings, const sweep::Sweep& sweep) {
  return settings.mesh->terms.frictionDamping &&
         (model.mesh->dimension == 3 || !model.contact.law.constant()) &&
         std::ranges::any_of(sweep.frictions,
                             [&](double f) { return model.contact.hasFriction(f); });
}

void checkMatrices(MPI_Comm comm, const Settings& settings, const sweep::Sweep& sweep) {
  if (settings.referee) readList(comm, settings, sweep);
  const auto named = readMatrices(comm, settings, sweep);
  OwnedMat pattern;  // of K0
  for (const auto& [name, term] : named) {
    MatInfo info;
    PetscInt rows = 0;
    check(MatGetInfo(term.matrix, MAT_GLOBAL_SUM, &info));
    check(MatGetSize(term.matrix, &rows, nullptr));
    printLine(comm, formatted("%-12s %s: %" PetscInt_FMT
                              " rows, %.0f entries, with s^%d, friction^%d, speed^%d, damping^%d",
                              "matrix", name.c_str(), rows, info.nz_used, term.power,
                              term.frictionExponent, term.speedExponent, term.dampingExponent));
    if (term.power != 0) continue;
    if (!pattern)
      check(MatDuplicate(term.matrix, MAT_COPY_VALUES, pattern.out()));
    else
      check(MatAXPY(pattern, 1, term.matrix, DIFFERENT_NONZERO_PATTERN));
  }
  printSweep(comm, sweep, false);
  PetscInt unknowns = 0;
  check(MatGetSize(named.front().term.matrix, &unknowns, nullptr));
  warnOfDenseWork(comm, settings, sweep, unknowns);
  if (!pattern) return;
  RunSize size = sizeOf(comm, settings, sweep, pattern);
  for (const auto& [name, term] : named) size.damped = size.damped || term.power == 1;
  printCost(comm, settings, size, false);
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
    RunSize size = sizeOf(comm, settings, sweep, system.k0());
    size.steadyPoints = sweep.steadyPoints().size();
    size.contactUnknowns = contactUnknowns(model);
    const bool convected = model.contact.sliding.convected;
    size.varied = convected || model.bodies.damping;
    size.damped = size.varied || hasFrictionDamping(model, settings, sweep);
    size.pointTerms = convected ? 3 : size.damped ? 1 : 0;
    printCost(comm, settings, size, size.contactUnknowns > 0);
    if (settings.mesh->audit) printLine(comm, audit);
  }
  printLine(comm,
            "dry run: no fault found in options and files; nothing was solved or written, so "
            "solvers and the steady state are untested");
}

}  // namespace squeal::analysis
