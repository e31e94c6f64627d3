// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/dry_run.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

#include "algebra/factor/symmetric_solver.hpp"
#include "base/options/options.hpp"
#include "base/session/stages.hpp"
#include "base/system/text.hpp"
#include "eigen/sweep/sweep.hpp"
#include "model/contact/coupled.hpp"
#include "model/mesh/mesh.hpp"
#include "run/analysis/analysis.hpp"
#include "run/analysis/checks.hpp"
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

/// Collective. Prints the memory in use (mesh, matrices, libraries) and estimates of the memory for
/// the factor of K0, by the analysis of MUMPS, and for the basis and its products: about
/// `vectorsPerMode` vectors per free mode, measured with 53,151 to 225,715 unknowns in three
/// dimensions and 119,600 in the plane.
void printMemory(MPI_Comm comm, const Settings& settings, Mat k0) {
  constexpr double vectorsPerMode = 12;
  PetscInt unknowns = 0;
  MatInfo info;
  check(MatGetSize(k0, &unknowns, nullptr));
  check(MatGetInfo(k0, MAT_GLOBAL_SUM, &info));
  const int modes =
      std::min<PetscInt>(settings.solver.modes.value_or(modes::Settings()).count, unknowns);
  const double factor = factor::factorMemory(k0);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double held = mpi::sum(comm, 1024.0 * usage.ru_maxrss);
  const double vectors = 8.0 * vectorsPerMode * modes * unknowns;
  const double machine = 1.0 * sysconf(_SC_PHYS_PAGES) * sysconf(_SC_PAGESIZE);
  printLine(comm, formatted("%-12s %" PetscInt_FMT ", %.0f entries in the stiffness", "unknowns",
                            unknowns, info.nz_used));
  printLine(
      comm,
      formatted("%-12s about %.2g GB on all ranks: %.2g in use now, %.2g for the factor, %.2g "
                "for vectors of %d modes; this machine "
                "has %.3g GB",
                "memory", 1e-9 * (held + factor + vectors), 1e-9 * held, 1e-9 * factor,
                1e-9 * vectors, modes, 1e-9 * machine));
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
  if (pattern) printMemory(comm, settings, pattern);
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
    printMemory(comm, settings, system.k0());
    if (settings.mesh->audit) printLine(comm, audit);
  }
  printLine(comm,
            "dry run: no fault found in options and files; nothing was solved or written, so "
            "solvers and the steady state are untested");
}

}  // namespace squeal::analysis
