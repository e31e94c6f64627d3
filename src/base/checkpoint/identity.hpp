// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The identity of a run, which decides whether it can resume from a checkpoint.
#include <mpi.h>

#include <map>
#include <string>

namespace squeal::checkpoint {

/// Properties that a checkpoint and the run that resumes it must share, by names for messages.
using Identity = std::map<std::string, std::string>;

/// Collective. Returns the identity of this run: the number of ranks, the program, and the options
/// except those of the report. Files count by content, not by name.
Identity identityOfRun(MPI_Comm comm);

/// Returns a sentence on the first three differences; empty if there are none.
std::string difference(const Identity& then, const Identity& now);

/// Not collective. Returns the CRC-32 of bytes, continued from the CRC-32 of preceding bytes.
unsigned long checksum(const void* data, std::size_t size, unsigned long before = 0);

}  // namespace squeal::checkpoint
