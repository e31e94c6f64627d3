#pragma once
/// The identity of a run tells whether it can continue from a checkpoint.
#include <mpi.h>

#include <map>
#include <string>

namespace squeal::checkpoint {

/// What a checkpoint must agree in with the run that continues it, by names for messages.
using Identity = std::map<std::string, std::string>;

/// Collective. Returns what this run must agree in with one that it continues: the number of ranks,
/// the program, and the options but for those of the report. Of files the content counts, not the
/// name.
Identity identityOfRun(MPI_Comm comm);

/// Returns a sentence on the first three things in which the two differ; empty if they agree.
std::string difference(const Identity& then, const Identity& now);

/// Not collective. Returns the CRC-32 of bytes, continued from that of the bytes before them.
unsigned long checksum(const void* data, std::size_t size, unsigned long before = 0);

}  // namespace squeal::checkpoint
