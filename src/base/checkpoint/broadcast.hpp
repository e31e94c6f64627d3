#pragma once
/// Values of several members are broadcast by their function fields().
#include <mpi.h>

#include <utility>
#include <vector>

#include "base/checkpoint/archive.hpp"
#include "base/system/mpi.hpp"

namespace squeal::checkpoint {

/// Collective. Sets the value on all ranks to that on rank `root`, by `void fields(Stream&,
/// Value&)`.
template <class Value>
void broadcast(MPI_Comm comm, Value& value, int root) {
  const bool isRoot = mpi::rank(comm) == root;
  std::vector<char> bytes;
  if (isRoot) {
    Stream stream;
    stream(value);
    for (const auto piece : stream.pieces()) bytes.insert(bytes.end(), piece.begin(), piece.end());
  }
  mpi::broadcast(comm, bytes, root);
  if (!isRoot) Stream(std::move(bytes))(value);
}

}  // namespace squeal::checkpoint
