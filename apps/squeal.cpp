// SPDX-License-Identifier: BSD-2-Clause
/// squeal: flutter of the steady sliding state of brakes. The method itself is
/// squeal::analysis::analyse (src/run/analysis/analysis.cpp).
#include <cstdio>
#include <cstring>
#include <new>
#include <nlohmann/json.hpp>
#include <string>

#include "base/options/options.hpp"
#include "base/options/settings.hpp"
#include "base/session/events.hpp"
#include "base/session/session.hpp"
#include "base/session/stages.hpp"
#include "base/system/blas_kernel.hpp"
#include "base/system/memory.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"
#include "problem/matrices/write.hpp"
#include "run/analysis/analysis.hpp"
#include "run/analysis/dry_run.hpp"
#include "run/report/report.hpp"
#include "run/report/settings.hpp"

namespace {

constexpr const char* usage =
    "usage: squeal -options_file CASE.yaml [-option value …]\n"
    "       mpirun -n 4 squeal -options_file CASE.yaml -report_dir results/case -flutter_friction "
    "0,0.2,0.4\n"
    "\n"
    "Finds which modes of a brake squeal: flutter of the steady sliding of pads on a disc. A case "
    "defines a mesh, materials, supports,\n"
    "loads and contact surfaces, or matrices; later options override it. Lists are separated by "
    "commas.\n"
    "  -dry_run   checks a case, and estimates memory and time of its run\n"
    "  -help      the manual: all options with units, defaults and ranges; -help STAGE: those of "
    "one stage\n"
    "  -help_json the same for programs; -help_json STAGE\n"
    "  -version   versions of this program and of its libraries\n"
    "Exit code: 0 done, 1 error, 2 a point or stage has no result, 3 stopped on request (SIGTERM, "
    "SIGUSR1; -resume continues).\n";

/// Prints an error and reports it to other programs.
void reportError(const squeal::Session& session, const std::string& message, bool onAllRanks) {
  squeal::logEvent("error", {{"text", message}});
  const squeal::ClearedLine away;
  if (onAllRanks && session.rank() > 0) return;
  std::fprintf(stderr, "squeal: error: %s\n", squeal::escaped(message).c_str());
}

/// Runs the program and returns its exit code.
int run(const squeal::Session& session) try {
  if (session.helpWanted() || session.helpJsonWanted()) {
    const std::string page = session.helpJsonWanted() ? squeal::manualAsJson(session.helpStage())
                                                      : squeal::manual(session.helpStage());
    if (session.rank() == 0) squeal::print(page);
    return 0;
  }
  if (session.versionWanted()) {
    if (session.rank() == 0) squeal::print(squeal::versions());
    return 0;
  }
  if (!session.optionsGiven()) {
    if (session.rank() == 0) std::fputs(usage, stderr);
    return 1;  // a script that has lost its arguments must not take this for a run
  }
  // All settings are read first, so that an error in them leaves all folders untouched.
  const auto settings = squeal::analysis::Settings::given();
  const auto reporting =
      squeal::report::Settings::given(settings.pencil.method == squeal::pencil::Method::reduced,
                                      settings.mesh.has_value(), settings.output.eventLog);
  squeal::setQuiet(settings.output.quiet);
  for (const auto& line : squeal::replacedSettings()) squeal::printLine(session.comm(), line);
  if (!settings.dryRun) squeal::beginEvents(session.comm(), settings.output);
  squeal::warnIfBlasDiffers(session.comm());
  if (settings.dryRun) {
    squeal::analysis::dryRun(session.comm(), settings);
    return 0;
  }
  squeal::report::Directory directory(session.comm(), reporting,
                                      squeal::sweep::grid(settings.sweep).points());
  if (settings.matrixExport.wanted())
    squeal::matrices::requireExportFolder(session.comm(), settings.matrixExport, directory.path());
  squeal::analysis::Analysis analysis = squeal::analysis::analyse(
      session.comm(), settings, directory.interrupted() / "checkpoint", reporting.modes);
  try {
    squeal::report::write(analysis, reporting, directory);
  } catch (const squeal::Error&) {
    if (analysis.checkpoint.exists())
      squeal::printWarning(session.comm(),
                           "the checkpoint stays: -resume writes the results again; they need "
                           "additional disk space");
    throw;
  }
  if (analysis.interrupted()) return 3;
  analysis.checkpoint.remove();
  squeal::report::removeInterrupted(session.comm(), directory);
  for (const auto& line : squeal::unusedOptions()) squeal::printLine(session.comm(), line);
  // Instability is a result; a failed point or one without a steady state is not.
  return analysis.converged() ? 0 : 2;
} catch (const squeal::Error& error) {
  reportError(session, error.what(), true);
  return 1;
} catch (const std::bad_alloc&) {  // perhaps only on this rank
  squeal::outOfMemory();
} catch (const std::exception& error) {  // only on this rank; the others wait for it
  reportError(session, "rank " + std::to_string(session.rank()) + ": " + error.what(), false);
  squeal::runTerminationHandlers();
  MPI_Abort(session.comm(), 1);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  squeal::restartWithBlasKernel(argv);
  const squeal::Session session(argc, argv);
  const int code = run(session);
  squeal::endEvents(code);
  if (squeal::outputError() == 0 || session.rank() != 0) return code;
  std::fprintf(stderr, "squeal: error: cannot write to the standard output: %s%s\n",
               std::strerror(squeal::outputError()), code == 1 ? "" : "; the files are complete");
  return 1;
}
