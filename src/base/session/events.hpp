#pragma once
/// What happens in a run is told to programs, and on a terminal by one line that moves.
#include <mpi.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace squeal {

/// Collective. Opens the file of -log_json, if it is given, to append to it, and begins the moving
/// line if the run has a terminal (-progress). The first event is `start`. Throws Error if the file
/// cannot be opened, or is neither a log of events, nor empty, nor a device.
void beginEvents(MPI_Comm comm);
/// Returns the path of -log_json; empty if it is not given.
std::string eventsFile();
/// Not collective. Ends the line, and writes the event `end` with the exit code.
void endEvents(int exitCode);

/// Not collective. Appends an event with the time, the seconds since the start and these members,
/// as an object on a line of its own; on rank 0, if there is a file. A failure to write ends the
/// log with a warning, not the run.
void tellEvent(const std::string& event, nlohmann::ordered_json members);

/// Not collective. Tells the number of points of the sweep in all, and that some more are done.
void expectPoints(std::size_t count);
void pointsDone(std::size_t count);

/// Not collective. The line shows this stage from here on; none for an empty name.
void showStage(const std::string& stage);
/// While a LineAway lives, the moving line is away, so that other lines can be printed.
class LineAway {
 public:
  LineAway();
  ~LineAway();
  LineAway(const LineAway&) = delete;
  LineAway& operator=(const LineAway&) = delete;
};

}  // namespace squeal
