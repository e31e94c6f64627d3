// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Collective operations of MPI on single values, lists and texts. An MPI call that fails ends the
/// run: the error handler of a communicator is MPI_ERRORS_ARE_FATAL.
#include <mpi.h>

#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace squeal::mpi {

/// Returns the MPI datatype of a number.
template <class Number>
MPI_Datatype typeOf() {
  if constexpr (std::is_same_v<Number, double>) return MPI_DOUBLE;
  if constexpr (std::is_same_v<Number, std::complex<double>>) return MPI_CXX_DOUBLE_COMPLEX;
  if constexpr (std::is_same_v<Number, char>) return MPI_CHAR;
  if constexpr (std::is_integral_v<Number> && !std::is_same_v<Number, char>) {
    if constexpr (sizeof(Number) == 1)
      return std::is_signed_v<Number> ? MPI_INT8_T : MPI_UINT8_T;
    else if constexpr (sizeof(Number) == 4)
      return std::is_signed_v<Number> ? MPI_INT32_T : MPI_UINT32_T;
    else
      return std::is_signed_v<Number> ? MPI_INT64_T : MPI_UINT64_T;
  }
}

/// Not collective. Returns the number of this rank.
int rank(MPI_Comm comm);
/// Not collective. Returns the number of ranks.
int size(MPI_Comm comm);

/// Not collective. Returns the number of reductions and broadcasts by the functions of this file
/// that this rank has taken part in so far, on communicators with several ranks.
double reductionsSoFar();

/// Collective. Replaces `count` values of a type by their reductions over all ranks. `count` may
/// exceed an int.
void reduceValues(MPI_Comm comm, void* values, std::size_t count, MPI_Datatype type,
                  MPI_Op operation);
/// Collective. Replaces each value by its reduction with `operation` over all ranks.
template <class Number>
void reduce(MPI_Comm comm, std::span<Number> values, MPI_Op operation) {
  reduceValues(comm, values.data(), values.size(), typeOf<Number>(), operation);
}

/// Collective. Returns the sum of the values of all ranks.
template <class Number>
Number sum(MPI_Comm comm, Number value) {
  reduce<Number>(comm, {&value, 1}, MPI_SUM);
  return value;
}
/// Collective. Returns the largest of the values of all ranks.
template <class Number>
Number max(MPI_Comm comm, Number value) {
  reduce<Number>(comm, {&value, 1}, MPI_MAX);
  return value;
}
/// Collective. Returns the smallest of the values of all ranks.
template <class Number>
Number min(MPI_Comm comm, Number value) {
  reduce<Number>(comm, {&value, 1}, MPI_MIN);
  return value;
}
/// Collective. Replaces each value by its sum over all ranks, with the same round-off on all ranks.
void sumAlike(MPI_Comm comm, std::span<double> values);

/// Collective. Returns the sum of the values of the ranks before this one.
template <class Number>
Number sumBefore(MPI_Comm comm, Number value) {
  Number before = 0;
  MPI_Exscan(&value, &before, 1, typeOf<Number>(), MPI_SUM, comm);
  return rank(comm) == 0 ? Number(0) : before;  // MPI leaves the value of rank 0 undefined
}

/// A value and the lowest rank that has it.
struct Located {
  double value;
  int rank;
};
/// Collective. Return the largest and the smallest of the values of all ranks.
Located maxLocated(MPI_Comm comm, double value);
Located minLocated(MPI_Comm comm, double value);

/// Collective. Returns true if the value is true on any rank.
bool any(MPI_Comm comm, bool value);
/// Collective. Returns true if the value is true on all ranks.
bool all(MPI_Comm comm, bool value);

/// Collective. Copies `count` bytes from rank `root` to all ranks; `count` may exceed an int.
void broadcastBytes(MPI_Comm comm, void* bytes, std::size_t count, int root);
/// Collective. Copies the value from rank `root` to all ranks.
template <class Value>
void broadcast(MPI_Comm comm, Value& value, int root = 0) {
  static_assert(std::is_trivially_copyable_v<Value> && !std::is_pointer_v<Value>);
  broadcastBytes(comm, &value, sizeof value, root);
}
/// Collective. Copies the list, its length included, from rank `root` to all ranks.
template <class Value>
void broadcast(MPI_Comm comm, std::vector<Value>& values, int root = 0) {
  static_assert(std::is_trivially_copyable_v<Value> && !std::is_pointer_v<Value>);
  std::size_t count = values.size();
  broadcast(comm, count, root);
  values.resize(count);
  broadcastBytes(comm, values.data(), count * sizeof(Value), root);
}
/// Collective. Copies entries from rank `root` to all ranks. All ranks must have the same number of
/// entries.
template <class Entry>
void broadcastEntries(MPI_Comm comm, std::span<Entry> entries, int root = 0) {
  static_assert(std::is_trivially_copyable_v<Entry> && !std::is_pointer_v<Entry>);
  broadcastBytes(comm, entries.data(), entries.size_bytes(), root);
}
/// Collective. Copies the text from rank `root` to all ranks.
void broadcast(MPI_Comm comm, std::string& text, int root = 0);

}  // namespace squeal::mpi
