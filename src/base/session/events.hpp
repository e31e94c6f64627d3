// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Reports progress events to other programs, and as a status line on a terminal.
#include <mpi.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/session/settings.hpp"

namespace squeal {

/// Collective. Opens the file of -log_json, if given, for appending, and starts the status line if
/// -progress selects it. The first event is `start`. Throws Error if the file cannot be opened, or
/// if it exists and is not an event log; an empty file or a device is accepted.
void beginEvents(MPI_Comm comm, const OutputSettings& settings);
/// Not collective. Erases the status line, and writes the event `end` with the exit code.
void endEvents(int exitCode);

/// Not collective. On rank 0, if there is a file, appends an event as a JSON object on its own
/// line, with the time, the seconds since the start and these members. If a write fails, the
/// program prints a warning and closes the log, and the run continues.
void logEvent(const std::string& event, nlohmann::ordered_json members);

/// Not collective. expectPoints() sets the total number of points of the sweep, and pointsDone()
/// adds completed points.
void expectPoints(std::size_t count);
void pointsDone(std::size_t count);

/// Not collective. Shows this stage in the status line from here on, or no stage if the name is
/// empty.
void showStage(const std::string& stage);
/// Clears the status line during the object's lifetime, so that other lines can be printed.
class ClearedLine {
 public:
  ClearedLine();
  ~ClearedLine();
  ClearedLine(const ClearedLine&) = delete;
  ClearedLine& operator=(const ClearedLine&) = delete;
};

}  // namespace squeal
