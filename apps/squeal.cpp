// SPDX-License-Identifier: BSD-2-Clause
/// squeal: flutter of the steady sliding state of brakes. The method itself is
/// squeal::analysis::analyse (src/analysis/analysis.cpp).
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
    "names a mesh, materials, "
    "supports,\n"
    "loads and contact surfaces, or matrices; options that follow it replace what it says. A list "
    "is separated by commas.\n"
    "  -dry_run   checks a case, and says what its run would take\n"
    "  -help      the manual: all options with units, defaults and ranges; -help STAGE: those of "
    "one stage\n"
    "  -help_json the same for programs; -help_json STAGE\n"
    "  -version   versions of this program and of its libraries\n"
    "Exit code: 0 done, 2 some point or stage has no result, 3 asked to stop (SIGTERM, SIGUSR1; "
    "-resume goes on), 1 error.\n";

/// Prints an error and reports it to other programs.
void tellError(const squeal::Session& session, const std::string& message, bool onAllRanks) {
  squeal::tellEvent("error", {{"text", message}});
  const squeal::LineAway away;
  if (onAllRanks && session.rank() > 0) return;
  std::fprintf(stderr, "squeal: error: %s\n", squeal::escaped(message).c_str());
}

/// The exit code.
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
    return 1;  // a script whose arguments went missing must not believe that it has run
  }
  squeal::analysis::checkOptions();  // first of all: a mistake in them touches no folder
  for (const auto& line : squeal::replacedSettings()) squeal::say(session.comm(), line);
  if (squeal::analysis::dryRunWanted()) {
    squeal::analysis::dryRun(session.comm());
    return 0;
  }
  squeal::beginEvents(session.comm());
  squeal::report::Directory directory(session.comm());
  if (const auto settings = squeal::matrices::ExportSettings::given(); settings.wanted())
    squeal::matrices::requireExportFolder(session.comm(), settings, directory.path());
  squeal::analysis::Analysis analysis =
      squeal::analysis::analyse(session.comm(), directory.interrupted() / "checkpoint",
                                squeal::report::Settings::given().modes);
  try {
    squeal::report::write(analysis, directory);
  } catch (const squeal::Error&) {
    if (analysis.checkpoint.exists())
      squeal::complain(session.comm(),
                       "the checkpoint is kept: -resume writes the results again; "
                       "they need room beside it");
    throw;
  }
  if (analysis.interrupted) return 3;
  analysis.checkpoint.remove();
  squeal::report::removeInterrupted(session.comm(), directory);
  for (const auto& line : squeal::unusedOptions()) squeal::say(session.comm(), line);
  return analysis.converged()
             ? 0
             : 2;  // instability is a result; a point without steady state or a failed one is not
} catch (const squeal::Error& error) {
  tellError(session, error.what(), true);
  return 1;
} catch (const std::bad_alloc&) {  // perhaps on this rank alone
  squeal::outOfMemory();
} catch (const std::exception& error) {  // of this rank alone: the others wait for it
  tellError(session, "rank " + std::to_string(session.rank()) + ": " + error.what(), false);
  squeal::performLastActs();
  MPI_Abort(session.comm(), 1);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  const squeal::Session session(argc, argv);
  const int code = run(session);
  squeal::endEvents(code);
  if (squeal::outputError() == 0 || session.rank() != 0) return code;
  std::fprintf(stderr, "squeal: error: cannot write to the standard output: %s%s\n",
               std::strerror(squeal::outputError()),
               code == 1 ? "" : "; what was written to files is complete");
  return 1;
}
