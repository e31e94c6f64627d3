// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The identity of a run, which decides whether it can resume from a checkpoint.
#include <mpi.h>

#include <map>
#include <string>

namespace squeal::checkpoint {

/// Properties that must be the same in a checkpoint and in the run that resumes from it. The key is
/// the name of the property in messages.
using Identity = std::map<std::string, std::string>;

/// Collective. Returns the identity of this run: the number of ranks, the program, and the options
/// except those that do not affect the computed results, such as the options of checkpoints, log
/// and report. An input file is identified by its content, not by its name.
Identity identityOfRun(MPI_Comm comm);

/// Returns a text that describes the first three differences and counts the others; empty if there
/// are none.
std::string difference(const Identity& then, const Identity& now);

/// Not collective. Returns the CRC-32 of bytes, continued from `before`, the CRC-32 of the
/// preceding bytes.
unsigned long checksum(const void* data, std::size_t size, unsigned long before = 0);

}  // namespace squeal::checkpoint
