// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Serialises values to bytes and back, and broadcasts values of any serialisable type.
#include <mpi.h>

#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/system/error.hpp"
#include "base/system/mpi.hpp"

namespace squeal {

/// Writes values consecutively as bytes, or reads them back in the same order. To make a type of
/// several members serialisable, define `void fields(Stream&, T&)` in its namespace; it lists all
/// members once, for both directions. Numbers and other trivially copyable types, lists, texts,
/// optional values, pairs and maps of serialisable types are serialisable already.
class Stream {
 public:
  /// Makes an empty stream to write to.
  Stream() = default;
  /// Takes bytes that another stream has written, in order to read them. `damage` is the message of
  /// the Error that a read throws if the bytes do not contain the value.
  explicit Stream(std::vector<char> bytes, std::string damage = "serialised values are damaged")
      : bytes_(std::move(bytes)), damage_(std::move(damage)), reads_(true) {}
  bool reads() const { return reads_; }
  /// Returns true if all bytes have been read.
  bool atEnd() const { return read_ == bytes_.size(); }
  /// Returns the bytes written, as consecutive pieces; borrowed.
  std::vector<std::span<const char>> pieces() const {
    std::vector<std::span<const char>> all;
    for (const auto& [bytes, borrowed, owner] : written_) {
      all.emplace_back(bytes);
      if (!borrowed.empty()) all.push_back(borrowed);
    }
    all.emplace_back(bytes_);
    return all;
  }
  /// Returns a copy of the bytes written.
  std::vector<char> bytes() const& {
    std::vector<char> all;
    for (const auto& piece : pieces()) all.insert(all.end(), piece.begin(), piece.end());
    return all;
  }
  /// Returns the bytes written; the stream must not be used afterwards.
  std::vector<char> bytes() && {
    return written_.empty() ? std::move(bytes_) : std::as_const(*this).bytes();
  }
  /// Not collective. Writes bytes without a copy: during its lifetime the stream borrows them and
  /// shares `owner`, which keeps them valid.
  void borrow(std::span<const char> bytes, std::shared_ptr<const void> owner = {}) {
    written_.push_back({std::move(bytes_), bytes, std::move(owner)});
    bytes_.clear();
  }
  /// Not collective. Writes `size` bytes from `data`, or reads `size` bytes into `data`. Throws
  /// Error if fewer are left to read.
  void raw(void* data, std::size_t size) {
    if (!reads_) {
      const auto* from = static_cast<const char*>(data);
      bytes_.insert(bytes_.end(), from, from + size);
      return;
    }
    if (size > bytes_.size() - read_) throw Error(damage_);
    if (size > 0) std::memcpy(data, bytes_.data() + read_, size);
    read_ += size;
  }
  /// Not collective. Writes or reads these values. Throws Error if the bytes do not contain them.
  template <class... Values>
  void operator()(Values&... values) {
    (serialise(values), ...);
  }

 private:
  template <class Value>
  void serialise(Value& value) {
    if constexpr (requires { fields(*this, value); }) {
      fields(*this, value);
    } else {
      static_assert(std::is_trivially_copyable_v<Value> && !std::is_pointer_v<Value>);
      raw(&value, sizeof value);
    }
  }
  /// Writes or reads a number of elements. Throws Error if a number that was read exceeds the
  /// number of bytes.
  void serialiseCount(std::size_t& count) {
    serialise(count);
    if (reads_ && count > bytes_.size()) throw Error(damage_);
  }
  template <class Value>
  void serialise(std::vector<Value>& values) {
    std::size_t count = values.size();
    serialiseCount(count);
    if (reads_) values.resize(count);
    if constexpr (std::is_trivially_copyable_v<Value> &&
                  !requires(Stream & stream, Value & value) { fields(stream, value); })
      raw(values.data(), count * sizeof(Value));
    else
      for (auto& value : values) serialise(value);
  }
  void serialise(std::string& text) {
    std::size_t count = text.size();
    serialiseCount(count);
    if (reads_) text.resize(count);
    raw(text.data(), count);
  }
  template <class Value>
  void serialise(std::optional<Value>& value) {
    bool has = value.has_value();
    serialise(has);
    if (reads_ && has) value.emplace();
    if (reads_ && !has) value.reset();
    if (has) serialise(*value);
  }
  template <class First, class Second>
  void serialise(std::pair<First, Second>& both) {
    serialise(both.first);
    serialise(both.second);
  }
  template <class Key, class Value>
  void serialise(std::map<Key, Value>& values) {
    std::vector<std::pair<Key, Value>> entries;
    if (!reads_) entries.assign(values.begin(), values.end());
    serialise(entries);
    if (reads_) values = std::map<Key, Value>(entries.begin(), entries.end());
  }

  /// Bytes, followed by borrowed ones.
  struct Written {
    std::vector<char> bytes;
    std::span<const char> borrowed;
    std::shared_ptr<const void> owner;
  };
  std::vector<Written> written_;
  std::vector<char> bytes_;  // the bytes written last, or the bytes to read
  std::string damage_;
  std::size_t read_ = 0;
  bool reads_ = false;
};

/// Collective. Copies a value of any serialisable type from rank `root` to all ranks.
template <class Value>
void broadcast(MPI_Comm comm, Value& value, int root = 0) {
  if (mpi::size(comm) == 1) return;
  const bool sends = mpi::rank(comm) == root;
  std::vector<char> bytes;
  if (sends) {
    Stream stream;
    stream(value);
    bytes = stream.bytes();
  }
  mpi::broadcast(comm, bytes, root);
  if (sends) return;
  Stream stream(std::move(bytes));
  stream(value);
  ensure(stream.atEnd(), "a broadcast value is read completely");
}

}  // namespace squeal
