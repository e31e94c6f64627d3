// SPDX-License-Identifier: BSD-2-Clause
#include "base/checkpoint/identity.hpp"

#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <vector>

#include "base/options/options.hpp"
#include "base/petsc/check.hpp"
#include "base/session/session.hpp"
#include "base/system/text.hpp"

namespace squeal::checkpoint {
namespace {

constexpr const char* rankCount = "the number of ranks";

/// Returns true for an option that does not affect the computed results.
bool isIndifferent(const std::string& name) {
  static const std::vector<std::string> exact{"resume", "checkpoint",  "checkpoint_interval",
                                              "quiet",  "progress",    "log_json",
                                              "audit",  "options_file"};
  return std::ranges::find(exact, name) != exact.end() || name.starts_with("report_") ||
         name.starts_with("log_");
}

/// Collective. Returns the checksum of a file as a text; empty if it cannot be read.
std::string checksumOfFile(MPI_Comm comm, const std::string& path) {
  unsigned long sum = 0;
  bool whole = false;
  if (mpi::rank(comm) == 0) {
    std::ifstream file(path, std::ios::binary);
    std::vector<char> piece(1 << 20);
    while (file.read(piece.data(), std::ssize(piece)) || file.gcount() > 0)
      sum = checksum(piece.data(), file.gcount(), sum);
    whole = file.eof();
  }
  mpi::broadcast(comm, sum);
  mpi::broadcast(comm, whole);
  return whole ? formatted("checksum %08lx", sum) : "";
}

}  // namespace

std::string difference(const Identity& then, const Identity& now) {
  const auto text = [](const Identity& of, const std::string& name) {
    const auto found = of.find(name);
    return found == of.end() ? std::string("not given") : "'" + found->second + "'";
  };
  Identity both = then;
  both.insert(now.begin(), now.end());
  std::vector<std::string> names{
      rankCount};  // first, since the distribution of the mesh depends on it
  for (const auto& [name, value] : both) names.push_back(name);
  std::set<std::string> differing;
  std::string sentence;
  constexpr std::size_t most = 3;
  for (const auto& name : names)
    if (text(then, name) != text(now, name) && differing.insert(name).second &&
        differing.size() <= most)
      sentence += (sentence.empty() ? "" : "; ") + name + " was " + text(then, name) + " and is " +
                  text(now, name);
  if (differing.size() > most) sentence += formatted("; and %zu more", differing.size() - most);
  return sentence;
}

unsigned long checksum(const void* data, std::size_t size, unsigned long before) {
  // The pointer may be null if there are no bytes, and zlib restarts the sum for a null pointer.
  return size == 0 ? before : crc32_z(before, static_cast<const Bytef*>(data), size);
}

Identity identityOfRun(MPI_Comm comm) {
  Identity identity{{rankCount, std::to_string(mpi::size(comm))}};
  // The layout of entries depends on the program's data structures.
  identity["the program"] = std::string(version()) + ", " + checksumOfFile(comm, "/proc/self/exe");
  for (const auto& [name, value] : givenOptions())
    if (FileOption::isDeclared(name))
      identity["the file of option -" + name] = checksumOfFile(comm, value);
    else if (!isIndifferent(name))
      identity["option -" + name] = value;
  return identity;
}

}  // namespace squeal::checkpoint
