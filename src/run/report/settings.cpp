// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/settings.hpp"

#include <algorithm>
#include <filesystem>

#include "base/options/options.hpp"

namespace squeal::report {
namespace {

const TextOption directoryOption("report", "report_dir", "results",
                                 "folder for the results: a new or empty one, or one with earlier "
                                 "results, which are replaced when the new ones are complete");
const TextOption noteOption("report", "report_note", "none",
                            "remark that is repeated in the log, the summary and the report, such "
                            "as a list of the parts of a model that an import has omitted");
const FlagOption fieldsOption(
    "report", "report_fields", true,
    "fields in results.h5 and in VTK files; off: these files are not written");
const IntegerOption modesOption("report", "report_modes", 10, 0, 100'000,
                                "number of free modes whose fields are written");
const IntegerOption animatedOption("report", "report_animated", 1, 0, 1000,
                                   "number of complex modes, the fastest growing ones of the whole "
                                   "sweep, that are stored as a time series over one period");
const IntegerOption piecesOption("report", "report_pieces", 8, 1, 1'000'000,
                                 "largest number of VTK files per field; if there are more ranks, "
                                 "neighbouring ranks share a file");
const IntegerOption framesOption("report", "report_frames", 16, 4, 1000,
                                 "number of frames per period of an animated mode");

/// Returns true if the folder belongs to the case: an options file names it, or it is results/NAME
/// for the case NAME.yaml, as with scripts/run.
bool isOfCase(const std::filesystem::path& folder) {
  if (!origin("report_dir", folder.string()).file.empty()) return true;
  const auto place = (std::filesystem::absolute(folder) / "").lexically_normal().parent_path();
  if (place.parent_path().filename() != "results") return false;
  return std::ranges::any_of(givenOptions(), [&](const auto& option) {
    const std::filesystem::path file = origin(option.first, option.second).file;
    return !file.empty() && file.stem() == place.filename();
  });
}

}  // namespace

Settings Settings::given(bool isReduced, bool ofMesh, const std::string& eventLog) {
  Settings settings;
  settings.eventLog = eventLog;
  settings.folder = directoryOption.get();
  settings.folderOfCase = isOfCase(settings.folder);
  settings.note = noteOption.get() == "none" ? "" : noteOption.get();
  settings.fields = fieldsOption.get();
  if (isReduced) settings.modes = modesOption.get();
  if (settings.fields && ofMesh) {
    settings.animated = animatedOption.get();
    settings.frames = framesOption.get();
    settings.pieces = piecesOption.get();
  }
  return settings;
}

}  // namespace squeal::report
